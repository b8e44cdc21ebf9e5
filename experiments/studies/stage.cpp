// Sets up a stage in order: context, scene, methods, reference.
#include "experiments/studies/stage.hpp"

#include <fmt/format.h>

#include <cmath>
#include <new>
#include <tuple>
#include <utility>

#include "experiments/studies/run_info.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/scene/assembly/load_scene.hpp"

namespace footprint {
namespace {

constexpr int default_width = 512;
constexpr float highest_default = 1 << 20;  // of a camera narrower than a hair
constexpr std::uint64_t pixel_bytes = 16;   // RGBA, 32-bit floats

// A method on the GPU, baked and uploaded one material after the other, so that what is baked lies in memory twice for
// one texture at most. A frame build may read what was baked; of every other method the GPU has all that a frame
// needs.
using Uploaded = std::pair<std::unique_ptr<BakedMethod>, std::unique_ptr<GpuMethod>>;

Uploaded bake_and_upload(const GpuScene& gpu_scene, const Scene& scene, const EffectSet& effects, const Method& method,
                         const MethodSpec& spec, const BakeCache* cache, const Progress& progress) {
  auto baked = std::make_unique<BakedMethod>(unbaked(method, spec));
  auto gpu = std::make_unique<GpuMethod>(gpu_scene, *baked);
  bake_materials(*baked, scene, effects, progress, cache, [&](std::size_t material) {
    gpu->upload_material(material, [&](std::size_t texture) {
      if (!gpu->has_frame_build()) free_texels(baked->materials[material].textures[texture]);
    });
  });
  return {std::move(baked), std::move(gpu)};
}

Uploaded bake_and_upload(const GpuScene& gpu_scene, const Scene& scene, const EffectSet& effects,
                         const MethodSpec& spec, const std::optional<DiskCache>& files, const Progress& progress) {
  const Method& method = find_method(spec.name);
  if (!files) return bake_and_upload(gpu_scene, scene, effects, method, spec, nullptr, progress);
  const BakeCache cache(*files);
  return bake_and_upload(gpu_scene, scene, effects, method, spec, &cache, progress);
}

// The scene's own maps are there already, and available memory knows it.
void require_maps(const MemoryEstimate& estimate) {
  require_memory(estimate.peak() - estimate.kept,
                 fmt::format("what {} methods make of the maps", estimate.methods.size()),
                 "compare fewer methods at once, use smaller textures, or free memory");
}

// A method that is to be staged.
struct WantedMethod {
  MethodSpec spec;
  FootprintFilter filter;
};

std::vector<WantedMethod> wanted_methods(const RunSettings& settings, const FootprintFilter& filter) {
  std::vector<WantedMethod> wanted;
  for (const MethodSpec& spec : settings.methods) wanted.push_back({.spec = spec, .filter = filter});
  return wanted;
}

// Of `direct` under the filter of the unit, added where it is not there yet. `direct:option=...` is another method.
std::size_t place_of_unit(const RunSettings& settings, std::vector<WantedMethod>& wanted, const FootprintFilter& own) {
  const FootprintFilter filter = settings.timing.unit.value_or(own);
  const auto is_unit = [&](const WantedMethod& method) {
    return method.spec.text == "direct" && method.filter == filter;
  };
  const auto found = std::ranges::find_if(wanted, is_unit);
  const auto place = static_cast<std::size_t>(found - wanted.begin());
  if (found == wanted.end())
    wanted.push_back({.spec = {.text = "direct", .name = "direct", .options = {}}, .filter = filter});
  return place;
}

// Whether the context is lost.
bool clear_errors(const gl::Context& context) {
  const std::vector<std::string> errors = context.take_debug_errors();
  return std::ranges::any_of(errors, [](const std::string& e) { return e.find("CONTEXT_LOST") != std::string::npos; });
}

}  // namespace

std::vector<NormalMemory> normal_memory_of(std::span<const MethodSpec> methods, const EffectSet& effects) {
  std::vector<NormalMemory> memory;
  for (const MethodSpec& spec : methods) {
    const Method& method = find_method(spec.name);
    const BakedMethod unmade = unbaked(method, spec);
    memory.emplace_back([&method, options = unmade.options, on = effects & method.info().honours](
                            const Material& material) { return method.normal_memory(material, options, on); });
  }
  return memory;
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

std::optional<DiskCache> cache_of(const RunSettings& settings) {
  if (!settings.cache) return {};
  return DiskCache(*settings.cache);
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

StagedMethod::StagedMethod(const MethodSpec& spec, const Error& refusal)
    : baked_(std::make_unique<BakedMethod>(unbaked(find_method(spec.name), spec))), refusal_(refusal) {}

StagedMethod::StagedMethod(const gl::ContextInfo& context, GpuScene& scene, const Scene& values,
                           const EffectSet& effects, const MethodSpec& spec, const FootprintFilter& filter,
                           const glm::ivec2& size, const RunSettings& settings, const Progress& progress) {
  std::tie(baked_, gpu_) = bake_and_upload(scene, values, effects, spec, cache_of(settings), progress);
  frames_ = std::make_unique<FrameRenderer>(
      context, scene, *gpu_, size,
      ProgramSettings{.sampling = Sampling::frame, .footprint = filter, .orthographic = values.camera.orthographic},
      settings.backend.tile);
}

Stage::Stage(Scene scene, const RunSettings& settings, const Progress& progress, int pictures, Unit unit,
             Refusal refusal)
    : context_(settings.backend.context),
      scene_(std::move(scene)),
      triangles_(scene_info(scene_, {}).triangles),
      settings_(settings),
      size_(frame_size(scene_, settings.view.size)),
      decisions_(derive_effects(scene_)),
      effects_(effects_on(decisions_) & ~settings.without) {
  require_pictures(size_, pictures);
  const FootprintFilter filter = footprint_filter_of(settings, scene_);
  std::vector<WantedMethod> wanted = wanted_methods(settings, filter);
  if (unit == Unit::direct) unit_ = place_of_unit(settings, wanted, filter);
  std::vector<MethodSpec> specs;
  for (const WantedMethod& method : wanted) specs.push_back(method.spec);
  const MemoryEstimate memory = estimate_memory(scene_, effects_, normal_memory_of(specs, effects_));
  require_maps(memory);
  scene_ = refined_for_visibility(std::move(scene_), effects_);
  const std::optional<DiskCache> cache = cache_of(settings);
  const auto bakes = static_cast<double>(wanted.size() + 1);
  const double upload = hides_environment(effects_) ? bakes : 1.0;  // visibility takes as long as all bakes, or longer
  ProgressParts parts(progress, upload + bakes);
  gpu_scene_ =
      std::make_unique<GpuScene>(context_.info(), scene_, effects_, parts.next(upload, ""), cache ? &*cache : nullptr);
  std::vector<std::optional<StagedMethod>> staged(wanted.size());
  for (const std::size_t i : memory.bake_order()) {
    const WantedMethod& method = wanted[i];
    const auto failure = failure_of(context_, method.spec, [&] {
      staged[i].emplace(context_.info(), *gpu_scene_, scene_, effects_, method.spec, method.filter, size_, settings,
                        parts.next(1, "bake "));
    });
    if (!failure) continue;
    if (i >= settings.methods.size() || refusal == Refusal::ends_the_run) throw *failure;
    staged[i].emplace(method.spec, *failure);
  }
  for (std::optional<StagedMethod>& method : staged) methods_.push_back(*std::move(method));
  std::tie(base_, gpu_base_) =
      bake_and_upload(*gpu_scene_, scene_, effects_, base_surface(),
                      {.text = "reference", .name = "reference", .options = {}}, nullptr, parts.next(1, "bake "));
  reference_ =
      std::make_unique<Supersampler>(context_.info(), *gpu_scene_, *gpu_base_, settings.reference.filter,
                                     scene_.camera.orthographic, settings.backend.tile, settings.reference.environment);
  context_.check("setting up the scene");
}

SceneInfo Stage::info(const Exposure& exposure) const {
  SceneInfo info = scene_info(scene_, exposure);
  info.triangles = triangles_;
  return info;
}

View Stage::view(double distance) const { return {.size = size_, .camera = camera_at_distance(scene_, distance)}; }

void Stage::move_lights(std::vector<Light> lights) {
  scene_.lights = std::move(lights);
  gpu_scene_->update(scene_);
}

StagedMethod Stage::stage(const MethodSpec& method, const Progress& progress) const {
  return {context_.info(), *gpu_scene_, scene_,  effects_, method, footprint_filter_of(settings_, scene_),
          size_,           settings_,   progress};
}

InteriorFinder Stage::interior_finder() const { return {*gpu_scene_, scene_}; }

FrameRenderer Stage::dense_frames(const StagedMethod& method) const {
  return {context_.info(),
          *gpu_scene_,
          method.gpu(),
          size_,
          ProgramSettings{.sampling = Sampling::frame,
                          .footprint = footprint_filter_of(settings_, scene_),
                          .orthographic = scene_.camera.orthographic,
                          .environment = EnvironmentUse::dense},
          settings_.backend.tile};
}

FrameRenderer Stage::counting_frames(const StagedMethod& method) const {
  return {context_.info(),
          *gpu_scene_,
          method.gpu(),
          size_,
          ProgramSettings{.sampling = Sampling::frame,
                          .footprint = footprint_filter_of(settings_, scene_),
                          .counting = true,
                          .orthographic = scene_.camera.orthographic},
          settings_.backend.tile};
}

Supersampler Stage::finest_level(const StagedMethod& method) const {
  return {context_.info(),       *gpu_scene_, method.gpu(), settings_.reference.filter, scene_.camera.orthographic,
          settings_.backend.tile};
}

}  // namespace footprint
