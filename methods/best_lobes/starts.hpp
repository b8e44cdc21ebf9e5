// Starts of lobe fits: clusters of the normals of one roughness, and what EM makes of them.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "methods/best_lobes/lobe_shapes.hpp"
#include "methods/fournier/peaks.hpp"
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

}  // namespace footprint::best_lobes
