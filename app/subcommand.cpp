// Adds rows of the table of settings to the parser of the command line, and reads their values. Places of errors,
// signatures, and the summary that is printed at the end.
#include "app/subcommand.hpp"

#include <algorithm>
#include <cctype>

#include "app/folders.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"
#include "renderer/image/false_color.hpp"
#include "results/report/results_table.hpp"

namespace footprint {
namespace {

// "Random seed of the reference (0 or more); default: 1".
std::string help_text(const Setting& setting) {
  std::string text(setting.help);
  text.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(text.front())));
  if (!setting.type.takes.empty()) text += fmt::format(" ({})", setting.type.takes);
  if (!setting.otherwise.empty()) text += fmt::format("; default: {}", setting.otherwise);
  return text;
}

const CLI::Option* add_option(CLI::App& command, const Setting& setting) {
  const std::string names(setting.option), help = help_text(setting);
  const std::string group(setting.group);
  if (setting.type.word.empty()) return command.add_flag(names, help)->group(group);
  CLI::Option* option = command.add_option(names, help)->type_name(setting.type.word)->required(setting.required);
  if (setting.type.repeats) option->multi_option_policy(CLI::MultiOptionPolicy::TakeAll);
  if (names.starts_with('-')) option->group(group);
  return option->default_str(default_text(setting));
}

}  // namespace

RunArguments::RunArguments(CLI::App& command) {
  for (const Setting& setting : run_settings()) {
    if (std::ranges::find(setting.commands, command.get_name()) == setting.commands.end()) continue;
    added_.emplace_back(&setting, add_option(command, setting));
  }
}

void RunArguments::apply(RunSettings& run) const {
  run.scene_library = scene_library();
  run.cache = default_cache_folder();
  for (const auto& [setting, option] : added_) {
    std::vector<std::string> texts = option->results();
    if (texts.empty() && !setting->start.empty()) texts.emplace_back(setting->start);
    for (const std::string& text : texts) setting->type.read(run, option_name(*setting), text);
  }
}

RunSettings RunArguments::settings() const {
  RunSettings run;
  apply(run);
  return run;
}

std::vector<std::string> RunArguments::given_of(std::string_view table) const {
  std::vector<std::string> given;
  for (const auto& [setting, option] : added_) {
    if (setting->key.table == table && option->count() > 0) given.emplace_back(option_name(*setting));
  }
  return given;
}

Error at_final_place(const Error& error, const OutputFolder& folder) {
  std::string place = error.place();
  const std::string hidden = folder.path().string();
  if (place.starts_with(hidden)) place.replace(0, hidden.size(), folder.final_path().string());
  return {error.kind(), std::move(place), error.message(), error.hint()};
}

std::optional<Error> losses_of(const OutputFolder& folder) {
  const std::vector<Error>& losses = folder.run().losses();
  if (losses.empty()) return {};
  const Error first = at_final_place(losses.front(), folder);
  const std::string more =
      losses.size() == 1 ? "" : fmt::format(" ({} files {})", losses.size(), folder.run().faults_text());
  return Error(ErrorKind::check, first.place(), fmt::format("{}; everything else is there{}", first.message(), more),
               first.hint());
}

void warn_without_captions() {
  if (!find_caption_font().empty()) return;
  write_message(
      "warning: pictures get no captions: the font DejaVu Sans was not found (install the package fonts-dejavu-core, "
      "or "
      "set FOOTPRINT_FONT to its file)");
}

void throw_first(std::initializer_list<std::optional<Error>> errors) {
  for (const std::optional<Error>& error : errors)
    if (error) throw *error;
}

std::filesystem::path image_path(const std::string& output, const std::string& hint) {
  std::filesystem::path path = output;
  if (lower_extension(path) == ".exr" || lower_extension(path) == ".png") return path;
  throw Error(ErrorKind::usage, "--output", fmt::format("`{}` is not an image file", output), hint);
}

void sign(ToolInfo& tool, BackendInfo& backend) {
  tool.version = FOOTPRINT_VERSION;
  backend.cpu = describe_cpu();
}

void keep(OutputFolder& folder) {
  throw_if_interrupted();
  folder.commit();
}

bool write_interim(const OutputFolder& folder, const std::string& document,
                   const std::function<std::string()>& make_document, const std::function<std::string()>& make_page) {
  const RunFolder interim(folder.path());  // with losses of its own
  interim.write_text(document, make_document);
  const std::size_t before = interim.losses().size();
  interim.write_text("index.html", make_page);
  return interim.losses().size() == before;
}

void print_results(const Results& results, const std::filesystem::path& folder, bool verbose) {
  write_output(verbose ? fmt::format("{}\npage: {}\n", results_table(results), (folder / "index.html").string())
                       : fmt::format("{}\n  page: {}\n  every figure: {}\n", results_summary(results),
                                     (folder / "index.html").string(), (folder / "table.md").string()));
}

void write_and_print_animation(const std::filesystem::path& output,
                               const std::function<Results(const RunFolder& folder)>& make) {
  const auto [animation, path, lost] = write_whole(output, [&](OutputFolder& folder) {
    Results made = make(folder.run());
    keep_results(made, folder, write_report);
    return made;
  });
  write_output(fmt::format("{}\nframes: {}\npage: {}\n", results_table(animation), (path / "images").string(),
                           (path / "index.html").string()));
  throw_first({lost});
}

std::optional<Error> row_failures(const Results& results) {
  const auto failure_of = [](const Record& record) {
    if (record.failure) return record.failure;
    const auto missing = std::ranges::find_if(record.gpu_costs, [](const GpuCost& cost) { return !!cost.failure; });
    return missing == record.gpu_costs.end() ? std::optional<std::string>() : missing->failure;
  };
  const auto is_failed = [&](const Record& record) { return !!failure_of(record); };
  const auto first = std::ranges::find_if(results.records, is_failed);
  if (first == results.records.end()) return {};
  return Error(ErrorKind::check, results.scene.name,
               fmt::format("{} of {} rows failed; the first, at distance {:g}: {}",
                           std::ranges::count_if(results.records, is_failed), results.records.size(), first->distance,
                           *failure_of(*first)));
}

void require_none_failed(const std::string& place, const char* checks, const std::vector<std::string>& failures) {
  std::string list;
  for (const std::string& failure : failures) list += "failed: " + failure + "\n";
  write_output(list);
  if (failures.empty()) return;
  throw Error(ErrorKind::check, place,
              fmt::format("{} {} failed, the first: {}", failures.size(), checks, failures.front().substr(0, 300)), "");
}

}  // namespace footprint
