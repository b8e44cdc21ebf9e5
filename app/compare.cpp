// `footprint compare`: methods against the supersampled reference on one scene, the error and fps table and the page.
#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>

#include "app/arguments.hpp"
#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/timing_process.hpp"
#include "experiments/studies/compare.hpp"
#include "renderer/core/files.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr const char* examples =
    "SCENE is a folder of scenes/, a path to a scene.toml, or a .gltf or .glb file. A method is written name or\n"
    "name:option=value:option=value; `footprint list methods` names them.\n"
    "\n"
    "Examples:\n"
    "  footprint compare model.gltf -o out\n"
    "  footprint compare model.gltf --methods direct,toksvig:storage=fp16 --distance 1,2,4,8 -o out\n"
    "  footprint compare scenes/quad/scene.toml --spp 256 --size 1024x768 --seed 7 -o out";

struct Arguments {
  std::string scene;
  std::string methods = "direct,naive_mip,toksvig";
  ReferenceArguments reference;
  std::string distances;  // empty: the scene's zoom path
  std::string size;       // empty: the scene's
  std::string exposure = "auto";
  std::string without;
  int repeats = 9;
  int processes = 1;
  int anisotropy = 1;
  BackendArguments backend;
  std::string output = "out";
  std::string timing_file;  // not empty: this is a process that only takes times
  bool no_cache = false;
  bool quiet = false;
};

void add_options(CLI::App& command, Arguments& arguments) {
  command.add_option("scene", arguments.scene, "What to render")->required();
  command.add_option("--methods", arguments.methods, "Methods, commas between")->capture_default_str();
  add_reference_options(command, arguments.reference);
  command.add_option("--distance", arguments.distances,
                     "Factors on the camera's distance, commas between; if not given the scene's zoom path");
  add_size_option(command, arguments.size);
  add_anisotropy_option(command, arguments.anisotropy);
  command.add_option("--exposure", arguments.exposure, "Factor on radiance for display and clamped errors, or auto")
      ->capture_default_str();
  command.add_option("--without", arguments.without,
                     "Effects that every method and the reference leave out, commas between, as `explain` names them");
  command.add_option("--repeats", arguments.repeats, "Timed frames of each method in each process, interleaved")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  add_processes_option(command, arguments.processes);
  add_backend_options(command, arguments.backend);
  command
      .add_option("-o,--output", arguments.output,
                  "Folder for results.json, results.csv, table.md, index.html, images/")
      ->capture_default_str();
  command.add_option(timing_file_option, arguments.timing_file)->group("");  // no part of the help
  add_cache_flag(command, arguments.no_cache);
  add_quiet_flag(command, arguments.quiet);
}

CompareSettings settings_from(const Arguments& arguments) {
  CompareSettings settings;
  settings.scene = arguments.scene;
  settings.scene_library = scene_library();
  settings.methods = parse_known_methods(arguments.methods);
  if (!arguments.distances.empty()) settings.distances = parse_distances(arguments.distances);
  settings.size = parse_optional_size(arguments.size);
  settings.spp = arguments.reference.spp;
  settings.seed = arguments.reference.seed;
  settings.filter = parse_filter(arguments.reference.filter);
  settings.environment = parse_environment_use(arguments.reference.environment);
  settings.exposure = parse_exposure(arguments.exposure);
  settings.without = parse_effects("--without", arguments.without);
  settings.repeats = arguments.repeats;
  settings.anisotropy = arguments.anisotropy;
  settings.tile = arguments.backend.tile;
  settings.cache = cache_folder(arguments.no_cache);
  settings.context = context_request(arguments.backend);
  return settings;
}

// Everything is written out of sight and moved to its place at the end.
Results compare_into(OutputFolder& folder, const CompareSettings& settings, int processes, const Progress& progress) {
  constexpr double weight = 10;  // of the main process's work, where a further process's is 1
  ProgressParts parts(progress, weight + processes - 1);
  const auto further = times_of_processes(processes - 1, {}, folder.path(), parts.next(processes - 1, ""));
  Results results = run_compare(settings, folder.path(), further, parts.next(weight, ""));
  keep_results(results, folder, write_report);
  return results;
}

void run_compare_command(const Arguments& arguments) {
  const CompareSettings settings = settings_from(arguments);
  ProgressDisplay display(progress_style(arguments.quiet));
  if (!arguments.timing_file.empty()) {
    return write_frame_times(arguments.timing_file, time_frames(settings, display.callback()));
  }
  const auto [results, place] = write_whole(arguments.output, [&](OutputFolder& folder) {
    return compare_into(folder, settings, arguments.processes, display.callback());
  });
  display.finish();
  print_results(results, place);
}

}  // namespace

void add_compare_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("compare", "Compare methods with a supersampled reference: the main job");
  const auto arguments = std::make_shared<Arguments>();
  add_options(*command, *arguments);
  command->footer(examples);
  command->callback([arguments] { run_compare_command(*arguments); });
}

}  // namespace footprint
