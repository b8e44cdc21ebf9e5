// Equal ratios of distance in a zoom, and turns about an axis through the centre of the bounds, in double. Sets up a
// stage in order: context, scene, methods, reference.
#include "experiments/studies/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <glm/gtc/matrix_transform.hpp>
#include <new>
#include <utility>
#include <variant>

#include "experiments/settings/setting.hpp"
#include "experiments/studies/given_bakes.hpp"
#include "experiments/studies/picture_files.hpp"
#include "methods/registry.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr int default_width = 512;
constexpr float highest_default = 1 << 20;  // of a camera narrower than a hair
constexpr std::uint64_t pixel_bytes = 16;   // RGBA, 32-bit floats

// Textures are freed one after the other as they are uploaded: at most one is in memory twice.
void require_upload(const Prefiltered& prefiltered) {
  for (const PrefilteredTexture& texture : prefiltered.textures) {
    const TextureLevel& finest = texture.levels.front();
    require_texels(finest.width, finest.height, byte_count(texture), "texture " + texture.name + " on the GPU");
  }
}

// A method on the GPU, baked and uploaded one material after the other, so that at most one texture is in memory
// twice. A frame build may read what was baked; of every other method the GPU has all that a frame needs.
PreparedMethod bake_and_upload(const GpuScene& gpu_scene, const Scene& scene, const EffectSet& effects,
                               BakedMethod made, const BakeSource& source, const Progress& progress) {
  auto baked = std::make_unique<BakedMethod>(std::move(made));
  auto gpu = std::make_unique<GpuMethod>(gpu_scene, *baked);
  bake_materials(*baked, scene, effects, progress, source, [&](std::size_t material) {
    require_upload(baked->materials[material]);
    gpu->upload_material(material, [&](std::size_t texture) {
      if (!gpu->has_frame_build()) free_texels(baked->materials[material].textures[texture]);
    });
  });
  return {std::move(baked), std::move(gpu)};
}

std::string text_of_maps(const MethodSpec& method) {
  std::string text = method.name;
  for (const auto& [name, value] : method.options) text += fmt::format(":{}={}", name, value);
  return text;
}

// Whether the context is lost.
bool clear_errors(const gl::Context& context) {
  const std::vector<std::string> errors = context.take_debug_errors();
  return std::ranges::any_of(errors, [](const std::string& e) { return e.find("CONTEXT_LOST") != std::string::npos; });
}

constexpr double percentile = 0.95;
constexpr float target_luminance = 0.8F;

constexpr double default_zoom = 8.0;

// Nine digits: 4, where the powers give 3.9999999999999996.
double rounded(double value) {
  const double scale = std::pow(10.0, 8.0 - std::floor(std::log10(value)));
  return std::round(value * scale) / scale;
}

constexpr double default_turn = 60.0;  // degrees

[[noreturn]] void refuse(const char* option, const char* why) {
  throw Error(ErrorKind::usage, option, why, "leave it out, or choose another --path");
}

void require_settings_of_its_own(const RunSettings& settings) {
  if (!is_animation(settings)) return;
  const bool zooms = settings.path.kind == AnimationPath::zoom;
  const bool plays = settings.path.kind == AnimationPath::animation;
  if ((zooms || plays) && settings.path.degrees) refuse("--degrees", "this path does not turn");
  if ((zooms || plays) && settings.path.axis) refuse("--axis", "this path does not turn");
  if (!plays && settings.path.until) refuse("--until", "this path follows no animation");
  if (zooms && !settings.view.distances.empty()) refuse("--distance", "a zoom goes from --from to --to");
  if (!zooms && settings.view.zoom.from) refuse("--from", "this path is not a zoom");
  if (!zooms && settings.view.zoom.to) refuse("--to", "this path is not a zoom");
}

double first_time(const RunSettings& settings) { return settings.overrides.model.time.value_or(0.0); }

// At equal times from --time to --until.
void set_times(const RunSettings& settings, const Scene& scene, std::vector<RunView>& views) {
  const double from = first_time(settings);
  const double until = settings.path.until.value_or(scene.motion ? scene.motion->last_key : from);
  if (from == until)
    throw Error(ErrorKind::usage, "--until", fmt::format("the animation ends at {:g} s, where it starts", until),
                "let --time and --until differ");
  for (RunView& view : views) view.seconds = from + (until - from) * view.frame / static_cast<double>(views.size() - 1);
}

