// Structured bindings list every setting: a new one does not compile until it is considered here.
#include "experiments/studies/run_fingerprint.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "experiments/studies/stage.hpp"
#include "experiments/studies/views.hpp"
#include "renderer/core/hash.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {
namespace {

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
    hash.add(fmt::format("{} {}", view.distance, view.degrees));
  hash.add(exposure ? fmt::format("{} {}", exposure->factor, static_cast<int>(exposure->source)) : "default");
  hash.add(fmt::format("{} {}", zoom.frames, number_or(error_scale, "auto")));
  const auto& [kind, degrees, axis] = settings.path;
  hash.add(fmt::format("{} {}", kind ? static_cast<int>(*kind) : -1, number_or(degrees, "default")));
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
  for (const MethodSpec& method : settings.methods) hash.add(method.text);
  hash.add(fmt::format("{}", fmt::join(settings.gpus, ",")));
  add_view(hash, settings, scene);
  add_reference(hash, settings.reference);
  const auto& [repeats, processes, unit] = settings.timing;
  hash.add(fmt::format("{} {} {}", repeats, processes, filter_or(unit, "the methods'")));
  for (const std::string& text : more) hash.add(text);
  return hash.hex();
}

}  // namespace footprint
