// `footprint animate`: the frames of a zoom-out, with error and flicker against the reference.
#include <fmt/format.h>

#include <memory>
#include <string>
#include <utility>

#include "app/arguments.hpp"
#include "app/commands.hpp"
#include "app/options.hpp"
#include "app/output.hpp"
#include "app/progress_display.hpp"
#include "app/standard_output.hpp"
#include "experiments/studies/animate.hpp"
#include "renderer/core/files.hpp"

namespace footprint {
namespace {

constexpr const char* examples =
    "SCENE is a folder of scenes/, a path to a scene.toml, or a .gltf or .glb file. The folder gets "
    "images/METHOD_NNNN\n"
    "and images/reference_NNNN, each .exr and .png, animation.json, animation.csv and table.md. A film of them:\n"
    "  ffmpeg -framerate 30 -i out/images/toksvig_%04d.png -pix_fmt yuv420p toksvig.mp4\n"
    "\n"
    "Examples:\n"
    "  footprint animate model.gltf --method toksvig --frames 60 -o out\n"
    "  footprint animate ribbed_plane --method direct,toksvig --frames 30 --from 1 --to 16 --spp 64 -o out";

struct Arguments {
  FrameArguments frame;
  std::string methods;
  int frames = 30;
  std::string from, to;  // empty: the scene's zoom path
  ReferenceArguments reference;
  std::string output = "out";
  bool no_cache = false;
};

void add_options(CLI::App& command, Arguments& arguments) {
  add_frame_options(command, arguments.frame, "for display and clamped errors");
  command.add_option("--method,--methods", arguments.methods, "Methods, commas between")->required();
  command.add_option("--frames", arguments.frames, "Frames of the zoom, at equal ratios of distance")
      ->check(CLI::Range(2, 10000))
      ->capture_default_str();
  command.add_option("--from", arguments.from,
                     "First factor on the camera's distance; if not given the first of the scene's zoom path");
  command.add_option("--to", arguments.to,
                     "Last factor; if not given the last of the scene's zoom path, or 8 times the first");
  add_reference_options(command, arguments.reference);
  command.add_option("-o,--output", arguments.output, "Folder for animation.json, animation.csv, table.md, images/")
      ->capture_default_str();
  add_cache_flag(command, arguments.no_cache);
}

std::optional<double> optional_distance(const std::string& text) {
  return text.empty() ? std::nullopt : std::optional(parse_distance(text));
}

AnimateSettings settings_from(const Arguments& arguments) {
  AnimateSettings settings;
  settings.scene = arguments.frame.scene;
  settings.scene_library = scene_library();
  settings.stage.methods = parse_known_methods(arguments.methods);
  settings.stage.size = parse_optional_size(arguments.frame.size);
  settings.stage.filter = parse_filter(arguments.reference.filter);
  settings.stage.environment = parse_environment_use(arguments.reference.environment);
  settings.stage.anisotropy = arguments.frame.anisotropy;
  settings.stage.tile = arguments.frame.backend.tile;
  settings.stage.cache = cache_folder(arguments.no_cache);
  settings.from = optional_distance(arguments.from);
  settings.to = optional_distance(arguments.to);
  settings.frames = arguments.frames;
  settings.spp = arguments.reference.spp;
  settings.seed = arguments.reference.seed;
  settings.exposure = parse_exposure(arguments.frame.exposure);
  settings.context = context_request(arguments.frame.backend);
  return settings;
}

Animation animate_into(OutputFolder& folder, const AnimateSettings& settings, const Progress& progress) {
  Animation animation = run_animation(settings, folder.path(), progress);
  keep_results(animation, folder, write_animation);
  return animation;
}

void run_animate(const Arguments& arguments) {
  const AnimateSettings settings = settings_from(arguments);
  ProgressDisplay display(progress_style(arguments.frame.quiet));
  const auto [animation, place] = write_whole(
      arguments.output, [&](OutputFolder& folder) { return animate_into(folder, settings, display.callback()); });
  display.finish();
  write_output(fmt::format("{}\nframes: {}\n", animation_table(animation), (place / "images").string()));
}

}  // namespace

void add_animate_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("animate", "Render the frames of a zoom, with error and flicker");
  const auto arguments = std::make_shared<Arguments>();
  add_options(*command, *arguments);
  command->footer(examples);
  command->callback([arguments] { run_animate(*arguments); });
}

}  // namespace footprint
