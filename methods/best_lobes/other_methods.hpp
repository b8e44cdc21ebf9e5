// The lobes that tan_gmm and cells have at a texel, as starts of a fit: a bound for them may err no more than they do.
#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "methods/best_lobes/lobe_shapes.hpp"
#include "methods/cells/cell_moments.hpp"
#include "methods/tan_gmm/mixture_chain.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::best_lobes {

/// Mixtures of one number of lobes: those of tan_gmm, aligned with their neighbours and not, and those of cells.
class OtherMethods {
 public:
  /// Bakes the levels above the finest. count: 1 to 8. with_roughness: texels have base lobes of their own.
  OtherMethods(const Material& material, std::size_t count, bool with_roughness, const Progress& progress);

  /// The mixtures of a texel above the finest level, over the base lobe of `family`. Weights sum to 1, but with
  /// roughness each is times its base lobe's energy over that of the family's. A mixture without normals is left out.
  /// Lobes of cells lose their direction with Shape::round.
  [[nodiscard]] std::vector<std::vector<FittedLobe>> at(std::size_t level, std::size_t texel,
                                                        const LobeFamily& family) const;

 private:
  std::vector<tan_gmm::MixtureChain> mixtures_;
  std::size_t count_;
  std::array<cells::PartFrame, cells::most_parts> frames_;
  std::vector<std::vector<Image>> moments_;         // by layer
  std::vector<std::vector<Image>> part_variances_;  // by layer, times the part's weight; none without roughness
  std::vector<Image> variances_;                    // of the base lobe; none without roughness
};

}  // namespace footprint::best_lobes
