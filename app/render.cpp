// `footprint render`: one picture of a scene by one method, or by the supersampled reference.
#include <fmt/format.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>

#include "app/arguments.hpp"
#include "app/commands.hpp"
#include "app/messages.hpp"
#include "app/options.hpp"
#include "app/progress_display.hpp"
#include "app/standard_output.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/interrupt.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr const char* examples =
    "SCENE is a folder of scenes/, a path to a scene.toml, or a .gltf or .glb file. EXR holds linear radiance with\n"
    "coverage in alpha; PNG is exposed for display.\n"
    "\n"
    "Examples:\n"
    "  footprint render model.gltf --method toksvig --size 1024x768 -o toksvig.exr\n"
    "  footprint render model.gltf --method reference --spp 256 --seed 7 -o reference.exr\n"
    "  footprint render model.gltf --method toksvig:storage=fp16 --distance 4 -o far.png";

constexpr int reference_pictures = 6;  // mean, squares, two halves, error, and one to spare

struct Arguments {
  FrameArguments frame;
  std::string method;
  ReferenceArguments reference;
  std::string distance = "1";
  std::optional<std::size_t> zoom_frame;
  std::string output;
  bool no_cache = false;
};

std::filesystem::path picture_path(const std::string& text) {
  std::filesystem::path path = text;
  if (path.extension() == ".exr" || path.extension() == ".png") return path;
  throw Error(ErrorKind::usage, "--output", fmt::format("`{}` names no picture", text),
              "end it in .exr for linear radiance, or .png for display");
}

// The factor on the camera's distance: given, or that of a frame of the scene's zoom path.
double distance_factor(double given, const std::optional<std::size_t>& frame, const Scene& scene) {
  if (!frame) return given;
  if (*frame < scene.distances.size()) return scene.distances[*frame];
  throw Error(ErrorKind::usage, "--frame", fmt::format("there is no frame {}", *frame),
              fmt::format("the scene's zoom path has frames 0 to {}", scene.distances.size() - 1));
}

bool is_reference(const MethodSpec& method) { return method.text == "reference"; }

Image render_picture(const Stage& stage, double distance, const ReferenceArguments& reference,
                     const Progress& progress) {
  const View view = stage.view(distance);
  Image picture = stage.methods().empty() ? stage.reference().render(view, reference.spp, reference.seed, progress).mean
                                          : stage.methods().front().frames().render(view);
  stage.context().check("rendering");
  return picture;
}

void save_picture(const std::filesystem::path& path, const Image& picture, std::optional<float> exposure) {
  if (path.extension() == ".exr") return write_exr(path, picture);
  write_png(path, to_display(picture, exposure ? *exposure : automatic_exposure(picture)));
}

void run_render(const Arguments& arguments) {
  const std::filesystem::path path = picture_path(arguments.output);
  const MethodSpec method = parse_known_method("--method", arguments.method);
  const std::optional<float> exposure = parse_exposure(arguments.frame.exposure);
  const double given_distance = parse_distance(arguments.distance);
  StageSettings settings;
  settings.size = parse_optional_size(arguments.frame.size);
  settings.filter = parse_filter(arguments.reference.filter);
  settings.environment = parse_environment_use(arguments.reference.environment);
  settings.anisotropy = arguments.frame.anisotropy;
  settings.tile = arguments.frame.backend.tile;
  settings.cache = cache_folder(arguments.no_cache);
  if (is_reference(method)) {
    settings.pictures = reference_pictures;
  } else {
    settings.methods = {method};
  }
  const gl::ContextRequest request = context_request(arguments.frame.backend);
  Scene scene = load_scene(arguments.frame.scene, scene_library());
  const double distance = distance_factor(given_distance, arguments.zoom_frame, scene);

  ProgressDisplay display(progress_style(arguments.frame.quiet));
  ProgressParts parts(display.callback(), 3);
  const Stage stage(request, std::move(scene), settings, parts.next(1, ""));
  const Image picture = render_picture(stage, distance, arguments.reference, parts.next(2, ""));
  throw_if_interrupted();
  save_picture(path, picture, exposure ? exposure : stage.scene().exposure);
  display.finish();
  write_scene_notes(stage.scene(), arguments.frame.quiet);
  write_output(fmt::format("{}\n", path.string()));
}

// Options that only the reference heeds: given with a method, they would be a silent misunderstanding.
void check_reference_options(const CLI::App& command, const std::string& method) {
  if (method == "reference") return;
  for (const char* option : {"--spp", "--seed", "--filter", "--environment"}) {
    if (command.count(option) == 0) continue;
    throw Error(ErrorKind::usage, option, fmt::format("`{}` takes one sample a pixel", method),
                "give it with --method reference");
  }
}

}  // namespace

void add_render_command(CLI::App& app) {
  CLI::App* command = app.add_subcommand("render", "Render one picture by a method or by the reference");
  const auto arguments = std::make_shared<Arguments>();
  add_frame_options(*command, arguments->frame, "of a .png");
  command->add_option("--method", arguments->method, "name or name:option=value, or `reference`")->required();
  command->add_option("-o,--output", arguments->output, "The picture, .exr or .png")->required();
  auto* distance =
      command->add_option("--distance", arguments->distance, "Factor on the camera's distance")->capture_default_str();
  command->add_option("--frame", arguments->zoom_frame, "Frame of the scene's zoom path, from 0")
      ->check(CLI::NonNegativeNumber)
      ->excludes(distance);
  add_reference_options(*command, arguments->reference);
  add_cache_flag(*command, arguments->no_cache);
  command->footer(examples);
  command->callback([arguments, command] {
    check_reference_options(*command, arguments->method);
    run_render(*arguments);
  });
}

}  // namespace footprint
