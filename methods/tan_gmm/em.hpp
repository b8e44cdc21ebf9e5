// Expectation-maximisation with Tan's prior for one texel: a mixture of isotropic Gaussians over the unit disc, or of
// Gaussians with a full covariance.
#pragma once

#include <array>
#include <span>

#include "methods/tan_gmm/samples.hpp"

namespace footprint::tan_gmm {

/// No variance is below it: a Gaussian that shrinks onto one normal would have an infinite likelihood.
constexpr float variance_floor = 1e-6F;

/// alpha g(n; mu, sigma) with g a density over dx dy of the disc (Tan 2005, section 3).
struct Gaussian {
  float alpha = 0.0F;               ///< 0 to 1; those of a mixture sum to 1
  float x = 0.0F, y = 0.0F;         ///< mu
  float variance = variance_floor;  ///< sigma^2 per axis

  friend bool operator==(const Gaussian&, const Gaussian&) = default;
};

/// What the neighbours that are known say of the means: the log of the prior is
/// -c sum_k sum_i alpha_ki |mu_ki - mu_i|^2 (Tan 2005, section 4.1; the factor c after its M-step).
class Prior {
 public:
  /// No neighbours yet; c >= 0.
  explicit Prior(double c) : c_(c) {}

  /// A neighbour's mixture, components in the order of all others.
  void add(std::span<const Gaussian> neighbour);

  /// c sum_k alpha_ki, and the mean of mu_ki with those weights; 0 where it has none.
  [[nodiscard]] double weight(std::size_t i) const { return c_ * weight_[i]; }
  [[nodiscard]] double mean_x(std::size_t i) const { return x_[i]; }
  [[nodiscard]] double mean_y(std::size_t i) const { return y_[i]; }

  /// The log of the prior for component i at (x, y), up to a constant that depends on the neighbours alone.
  [[nodiscard]] double log_density(std::size_t i, double x, double y) const;

 private:
  double c_;
  std::array<double, most_components> weight_{}, x_{}, y_{};  // sum and means over the neighbours
};

/// How the mean is updated. exact: the maximum of the posterior; published: Tan's approximation of it, which weighs the
/// prior by c in place of 2 sigma^2 c.
enum class MStep { exact, published };

/// Where EM starts. inherit: from the coarser texel's mixture where it is known, so that components keep their meaning
/// from level to level, else as dense_seed. dense_seed: the best of clusters, a seed on the densest spot and, where it
/// is known, the coarser texel's mixture. clusters: clusters alone, as the paper has it.
enum class Start { inherit, dense_seed, clusters };

struct FitSettings {
  std::size_t components = 4;  ///< 1 to most_components
  bool align = true;           ///< neighbours draw the means; else each texel on its own
  MStep m_step = MStep::exact;
  Start start = Start::inherit;
  bool full_covariance = false;  ///< a whole covariance each, by EM from the isotropic mixture on
  double prior_weight = 1.0;     ///< c of the prior
  int most_iterations = 40;      ///< EM steps from the best start
  int trial_iterations = 4;      ///< EM steps that each start is judged by
  double tolerance = 1e-4;       ///< gain of the log posterior, a unit of sample weight, that ends EM
};

/// What the E-step leaves of the samples for one component: sums over samples of weight * responsibility.
struct Moments {
  double weight = 0;
  double x = 0, y = 0;  ///< mean
  double scatter = 0;   ///< sum of squared distances from that mean, both axes together
};

struct Expectation {
  std::array<Moments, most_components> moments{};
  double log_likelihood = 0;  ///< of the mixture that the responsibilities are taken from
};

/// The E-step, with responsibilities by log-sum-exp. `samples` is not empty, and a component has an alpha above 0. A
/// sample with a spread counts as its points would with the mean of their log densities (Verbeek, Nunnink, Vlassis
/// 2006).
[[nodiscard]] Expectation expectation(const Samples& samples, std::span<const Gaussian> mixture);

/// The M-step. alpha = sum / M; mu with the variance before the step; then sigma^2 per axis about the new mean, with
/// the floor. A component without samples keeps mean and variance, and has alpha 0.
void maximise(const Expectation& e, const Prior& prior, MStep step, std::span<Gaussian> mixture);

/// The log of the prior at a mixture.
[[nodiscard]] double log_prior(const Prior& prior, std::span<const Gaussian> mixture);

/// Iterates until the posterior gains less than `tolerance` a unit of sample weight, `most_iterations` at most. Returns
/// the posterior before the last step.
double iterate(const Samples& samples, const Prior& prior, MStep step, int most_iterations, double tolerance,
               std::span<Gaussian> mixture);

/// alpha times a Gaussian over the disc.
struct FullGaussian {
  double alpha = 0.0;
  double x = 0.0, y = 0.0;              ///< mean
  double xx = 0.0, xy = 0.0, yy = 0.0;  ///< covariance, without the floor that EM keeps it above
};

/// Fits `mixture` to the samples, from `start`, component by component; means are drawn to the prior's as those of
/// isotropic Gaussians are, by what is the exact M-step here: (N I + 2 w S) mu = N m + 2 w S mu_0, S the covariance
/// before the step, w the prior's weight. Steps and tolerance are those of `settings`. A component without samples
/// keeps what it has, with alpha 0; without any samples all do.
void fit_full(const Samples& samples, const Prior& prior, const FitSettings& settings, std::span<const Gaussian> start,
              std::span<FullGaussian> mixture);

/// The round Gaussian of the same mean spread: what neighbours and finer levels see of it.
[[nodiscard]] Gaussian rounded(const FullGaussian& full);

}  // namespace footprint::tan_gmm
