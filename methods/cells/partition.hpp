// Normals as weighted points of a plane, their anisotropic Gaussians, and their partition: the share of each texel in
// each part, the same for all levels. And what a texel stores of each part: weight, first and second moments along the
// axes of the part about its centre, and values of the texel. All are linear in the texels below.
#pragma once

#include <array>
#include <functional>
#include <glm/glm.hpp>
#include <span>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::cells {

/// The plane of the moments.
enum class Coordinates { stereographic, slopes };

/// n_xy / (1 + n_z) of a unit normal: the stereographic projection from the pole below. It is conformal, and the
/// horizon has length 1. Normals below the horizon are moved onto it.
[[nodiscard]] inline glm::dvec2 stereographic_of(const glm::dvec3& normal) {
  const glm::dvec2 p = glm::dvec2(normal) / (1.0 + std::max(normal.z, 0.0));
  return normal.z < 0.0 ? p / std::max(glm::length(p), 1e-12) : p;
}

/// A normal of the map as a point; invalid normals have weight 0.
struct PlanePoint {
  glm::dvec2 at{0.0};
  double weight = 0.0;
};

/// The points of a normal map (RGBA: normal, weight), row by row. Slopes are limited to `steepest`.
[[nodiscard]] std::vector<PlanePoint> plane_points(const Image& normals, Coordinates coordinates, double steepest);

/// Weighted sums over points, which add up from texels to blocks to larger blocks.
struct PlaneSums {
  double weight = 0.0;
  glm::dvec2 first{0.0};
  glm::dvec3 second{0.0};  ///< xx, xy, yy

  void add(const glm::dvec2& p, double w);
  void add(const PlaneSums& others);
};

/// c + b.p - p^T A p / 2: a log density, or a sum of several.
struct Quadratic {
  double c = 0.0;
  glm::dvec2 b{0.0};
  glm::dvec3 a{0.0};  ///< xx, xy, yy

  void add(const Quadratic& other, double factor);
  [[nodiscard]] double at(const glm::dvec2& p) const;
};

/// log(share g). g is the Gaussian with the mean and the covariance of the sums, widened by `lobe_floor` of the base
/// lobe. `variance` is the slope variance of the base lobe, which over the plane is variance ((1 + |mean|^2) / 2)^2 per
/// axis.
[[nodiscard]] Quadratic log_density(const PlaneSums& sums, double share, double variance);

/// The share of the base lobe's variance that widens a part. It is well below one, so that parts are separated even if
/// the lobe blurs them into one peak.
inline constexpr double lobe_floor = 0.1;

constexpr int most_parts = 8;

/// How texels are assigned to parts. global: by one mixture over the whole map. joint: so that one Gaussian per part
/// describes blocks of every size.
enum class Labels { joint, global };

struct PartitionSettings {
  int parts = 4;
  Labels labels = Labels::joint;
  double variance = 1.0 / 64.0;  ///< slope variance per axis of the base lobe, which limits the resolution of parts
  int rounds = 20;               ///< of `joint`
};

/// The shares of the texels, row by row: `parts` numbers per texel that sum to one. Shares of texels without weight are
/// arbitrary. `points` are width * height stereographic points. Equal arguments give equal shares at any number of
/// threads. Errors: std::logic_error if the sizes do not match.
[[nodiscard]] std::vector<float> partition(std::span<const PlanePoint> points, int width, int height,
                                           const PartitionSettings& settings, const Progress& progress);

/// The slope variance of the base lobe of each texel of a normal map of width x height texels, row by row, where
/// roughness_lies_on_normals(material).
[[nodiscard]] std::vector<double> texel_variances(const Material& material, int width, int height);

/// Whether each value belongs to the upper of two groups, by 2-means that starts from the extremes (Lloyd 1982).
/// Equal values are all in the lower group. Values are finite.
[[nodiscard]] std::vector<bool> upper_group(std::span<const double> values);

/// Partitions like partition(), with half of the parts, rounded up, for the texels of the narrower lobes and the rest
/// for the others: one lobe cannot stand for a sharp and a blunt one. The groups are those of the logarithms of the
/// variances.
/// variances: the slope variance of each texel's lobe, above 0. Where all are in one group, or settings.parts is 1, the
/// result is that of partition(). settings.variance is that of each group's mean. Errors: those of partition().
[[nodiscard]] std::vector<float> partition_with_roughness(std::span<const PlanePoint> points,
                                                          std::span<const double> variances, int width, int height,
                                                          const PartitionSettings& settings, const Progress& progress);

/// The stored second moments of a part. full: all three, along the axes of the plane. axes: two, along the axes of the
/// part, in which the third is 0 over the whole map.
enum class Covariance { full, axes };

/// Channels per part: w, w dx, w dy, w dx^2, w dx dy, w dy^2 with d the distance from the part's centre along its axes.
/// `axes` leaves out w dx dy.
[[nodiscard]] constexpr int part_channels(Covariance covariance) { return covariance == Covariance::full ? 6 : 5; }

/// The origin and the axes of a part's moments.
struct PartFrame {
  glm::dvec2 centre{0.0};
  glm::dvec2 axis{1.0, 0.0};  ///< unit; the second axis is a quarter turn counter-clockwise

  [[nodiscard]] bool operator==(const PartFrame&) const = default;
};

/// The points of a whole map and their shares in the parts, row by row.
struct PartedPoints {
  std::vector<PlanePoint> points;
  std::vector<float> shares;
  std::size_t parts;
  int width, height;
};

/// The stereographic points of a normal map (as plane_points) and their shares by partition_with_roughness.
[[nodiscard]] PartedPoints parted_points(const Image& normals, double steepest, std::span<const double> variances,
                                         const PartitionSettings& settings, const Progress& progress);

/// The mean of each part over the whole map and, with `axes`, the direction of its largest spread. Parts without texels
/// have those of all texels.
[[nodiscard]] std::array<PartFrame, most_parts> part_frames(const PartedPoints& map, Covariance covariance);

/// The finest level of one layer: channels 4 layer to 4 layer + 3 of the channels of all parts in sequence, 0 beyond
/// the last part. The weights of a texel sum to the weight of its normal.
[[nodiscard]] Image moment_layer(const PartedPoints& map, const std::array<PartFrame, most_parts>& frames,
                                 Covariance covariance, int layer);

/// Layers of four channels for `channels` of all parts together.
[[nodiscard]] constexpr int layer_count(int channels) { return (channels + 3) / 4; }

/// The finest level of w v for parts 4 layer and following. v is the value of `values` (one channel) at the texel's
/// centre.
[[nodiscard]] Image value_layer(const PartedPoints& map, const Image& values, int layer);

/// The mip chains of layers by their finest levels, made one after the other, because all finest levels together would
/// be the largest allocation of the bake.
[[nodiscard]] std::vector<std::vector<Image>> layer_chains(int layers, const std::function<Image(int layer)>& finest);

/// The mip chains of the layers of moment_layer.
[[nodiscard]] std::vector<std::vector<Image>> moment_chains(const PartedPoints& map,
                                                            const std::array<PartFrame, most_parts>& frames,
                                                            Covariance covariance);

}  // namespace footprint::cells
