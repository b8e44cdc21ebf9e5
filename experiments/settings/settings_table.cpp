// The table of a run's settings: a new one is a field of RunSettings and a row here (adding-an-option.md).
#include "experiments/settings/setting_types.hpp"

#include <limits>

namespace footprint {
namespace {

using namespace setting_types;
using Run = RunSettings;
using Commands = std::vector<std::string_view>;

// Groups of subcommands.
const Commands of_a_scene{"compare", "recommend", "render", "animate", "edit", "bake", "explain", "cost"};
const Commands of_a_picture{"compare", "recommend", "render", "animate", "edit", "explain", "cost"};
const Commands that_compare{"compare", "recommend"};
const Commands with_a_reference{"compare", "recommend", "render", "animate", "score"};
const Commands with_a_footprint{"compare", "render", "animate", "edit", "bake", "explain", "ndf", "cost", "shader"};
const Commands with_a_history{"compare", "render", "animate"};
const Commands that_draw{"compare", "recommend", "render", "animate", "edit", "explain",
                         "ndf",     "run",       "check",  "score",   "cost"};
const Commands that_take_bakes{"compare", "recommend", "render", "animate"};
const Commands that_may_cache{"compare", "recommend", "render", "animate", "bake",  "explain",
                              "ndf",     "run",       "check",  "cost",    "shader"};

constexpr double largest_turn = 36000;  // degrees: a hundred turns
constexpr int any_count = std::numeric_limits<int>::max();
constexpr std::uint64_t any_seed = std::numeric_limits<std::uint64_t>::max();

std::string& scene(Run& run) { return run.scene; }
std::vector<MethodSpec>& all_of(Run& run) { return run.methods; }
std::vector<double>& distances_of(Run& run) { return run.view.distances; }
std::optional<double>& zoom_from(Run& run) { return run.view.zoom.from; }
std::optional<double>& zoom_to(Run& run) { return run.view.zoom.to; }
int& zoom_frames(Run& run) { return run.view.zoom.frames; }
std::optional<Exposure>& exposure_of(Run& run) { return run.view.exposure; }
AnimationPath& animation_path(Run& run) {
  return run.view.path.kind ? *run.view.path.kind : run.view.path.kind.emplace();
}
std::vector<std::string>& gpus_of(Run& run) { return run.gpus; }
int& repeats(Run& run) { return run.timing.repeats; }

SettingType method_argument() {
  SettingType type = one_method(all_of);
  type.word = "METHOD";
  return type;
}

std::vector<Setting> scene_settings() {
  return {
      {.option = "scene",
       .commands = of_a_scene,
       .type = any_text(scene, "SCENE"),
       .help = "a scene of `footprint list scenes`, a path to a scene.toml, or a model (.gltf, .glb, .obj)",
       .required = true},
      {.option = "--scene",
       .commands = {"shader"},
       .type = any_text(scene, "SCENE"),
       .help = "SCENE whose effects the shader simulates",
       .otherwise = "a GGX material with a normal map and a metallic-roughness map"},
      {.key = {"experiment", "scene"},
       .type = any_text(scene, "SCENE"),
       .help = "SCENE as on the command line; scenes next to the file come first",
       .required = true},
      {.option = "--model-scene",
       .commands = of_a_scene,
       .type = any_name([](Run& run) -> std::optional<std::string>& { return run.overrides.model.scene; }, "NAME"),
       .help = "scene of the model file, by name or number from 0; `explain` lists them",
       .otherwise = "the file's own"},
      {.option = "--camera",
       .commands = of_a_picture,
       .type = any_name([](Run& run) -> std::optional<std::string>& { return run.overrides.model.camera; }, "NAME"),
       .help = "camera of the model file, by name or number from 0",
       .otherwise = "the scene's, else the file's first"},
      {.option = "--animation",
       .commands = of_a_scene,
       .type = any_name([](Run& run) -> std::optional<std::string>& { return run.overrides.model.animation; }, "NAME"),
       .help = "animation of the model file that poses it, by name or number from 0",
       .otherwise = "none; with --time the first"},
      {.option = "--time",
       .commands = of_a_scene,
       .type = seconds([](Run& run) -> std::optional<double>& { return run.overrides.model.time; }),
       .help = "time of the animation; clamped to its first and last key",
       .otherwise = "0 with --animation, else the pose at rest"},
      {.option = "--environment",
       .commands = of_a_picture,
       .type = file_path([](Run& run) -> std::optional<std::filesystem::path>& { return run.overrides.environment; }),
       .help = "environment map: latitude-longitude, EXR or Radiance HDR",
       .otherwise = "the scene's"},
      {.option = "--variant",
       .commands = of_a_scene,
       .type = any_name([](Run& run) -> std::optional<std::string>& { return run.overrides.model.variant; }, "NAME"),
       .help = "material variant of the model file (KHR_materials_variants), by name or number from 0",
       .otherwise = "the file's own materials"},
      {.option = "--methods",
       .commands = {"compare"},
       .type = methods(all_of, parse_methods_with_histories),
       .help = "methods to compare",
       .start = "direct,naive_mip,toksvig"},
      {.option = "--methods",
       .commands = {"cost"},
       .type = methods(all_of),
       .help = "methods whose cost is estimated",
       .start = "direct,naive_mip,toksvig"},
      {.option = "--methods",
       .commands = {"recommend"},
       .type = methods(all_of),
       .help = "methods to choose from",
       .start = "direct,naive_mip,toksvig,roughness_bake,lean,leadr,tan_gmm"},
      {.option = "--methods,--method",
       .commands = {"animate"},
       .type = methods(all_of, parse_methods_with_histories),
       .help = "methods to render",
       .required = true},
      {.option = "--method",
       .commands = {"render"},
       .type = one_method(all_of, parse_methods_with_histories),
       .help = "method, or `reference`",
       .required = true},
      {.option = "--method",
       .commands = {"edit"},
       .type = one_method(all_of),
       .help = "method to bake and render",
       .start = "iwasaki_sg"},
      {.option = "--method",
       .commands = {"explain"},
       .type = one_method(all_of),
       .help = "method whose textures and shader are reported",
       .start = "direct"},
      {.option = "--method",
       .commands = {"bake"},
       .type = one_method(all_of),
       .help = "method whose maps are written",
       .required = true},
      {.option = "method",
       .commands = {"shader"},
       .type = method_argument(),
       .help = "method whose shader is written",
       .required = true},
      {.option = "--methods",
       .commands = {"ndf"},
       .type = methods(all_of),
       .help = "methods to show",
       .otherwise = "all that can show the material, except slow ones"},
      {.option = "--methods",
       .commands = {"check"},
       .type = methods(all_of),
       .help = "`hard_cases` only: methods to test",
       .otherwise = "every method"},
      {.key = {"experiment", "methods"},
       .type = methods(all_of, parse_methods_with_histories),
       .help = "methods to compare",
       .required = true},
      {.option = "--bakes",
       .commands = that_take_bakes,
       .type = folders([](Run& run) -> std::vector<std::filesystem::path>& { return run.bakes; }),
       .help = "folder of `footprint bake` with the maps of a method, which is then not baked; give one per method",
       .otherwise = "the methods are baked"},
      {.option = "--without",
       .commands = {"compare"},
       .key = {"experiment", "without"},
       .type = effects([](Run& run) -> EffectSet& { return run.without; }),
       .help = "effects to leave out of every method and of the reference, by their names in `explain`",
       .otherwise = "none"},
  };
}

std::vector<Setting> view_settings() {
  return {
      {.option = "--size",
       .commands = of_a_picture,
       .key = {"experiment", "size"},
       .type = frame_size([](Run& run) -> std::optional<glm::ivec2>& { return run.view.size; }),
       .help = "frame size in pixels",
       .otherwise = "the scene's, else 512 wide in the camera's aspect ratio"},
      {.key = {"experiment", "quick_size"},
       .type = frame_size([](Run& run) -> std::optional<glm::ivec2>& { return run.view.quick_size; }),
       .help = "frame size in pixels with --quick",
       .otherwise = "a quarter of `size`, 128x128 without one"},
      {.option = "--distance",
       .commands = that_compare,
       .key = {"zoom", "distances"},
       .type = distances(distances_of, any_count),
       .help = "camera distances to the centre of the bounds, as multiples of the scene's own",
       .otherwise = "the scene's zoom path"},
      {.option = "--distance",
       .commands = {"render", "score", "cost"},
       .type = distances(distances_of, 1),
       .help = "camera distance to the centre of the bounds, as a multiple of the scene's own",
       .start = "1"},
      {.option = "--path",
       .commands = {"animate"},
       .type = one_word(animation_path, animation_paths, "path"),
       .help =
           "what moves: the camera away from the object (zoom) or around it (orbit), the lights around it (light), or "
           "what the model file moves (animation)",
       .start = "zoom"},
      {.option = "--frames",
       .commands = {"animate"},
       .type = whole_number(zoom_frames, 2, 10000),
       .help = "number of frames, at equal ratios of distance, or at equal angles or times",
       .start = "30"},
      {.option = "--from",
       .commands = {"animate"},
       .type = positive_number(zoom_from, smallest_distance, largest_distance),
       .help = "zoom: camera distance of the first frame, as a multiple of the scene's own",
       .otherwise = "the first of the scene's zoom path"},
      {.option = "--to",
       .commands = {"animate"},
       .type = positive_number(zoom_to, smallest_distance, largest_distance),
       .help = "zoom: camera distance of the last frame",
       .otherwise = "the last of the scene's zoom path, or 8 times the first"},
      {.option = "--degrees",
       .commands = {"animate"},
       .type = angle([](Run& run) -> std::optional<double>& { return run.view.path.degrees; }, largest_turn),
       .help = "orbit, light: angle from the first frame to the last",
       .otherwise = "60"},
      {.option = "--axis",
       .commands = {"animate"},
       .type = direction([](Run& run) -> std::optional<glm::dvec3>& { return run.view.path.axis; }),
       .help = "orbit, light: axis of rotation through the centre of the bounds, in world space",
       .otherwise = "the camera's up"},
      {.option = "--distance",
       .commands = {"animate"},
       .type = distances(distances_of, 1),
       .help = "orbit, light, animation: camera distance, as a multiple of the scene's own",
       .otherwise = "1"},
      {.option = "--until",
       .commands = {"animate"},
       .type = seconds([](Run& run) -> std::optional<double>& { return run.view.path.until; }),
       .help = "animation: time of the last frame; the first has that of --time",
       .otherwise = "the last key"},
      {.key = {"zoom", "from"},
       .type = positive_number(zoom_from, smallest_distance, largest_distance),
       .help = "first distance of a zoom, instead of `distances`; flicker is measured between its frames",
       .otherwise = "no zoom"},
      {.key = {"zoom", "to"},
       .type = positive_number(zoom_to, smallest_distance, largest_distance),
       .help = "last distance of a zoom",
       .otherwise = "no zoom"},
      {.key = {"zoom", "frames"},
       .type = whole_number(zoom_frames, 2, 10000),
       .help = "number of frames of a zoom, at equal ratios of distance",
       .otherwise = "no zoom"},
      {.option = "--exposure",
       .commands = {"compare", "recommend", "animate", "score"},
       .key = {"experiment", "exposure"},
       .type = exposure(exposure_of),
       .help = "factor on radiance for display and for errors of clamped values; auto: the scene's, else derived from "
               "the first reference"},
      {.option = "--exposure",
       .commands = {"render", "edit"},
       .type = exposure(exposure_of),
       .help = "factor on radiance for display; auto: the scene's, else derived from the first image"},
      {.option = "--error-scale",
       .commands = {"compare"},
       .key = {"experiment", "error_scale"},
       .type = positive_number([](Run& run) -> std::optional<double>& { return run.view.error_scale; }, 1e-6, 1.0),
       .help = "normalised colour error at the top of the colour scale of every error image",
       .otherwise = "the largest 99th percentile of all images"},
      {.option = "--gpu",
       .commands = {"compare", "check"},
       .key = {"experiment", "gpu"},
       .type = gpus(gpus_of),
       .help = "GPUs on which the cost of each method is estimated (docs/explanation/gpu-cost.md)",
       .otherwise = "none"},
      {.option = "--gpu",
       .commands = {"cost"},
       .type = gpus(gpus_of),
       .help = "GPUs on which the cost of each method is estimated",
       .start = "Steam Deck,RX 6800"},
      {.option = "--footprint",
       .commands = with_a_footprint,
       .key = {"experiment", "footprint"},
       .type = footprint_filter([](Run& run) -> std::optional<FootprintFilter>& { return run.footprint; }),
       .help = "how maps are filtered over the area of a pixel (docs/reference/filters.md)",
       .otherwise = "the scene's, else anisotropic:8"},
  };
}

// A method may have an option of the same key for its own history.
std::vector<Setting> history_settings() {
  return {
      {.option = "--history",
       .commands = with_a_history,
       .key = {"experiment", "history"},
       .type = whole_number([](Run& run) -> int& { return run.history.frames; }, 0, 1024),
       .help = "frames of the first view, or of each distance, that are accumulated before an image is shown; later "
               "frames of a path are added to them (docs/explanation/temporal.md); 0: no history"},
      {.option = "--history-alpha",
       .commands = with_a_history,
       .key = {"experiment", "history_alpha"},
       .type = positive_number([](Run& run) -> double& { return run.history.alpha; }, 0.001, 1),
       .help = "share of the newest frame in a history"},
      {.option = "--history-clamp",
       .commands = with_a_history,
       .key = {"experiment", "history_clamp"},
       .type = one_word([](Run& run) -> HistoryClamp& { return run.history.clamp; }, history_clamps, "clamp"),
       .help = "limits of a history from the 3 x 3 pixels of the newest frame: none, their range, or also one "
               "deviation from their mean"},
      {.option = "--history-jitter",
       .commands = with_a_history,
       .key = {"experiment", "history_jitter"},
       .type = one_word([](Run& run) -> bool& { return run.history.jitter; }, switch_words, "switch"),
       .help = "whether the samples of a history's frames move within the pixels"},
  };
}

std::vector<Setting> reference_settings() {
  return {
      {.option = "--spp",
       .commands = with_a_reference,
       .key = {"reference", "spp"},
       .type = fixed_samples([](Run& run) -> ReferenceSettings& { return run.reference; }, 1, 4096),
       .help = "fixed number of reference samples per pixel; if not given, runs with a noise floor start at the "
               "default and add more"},
      {.option = "--noise",
       .commands = that_compare,
       .type = noise([](Run& run) -> ReferenceSettings& { return run.reference; }),
       .help =
           "target noise floor: tiles of the reference get more samples until they reach it (not with `--spp`); auto: "
           "a fifth of the smallest error difference between methods, within about twice the first samples",
       .start = "auto"},
      {.key = {"reference", "noise"},
       .type = noise([](Run& run) -> ReferenceSettings& { return run.reference; }),
       .help = "target noise floor, as `--noise` (not with `spp`)",
       .otherwise = "the samples are fixed"},
      {.option = "--spp-max",
       .commands = that_compare,
       .key = {"reference", "spp_max"},
       .type = whole_number([](Run& run) -> int& { return run.reference.spp_max; }, 64, 4096),
       .help = "maximum of reference samples per pixel, even if the noise floor is not reached"},
      {.key = {"reference", "other_spp"},
       .type = whole_numbers([](Run& run) -> std::vector<int>& { return run.reference.other_spp; }, 1, 4096),
       .help = "samples per pixel of further references, such as the 16 of a paper, for `error(METHOD, spp=16)`"},
      {.key = {"reference", "supersampling"},
       .type = whole_numbers([](Run& run) -> std::vector<int>& { return run.reference.supersampling; }, 1, 4096),
       .help = "samples per pixel at which plain supersampling is measured and timed"},
      {.option = "--seed",
       .commands = with_a_reference,
       .key = {"reference", "seed"},
       .type = whole_number([](Run& run) -> std::uint64_t& { return run.reference.seed; }, 0, any_seed),
       .help = "random seed of the reference: same seed, same bytes"},
      {.option = "--filter",
       .commands = with_a_reference,
       .key = {"reference", "filter"},
       .type = one_word([](Run& run) -> Sampling& { return run.reference.filter; }, reference_filters, "filter"),
       .help = "filter of the reference: after shading, or of the maps before shading (nearest texel, bilinear)"},
      {.option = "--integrator",
       .commands = with_a_reference,
       .key = {"reference", "integrator"},
       .type = one_word([](Run& run) -> EnvironmentUse& { return run.reference.environment; }, reference_integrals,
                        "integrator"),
       .help = "how the reference integrates an environment; dense: 6 x 32 x 32 lights per sample"},
      {.option = "--bound",
       .commands = {"compare", "animate"},
       .key = {"reference", "bound"},
       .type = one_word([](Run& run) -> BoundUse& { return run.reference.bound; }, bound_uses, "use of the bound"),
       .help = "render `exact` too, to separate the footprint filter's error from the method's own; auto: on as many "
               "pixels "
               "as are cheap"},
  };
}

std::vector<Setting> timing_settings() {
  return {
      {.option = "--repeats",
       .commands = that_compare,
       .key = {"experiment", "repeats"},
       .type = whole_number(repeats, 1, 10000),
       .help = "maximum of timed frames per method, distance and process, interleaved; timing stops once each ratio to "
               "`direct` is known to 3%"},
      {.option = "--repeats",
       .commands = {"explain"},
       .type = whole_number(repeats, 1, 10000),
       .help =
           "maximum of timed frames with and without each effect, for --cost; timing stops once each ratio is known "
           "to 3%",
       .start = "15"},
      {.option = "--time-unit",
       .commands = {"compare"},
       .key = {"experiment", "time_unit"},
       .type = footprint_filter([](Run& run) -> std::optional<FootprintFilter>& { return run.timing.unit; }),
       .help = "footprint filter of the `direct` frame that costs 1; name one to compare costs under several filters",
       .otherwise = "the run's own"},
      {.option = "--processes",
       .commands = {"compare", "run", "check"},
       .type = whole_number([](Run& run) -> int& { return run.timing.processes; }, 1, 64),
       .help = "processes that time frames, one after another; times are over all of them"},
      {.option = "--backend",
       .commands = that_draw,
       .type = one_word([](Run& run) -> std::optional<gl::Backend>& { return run.backend.context.backend; },
                        gl::backend_words, "backend"),
       .help = "OpenGL backend; auto takes the first that works"},
      {.option = "--device",
       .commands = that_draw,
       .type = whole_number([](Run& run) -> int& { return run.backend.context.device; }, 0, any_count),
       .help = "GPU of egl-device, by its number in `footprint info`"},
      {.option = "--tile",
       .commands = that_draw,
       .type = whole_number([](Run& run) -> int& { return run.backend.tile; }, 0, 1 << 16),
       .help = "side in pixels of the tiles in which a frame is rendered; 0: the largest tile that the GPU allows"},
      {.option = "--no-cache",
       .commands = that_may_cache,
       .type = no_folder([](Run& run) -> std::optional<std::filesystem::path>& { return run.cache; }),
       .help = "ignore the bake cache ($FOOTPRINT_CACHE, else ~/.cache/footprint): neither read nor write it"},
  };
}

bool& fresh(Run& run) { return run.output.fresh; }

std::vector<Setting> output_settings() {
  return {
      {.option = "-v,--verbose",
       .commands = {"compare"},
       .type = flag([](Run& run) -> bool& { return run.output.verbose; }),
       .help = "print all of table.md: errors by cause, pairs of methods, supersampling, bakes"},
      {.option = "--video",
       .commands = {"animate"},
       .type = flag([](Run& run) -> bool& { return run.output.video; }),
       .help = "also make images/film.mp4 with ffmpeg: the reference and all methods side by side, 30 frames per "
               "second"},
      {.option = "--fresh",
       .commands = {"recommend", "run", "check"},
       .type = flag(fresh),
       .help = "measure everything again: discard the finished work in the output folder"},
      {.option = "--fresh",
       .commands = {"animate"},
       .type = flag(fresh),
       .help = "render every frame again: discard the finished ones"},
  };
}

}  // namespace

std::span<const Setting> run_settings() {
  static const std::vector<Setting> settings = [] {
    std::vector<Setting> all;
    const auto add = [&](std::string_view group, std::vector<Setting> part) {
      for (Setting& setting : part) setting.group = group;
      all.insert(all.end(), part.begin(), part.end());
    };
    add("Scene and methods", scene_settings());
    add("View", view_settings());
    add("History", history_settings());
    add("Reference", reference_settings());
    add("Timing and OpenGL", timing_settings());
    add("Output", output_settings());
    return all;
  }();
  return settings;
}

}  // namespace footprint