// The turn that a path has made in a frame, about the centre of the bounds.
glm::dmat4 turn_of(const PathSettings& path, const Scene& scene, const RunView& view) {
  const glm::dvec3 axis = turning_axis(path, scene);
  const glm::dvec3 centre(scene.bounds.centre());
  return glm::translate(glm::dmat4(1.0), centre) * glm::rotate(glm::dmat4(1.0), glm::radians(view.degrees), axis) *
         glm::translate(glm::dmat4(1.0), -centre);
}

// A light turned: its positions and its directions.
Light turned(Light light, const glm::dmat4& turn) {
  const auto point = [&](const glm::vec3& at) { return glm::vec3(turn * glm::dvec4(glm::dvec3(at), 1.0)); };
  const auto direction = [&](const glm::vec3& to) {
    return glm::normalize(glm::vec3(glm::dmat3(turn) * glm::dvec3(to)));
  };
  const auto turn_members = [&](auto& own) {
    if constexpr (requires { own.point; }) own.point.position = point(own.point.position);
    if constexpr (requires { own.position; }) own.position = point(own.position);
    if constexpr (requires { own.direction; }) own.direction = direction(own.direction);
    if constexpr (requires { own.across; }) {
      own.across = direction(own.across);
      own.up = direction(own.up);
    }
  };
  std::visit(turn_members, light);
  return light;
}

bool casts_shadows(const Scene& scene) {
  return std::ranges::any_of(derive_effects(scene), [](const EffectDecision& decision) {
    return decision.effect == Effect::cast_shadow && decision.on;
  });
}

}  // namespace

float automatic_exposure(const Image& reference) {
  std::vector<float> luminances;
  for (std::size_t i = 0; i < reference.texels.size(); i += 4) {
    const float* const p = &reference.texels[i];
    if (p[3] == 1.0F) luminances.push_back(luminance(p[0], p[1], p[2]));
  }
  if (luminances.empty()) return 1.0F;
  const auto nth =
      luminances.begin() + static_cast<std::ptrdiff_t>(percentile * static_cast<double>(luminances.size() - 1));
  std::ranges::nth_element(luminances, nth);
  return *nth > 0.0F && std::isfinite(*nth) ? target_luminance / *nth : 1.0F;
}

Exposure choose_exposure(const std::optional<Exposure>& given, const Scene& scene, const Image& first_reference) {
  if (given) return *given;
  if (scene.exposure) return {.factor = *scene.exposure, .source = ExposureSource::scene};
  return {.factor = automatic_exposure(first_reference), .source = ExposureSource::automatic};
}

BackendInfo backend_info(const gl::ContextInfo& context) {
  return {
      .name = std::string(gl::backend_name(context.backend)), .renderer = context.renderer, .version = context.version};
}

SceneInfo scene_info(const Scene& scene, const Exposure& exposure) {
  SceneInfo info{.name = scene.name,
                 .source = scene.source,
                 .triangles = 0,
                 .materials = scene.materials.size(),
                 .lights = scene.lights.size(),
                 .exposure = exposure.factor,
                 .exposure_source = std::string(word_for(exposure_sources, exposure.source)),
                 .defaults = scene.defaults,
                 .warnings = scene.warnings};
  for (const Mesh& mesh : scene.meshes) info.triangles += mesh.indices.size() / 3;
  return info;
}

glm::ivec2 frame_size(const Scene& scene, const std::optional<glm::ivec2>& wanted) {
  glm::ivec2 size(default_width, default_width);
  if (scene.camera.aspect) {
    size.y = static_cast<int>(std::lround(std::clamp(default_width / *scene.camera.aspect, 1.0F, highest_default)));
  }
  if (scene.frame_size) size = *scene.frame_size;
  if (wanted) size = *wanted;
  if (size.x < 1 || size.y < 1) {
    throw Error(ErrorKind::usage, "--size", fmt::format("{}x{} has no pixel", size.x, size.y), "give at least 1x1");
  }
  return size;
}

