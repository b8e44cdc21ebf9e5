// `footprint compare`: methods against the supersampled reference on one scene, the error and fps table and the page.
#include "app/child_process.hpp"
#include "app/experiment_runs.hpp"
#include "app/subcommand.hpp"
#include "renderer/languages/compilers.hpp"

namespace footprint {
namespace {

constexpr const char* compare_examples =
    R"(Examples:
  footprint compare model.gltf -o out
  footprint compare model.gltf --methods direct,toksvig:storage=fp16 --distance 1,2,4,8 -o out
  footprint compare carved_disk --spp 256 --size 1024x768 --seed 7 -o out)";

struct CompareArguments : RunArguments {
  explicit CompareArguments(CLI::App& command) : RunArguments(command) {
    add_output_folder(command, output, "Folder for results.json, results.csv, table.md, index.html, images/");
    command.add_option(timing_file_option, timing_file)->group("");  // no part of the help
  }

  std::string output = "out";
  std::string timing_file;  // not empty: this is a process that only takes times
};

// Everything is written to a hidden folder and moved to its place at the end. The hidden folder has a page after the
// first distance.
Results compare_into(OutputFolder& folder, const RunSettings& settings, bool quiet, const Progress& progress) {
  const int others = settings.timing.processes - 1;
  ProgressParts parts(progress, main_process_weight + others);
  const Progress of_others = parts.next(others, "");
  bool has_message = false;
  const ResultsWatch so_far = [&](Results results) {
    sign(results.tool, results.backend);
    results.scene.warnings.insert(results.scene.warnings.begin(), "the run is not finished; more distances follow");
    const bool has_page = write_interim(
        folder, "results.json", [&] { return results_json(results); }, [&] { return results_page(results); });
    if (has_page && !quiet && !std::exchange(has_message, true))
      write_message(fmt::format("page of the finished distances, until the run ends: {}",
                                (folder.path() / "index.html").string()));
  };
  const CompareContext context{.further_times = times_of_processes(others, {}, folder.path(), of_others),
                               .so_far = so_far,
                               .gpu_compiler = amd_compiler()};
  Results results = run_compare(settings, folder.run(), parts.next(main_process_weight, ""), context);
  keep_results(results, folder, write_report);
  return results;
}

void run_compare_command(const CompareArguments& arguments) {
  const RunSettings settings = arguments.settings();
  if (!settings.gpus.empty()) require_compilers("--gpu");
  ProgressDisplay display(progress_style(arguments.quiet));
  if (!arguments.timing_file.empty()) {
    return write_frame_times(arguments.timing_file, time_frames(settings, display.callback()));
  }
  warn_without_captions();
  const auto [results, path, lost] = write_whole(arguments.output, [&](OutputFolder& folder) {
    return compare_into(folder, settings, arguments.quiet, display.callback());
  });
  display.finish();
  print_results(results, path, settings.output.verbose);
  throw_first({row_failures(results), lost});
}

}  // namespace

void add_compare_command(CLI::App& app) {
  add_command(app, "compare", "Compare methods with a supersampled reference (the main command)", compare_examples,
              run_compare_command);
}

}  // namespace footprint
