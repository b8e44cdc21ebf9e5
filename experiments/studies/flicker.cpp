// Changes of a method's frames that the reference does not show.
#include "experiments/studies/flicker.hpp"

#include <algorithm>
#include <functional>

#include "experiments/studies/reference_noise.hpp"
#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

Image in_both(Image first, const Image& second) {
  std::ranges::transform(first.texels, second.texels, first.texels.begin(), std::multiplies<>());
  return first;
}

Image without(Image mask, const Image& left_out) {
  std::ranges::transform(mask.texels, left_out.texels, mask.texels.begin(), std::minus<>());
  return mask;
}

}  // namespace

std::optional<Flicker> flicker_between(const Image& before, const Image& picture, const Supersampled& reference_before,
                                       const Supersampled& reference, float exposure) {
  const auto figures = compare_changes(before, picture, reference_before.mean, reference.mean, exposure);
  if (!figures) return std::nullopt;
  Flicker flicker{.mean = figures->mean, .p99 = figures->p99};
  flicker.ghosting = normalized_color(picture, reference.mean, exposure,
                                      trailing_edges(reference_before.mean, reference.mean, exposure));
  if (!reference_before.halves || !reference.halves) return flicker;
  const auto& [old_even, old_odd] = *reference_before.halves;
  const auto& [even, odd] = *reference.halves;
  if (const auto noise = compare_changes(old_even, even, old_odd, odd, exposure)) {
    flicker.noise_floor = noise->mean / halves_over_whole;
  }
  return flicker;
}

FlickerCauses flicker_causes(const Image& before, const Image& picture, const Reference& target_before,
                             const Reference& target, float exposure) {
  const Image& old_reference = target_before.reference.mean;
  const Image& reference = target.reference.mean;
  const Image interior = in_both(target_before.parts.interior, target.parts.interior);
  const Image edges = without(object_pixels(reference), interior);
  const auto over = [&](const Image& mask) {
    return compare_changes(before, picture, old_reference, reference, exposure, mask);
  };
  FlickerCauses causes{.shading = over(interior), .edges = over(edges)};
  if (!target_before.bound || !target.bound) return causes;
  const Image pixels = in_both(target_before.bound->pixels, target.bound->pixels);
  const Image& old_bound = target_before.bound->picture;
  const Image& bound = target.bound->picture;
  causes.filter = compare_changes(old_bound, bound, old_reference, reference, exposure, pixels);
  causes.method = compare_changes(before, picture, as_reference(old_bound, old_reference),
                                  as_reference(bound, reference), exposure, pixels);
  return causes;
}

void add_flicker(std::span<Record> records, const FrameBefore& before, std::span<const Image> images,
                 const Reference& reference, float exposure) {
  for (std::size_t m = 0; m < records.size(); ++m) {
    if (images[m].texels.empty() || before.images[m].texels.empty()) continue;
    std::optional<Flicker>& flicker = records[m].flicker;
    flicker = flicker_between(before.images[m], images[m], before.reference.reference, reference.reference, exposure);
    if (!flicker) continue;
    flicker->causes = flicker_causes(before.images[m], images[m], before.reference, reference, exposure);
    if (records[m].history) flicker->causes.filter = flicker->causes.method = {};  // it has no footprint filter
  }
}

}  // namespace footprint
