// Pixels that count in both frames, and changes relative to the reference's or to those of `exact`.
#include "experiments/studies/flicker_causes.hpp"

#include "renderer/image/metrics.hpp"

namespace footprint {
namespace {

Image in_both(const Image& first, const Image& second) {
  Image both = first;
  for (std::size_t i = 0; i < both.texels.size(); ++i) {
    if (second.texels[i] <= 0.0F) both.texels[i] = 0.0F;
  }
  return both;
}

Image without(const Image& mask, const Image& left_out) {
  Image rest = mask;
  for (std::size_t i = 0; i < rest.texels.size(); ++i) {
    if (left_out.texels[i] > 0.0F) rest.texels[i] = 0.0F;
  }
  return rest;
}

std::optional<PartFlicker> part_of(const std::optional<FlickerFigures>& figures) {
  if (!figures) return {};
  return PartFlicker{.mean = figures->mean, .p99 = figures->p99};
}

}  // namespace

FlickerCauses flicker_causes(const Image& before, const Image& picture, const ReferenceView& target_before,
                             const ReferenceView& target, float exposure) {
  const Image& old_reference = target_before.reference.mean;
  const Image& reference = target.reference.mean;
  const Image interior = in_both(target_before.parts.interior, target.parts.interior);
  const Image edges = without(object_pixels(reference), interior);
  const auto over = [&](const Image& mask) {
    return part_of(compare_changes_over(before, picture, old_reference, reference, exposure, mask));
  };
  FlickerCauses causes{.shading = over(interior), .edges = over(edges), .filter = {}, .method = {}};
  if (!target_before.bound || !target.bound) return causes;
  const Image pixels = in_both(target_before.bound->pixels, target.bound->pixels);
  const Image& old_bound = target_before.bound->picture;
  const Image& bound = target.bound->picture;
  causes.filter = part_of(compare_changes_over(old_bound, bound, old_reference, reference, exposure, pixels));
  causes.method = part_of(compare_changes_over(before, picture, as_reference(old_bound, old_reference),
                                               as_reference(bound, reference), exposure, pixels));
  return causes;
}

}  // namespace footprint
