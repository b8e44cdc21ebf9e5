// `footprint render`: one image of a scene by a method, or by the supersampled reference; and `footprint edit`:
// small-scale geometry that changes every frame, with the time of each stage up to the picture.
#include "app/subcommand.hpp"
#include "experiments/studies/edit.hpp"
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

Image render_picture(const Stage& stage, double distance, const RunSettings& run, const Progress& progress) {
  const ReferenceSettings& reference = run.reference;
  const View view = stage.view(distance);
  Image picture = stage.methods().empty() ? stage.reference().render(view, reference.spp, reference.seed, progress).mean
                                          : image_of(stage.methods().front(), view);
  stage.context().check("rendering");
  return picture;
}

void save_picture(const std::filesystem::path& path, const Image& picture, const RunSettings& run, const Scene& scene) {
  if (lower_extension(path) == ".exr") return write_exr(path, picture);
  write_png(path, to_display(picture, choose_exposure(run.view.exposure, scene, picture).factor));
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
  const Image picture = render_picture(stage, distance, run, parts.next(2, ""));
  throw_if_interrupted();
  save_picture(path, picture, run, stage.scene());
  display.finish();
  write_scene_notes(stage.scene(), arguments.quiet);
  write_output(fmt::format("{}\n", path.string()));
}

constexpr const char* edit_examples =
    R"(KIND.PARAMETER is a parameter of the scene's [microgeometry] (docs/reference/scenes.md) or brdf.PARAMETER:
roughness, exponent, alpha, kappa, specular, metallic, or measured with two MERL files. The folder gets
images/METHOD_NNNN (.exr and .png), edit.json, edit.csv and table.md.

Examples:
  footprint edit woven_cloth --set weave.warp_width=0.1:0.5 --frames 10 -o out
  footprint edit woven_cloth --set weave.warp_width=0.9:0.3 --set weave.height=0.1 --method iwasaki_sg:j=4 -o out
  footprint edit ribbed_plane --set brdf.exponent=10:1000 --method xu_vmf -o out)";

struct EditArguments : RunArguments {
  explicit EditArguments(CLI::App& command) : RunArguments(command) {
    add_value(command, "--set", sets, "KIND.PARAMETER=FROM:TO",
              "Change a parameter from FROM to TO, or set it to VALUE; may be repeated")
        ->required()
        ->expected(1)
        ->take_all();
    command.add_option("--frames", frames, "Number of edits, at equal steps of the parameters")
        ->check(CLI::Range(1, 10000))
        ->capture_default_str();
    add_output_folder(command, output, "Folder for edit.json, edit.csv, table.md, images/");
  }

  std::vector<std::string> sets;
  int frames = EditSettings{}.frames;
  std::string output = "out";
};

EditSettings settings_from(const EditArguments& arguments) {
  EditSettings settings{.run = arguments.settings(), .frames = arguments.frames};
  for (const std::string& set : arguments.sets) settings.sweeps.push_back(parse_sweep(set));
  if (settings.run.methods.front().name == "reference")
    throw Error(ErrorKind::usage, "--method", "`reference` has no precompute to time", "name a method");
  return settings;
}

void run_edit_command(const EditArguments& arguments) {
  const EditSettings settings = settings_from(arguments);
  ProgressDisplay display(progress_style(arguments.quiet));
  const auto [run, path, lost] = write_whole(arguments.output, [&](OutputFolder& folder) {
    EditRun edits = run_edit(settings, folder.run(), display.callback());
    keep_results(edits, folder, write_edit, "edit.json");
    return edits;
  });
  display.finish();
  write_output(fmt::format("{}\nframes: {}\n", edit_table(run), (path / "images").string()));
  throw_first({lost});
}

}  // namespace

void add_render_command(CLI::App& app) {
  add_command(app, "render", "Render one image by a method or by the reference", render_examples, run_render);
}

void add_edit_command(CLI::App& app) {
  add_command(app, "edit", "Edit small-scale geometry or the base BRDF frame by frame and time each stage",
              edit_examples, run_edit_command);
}

}  // namespace footprint
