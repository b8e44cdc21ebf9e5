// `footprint render`: one image of a scene by a method, or by the supersampled reference.
#include "app/subcommand.hpp"
#include "experiments/studies/exposure.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/frame_times.hpp"
#include "experiments/studies/stage.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/process.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr const char* render_examples =
    R"(EXR stores linear radiance with coverage in alpha; PNG stores the image as displayed, after exposure.

Examples:
  footprint render model.gltf --method toksvig --size 1024x768 -o toksvig.exr
  footprint render model.gltf --method reference --spp 256 --seed 7 -o reference.exr
  footprint render model.gltf --method toksvig:storage=fp16 --distance 4 -o far.png)";

constexpr int reference_pictures = 6;  // mean, squares, two halves, error, and one to spare

struct RenderArguments : RunArguments {
  explicit RenderArguments(CLI::App& command) : RunArguments(command) {
    add_value(command, "-o,--output", output, "FILE", "The image, .exr or .png")->required();
    add_value(command, "--frame", zoom_frame, "N", "Frame of the scene's zoom path, from 0")
        ->check(within(0.0, 1e6))
        ->excludes(command.get_option("--distance"));
  }

  std::optional<std::size_t> zoom_frame;
  std::string output;
};

// The factor on the camera's distance: as given, or of a frame of the scene's zoom path.
double distance_factor(double given, const std::optional<std::size_t>& frame, const Scene& scene) {
  if (!frame) return given;
  if (*frame < scene.distances.size()) return scene.distances[*frame];
  throw Error(ErrorKind::usage, "--frame", fmt::format("frame {} does not exist", *frame),
              fmt::format("the scene's zoom path has frames 0 to {}", scene.distances.size() - 1));
}

Image render_picture(const Stage& stage, double distance, const ReferenceSettings& reference,
                     const Progress& progress) {
  const View view = stage.view(distance);
  Image picture = stage.methods().empty() ? stage.reference().render(view, reference.spp, reference.seed, progress).mean
                                          : render_image(stage.methods().front(), view);
  stage.context().check("rendering");
  return picture;
}

void save_picture(const std::filesystem::path& path, const Image& picture, const std::optional<Exposure>& exposure,
                  const Scene& scene) {
  if (lower_extension(path) == ".exr") return write_exr(path, picture);
  write_png(path, to_display(picture, choose_exposure(exposure, scene, picture).factor));
}

// The settings of the stage, which always has the reference and does not take it as a method. Options of the reference
// are refused with a method, which would ignore them.
RunSettings staged(const RunArguments& arguments) {
  RunSettings run = arguments.settings();
  const std::string method = run.methods.front().text;
  if (method == "reference") {
    run.methods.clear();
    return run;
  }
  for (const std::string& option : arguments.given_of("reference")) {
    throw Error(ErrorKind::usage, option, fmt::format("`{}` takes one sample per pixel", method),
                "use it with --method reference");
  }
  return run;
}

void run_render(const RenderArguments& arguments) {
  const std::filesystem::path path =
      image_path(arguments.output, "use the extension .exr for linear radiance, or .png for display");
  const RunSettings run = staged(arguments);
  Scene scene = load_scene(run.scene, run.scene_library, run.overrides);
  const double distance = distance_factor(run.view.distances.front(), arguments.zoom_frame, scene);

  ProgressDisplay display(progress_style(arguments.quiet));
  ProgressParts parts(display.callback(), 3);
  const Stage stage(std::move(scene), run, parts.next(1, ""),
                    {.pictures = run.methods.empty() ? reference_pictures : pictures_of_a_frame});
  const Image picture = render_picture(stage, distance, run.reference, parts.next(2, ""));
  throw_if_interrupted();
  save_picture(path, picture, run.view.exposure, stage.scene());
  display.finish();
  write_scene_notes(stage.scene(), arguments.quiet);
  write_output(fmt::format("{}\n", path.string()));
}

}  // namespace

void add_render_command(CLI::App& app) {
  add_command(app, "render", "Render one image by a method or by the reference", render_examples, run_render);
}

}  // namespace footprint