FootprintFilter footprint_filter_of(const RunSettings& settings, const Scene& scene) {
  return settings.footprint.value_or(scene.footprint.value_or(default_footprint_filter));
}

ShaderVariant frame_program(const Scene& scene, const FootprintFilter& filter) {
  return {.footprint = filter, .orthographic = scene.camera.orthographic};
}

std::optional<DiskCache> cache_of(const RunSettings& settings) {
  if (!settings.cache) return {};
  return DiskCache(*settings.cache);
}

BakedMethod bake_first(const RunSettings& settings, const Scene& scene, const EffectSet& effects,
                       const Progress& progress) {
  const MethodSpec& spec = settings.methods.front();
  const std::optional<DiskCache> files = cache_of(settings);
  return bake(find_method(spec), spec, scene, effects, progress, files ? &*files : nullptr);
}

void require_pictures(const glm::ivec2& size, int count) {
  const std::uint64_t bytes = frame_bytes(static_cast<std::uint64_t>(size.x), static_cast<std::uint64_t>(size.y),
                                          pixel_bytes * static_cast<std::uint64_t>(count));
  require_memory(bytes, fmt::format("{} images of {}x{}", count, size.x, size.y));
}

std::optional<Error> failure_of(const gl::Context& context, const MethodSpec& method,
                                const std::function<void()>& action) {
  const std::string place = "method " + method.text;
  std::optional<Error> failure;
  try {
    action();
  } catch (const Error& error) {
    if (error.kind() == ErrorKind::interrupted) throw;
    failure = error.within(place);
  } catch (const std::bad_alloc&) {
    failure.emplace(ErrorKind::machine, place, "out of memory", "use smaller textures or images, or free memory");
  }
  if (failure && clear_errors(context)) throw *failure;
  return failure;
}

PreparedScene::PreparedScene(Scene loaded, const RunSettings& settings)
    : context(settings.backend.context),
      scene(std::move(loaded)),
      triangles(scene_info(scene, {}).triangles),
      decisions(derive_effects(scene)),
      effects(effects_on(decisions) & ~settings.without) {
  require_given_bakes(settings, scene, effects);
}

StagedMethod::StagedMethod(const MethodSpec& spec, const Error& refusal)
    : prepared_(std::make_shared<const PreparedMethod>(
          PreparedMethod{.baked = std::make_unique<BakedMethod>(make_bake(find_method(spec), spec)), .gpu = nullptr})),
      drawn_{.spec = spec},
      refusal_(refusal) {}

std::shared_ptr<const PreparedMethod> prepared_method(const GpuScene& gpu_scene, const Scene& scene,
                                                      const EffectSet& effects, const MethodSpec& spec,
                                                      const RunSettings& settings, const Progress& progress) {
  BakedMethod made = make_bake(find_method(spec), spec);
  const std::optional<DiskCache> files = cache_of(settings);
  const std::optional<BakeFolder> given = given_bake(settings, spec);
  BakeSource source{.cache = files ? &*files : nullptr};
  if (given) {
    made.given_by = given->folder().string();
    source.given = [&, wanted = made](std::size_t material) { return given->read(wanted, scene, material, effects); };
  }
  return std::make_shared<const PreparedMethod>(
      bake_and_upload(gpu_scene, scene, effects, std::move(made), source, progress));
}

StagedMethod::StagedMethod(const gl::ContextInfo& context, GpuScene& gpu_scene, const Scene& scene,
                           std::shared_ptr<const PreparedMethod> prepared, const StagedFrames& wanted,
                           const glm::ivec2& size, int tile)
    : prepared_(std::move(prepared)),
      frames_(std::make_unique<FrameRenderer>(context, gpu_scene, *prepared_->gpu, size,
                                              frame_program(scene, wanted.filter), tile)),
      drawn_(wanted) {}

Stage::Stage(Scene scene, const RunSettings& settings, const Progress& progress, const StageOptions& options)
    : Stage(std::make_shared<PreparedScene>(std::move(scene), settings), settings, progress, options) {}

