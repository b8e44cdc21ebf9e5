// Which facets of a tiled patch see which directions: exact, by projecting the patch along each direction.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/microgeometry/facet_samples.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint {

/// Vs(x, w) of Iwasaki 2012, Eq. 2, one bit for each direction and sample.
class FacetVisibility {
 public:
  FacetVisibility() = default;
  /// Nothing is visible yet.
  FacetVisibility(std::size_t directions, std::size_t samples)
      : directions_(directions), words_((samples + 63) / 64), bits_(directions * words_) {}

  [[nodiscard]] std::size_t directions() const { return directions_; }

  /// The samples that see a direction: sample i is bit i % 64 of word i / 64.
  [[nodiscard]] std::span<const std::uint64_t> of(std::size_t direction) const {
    return {bits_.data() + direction * words_, words_};
  }
  [[nodiscard]] std::span<std::uint64_t> of(std::size_t direction) {
    return {bits_.data() + direction * words_, words_};
  }
  [[nodiscard]] bool visible(std::size_t direction, std::size_t sample) const {
    return ((of(direction)[sample / 64] >> (sample % 64)) & 1U) != 0;
  }

  friend bool operator==(const FacetVisibility&, const FacetVisibility&) = default;

 private:
  std::size_t directions_ = 0, words_ = 0;
  std::vector<std::uint64_t> bits_;
};

/// A sample sees a direction if its facet faces it and no triangle of the endlessly tiled patch that faces the
/// direction lies in front of it. Along a direction the tiling projects onto a torus, where each sample is tested
/// against every triangle that covers it: no copy is left out however far a grazing ray goes, and no depth map is
/// resampled. That triangles which face away need not be tested holds for surfaces with an inside: a ray that enters
/// leaves again. `directions` are unit with z > 0. The result does not depend on the number of threads.
[[nodiscard]] FacetVisibility facet_visibility(const Patch& patch, const FacetSamples& samples,
                                               std::span<const glm::dvec3> directions, const Progress& progress);

}  // namespace footprint
