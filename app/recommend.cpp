// `footprint recommend`: chooses a method for each material, within a limit of error, cost or size.
#include "experiments/studies/recommend.hpp"

#include <algorithm>
#include <sstream>

#include "app/child_process.hpp"
#include "app/experiment_runs.hpp"
#include "app/folders.hpp"
#include "app/subcommand.hpp"
#include "experiments/studies/quick_advice.hpp"
#include "renderer/core/numbers.hpp"
#include "renderer/languages/compilers.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr const char* recommend_examples =
    R"(Every method is measured under every footprint filter: coarsely first, then the contenders in full. Costs are
frame times relative to `direct` under trilinear lookups. At most one limit can be given; without
one, the smallest error wins.

Examples:
  footprint recommend model.gltf -o advice
  footprint recommend model.gltf --max-error 0.05 --distance 1,2,4,8 -o advice
  footprint recommend model.gltf --max-cost 2 --footprints trilinear,anisotropic:8 -o advice
  footprint recommend model.gltf --max-cost '2@Steam Deck' -o advice
  footprint recommend model.gltf --max-bytes 4000000 --methods direct,toksvig:storage=unorm8,lean:storage=fp16
  footprint recommend model.gltf --quick --max-cost '2@Steam Deck')";

struct RecommendArguments : RunArguments {
  explicit RecommendArguments(CLI::App& command) : RunArguments(command) {
    auto* error = command.add_option("--max-error", limits.max_error,
                                     "Choose the cheapest with at most this error at every distance");
    auto* cost = add_value(command, "--max-cost", max_cost, "R[@GPU]",
                           "Choose the most accurate with at most this cost relative to direct: of frame times, or "
                           "with @GPU as `footprint cost` estimates it");
    auto* bytes = add_value(command, "--max-bytes", limits.max_bytes, "N",
                            "Choose the most accurate with at most this many bytes of maps per material")
                      ->check(within(0.0, 1e18));
    error->excludes(cost)->excludes(bytes);
    cost->excludes(bytes);
    add_value(command, "--footprints", filters, "LIST",
              "Footprint filters to try, comma-separated, as for `compare --footprint`; trilinear is always included")
        ->capture_default_str();
    auto* in_full = command.add_flag("--exhaustive", exhaustive, "Measure every candidate in full");
    auto* quick =
        command.add_flag("--quick", predicted,
                         "Predict errors within a second from the statistics of each normal map: nothing is drawn "
                         "or written, and options of view, reference and timing have no effect");
    quick->excludes(in_full);
    command.add_flag("--json", json, "With --quick: JSON instead of text, for programs")->needs(quick);
    auto* folder = add_output_folder(
        command, output,
        "Folder for index.html, recommend.json, the full runs, and kept/ with the finished work, from which an "
        "interrupted run resumes");
    quick->excludes(folder)->excludes(command.get_option("--fresh"));
  }

  std::string filters = "trilinear,anisotropic:8,shaded:2";
  Limits limits;
  std::string max_cost;  // R or R@GPU
  bool exhaustive = false;
  bool predicted = false;  // by a model, without a measurement
  bool json = false;
  std::string output = "out";
};

// Trilinear is always among them: costs are relative to `direct` with it.
std::vector<FootprintFilter> parse_filters(const std::string& text) {
  std::vector<FootprintFilter> filters{{FootprintFilterKind::trilinear, 1}};
  std::istringstream words(text);
  for (std::string word; std::getline(words, word, ',');) {
    const FootprintFilter filter = parse_footprint_filter(word, "--footprints");
    if (std::ranges::find(filters, filter) == filters.end()) filters.push_back(filter);
  }
  return filters;
}

void require_positive(const char* option, const std::optional<double>& value) {
  if (!value || (*value > 0.0 && std::isfinite(*value))) return;
  throw Error(ErrorKind::usage, option, fmt::format("{} is not a valid limit", *value), "give a number above 0");
}