Stage::Stage(std::shared_ptr<PreparedScene> scene, const RunSettings& settings, const Progress& progress,
             const StageOptions& options)
    : prepared_(std::move(scene)),
      settings_(settings),
      lights_(prepared_->scene.lights),
      size_(frame_size(prepared_->scene, settings.view.size)) {
  require_pictures(size_, options.pictures);
  PreparedScene& shared = *prepared_;
  const std::vector<StagedFrames> wanted = wanted_methods(options.has_unit);
  const bool is_first = shared.gpu == nullptr;
  const auto bakes = static_cast<double>(wanted.size() + 1);
  // Visibility takes as long as all bakes, or longer.
  const double upload = hides_environment(shared.effects) ? bakes : 1.0;
  ProgressParts parts(progress, upload + bakes);
  const Progress of_upload = parts.next(upload, "");
  if (settings.path.kind == AnimationPath::animation) shapes_ = shared.scene.meshes;
  if (is_first) {
    shared.scene = refined_for_visibility(std::move(shared.scene), shared.effects);
    const std::optional<DiskCache> cache = cache_of(settings);
    shared.gpu = std::make_unique<GpuScene>(shared.context.info(), shared.scene, shared.effects, of_upload,
                                            cache ? &*cache : nullptr);
    const GpuVisibility* const visibility = shared.gpu->visibility();
    if (visibility != nullptr && !visibility->shortage().empty())
      shared.scene.warnings.push_back(visibility->shortage());
  }
  for (const StagedFrames& method : wanted) {
    const auto failure =
        failure_of(shared.context, method.spec, [&] { methods_.push_back(staged(method, parts.next(1, "bake "))); });
    if (!failure) continue;
    if (methods_.size() >= settings.methods.size() || !options.records_refusals) throw *failure;
    methods_.emplace_back(method.spec, *failure);
  }
  if (is_first)
    shared.base = bake_and_upload(*shared.gpu, shared.scene, shared.effects,
                                  make_bake(base_surface(), {.text = "reference", .name = "reference", .options = {}}),
                                  {}, parts.next(1, "bake "));
  reference_ = std::make_unique<Supersampler>(shared.context.info(), *shared.gpu, *shared.base.gpu,
                                              settings.reference.filter, shared.scene.camera.orthographic,
                                              settings.backend.tile, settings.reference.environment);
  shared.context.check("setting up the scene");
}

// The unit is a single frame of `direct` under its filter, added where it is not there yet. `direct:option=...` is
// another method.
std::vector<StagedFrames> Stage::wanted_methods(bool has_unit) {
  const FootprintFilter own = footprint_filter_of(settings_, scene());
  std::vector<StagedFrames> wanted;
  for (const MethodSpec& spec : settings_.methods)
    wanted.push_back({.spec = spec, .filter = own, .history = history_of(spec, settings_.history)});
  if (!has_unit) return wanted;
  const StagedFrames direct{.spec = {.text = "direct", .name = "direct", .options = {}},
                            .filter = settings_.timing.unit.value_or(own)};
  const auto is_unit = [&](const StagedFrames& method) {
    return method.spec.text == direct.spec.text && method.filter == direct.filter && method.history.frames == 0;
  };
  const auto found = std::ranges::find_if(wanted, is_unit);
  unit_ = static_cast<std::size_t>(found - wanted.begin());
  if (found == wanted.end()) wanted.push_back(direct);
  return wanted;
}

StagedMethod Stage::staged(const StagedFrames& method, const Progress& progress) const {
  std::shared_ptr<const PreparedMethod>& known = prepared_->methods[text_of_maps(method.spec)];
  if (!known) known = prepared_method(*prepared_->gpu, scene(), effects(), method.spec, settings_, progress);
  return {context().info(), *prepared_->gpu, scene(), known, method, size_, settings_.backend.tile};
}

SceneInfo Stage::info() const {
  SceneInfo info = scene_info(scene(), {});
  info.triangles = prepared_->triangles;
  return info;
}

View Stage::view(double distance) const {
  return {.size = size_, .camera = camera_at_distance(scene(), distance), .seed = settings_.reference.seed};
}

