// The table of a run's settings: a new one is a field of RunSettings and a row here (docs/adding-an-option.md).
#include <limits>

#include "experiments/settings/setting.hpp"
#include "experiments/settings/setting_types.hpp"

namespace footprint {
namespace {

using namespace setting_types;
using Run = RunSettings;
using Commands = std::vector<std::string_view>;

// Subcommands by what they have in common.
const Commands of_a_scene{"compare", "recommend", "render", "animate", "edit", "bake", "explain"};
const Commands of_a_picture{"compare", "recommend", "render", "animate", "edit", "explain"};
const Commands that_compare{"compare", "recommend"};
const Commands with_a_reference{"compare", "recommend", "render", "animate", "score"};
const Commands with_a_footprint{"compare", "render", "animate", "edit", "bake", "explain", "ndf"};
const Commands that_draw{"compare", "recommend", "render", "animate", "edit",
                         "explain", "ndf",       "run",    "check",   "score"};
const Commands that_may_cache{"compare", "recommend", "render", "animate", "bake", "explain", "ndf", "run", "check"};

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
int& repeats(Run& run) { return run.timing.repeats; }

std::vector<Setting> what_is_drawn() {
  return {
      {.option = "scene",
       .commands = of_a_scene,
       .type = any_text(scene, "SCENE"),
       .help = "what to look at",
       .required = true},
      {.table = "experiment",
       .key = "scene",
       .type = any_text(scene, "SCENE"),
       .help = "SCENE as on the command line; a scene beside the file comes first",
       .required = true},
      {.option = "--model-scene",
       .commands = of_a_scene,
       .type = any_name([](Run& run) -> std::optional<std::string>& { return run.overrides.model.scene; }, "NAME"),
       .help = "scene of the model file, by name or number from 0; `explain` lists them",
       .otherwise = "the file's default one"},
      {.option = "--camera",
       .commands = of_a_picture,
       .type = any_name([](Run& run) -> std::optional<std::string>& { return run.overrides.model.camera; }, "NAME"),
       .help = "camera of the model file, likewise",
       .otherwise = "the scene's, else the file's first"},
      {.option = "--environment",
       .commands = of_a_picture,
       .type = file_path([](Run& run) -> std::optional<std::filesystem::path>& { return run.overrides.environment; }),
       .help = "latitude-longitude picture of the light from all around, EXR or Radiance HDR",
       .otherwise = "the scene's"},
      {.option = "--variant",
       .commands = of_a_scene,
       .type = any_name([](Run& run) -> std::optional<std::string>& { return run.overrides.model.variant; }, "NAME"),
       .help = "variant of the model file's materials (KHR_materials_variants), likewise",
       .otherwise = "the file's own materials"},
      {.option = "--methods",
       .commands = {"compare"},
       .type = methods(all_of),
       .help = "the methods",
       .start = "direct,naive_mip,toksvig"},
      {.option = "--methods",
       .commands = {"recommend"},
       .type = methods(all_of),
       .help = "the candidates",
       .start = "direct,naive_mip,toksvig,roughness_bake,lean,leadr,tan_gmm"},
      {.option = "--method,--methods",
       .commands = {"animate"},
       .type = methods(all_of),
       .help = "the methods",
       .required = true},
      {.option = "--method",
       .commands = {"render"},
       .type = one_method(all_of),
       .help = "the method, or `reference`",
       .required = true},
      {.option = "--method",
       .commands = {"edit"},
       .type = one_method(all_of),
       .help = "the method",
       .start = "iwasaki_sg"},
      {.option = "--method",
       .commands = {"explain"},
       .type = one_method(all_of),
       .help = "the method whose textures and shader count",
       .start = "direct"},
      {.option = "--method",
       .commands = {"bake"},
       .type = one_method(all_of),
       .help = "the method whose maps are written",
       .required = true},
      {.option = "--methods",
       .commands = {"ndf"},
       .type = methods(all_of),
       .help = "the methods",
       .otherwise = "all but slow ones that take the material"},
      {.table = "experiment", .key = "methods", .type = methods(all_of), .help = "the methods", .required = true},
      {.option = "--without",
       .commands = {"compare"},
       .table = "experiment",
       .key = "without",
       .type = effects([](Run& run) -> EffectSet& { return run.without; }),
       .help = "effects that every method and the reference leave out, as `explain` names them; the report says so",
       .otherwise = "none"},
  };
}

std::vector<Setting> what_is_seen() {
  return {
      {.option = "--size",
       .commands = of_a_picture,
       .table = "experiment",
       .key = "size",
       .type = frame_size([](Run& run) -> std::optional<glm::ivec2>& { return run.view.size; }),
       .help = "frame size, pixels",
       .otherwise = "the scene's, else 512 wide in the camera's aspect"},
      {.table = "experiment",
       .key = "quick_size",
       .type = frame_size([](Run& run) -> std::optional<glm::ivec2>& { return run.view.quick_size; }),
       .help = "frame size with --quick, pixels",
       .otherwise = "a quarter of `size`, 128x128 without one"},
      {.option = "--distance",
       .commands = that_compare,
       .table = "zoom",
       .key = "distances",
       .type = distances(distances_of, any_count),
       .help = "factors on the camera's distance to the centre of the bounds",
       .otherwise = "the scene's zoom path"},
      {.option = "--distance",
       .commands = {"render", "score"},
       .type = distances(distances_of, 1),
       .help = "factor on the camera's distance to the centre of the bounds",
       .start = "1"},
      {.option = "--path",
       .commands = {"animate"},
       .type = one_word([](Run& run) -> AnimationPath& { return run.path.kind; }, animation_paths, "path"),
       .help = "what moves: the camera away from the object, the camera around it, or the lights around it"},
      {.option = "--frames",
       .commands = {"animate"},
       .type = whole_number(zoom_frames, 2, 10000),
       .help = "frames, at equal ratios of distance or at equal angles",
       .start = "30"},
      {.option = "--from",
       .commands = {"animate"},
       .type = positive_number(zoom_from, smallest_distance, largest_distance),
       .help = "first factor on the camera's distance, of a zoom",
       .otherwise = "the first of the scene's zoom path"},
      {.option = "--to",
       .commands = {"animate"},
       .type = positive_number(zoom_to, smallest_distance, largest_distance),
       .help = "last factor, of a zoom",
       .otherwise = "the last of it, or 8 times the first"},
      {.option = "--degrees",
       .commands = {"animate"},
       .type = angle([](Run& run) -> std::optional<double>& { return run.path.degrees; }, largest_turn),
       .help = "how far camera or lights turn from the first frame to the last, of an orbit or a light's path",
       .otherwise = "60"},
      {.option = "--axis",
       .commands = {"animate"},
       .type = direction([](Run& run) -> std::optional<glm::dvec3>& { return run.path.axis; }),
       .help = "what they turn around, through the centre of the bounds, in the world",
       .otherwise = "the camera's up"},
      {.option = "--distance",
       .commands = {"animate"},
       .type = distances(distances_of, 1),
       .help = "factor on the camera's distance, of an orbit or a light's path",
       .otherwise = "1"},
      {.table = "zoom",
       .key = "from",
       .type = positive_number(zoom_from, smallest_distance, largest_distance),
       .help = "instead of distances, with the two below: first factor of a zoom, between whose frames flicker is "
               "measured",
       .otherwise = "no zoom"},
      {.table = "zoom",
       .key = "to",
       .type = positive_number(zoom_to, smallest_distance, largest_distance),
       .help = "last factor of a zoom",
       .otherwise = "no zoom"},
      {.table = "zoom",
       .key = "frames",
       .type = whole_number(zoom_frames, 2, 10000),
       .help = "frames of a zoom, at equal ratios of distance",
       .otherwise = "no zoom"},
      {.option = "--exposure",
       .commands = {"compare", "recommend", "animate", "score"},
       .table = "experiment",
       .key = "exposure",
       .type = exposure(exposure_of),
       .help = "factor on radiance for display and for errors on clamped values; auto: the scene's, else derived from "
               "the first reference"},
      {.option = "--exposure",
       .commands = {"render", "edit"},
       .type = exposure(exposure_of),
       .help = "factor on radiance for display; auto: the scene's, else derived from the first picture"},
      {.option = "--error-scale",
       .commands = {"compare"},
       .table = "experiment",
       .key = "error_scale",
       .type = positive_number([](Run& run) -> std::optional<double>& { return run.view.error_scale; }, 1e-6, 1.0),
       .help = "normalised colour error at the top of every error picture",
       .otherwise = "the largest 99th percentile of all pictures"},
      {.option = "--footprint",
       .commands = with_a_footprint,
       .table = "experiment",
       .key = "footprint",
       .type = footprint_filter([](Run& run) -> std::optional<FootprintFilter>& { return run.footprint; }),
       .help = "how what lies under a pixel is filtered (docs/filters.md)",
       .otherwise = "the scene's, else anisotropic:8"},
  };
}

std::vector<Setting> what_errors_are_measured_against() {
  return {
      {.option = "--spp",
       .commands = with_a_reference,
       .table = "reference",
       .key = "spp",
       .type = fixed_samples([](Run& run) -> ReferenceSettings& { return run.reference; }, 1, 4096),
       .help = "samples a pixel of the reference, whatever its noise; without it, those to begin with"},
      {.option = "--noise",
       .commands = that_compare,
       .type = noise([](Run& run) -> ReferenceSettings& { return run.reference; }),
       .help =
           "where `--spp` is not given, the reference goes on, tile by tile, until this is its noise floor; auto: a "
           "fifth of the least difference between methods, as far as twice the first samples lead",
       .start = "auto"},
      {.table = "reference",
       .key = "noise",
       .type = noise([](Run& run) -> ReferenceSettings& { return run.reference; }),
       .help = "where `spp` is not given, the noise floor to be reached, as `--noise`",
       .otherwise = "the samples are fixed"},
      {.option = "--spp-max",
       .commands = that_compare,
       .table = "reference",
       .key = "spp_max",
       .type = whole_number([](Run& run) -> int& { return run.reference.spp_max; }, 64, 4096),
       .help = "samples a pixel at which the reference stops, whatever its noise"},
      {.table = "reference",
       .key = "other_spp",
       .type = whole_numbers([](Run& run) -> std::vector<int>& { return run.reference.other_spp; }, 1, 4096),
       .help = "samples a pixel of further references, such as the 16 of a paper, for `error(METHOD, spp=16)`"},
      {.table = "reference",
       .key = "supersampling",
       .type = whole_numbers([](Run& run) -> std::vector<int>& { return run.reference.supersampling; }, 1, 4096),
       .help = "samples a pixel at which plain supersampling is measured and timed"},
      {.option = "--seed",
       .commands = with_a_reference,
       .table = "reference",
       .key = "seed",
       .type = whole_number([](Run& run) -> std::uint64_t& { return run.reference.seed; }, 0, any_seed),
       .help = "seed of the reference's samples: same seed, same bytes"},
      {.option = "--filter",
       .commands = with_a_reference,
       .table = "reference",
       .key = "filter",
       .type = one_word([](Run& run) -> ReferenceFilter& { return run.reference.filter; }, reference_filters, "filter"),
       .help = "the reference's filter"},
      {.option = "--integrator",
       .commands = with_a_reference,
       .table = "reference",
       .key = "integrator",
       .type = one_word([](Run& run) -> EnvironmentUse& { return run.reference.environment; }, reference_integrals,
                        "way to integrate an environment"),
       .help = "how the reference integrates an environment; dense: 6 x 32 x 32 lights for every sample"},
      {.option = "--bound",
       .commands = {"compare", "animate"},
       .table = "reference",
       .key = "bound",
       .type = one_word([](Run& run) -> BoundUse& { return run.reference.bound; }, bound_uses, "use of the bound"),
       .help =
           "whether `exact` is drawn to tell what the footprint filter leaves; auto: of as many pixels as are cheap"},
  };
}

std::vector<Setting> how_it_runs() {
  return {
      {.option = "--repeats",
       .commands = that_compare,
       .table = "experiment",
       .key = "repeats",
       .type = whole_number(repeats, 1, 10000),
       .help = "most timed frames of each method and distance in each process, interleaved; timing ends where each "
               "ratio to `direct` is known to 3%"},
      {.option = "--repeats",
       .commands = {"explain"},
       .type = whole_number(repeats, 1, 10000),
       .help = "timed frames with and without each effect, for --cost",
       .start = "15"},
      {.option = "--time-unit",
       .commands = {"compare"},
       .table = "experiment",
       .key = "time_unit",
       .type = footprint_filter([](Run& run) -> std::optional<FootprintFilter>& { return run.timing.unit; }),
       .help = "footprint filter of the `direct` whose frame costs 1: name one to compare costs under several filters",
       .otherwise = "the run's own"},
      {.option = "--processes",
       .commands = {"compare", "run", "check"},
       .type = whole_number([](Run& run) -> int& { return run.timing.processes; }, 1, 64),
       .help = "processes that time frames, one after the other; figures are over all of them"},
      {.option = "--backend",
       .commands = that_draw,
       .type = one_word([](Run& run) -> std::optional<gl::Backend>& { return run.backend.context.backend; },
                        gl::backend_words, "backend"),
       .help = "way to OpenGL; auto takes the first that works"},
      {.option = "--device",
       .commands = that_draw,
       .type = whole_number([](Run& run) -> int& { return run.backend.context.device; }, 0, any_count),
       .help = "which GPU for egl-device, as `footprint info` numbers them"},
      {.option = "--tile",
       .commands = that_draw,
       .type = whole_number([](Run& run) -> int& { return run.backend.tile; }, 0, 1 << 16),
       .help = "side of the tiles that a frame is rendered in, pixels; 0: as few tiles as fit"},
      {.option = "--no-cache",
       .commands = that_may_cache,
       .type = no_folder([](Run& run) -> std::optional<std::filesystem::path>& { return run.cache; }),
       .help = "bake anew: neither read nor keep slow precomputes (kept in $FOOTPRINT_CACHE, or ~/.cache/footprint)"},
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
    add("Scene and methods", what_is_drawn());
    add("View", what_is_seen());
    add("Reference", what_errors_are_measured_against());
    add("Timing and OpenGL", how_it_runs());
    return all;
  }();
  return settings;
}

}  // namespace footprint