// Reads `R` or `R@GPU`.
void set_max_cost(const std::string& text, RecommendSettings& settings) {
  if (text.empty()) return;
  const auto at = std::min(text.find('@'), text.size());
  settings.limits.max_cost = parse_whole_of<double>(std::string_view(text).substr(0, at));
  if (!settings.limits.max_cost)
    throw Error(ErrorKind::usage, "--max-cost", fmt::format("`{}` is not a limit", text), "give R or R@GPU, as 2@PS4");
  require_positive("--max-cost", settings.limits.max_cost);
  if (at == text.size()) return;
  const std::vector<const Chip*> chips = chips_named("--max-cost", {text.substr(at + 1)});
  if (chips.size() > 1) throw Error(ErrorKind::usage, "--max-cost", "names several GPUs", "name one");
  settings.limits.gpu = chips.front()->name;
  settings.run.gpus = {settings.limits.gpu};
}

void write_answer(Recommendation answer, const RunFolder& folder) {
  folder.write_document("recommend.json", recommendation_json(answer));
  if (std::string lost = folder.losses_text(); !lost.empty()) answer.scene.warnings.push_back(std::move(lost));
  folder.write_text("index.html", [&] { return recommendation_page(answer); });
}

// The GPU of predicted costs where no limit names one.
constexpr const char* usual_gpu = "Steam Deck";

void run_quick_command(const RecommendArguments& arguments, const RecommendSettings& settings) {
  QuickQuestion question{.methods = settings.run.methods, .limits = settings.limits};
  for (const FootprintFilter& filter : settings.filters) question.filters.push_back(footprint_filter_text(filter));
  if (question.limits.max_cost && question.limits.gpu.empty())
    throw Error(ErrorKind::usage, "--max-cost", "--quick times no frames", "name a GPU: R@GPU");
  if (question.limits.gpu.empty()) question.limits.gpu = usual_gpu;
  const Scene scene = load_scene(settings.run.scene, settings.run.scene_library, settings.run.overrides);
  const QuickAdvice advice = quick_advice(scene, read_quick_model(quick_model_file()), question);
  write_output(arguments.json ? quick_advice_json(advice) : quick_advice_text(advice));
}

void run_recommend_command(const RecommendArguments& arguments) {
  require_positive("--max-error", arguments.limits.max_error);
  RecommendSettings settings{.run = arguments.settings(),
                             .filters = parse_filters(arguments.filters),
                             .limits = arguments.limits,
                             .exhaustive = arguments.exhaustive,
                             .gpu_compiler = amd_compiler()};
  set_max_cost(arguments.max_cost, settings);
  if (arguments.predicted) return run_quick_command(arguments, settings);
  if (!settings.run.gpus.empty()) require_compilers("--max-cost");
  warn_without_captions();
  ProgressDisplay display(progress_style(arguments.quiet));
  const FinishedWork finished =
      finished_work_in(arguments.output, settings.run.backend.context, settings.run.output.fresh);
  const auto [result, path, lost] = write_whole(arguments.output, [&](OutputFolder& folder) {
    const RecommendListener listener{
        .results =
            [](Results& results, const RunFolder& own) {
              sign(results.tool, results.backend);
              write_report(results, own);
            },
        .first_answer =
            [&](const Recommendation& answer) {
              const bool has_page = write_interim(
                  folder, "recommend.json", [&] { return recommendation_json(answer); },
                  [&] { return recommendation_page(answer); });
              display.finish();
              write_output(recommendation_text(answer) + "\n");
              if (has_page && !arguments.quiet)
                write_message(fmt::format("page of the first answer, until the run ends: {}",
                                          (folder.path() / "index.html").string()));
            }};
    Recommendation made = run_recommend(settings, folder.run(), finished, listener, display.callback());
    write_answer(made, folder.run());
    keep(folder);
    return made;
  });
  display.finish();
  write_output(fmt::format("{}\npage: {}\n", recommendation_text(result), (path / "index.html").string()));
  write_reuse(finished, arguments.quiet);
  throw_first({lost});
}

}  // namespace

void add_recommend_command(CLI::App& app) {
  add_command(app, "recommend", "Choose the best method for each material, within a limit", recommend_examples,
              run_recommend_command);
}

}  // namespace footprint
