// `footprint recommend`: chooses a method for each material, within a limit of error, cost or size.
#include "experiments/studies/recommend.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <charconv>
#include <cmath>
#include <memory>
#include <sstream>
#include <string>
#include <vector>

#include "app/child_process.hpp"
#include "app/commands.hpp"
#include "app/experiment_runs.hpp"
#include "app/folders.hpp"
#include "app/messages.hpp"
#include "app/output.hpp"
#include "app/run_options.hpp"
#include "experiments/studies/quick_advice.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr const char* recommend_examples =
    "Every method is measured under every footprint filter: coarsely first, then the contenders in full. Costs are\n"
    "frame times relative to `direct` under trilinear lookups. At most one limit can be given; without\n"
    "one, the smallest error wins.\n"
    "\n"
    "Examples:\n"
    "  footprint recommend model.gltf -o advice\n"
    "  footprint recommend model.gltf --max-error 0.05 --distance 1,2,4,8 -o advice\n"
    "  footprint recommend model.gltf --max-cost 2 --footprints trilinear,anisotropic:8 -o advice\n"
    "  footprint recommend model.gltf --max-cost '2@Steam Deck' -o advice\n"
    "  footprint recommend model.gltf --max-bytes 4000000 --methods direct,toksvig:storage=unorm8,lean:storage=fp16\n"
    "  footprint recommend model.gltf --quick --max-cost '2@Steam Deck'";

struct RecommendArguments {
  explicit RecommendArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::string filters = "trilinear,anisotropic:8,shaded:2";
  Limits limits;
  std::string max_cost;  // R or R@GPU
  bool exhaustive = false;
  bool predicted = false;  // by a model, without a measurement
  bool json = false;
  bool fresh = false;
  std::string output = "out";
  bool quiet = false;
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
  double limit = 0;
  const auto parsed = std::from_chars(text.data(), text.data() + at, limit);
  if (parsed.ec != std::errc() || parsed.ptr != text.data() + at)
    throw Error(ErrorKind::usage, "--max-cost", fmt::format("`{}` is not a limit", text), "give R or R@GPU, as 2@PS4");
  settings.limits.max_cost = limit;
  require_positive("--max-cost", settings.limits.max_cost);
  if (at == text.size()) return;
  const std::vector<const Chip*> chips = chips_named("--max-cost", {text.substr(at + 1)});
  if (chips.size() > 1) throw Error(ErrorKind::usage, "--max-cost", "names several GPUs", "name one");
  settings.limits.gpu = chips.front()->name;
  settings.run.gpus = {settings.limits.gpu};
}

void write_answer(const Recommendation& answer, const std::filesystem::path& folder) {
  write_file_atomically(folder / "recommend.json", recommendation_json(answer));
  write_file_atomically(folder / "index.html", recommendation_page(answer));
}

// The GPU of predicted costs where no limit names one.
constexpr const char* usual_gpu = "Steam Deck";

void run_quick_command(const RecommendArguments& arguments, const RecommendSettings& settings) {
  QuickQuestion question{.methods = settings.run.methods, .filters = {}, .limits = settings.limits};
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
  RecommendSettings settings{.run = arguments.run.settings(),
                             .filters = parse_filters(arguments.filters),
                             .limits = arguments.limits,
                             .exhaustive = arguments.exhaustive,
                             .gpu_compiler = amd_compiler()};
  set_max_cost(arguments.max_cost, settings);
  if (arguments.predicted) return run_quick_command(arguments, settings);
  ProgressDisplay display(progress_style(arguments.quiet));
  const FinishedWork finished(finished_work_folder(arguments.output), maker_for(settings.run));
  if (arguments.fresh) finished.clear();
  const auto [result, path] = write_whole(arguments.output, [&](OutputFolder& folder) {
    const RecommendListener listener{
        .results =
            [](Results& results, const std::filesystem::path& own) {
              sign(results.tool, results.backend);
              write_report(results, own);
            },
        .first_answer =
            [&](const Recommendation& answer) {
              write_answer(answer, folder.path());
              display.finish();
              write_output(recommendation_text(answer) + "\n");
              if (!arguments.quiet)
                write_message(fmt::format("page of the first answer, until the run ends: {}",
                                          (folder.path() / "index.html").string()));
            }};
    Recommendation made = run_recommend(settings, folder.path(), finished, listener, display.callback());
    write_answer(made, folder.path());
    keep(folder);
    return made;
  });
  display.finish();
  write_output(fmt::format("{}\npage: {}\n", recommendation_text(result), (path / "index.html").string()));
  if (finished.reused() > 0 && !arguments.quiet) write_message(reuse_text(finished));
}

}  // namespace

void add_recommend_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("recommend", "Choose the best method for each material, within a limit");
  const auto arguments = std::make_shared<RecommendArguments>(*command);
  auto* error = command->add_option("--max-error", arguments->limits.max_error,
                                    "Choose the cheapest with at most this error at every distance");
  auto* cost =
      command
          ->add_option("--max-cost", arguments->max_cost,
                       "Choose the most accurate with at most this cost relative to direct: of frame times, or "
                       "with @GPU as `footprint cost` estimates it")
          ->type_name("R[@GPU]");
  auto* bytes = command
                    ->add_option("--max-bytes", arguments->limits.max_bytes,
                                 "Choose the most accurate with at most this many bytes of maps per material")
                    ->type_name("N")
                    ->check(within(0.0, 1e18));
  error->excludes(cost)->excludes(bytes);
  cost->excludes(bytes);
  command
      ->add_option(
          "--footprints", arguments->filters,
          "Footprint filters to try, comma-separated, as for `compare --footprint`; trilinear is always included")
      ->type_name("LIST")
      ->capture_default_str();
  auto* exhaustive = command->add_flag("--exhaustive", arguments->exhaustive, "Measure every candidate in full");
  auto* quick =
      command->add_flag("--quick", arguments->predicted,
                        "Predict errors within a second from the statistics of each normal map: nothing is drawn "
                        "or written, and options of view, reference and timing have no effect");
  quick->excludes(exhaustive);
  command->add_flag("--json", arguments->json, "With --quick: JSON instead of text, for programs")->needs(quick);
  auto* output =
      command
          ->add_option(
              "-o,--output", arguments->output,
              "Folder for index.html, recommend.json, the full runs, and kept/ with the finished work, from which an "
              "interrupted run resumes")
          ->type_name("DIR")
          ->capture_default_str();
  auto* fresh = command->add_flag("--fresh", arguments->fresh,
                                  "Measure everything again: discard the finished work in the output folder");
  quick->excludes(output)->excludes(fresh);
  add_quiet_flag(*command, arguments->quiet);
  command->footer(recommend_examples);
  command->callback([arguments] { run_recommend_command(*arguments); });
}

}  // namespace footprint