void Stage::pose_at(double seconds) {
  if (posed_at_ == seconds) return;
  Scene posed = scene_at_time(settings_, seconds, PlacedBounds{scene().bounds, scene().origin});
  const auto same_triangles = [](const Mesh& a, const Mesh& b) {
    return a.indices == b.indices && a.vertices.size() == b.vertices.size();
  };
  if (!std::ranges::equal(posed.meshes, shapes_, same_triangles))
    throw Error(ErrorKind::usage, posed.source,
                fmt::format("at {:g} s its triangles differ from those of the first frame", seconds),
                "give its meshes texture coordinates, normals and tangents");
  posed = refined_for_visibility(std::move(posed), effects(), shapes_);
  prepared_->scene.meshes = std::move(posed.meshes);
  prepared_->scene.lights = std::move(posed.lights);
  prepared_->scene.camera = posed.camera;
  prepared_->gpu->update(scene());
  posed_at_ = seconds;
}

View Stage::move_to(const RunView& view) {
  if (settings_.path.kind == AnimationPath::light) {
    prepared_->scene.lights = lights_on_path(settings_.path, scene(), lights_, view);
    prepared_->gpu->update(scene());
  }
  if (settings_.path.kind == AnimationPath::animation) pose_at(view.seconds);
  return {.size = size_,
          .camera = camera_on_path(settings_.path, scene(), view),
          .seed = settings_.reference.seed,
          .frame = view.frame};
}

StagedMethod Stage::stage(const MethodSpec& method, const Progress& progress) const {
  return staged({.spec = method, .filter = footprint_filter_of(settings_, scene())}, progress);
}

InteriorFinder Stage::interior_finder() const { return {*prepared_->gpu, scene()}; }

FrameRenderer Stage::dense_frames(const StagedMethod& method) const {
  ShaderVariant wanted = frame_program(scene(), footprint_filter_of(settings_, scene()));
  wanted.environment = EnvironmentUse::dense;
  return {context().info(), *prepared_->gpu, method.gpu(), size_, wanted, settings_.backend.tile};
}

FrameRenderer Stage::counting_frames(const StagedMethod& method, Counting counting) const {
  ShaderVariant wanted = frame_program(scene(), method.filter());
  wanted.counting = counting;
  return {context().info(), *prepared_->gpu, method.gpu(), size_, wanted, settings_.backend.tile};
}

ForwardProgram Stage::program_for_cost(const StagedMethod& method, const FixedTrips& trips) const {
  ShaderVariant wanted = frame_program(scene(), method.filter());
  wanted.fixed_trips = trips;
  return forward_program(*prepared_->gpu, method.baked(), wanted);
}

Supersampler Stage::finest_level(const StagedMethod& method) const {
  return {context().info(),      *prepared_->gpu, method.gpu(), settings_.reference.filter, scene().camera.orthographic,
          settings_.backend.tile};
}

std::vector<double> zoom_distances(double from, double to, int frames) {
  std::vector<double> distances;
  distances.reserve(static_cast<std::size_t>(frames));
  for (int i = 0; i < frames; ++i) {
    distances.push_back(rounded(from * std::pow(to / from, static_cast<double>(i) / (frames - 1))));
  }
  distances.front() = from;
  distances.back() = to;
  return distances;
}

std::vector<double> given_distances(const ViewSettings& view) {
  const ZoomSettings& zoom = view.zoom;
  if (zoom.frames == 0) return view.distances;
  if (!zoom.from || !zoom.to) return {};
  return zoom_distances(*zoom.from, *zoom.to, zoom.frames);
}

std::vector<double> run_distances(const ViewSettings& view, const Scene& scene) {
  const ZoomSettings& zoom = view.zoom;
  if (zoom.frames == 0) return view.distances.empty() ? scene.distances : view.distances;
  const double from = zoom.from.value_or(scene.distances.front());
  const double last = scene.distances.size() > 1 ? scene.distances.back() : default_zoom * from;
  const double to = zoom.to.value_or(last);
  if (from == to) {
    throw Error(ErrorKind::usage, "--to", fmt::format("the zoom ends at {:g}, where it starts", to),
                "let --from and --to differ");
  }
  return zoom_distances(from, to, zoom.frames);
}

