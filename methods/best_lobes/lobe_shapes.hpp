// The shapes that lobes of a fit can have, and the fit of K lobes to the NDF of a texel.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <functional>
#include <span>
#include <vector>

#include "methods/fournier/peaks.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::best_lobes {

/// stretched: the base lobe widened by a slope variance, then stretched to a covariance (stretched_part.glsl). It has
/// the lobes of tan_gmm, which are not stretched, and those of cells, which are not widened. round: widened alone.
enum class Shape { stretched, round };

/// Stereographic coordinates n_xy / (1 + n_z) of a unit vector. They are conformal: a slope variance v about the normal
/// at p is the covariance v ((1 + |p|^2) / 2)^2 I. Infinitely far for the pole below, here at most 1000.
[[nodiscard]] Eigen::Vector2d plane_from_direction(const Eigen::Vector3d& direction);
[[nodiscard]] Eigen::Vector3d direction_from_plane(const Eigen::Vector2d& p);

/// ((1 + |p|^2) / 2)^2: a variance over the plane, of a slope variance of 1.
[[nodiscard]] double plane_variance(const Eigen::Vector2d& p);

/// A lobe as its parameters in stereographic coordinates.
struct FittedLobe {
  double weight = 0.0;
  Eigen::Vector2d mean{0.0, 0.0};
  double deviation = 0.0;  ///< of slopes; its square widens the base lobe, with the energy of the base lobe
  Eigen::Vector3d root{0.0, 0.0, 0.0};  ///< xx, yx, yy of the lower triangle L of the covariance L L^T over the plane

  /// xx, xy, yy of that covariance.
  [[nodiscard]] Eigen::Vector3d spread() const {
    return {root.x() * root.x(), root.x() * root.y(), root.y() * root.y() + root.z() * root.z()};
  }
  /// Mean (2), deviation, root (3).
  [[nodiscard]] double& parameter(Eigen::Index i) { return i < 2 ? mean[i] : i == 2 ? deviation : root[i - 3]; }
};

/// Directions above the surface, a lattice over the stereographic plane.
struct Directions {
  std::vector<double> x, y;
  std::vector<double> root_of_angle;  ///< the root of the solid angle of each, sr^(1/2)

  [[nodiscard]] std::size_t size() const { return x.size(); }
};

/// The lobes over one base lobe.
class LobeFamily {
 public:
  /// variance: slope variance of the base lobe, above 0.
  LobeFamily(NormalDistribution distribution, double variance, Shape shape);

  [[nodiscard]] Shape shape() const { return shape_; }
  [[nodiscard]] double variance() const { return variance_; }
  /// The standard deviation per axis of the base lobe's core, in radians.
  [[nodiscard]] double width() const;
  [[nodiscard]] NormalDistribution distribution() const { return distribution_; }
  /// The energy over solid angle of the lobe that is wider by `spread`, over that of the base lobe.
  [[nodiscard]] double energy(double spread) const;

  /// The first parameters of a lobe, which fits change.
  [[nodiscard]] Eigen::Index parameters() const { return shape_ == Shape::round ? 3 : 6; }

  /// The density of a lobe of weight 1 at each direction, 1/sr, times the root of its solid angle, into `values`, and
  /// its derivatives by the parameters into the columns of `derivatives`.
  void evaluate(const FittedLobe& lobe, const Directions& directions, Eigen::Ref<Eigen::VectorXd> values,
                Eigen::Ref<Eigen::MatrixXd> derivatives) const;

  /// Adds `weight` times the round lobe of normals with a slope variance of `spread` about `mean`, in the same measure.
  void add_round(double weight, const Eigen::Vector2d& mean, double spread, const Directions& directions,
                 Eigen::Ref<Eigen::VectorXd> values) const;

 private:
  NormalDistribution distribution_;
  double variance_;
  double support_;  // the greatest u of a base lobe that is not negligible
  Shape shape_;
};

/// The result of one fit.
struct LobeFit {
  std::vector<FittedLobe> lobes;  ///< heaviest first
  /// L2 distance to the target over the directions above the surface, relative to the norm of the target.
  double error = 0.0;
  bool converged = true;  ///< whether the last minimisation ended before its most evaluations
  bool resolved = true;   ///< whether the base lobe is wide enough; else the fit has a wider one, and is no bound
};

/// Mixtures of a number of lobes that a fit starts from, next to its own.
using Starts = std::function<std::vector<std::vector<FittedLobe>>(std::size_t count)>;

/// The edge of the cells of Lambert's disc that normals are pooled in: a sixteenth of the base lobe's deviation.
[[nodiscard]] double cell_edge(const LobeFamily& family);

/// The weights of the lobes together: those of the target, or as the fit has them. One lobe for facets of different
/// roughness has not their energy.
enum class Weights { of_target, free };

/// Fits 1 to `count` lobes, one more after the other, each time from several starts, and keeps the best of all. Where
/// it is resolved, the error exceeds neither that of any mixture of `starts` nor that of fewer lobes. target: pooled
/// normals, not empty; their spread is small against the base lobe.
[[nodiscard]] LobeFit fit_lobes(std::span<const fournier::Peak> target, std::size_t count, const LobeFamily& family,
                                const Starts& starts, Weights weights = Weights::of_target);

}  // namespace footprint::best_lobes
