// Expectation-maximisation with Tan's prior for one texel: Gaussians over the disc, isotropic or of full covariance.
#pragma once

#include <array>
#include <span>

#include "methods/tan_gmm/samples.hpp"

namespace footprint::tan_gmm {

/// The least variance, because a Gaussian that shrinks onto one normal would have an infinite likelihood.
constexpr float variance_floor = 1e-6F;

/// alpha g(n; mu, sigma) with g a density over dx dy of the disc (Tan 2005, section 3).
struct Gaussian {
  float alpha = 0.0F;               ///< 0 to 1; a mixture sums to 1
  float x = 0.0F, y = 0.0F;         ///< mu
  float variance = variance_floor;  ///< sigma^2 per axis

  friend bool operator==(const Gaussian&, const Gaussian&) = default;
};

/// The prior of the means from known neighbours. Its log is -c sum_k sum_i alpha_ki |mu_ki - mu_i|^2 (Tan 2005, section
/// 4.1; the factor c after its M-step).
class Prior {
 public:
  /// No neighbours yet; c >= 0.
  explicit Prior(double c) : c_(c) {}

  /// A neighbour's mixture, components in the order of all others.
  void add(std::span<const Gaussian> neighbour);

  /// c sum_k alpha_ki, and the mean of mu_ki with those weights; both 0 without neighbours.
  [[nodiscard]] double weight(std::size_t i) const { return c_ * weight_[i]; }
  [[nodiscard]] double mean_x(std::size_t i) const { return x_[i]; }
  [[nodiscard]] double mean_y(std::size_t i) const { return y_[i]; }

  /// The log of the prior for component i at (x, y), up to a constant that depends on the neighbours alone.
  [[nodiscard]] double log_density(std::size_t i, double x, double y) const;

 private:
  double c_;
  std::array<double, most_components> weight_{}, x_{}, y_{};  // sum and means over the neighbours
};

/// The mean's update. exact: the posterior's maximum. published: Tan's, whose prior weighs c, not 2 sigma^2 c.
enum class MStep { exact, published };

/// The update of the variance. exact: the responsibilities' mean of |n - mu|^2 / 2. published: as the paper prints it,
/// which divides that mean by the number M of samples again. published_share: the printed sum over 2 M alone, without
/// the division by the sum of responsibilities.
enum class VarianceStep { exact, published, published_share };

/// Where EM starts. inherit: from the coarser texel's mixture, so that components keep their meaning from level to
/// level, or as dense_seed if there is none. dense_seed: the best of clusters, a seed on the densest spot, and the
/// coarser texel's mixture if there is one. clusters: only from clusters, as in the paper.
enum class Start { inherit, dense_seed, clusters };

struct FitSettings {
  std::size_t components = 4;  ///< 1 to most_components
  bool align = true;           ///< neighbours attract the means; otherwise each texel on its own
  MStep m_step = MStep::exact;
  VarianceStep variance = VarianceStep::exact;
  Start start = Start::inherit;
  bool full_covariance = false;  ///< full covariances, by EM from the isotropic mixture
  double prior_weight = 1.0;     ///< c of the prior
  int most_iterations = 40;      ///< EM steps from the best start
  int trial_iterations = 4;      ///< EM steps for the choice of a start
  double tolerance = 1e-4;       ///< gain of the log posterior per unit of sample weight that ends EM
};

/// The result of the E-step for one component: sums over samples of weight * responsibility.
struct Moments {
  double weight = 0;
  double x = 0, y = 0;  ///< mean
  double scatter = 0;   ///< sum of squared distances from that mean, both axes together
};

struct Expectation {
  std::array<Moments, most_components> moments{};
  double log_likelihood = 0;  ///< of the mixture that gave the responsibilities
};

/// The E-step, with responsibilities by log-sum-exp. `samples` is not empty, and at least one component has alpha above
/// 0. A sample with a spread contributes the mean log density of its points (Verbeek, Nunnink, Vlassis 2006).
[[nodiscard]] Expectation expectation(const Samples& samples, std::span<const Gaussian> mixture);

/// The M-step: alpha = sum / M, then mu with the variance before the step, then sigma^2 per axis about the new mean,
/// limited to the floor. A component without samples keeps mean and variance, and gets alpha 0.
void maximise(const Expectation& e, const Prior& prior, MStep step, std::span<Gaussian> mixture,
              VarianceStep variance = VarianceStep::exact);

/// The log of the prior of a mixture.
[[nodiscard]] double log_prior(const Prior& prior, std::span<const Gaussian> mixture);

/// Iterates until the posterior gains less than `tolerance` per unit of weight; returns that before the last step.
double iterate(const Samples& samples, const Prior& prior, MStep step, int most_iterations, double tolerance,
               std::span<Gaussian> mixture, VarianceStep variance = VarianceStep::exact);

/// A Gaussian over the disc with a full covariance, times alpha.
struct FullGaussian {
  double alpha = 0.0;
  double x = 0.0, y = 0.0;              ///< mean
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< covariance, without the floor of EM
};

/// Fits `mixture` to the samples, starting from `start` component by component. The prior attracts means as with
/// isotropic Gaussians, here by the exact M-step (N I + 2 w S) mu = N m + 2 w S mu_0, with S the covariance before the
/// step and w the weight of the prior. Steps and tolerance are those of `settings`. Components without samples keep
/// their values and get alpha 0; without any samples all components do.
void fit_full(const Samples& samples, const Prior& prior, const FitSettings& settings, std::span<const Gaussian> start,
              std::span<FullGaussian> mixture);

/// The round Gaussian with the same mean spread, which neighbours and finer levels read.
[[nodiscard]] Gaussian rounded(const FullGaussian& full);

}  // namespace footprint::tan_gmm
