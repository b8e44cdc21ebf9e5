// `footprint edit`: small-scale geometry that changes every frame, with the time of each stage up to the picture.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <vector>

#include "app/arguments.hpp"
#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/standard_output.hpp"
#include "experiments/studies/edit.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

constexpr const char* examples =
    "SCENE is a folder of scenes/ or a path to a scene.toml whose [microgeometry] has a kind. KIND.PARAMETER is a\n"
    "parameter of that kind (docs/scenes.md). The folder gets images/METHOD_NNNN, each .exr and .png, edit.json,\n"
    "edit.csv and table.md.\n"
    "\n"
    "Examples:\n"
    "  footprint edit woven_cloth --set weave.warp_width=0.1:0.5 --frames 10 -o out\n"
    "  footprint edit woven_cloth --set weave.warp_width=0.9:0.3 --set weave.height=0.1 --method iwasaki_sg:j=4 -o out";

struct Arguments {
  FrameArguments frame;
  std::vector<std::string> sets;
  std::string method = "iwasaki_sg";
  int frames = 10;
  std::string output = "out";
};

void add_options(CLI::App& command, Arguments& arguments) {
  add_frame_options(command, arguments.frame, "for display");
  command.add_option("--set", arguments.sets, "KIND.PARAMETER=FROM:TO, or =VALUE; may be given several times")
      ->required()
      ->expected(1)
      ->take_all();
  command.add_option("--method", arguments.method, "The method")->capture_default_str();
  command.add_option("--frames", arguments.frames, "Edits, at equal steps of the parameters")
      ->check(CLI::Range(1, 10000))
      ->capture_default_str();
  command.add_option("-o,--output", arguments.output, "Folder for edit.json, edit.csv, table.md, images/")
      ->capture_default_str();
}

EditSettings settings_from(const Arguments& arguments) {
  EditSettings settings;
  settings.scene = arguments.frame.scene;
  settings.scene_library = scene_library();
  for (const std::string& set : arguments.sets) settings.sweeps.push_back(parse_sweep(set));
  settings.method = parse_known_method("--method", arguments.method);
  if (settings.method.name == "reference") {
    throw Error(ErrorKind::usage, "--method", "`reference` has no precompute to time", "name a method");
  }
  settings.frames = arguments.frames;
  settings.size = parse_optional_size(arguments.frame.size);
  settings.anisotropy = arguments.frame.anisotropy;
  settings.tile = arguments.frame.backend.tile;
  settings.exposure = parse_exposure(arguments.frame.exposure);
  settings.context = context_request(arguments.frame.backend);
  return settings;
}

EditRun edit_into(OutputFolder& folder, const EditSettings& settings, const Progress& progress) {
  EditRun run = run_edit(settings, folder.path(), progress);
  keep_results(run, folder, write_edit);
  return run;
}

void run_edit_command(const Arguments& arguments) {
  const EditSettings settings = settings_from(arguments);
  ProgressDisplay display(progress_style(arguments.frame.quiet));
  const auto [run, place] = write_whole(
      arguments.output, [&](OutputFolder& folder) { return edit_into(folder, settings, display.callback()); });
  display.finish();
  write_output(fmt::format("{}\nframes: {}\n", edit_table(run), (place / "images").string()));
}

}  // namespace

void add_edit_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("edit", "Edit small-scale geometry frame by frame, and time each stage");
  const auto arguments = std::make_shared<Arguments>();
  add_options(*command, *arguments);
  command->footer(examples);
  command->callback([arguments] { run_edit_command(*arguments); });
}

}  // namespace footprint