std::vector<RunView> run_views(const RunSettings& settings, const Scene& scene) {
  require_settings_of_its_own(settings);
  std::vector<RunView> views;
  const auto add = [&](double distance, double degrees) {
    const auto frame = static_cast<std::uint32_t>(settings.view.zoom.frames > 0 ? views.size() : 0);
    views.push_back({.distance = distance, .degrees = degrees, .frame = frame});
  };
  if (settings.path.kind.value_or(AnimationPath::zoom) == AnimationPath::zoom) {
    for (const double distance : run_distances(settings.view, scene)) add(distance, 0.0);
    return views;
  }
  if (settings.path.kind == AnimationPath::light && scene.lights.empty())
    throw Error(ErrorKind::usage, "--path", scene.source + " has no light to move, and its environment stays",
                "take --path orbit");
  const int count = settings.view.zoom.frames;
  const double distance = settings.view.distances.empty() ? 1.0 : settings.view.distances.front();
  const bool plays = settings.path.kind == AnimationPath::animation;
  const double turn = plays ? 0.0 : settings.path.degrees.value_or(default_turn);
  for (int i = 0; i < count; ++i) add(distance, turn * i / (count - 1));
  if (plays) set_times(settings, scene, views);
  return views;
}

std::string view_words(const RunSettings& settings, std::size_t index, const RunView& view) {
  if (!is_animation(settings)) return fmt::format("distance {:g}", view.distance);
  return fmt::format("frame {} of {}", index + 1, settings.view.zoom.frames);
}

std::string view_stem(const RunSettings& settings, std::size_t index, const RunView& view, const std::string& what) {
  return is_animation(settings) ? fmt::format("{}_{:04}", what, index) : distance_stem(view.distance, what);
}

glm::dvec3 turning_axis(const PathSettings& path, const Scene& scene) {
  return path.axis.value_or(glm::normalize(glm::dvec3(scene.camera.world[1])));
}

Camera camera_on_path(const PathSettings& path, const Scene& scene, const RunView& view) {
  Camera camera = camera_at_distance(scene, view.distance);
  if (path.kind != AnimationPath::orbit || view.degrees == 0.0) return camera;
  camera.world = glm::mat4(turn_of(path, scene, view) * glm::dmat4(camera.world));
  return camera;
}

std::vector<Light> lights_on_path(const PathSettings& path, const Scene& scene, const std::vector<Light>& lights,
                                  const RunView& view) {
  if (path.kind != AnimationPath::light || view.degrees == 0.0) return lights;
  const glm::dmat4 turn = turn_of(path, scene, view);
  std::vector<Light> moved;
  for (const Light& light : lights) moved.push_back(turned(light, turn));
  return moved;
}

Scene scene_at_time(const RunSettings& settings, double seconds, const std::optional<PlacedBounds>& bounds) {
  SceneOverrides overrides = settings.overrides;
  overrides.model.time = seconds;
  overrides.bounds = bounds;
  return load_scene(settings.scene, settings.scene_library, overrides);
}

Scene scene_of_run(const RunSettings& settings) {
  if (settings.path.kind != AnimationPath::animation)
    return load_scene(settings.scene, settings.scene_library, settings.overrides);
  const Scene first = scene_at_time(settings, first_time(settings), {});
  WideBounds bounds;
  bounds.add(first.bounds, first.origin);
  bool casts = false;
  for (const RunView& view : run_views(settings, first)) {
    const Scene posed = scene_at_time(settings, view.seconds, {});
    bounds.add(posed.bounds, posed.origin);
    casts = casts || casts_shadows(posed);
  }
  const glm::dvec3 origin = origin_for(bounds);
  Scene scene = scene_at_time(settings, first_time(settings), PlacedBounds{bounds.from(origin), origin});
  if (casts && !scene.shadows.cast) scene.shadows.cast = true;
  return scene;
}

Scene scene_for_path(const RunSettings& settings, Scene scene) {
  if (settings.path.kind != AnimationPath::light || scene.shadows.cast || casts_shadows(scene)) return scene;
  Scene moved = scene;
  const std::vector<RunView> views = run_views(settings, scene);
  const bool casts = std::ranges::any_of(views, [&](const RunView& view) {
    moved.lights = lights_on_path(settings.path, scene, scene.lights, view);
    return casts_shadows(moved);
  });
  if (casts) scene.shadows.cast = true;
  return scene;
}

}  // namespace footprint
