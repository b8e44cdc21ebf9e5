// Sets up a stage in order: context, scene, methods, reference.
#include "experiments/studies/stage.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstddef>
#include <new>
#include <utility>

#include "experiments/settings/setting.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/given_bakes.hpp"
#include "experiments/studies/report_facts.hpp"
#include "experiments/studies/view_path.hpp"
#include "methods/registry.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/pipeline/base_surface.hpp"

namespace footprint {
namespace {

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

}  // namespace

std::optional<DiskCache> cache_in(const std::optional<std::filesystem::path>& folder) {
  if (!folder) return {};
  return DiskCache(*folder);
}

BakedMethod bake_by_cache(const std::optional<std::filesystem::path>& cache, const MethodSpec& spec, const Scene& scene,
                          const EffectSet& effects, const Progress& progress) {
  const std::optional<DiskCache> files = cache_in(cache);
  return bake(find_method(spec), spec, scene, effects, progress, files ? &*files : nullptr);
}

std::optional<Error> catch_failure(const gl::Context& context, const MethodSpec& method,
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

PreparedScene::PreparedScene(Scene loaded, const RunSettings& settings, std::shared_ptr<ScenePoses> scene_poses)
    : context(settings.backend.context),
      scene(std::move(loaded)),
      triangles(scene_info(scene, {}).triangles),
      decisions(derive_effects(scene)),
      effects(effects_on(decisions) & ~settings.without),
      poses(scene_poses ? std::move(scene_poses)
                        : std::make_shared<ScenePoses>(settings.scene, settings.scene_library, settings.overrides)) {
  require_given_bakes(settings.bakes, settings.methods, scene, effects);
}

StagedMethod::StagedMethod(const MethodSpec& spec, const Error& refusal)
    : prepared_(std::make_shared<const PreparedMethod>(
          PreparedMethod{.baked = std::make_unique<BakedMethod>(make_bake(find_method(spec), spec)), .gpu = nullptr})),
      drawn_{.spec = spec},
      refusal_(refusal) {}

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
  if (settings.view.path.kind == AnimationPath::animation) shapes_ = shared.scene.meshes;
  if (is_first) {
    shared.scene = refined_for_visibility(std::move(shared.scene), shared.effects);
    const std::optional<DiskCache> cache = cache_in(settings.cache);
    shared.gpu = std::make_unique<GpuScene>(shared.context.info(), shared.scene, shared.effects, of_upload,
                                            cache ? &*cache : nullptr);
    const GpuVisibility* const visibility = shared.gpu->visibility();
    if (visibility != nullptr && !visibility->shortage().empty())
      shared.scene.warnings.push_back(visibility->shortage());
  }
  for (const StagedFrames& method : wanted) {
    const auto failure =
        catch_failure(shared.context, method.spec, [&] { methods_.push_back(staged(method, parts.next(1, "bake "))); });
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
  const FootprintFilter own = footprint_filter_of(settings_.footprint, scene());
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

std::shared_ptr<const PreparedMethod> Stage::prepared(const MethodSpec& spec, const EffectSet& effects,
                                                      const GpuScene& gpu_scene, const Progress& progress) const {
  BakedMethod made = make_bake(find_method(spec), spec);
  const std::optional<DiskCache> files = cache_in(settings_.cache);
  const std::optional<BakeFolder> given = given_bake(settings_.bakes, spec);
  BakeSource source{.cache = files ? &*files : nullptr};
  if (given) {
    made.given_by = given->folder().string();
    source.given = [&, wanted = made](std::size_t material) { return given->read(wanted, scene(), material, effects); };
  }
  return std::make_shared<const PreparedMethod>(
      bake_and_upload(gpu_scene, scene(), effects, std::move(made), source, progress));
}

StagedMethod Stage::staged(const StagedFrames& method, const Progress& progress) const {
  std::shared_ptr<const PreparedMethod>& known = prepared_->methods[text_of_maps(method.spec)];
  if (!known) known = prepared(method.spec, effects(), *prepared_->gpu, progress);
  return {context().info(), *prepared_->gpu, scene(), known, method, size_, settings_.backend.tile};
}

SceneInfo Stage::info() const {
  SceneInfo info = scene_info(scene(), {});
  info.triangles = prepared_->triangles;
  return info;
}

std::span<const StagedMethod> Stage::requested_methods() const {
  return std::span(methods_).first(settings_.methods.size());
}

View Stage::view(double distance) const {
  return {.size = size_, .camera = camera_at_distance(scene(), distance), .seed = settings_.reference.seed};
}

void Stage::pose_at(double seconds) {
  if (posed_at_ == seconds) return;
  Scene posed = prepared_->poses->at(seconds, PlacedBounds{scene().bounds, scene().origin});
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
  if (settings_.view.path.kind == AnimationPath::light) {
    prepared_->scene.lights = lights_on_path(settings_.view.path, scene(), lights_, view);
    prepared_->gpu->update(scene());
  }
  if (settings_.view.path.kind == AnimationPath::animation) pose_at(view.seconds);
  return {.size = size_,
          .camera = camera_on_path(settings_.view.path, scene(), view),
          .seed = settings_.reference.seed,
          .frame = view.frame};
}

StagedMethod Stage::stage_with(const EffectSet& effects, GpuScene& gpu_scene) const {
  const StagedFrames wanted{.spec = methods_.front().spec(), .filter = methods_.front().filter()};
  return {
      context().info(),      gpu_scene, scene(), prepared(wanted.spec, effects, gpu_scene, no_progress), wanted, size_,
      settings_.backend.tile};
}

StagedMethod Stage::stage(const MethodSpec& method, const Progress& progress) const {
  return staged({.spec = method, .filter = footprint_filter_of(settings_.footprint, scene())}, progress);
}

InteriorFinder Stage::interior_finder() const { return {*prepared_->gpu, scene()}; }

FrameRenderer Stage::dense_frames(const StagedMethod& method) const {
  ShaderVariant wanted = frame_program(scene(), footprint_filter_of(settings_.footprint, scene()));
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

}  // namespace footprint
