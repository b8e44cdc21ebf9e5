// `footprint animate`: the frames of a zoom-out, with error and flicker against the reference.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <utility>

#include "app/commands.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/run_options.hpp"
#include "app/standard_output.hpp"
#include "experiments/studies/animate.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

constexpr const char* animate_examples =
    "SCENE is a folder of scenes/, a path to a scene.toml, or a .gltf or .glb file. The folder gets "
    "images/METHOD_NNNN\n"
    "and images/reference_NNNN, each .exr and .png, animation.json, animation.csv and table.md. A film of them:\n"
    "  ffmpeg -framerate 30 -i out/images/toksvig_%04d.png -pix_fmt yuv420p toksvig.mp4\n"
    "\n"
    "Examples:\n"
    "  footprint animate model.gltf --method toksvig --frames 60 -o out\n"
    "  footprint animate ribbed_plane --method direct,toksvig --frames 30 --from 1 --to 16 --spp 64 -o out";

struct AnimateArguments {
  explicit AnimateArguments(CLI::App& command) : run(command) {}

  RunOptions run;
  std::string output = "out";
  bool quiet = false;
};

void add_options(CLI::App& command, AnimateArguments& arguments) {
  command.add_option("-o,--output", arguments.output, "Folder for animation.json, animation.csv, table.md, images/")
      ->capture_default_str();
  add_quiet_flag(command, arguments.quiet);
}

Animation animate_into(OutputFolder& folder, const RunSettings& settings, const Progress& progress) {
  Animation animation = run_animation(settings, folder.path(), progress);
  keep_results(animation, folder, write_animation);
  return animation;
}

void run_animate(const AnimateArguments& arguments) {
  const RunSettings settings = arguments.run.settings();
  ProgressDisplay display(progress_style(arguments.quiet));
  const auto [animation, path] = write_whole(
      arguments.output, [&](OutputFolder& folder) { return animate_into(folder, settings, display.callback()); });
  display.finish();
  write_output(fmt::format("{}\nframes: {}\n", animation_table(animation), (path / "images").string()));
}

}  // namespace

void add_animate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("animate", "Render the frames of a zoom, with error and flicker");
  const auto arguments = std::make_shared<AnimateArguments>(*command);
  add_options(*command, *arguments);
  command->footer(animate_examples);
  command->callback([arguments] { run_animate(*arguments); });
}

}  // namespace footprint
