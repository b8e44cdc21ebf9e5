// Starts of lobe fits: clusters of the normals of one roughness, what EM makes of them, and the lobes that tan_gmm and
// cells have at a texel, because a bound for them may err no more than they do.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/best_lobes/lobe_shapes.hpp"
#include "methods/cells/partition.hpp"
#include "methods/fournier/peaks.hpp"
#include "methods/tan_gmm/mixture_chain.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::best_lobes {

/// A pooled normal in stereographic coordinates.
struct PlaneNormal {
  double weight;
  Eigen::Vector2d at;  ///< normals below the horizon are moved onto it
  double spread;       ///< slope variance
};

/// Weights sum to 1.
[[nodiscard]] std::vector<PlaneNormal> plane_normals(std::span<const fournier::Peak> target);

/// A lobe of a spread (xx, xy, yy) over the plane; a round one has its mean.
[[nodiscard]] FittedLobe lobe_of_spread(double weight, const Eigen::Vector2d& mean, const Eigen::Vector3d& spread,
                                        Shape shape);

/// `count` clusters about k-means++ seeds (Arthur and Vassilvitskii 2007), drawn from `seed`.
[[nodiscard]] std::vector<FittedLobe> clusters(const std::vector<PlaneNormal>& normals, std::size_t count,
                                               const LobeFamily& family, std::uint64_t seed);

/// EM of the normals, each blurred by the base lobe: the components' own spread is what is left of theirs.
[[nodiscard]] std::vector<FittedLobe> by_em(const std::vector<PlaneNormal>& normals, std::vector<FittedLobe> lobes,
                                            const LobeFamily& family);

struct RoughnessGroups {
  double narrowest = 0.0;                ///< the least slope variance of a base lobe
  std::vector<std::uint32_t> of_texels;  ///< row by row
  std::vector<double> spreads;           ///< of each group: its variance above the narrowest
};

/// The groups of a normal map of width x height texels, where roughness_lies_on_normals(material). The variances of a
/// group differ by a thousandth at most, and its own is their mean.
[[nodiscard]] RoughnessGroups roughness_groups(const Material& material, int width, int height);

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
