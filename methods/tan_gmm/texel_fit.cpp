// Tries EM from clusters, from the densest spot and from the coarser texel, and keeps the likeliest.
#include "methods/tan_gmm/texel_fit.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include "methods/tan_gmm/starts.hpp"

namespace footprint::tan_gmm {
namespace {

// A histogram tells nothing of a handful of samples.
constexpr std::size_t fewest_for_histogram = 32;

// Runs a few steps of EM from each start that it is handed and keeps the best.
class Trials {
 public:
  Trials(const Samples& samples, const Prior& prior, const FitSettings& settings, std::span<Gaussian> best)
      : samples_(&samples), prior_(&prior), settings_(&settings), best_(best) {}

  void take(std::span<Gaussian> start) {
    const double posterior =
        iterate(*samples_, *prior_, settings_->m_step, settings_->trial_iterations, settings_->tolerance, start);
    if (posterior <= greatest_) return;
    greatest_ = posterior;
    std::ranges::copy(start, best_.begin());
  }

 private:
  const Samples* samples_;
  const Prior* prior_;
  const FitSettings* settings_;
  std::span<Gaussian> best_;
  double greatest_ = -std::numeric_limits<double>::infinity();
};

// Rounding aside.
bool are_one_normal(const Samples& samples) {
  for (std::size_t j = 1; j < samples.size(); ++j) {
    const float dx = samples.x[j] - samples.x[0];
    const float dy = samples.y[j] - samples.y[0];
    if (dx * dx + dy * dy > 1e-12F || samples.spread[j] > 0.0F) return false;
  }
  return true;
}

// To the component that suits the neighbours: shared among several a normal would be blended with several.
void give_whole(float x, float y, const Prior& prior, std::span<Gaussian> mixture) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    mixture[i] = {.x = static_cast<float>(prior.mean_x(i)), .y = static_cast<float>(prior.mean_y(i))};
    if (prior.log_density(i, x, y) > prior.log_density(best, x, y)) best = i;
  }
  mixture[best] = {.alpha = 1.0F, .x = x, .y = y, .variance = variance_floor};
}

void start_from_clusters(const Samples& samples, const Prior& prior, std::span<Gaussian> mixture) {
  cluster_start(samples, mixture);
  match_order(prior, mixture);
}

void start_from_best(const Samples& samples, const Prior& prior, std::span<const Gaussian> parent,
                     const FitSettings& settings, std::span<Gaussian> mixture) {
  std::array<Gaussian, most_components> storage{};
  const std::span<Gaussian> start(storage.data(), mixture.size());
  Trials trials(samples, prior, settings, mixture);
  start_from_clusters(samples, prior, start);
  trials.take(start);
  if (mixture.size() > 1 && samples.size() >= fewest_for_histogram) {
    dense_start(samples, start);
    match_order(prior, start);
    trials.take(start);
  }
  if (!parent.empty()) {
    std::ranges::copy(parent, start.begin());
    trials.take(start);
  }
}

}  // namespace

void fit_texel(const Samples& samples, const Prior& prior, std::span<const Gaussian> parent,
               const FitSettings& settings, std::span<Gaussian> mixture) {
  std::ranges::fill(mixture, Gaussian{});
  if (samples.size() == 0) return;
  const bool inherit = settings.start == Start::inherit && !parent.empty();
  if (are_one_normal(samples)) {
    give_whole(samples.x[0], samples.y[0], prior, mixture);
  } else if (settings.start == Start::clusters) {
    start_from_clusters(samples, prior, mixture);
  } else if (inherit) {
    std::ranges::copy(parent, mixture.begin());
  } else {
    start_from_best(samples, prior, parent, settings, mixture);
  }
  iterate(samples, prior, settings.m_step, settings.most_iterations, settings.tolerance, mixture);
}

}  // namespace footprint::tan_gmm
