// The choice between exposures, facts of a context and of a scene, and their hash: structured bindings list every
// setting, so a new one does not compile until it is considered here.
#include "experiments/studies/run_info.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "experiments/studies/views.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {
namespace {

constexpr double percentile = 0.95;
constexpr float target_luminance = 0.8F;

// Without a number, `word`.
std::string number_or(const std::optional<double>& value, const char* word) {
  return value ? fmt::format("{}", *value) : word;
}

std::string filter_or(const std::optional<FootprintFilter>& filter, const char* word) {
  return filter ? footprint_filter_text(*filter) : word;
}

// A distance does not depend on the others, except for the first, which decides an automatic exposure, and for the
// frame before it in a zoom.
void add_view(ContentHash& hash, const RunSettings& settings, const Scene& scene) {
  const auto& [size, quick_size, distances, zoom, exposure, error_scale] = settings.view;
  const glm::ivec2 pixels = frame_size(scene, size);
  hash.add(fmt::format("{}x{}", pixels.x, pixels.y));
  const std::vector<RunView> all = run_views(settings, scene);
  for (const RunView& view : std::span(all).first(zoom.frames > 0 ? all.size() : 1))
    hash.add(fmt::format("{} {} {}", view.distance, view.degrees, view.seconds));
  hash.add(exposure ? fmt::format("{} {}", exposure->factor, static_cast<int>(exposure->source)) : "default");
  hash.add(fmt::format("{} {}", zoom.frames, number_or(error_scale, "auto")));
  const auto& [kind, degrees, axis, until] = settings.path;
  hash.add(fmt::format("{} {} {}", kind ? static_cast<int>(*kind) : -1, number_or(degrees, "default"),
                       number_or(until, "default")));
  if (axis) hash.add(fmt::format("{} {} {}", axis->x, axis->y, axis->z));
}

void add_reference(ContentHash& hash, const ReferenceSettings& reference) {
  const auto& [spp, by_noise, fixed_spp, noise, spp_max, other_spp, supersampling, seed, filter, environment, bound,
               by_cause] = reference;
  hash.add(fmt::format("{} {} {} {} {}", spp, by_noise, fixed_spp, number_or(noise, "auto"), spp_max));
  hash.add(fmt::format("{} / {}", fmt::join(other_spp, " "), fmt::join(supersampling, " ")));
  hash.add(fmt::format("{} {} {} {} {}", seed, static_cast<int>(filter), static_cast<int>(environment),
                       static_cast<int>(bound), by_cause));
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
  return {.name = std::string(gl::backend_name(context.backend)),
          .renderer = context.renderer,
          .version = context.version,
          .cpu = {}};
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

std::string scene_content(const Scene& scene) {
  ContentHash hash;
  add_content(hash, scene);
  return hash.hex();
}

std::string run_fingerprint(std::string_view maker, const RunSettings& settings, const Scene& scene,
                            const std::string& content, const std::vector<std::string>& more) {
  ContentHash hash;
  hash.add(maker);
  hash.add(content);
  hash.add(scene.source);
  hash.add(settings.without.to_string());
  hash.add(fmt::format("{} {} {}", settings.backend.tile, settings.by_material,
                       footprint_filter_text(footprint_filter_of(settings, scene))));
  for (const MethodSpec& method : settings.methods) {
    hash.add(method.text);
    if (method.file) hash.add(method.file->file_content);
  }
  hash.add(fmt::format("{}", fmt::join(settings.gpus, ",")));
  add_view(hash, settings, scene);
  add_reference(hash, settings.reference);
  const auto& [frames, alpha, clamp, jitter] = settings.history;
  if (frames > 0) hash.add(fmt::format("history {} {} {} {}", frames, alpha, word_for(history_clamps, clamp), jitter));
  const auto& [repeats, processes, unit] = settings.timing;
  hash.add(fmt::format("{} {} {}", repeats, processes, filter_or(unit, "the methods'")));
  for (const std::string& text : more) hash.add(text);
  return hash.hex();
}

}  // namespace footprint
