// Samples facets of equal area on a patch and determines the directions that each of them sees.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/microgeometry/patch.hpp"

namespace footprint {

/// Facets of equal area, each on a triangle of the patch.
struct FacetSamples {
  std::vector<glm::vec3> positions;
  std::vector<std::uint32_t> triangles;  ///< the triangle of each
  double facet_area = 0.0;               ///< of each, in the patch's units

  [[nodiscard]] std::size_t size() const { return positions.size(); }
};

/// Draws `count` >= 1 stratified samples, one in each of `count` equal shares of the area, in the order of the
/// triangles. A triangle gets its expected number to within one. Deterministic for a seed. The patch must satisfy
/// check_patch.
[[nodiscard]] FacetSamples sample_facets(const Patch& patch, std::size_t count, std::uint64_t seed);

/// The visibility Vs(x, w) of Iwasaki 2012, Eq. 2: one bit per direction and sample.
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

/// Determines the visibility of `samples` in the infinitely tiled patch for `directions` (unit, z > 0). The result is
/// independent of the number of threads.
/// A sample sees a direction if its facet faces it and no triangle that faces the direction occludes it. The tiling
/// projects along the direction onto a torus, where each sample is tested against every triangle that covers it. So
/// grazing rays of any length find all copies, without resampling a depth map.
/// Triangles that face away need no test on closed surfaces, because a ray that enters also leaves.
[[nodiscard]] FacetVisibility facet_visibility(const Patch& patch, const FacetSamples& samples,
                                               std::span<const glm::dvec3> directions, const Progress& progress);

}  // namespace footprint
