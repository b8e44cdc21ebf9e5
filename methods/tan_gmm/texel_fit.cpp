// Starts EM from clusters of far-apart centres, from the densest cell and from the coarser texel, and keeps the
// likeliest result. Matches components to the prior exactly.
#include "methods/tan_gmm/mixture_chain.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <limits>
#include <vector>

namespace footprint::tan_gmm {
namespace {

constexpr int lloyd_steps = 4;
constexpr float same_point = 1e-12F;  // squared distance of normals that differ by rounding only

struct Point {
  float x, y;
};

float squared_distance(const Samples& samples, std::size_t j, const Point& p) {
  const float dx = samples.x[j] - p.x;
  const float dy = samples.y[j] - p.y;
  return dx * dx + dy * dy;
}

Point mean_of(const Samples& samples) {
  double x = 0;
  double y = 0;
  for (std::size_t j = 0; j < samples.size(); ++j) {
    x += static_cast<double>(samples.weight[j]) * samples.x[j];
    y += static_cast<double>(samples.weight[j]) * samples.y[j];
  }
  const double total = samples.total_weight();
  return {static_cast<float>(x / total), static_cast<float>(y / total)};
}

// Chooses the sample farthest from the mean, then repeatedly the one farthest from all centres. Returns fewer centres
// if the samples are exhausted.
std::size_t farthest_first(const Samples& samples, std::span<Point> centres) {
  std::vector<float> nearest(samples.size(), std::numeric_limits<float>::max());
  Point last = mean_of(samples);
  for (std::size_t count = 0; count < centres.size(); ++count) {
    std::size_t farthest = 0;
    float most = -1.0F;
    for (std::size_t j = 0; j < samples.size(); ++j) {
      const float d = squared_distance(samples, j, last);
      nearest[j] = count <= 1 ? d : std::min(nearest[j], d);  // the mean is not a centre
      if (nearest[j] > most) {
        most = nearest[j];
        farthest = j;
      }
    }
    if (count > 0 && most <= same_point) return count;
    last = {samples.x[farthest], samples.y[farthest]};
    centres[count] = last;
  }
  return centres.size();
}

// Sums over the samples of one cluster, relative to its centre.
struct Cluster {
  double weight = 0, dx = 0, dy = 0, square = 0;
};

std::array<Cluster, most_components> assigned(const Samples& samples, std::span<const Point> centres) {
  std::array<Cluster, most_components> clusters{};
  for (std::size_t j = 0; j < samples.size(); ++j) {
    std::size_t nearest = 0;
    float least = squared_distance(samples, j, centres[0]);
    for (std::size_t i = 1; i < centres.size(); ++i) {
      const float d = squared_distance(samples, j, centres[i]);
      nearest = d < least ? i : nearest;
      least = std::min(d, least);
    }
    const double w = samples.weight[j];
    Cluster& cluster = clusters[nearest];
    cluster.weight += w;
    cluster.dx += w * (samples.x[j] - centres[nearest].x);
    cluster.dy += w * (samples.y[j] - centres[nearest].y);
    cluster.square += w * (least + samples.spread[j]);
  }
  return clusters;
}

void move_to_means(std::span<Point> centres, std::span<const Cluster> clusters) {
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (clusters[i].weight <= 0) continue;
    centres[i].x += static_cast<float>(clusters[i].dx / clusters[i].weight);
    centres[i].y += static_cast<float>(clusters[i].dy / clusters[i].weight);
  }
}

// The centre of the densest cell of a histogram over the disc, as a component.
Gaussian densest_spot(const Samples& samples) {
  constexpr std::size_t across = 64;
  constexpr float seed_variance = 1e-4F;
  std::vector<Cluster> cells(across * across);
  const auto cell = [](float v) {
    constexpr auto last = static_cast<int>(across) - 1;
    return static_cast<std::size_t>(std::clamp(static_cast<int>((v + 1.0F) * (0.5F * across)), 0, last));
  };
  for (std::size_t j = 0; j < samples.size(); ++j) {
    Cluster& c = cells[cell(samples.y[j]) * across + cell(samples.x[j])];
    const double w = samples.weight[j];
    c.weight += w;
    c.dx += w * samples.x[j];
    c.dy += w * samples.y[j];
  }
  const Cluster& most = *std::ranges::max_element(cells, {}, &Cluster::weight);
  return {.alpha = static_cast<float>(most.weight / samples.total_weight()),
          .x = static_cast<float>(most.dx / most.weight),
          .y = static_cast<float>(most.dy / most.weight),
          .variance = seed_variance};
}

// The best prior of matching the first clusters to a set of as many components, for every set.
struct Matching {
  double prior;
  std::size_t last;  // the component of the last of those clusters
};

// The fewest samples for a useful histogram.
constexpr std::size_t fewest_for_histogram = 32;

// Whether all samples are one normal, up to rounding.
bool are_one_normal(const Samples& samples) {
  for (std::size_t j = 1; j < samples.size(); ++j) {
    const bool apart = squared_distance(samples, j, {samples.x[0], samples.y[0]}) > same_point;
    if (apart || samples.spread[j] > 0.0F) return false;
  }
  return true;
}

// Assigns a normal to the component that suits the neighbours best. Shared among several, it would be blended with
// several.
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

// Runs a few steps of EM from each start, and keeps the best.
void start_from_best(const Samples& samples, const Prior& prior, std::span<const Gaussian> parent,
                     const FitSettings& settings, std::span<Gaussian> mixture) {
  std::array<Gaussian, most_components> storage{};
  const std::span<Gaussian> start(storage.data(), mixture.size());
  double greatest = -std::numeric_limits<double>::infinity();
  const auto try_start = [&] {
    const double posterior = iterate(samples, prior, settings.m_step, settings.trial_iterations, settings.tolerance,
                                     start, settings.variance);
    if (posterior <= greatest) return;
    greatest = posterior;
    std::ranges::copy(start, mixture.begin());
  };
  start_from_clusters(samples, prior, start);
  try_start();
  if (mixture.size() > 1 && samples.size() >= fewest_for_histogram) {
    dense_start(samples, start);
    match_order(prior, start);
    try_start();
  }
  if (!parent.empty()) {
    std::ranges::copy(parent, start.begin());
    try_start();
  }
}

}  // namespace

void cluster_start(const Samples& samples, std::span<Gaussian> mixture) {
  std::array<Point, most_components> storage{};
  const std::span<Point> all(storage.data(), mixture.size());
  const std::span<Point> centres = all.first(farthest_first(samples, all));
  std::array<Cluster, most_components> clusters = assigned(samples, centres);
  for (int step = 0; step < lloyd_steps; ++step) {
    move_to_means(centres, clusters);
    clusters = assigned(samples, centres);
  }
  const double total = samples.total_weight();
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    const Cluster& c = clusters[i];
    mixture[i] = {};
    if (c.weight <= 0) continue;
    const double dx = c.dx / c.weight;
    const double dy = c.dy / c.weight;
    const double variance = 0.5 * (c.square / c.weight - dx * dx - dy * dy);
    mixture[i] = {.alpha = static_cast<float>(c.weight / total),
                  .x = static_cast<float>(centres[i].x + dx),
                  .y = static_cast<float>(centres[i].y + dy),
                  .variance = std::max(static_cast<float>(variance), variance_floor)};
  }
}

void dense_start(const Samples& samples, std::span<Gaussian> mixture) {
  const std::span<Gaussian> wide = mixture.first(mixture.size() - 1);
  cluster_start(samples, wide);
  mixture.back() = densest_spot(samples);
  for (Gaussian& g : wide) g.alpha *= 1.0F - mixture.back().alpha;
}

// Exact, by dynamic programming over sets of components in 2^n n steps.
void match_order(const Prior& prior, std::span<Gaussian> mixture) {
  const std::size_t n = mixture.size();
  std::array<std::array<double, most_components>, most_components> own{};  // of cluster j as component i
  for (std::size_t j = 0; j < n; ++j) {
    if (mixture[j].alpha <= 0.0F) continue;
    for (std::size_t i = 0; i < n; ++i) own[j][i] = prior.log_density(i, mixture[j].x, mixture[j].y);
  }
  std::array<Matching, std::size_t{1} << most_components> best;
  best[0] = {0.0, 0};
  for (std::size_t set = 1; set < (std::size_t{1} << n); ++set) {
    best[set] = {-std::numeric_limits<double>::infinity(), 0};
    const auto placed = static_cast<std::size_t>(std::popcount(set)) - 1;
    for (std::size_t i = 0; i < n; ++i) {
      if ((set >> i & 1U) == 0) continue;
      const double sum = best[set ^ (std::size_t{1} << i)].prior + own[placed][i];
      if (sum > best[set].prior) best[set] = {sum, i};
    }
  }
  std::array<Gaussian, most_components> ordered{};
  std::size_t set = (std::size_t{1} << n) - 1;
  for (std::size_t placed = n; placed-- > 0;) {
    const std::size_t i = best[set].last;
    ordered[i] = mixture[placed];
    if (ordered[i].alpha <= 0.0F) {
      ordered[i].x = static_cast<float>(prior.mean_x(i));
      ordered[i].y = static_cast<float>(prior.mean_y(i));
    }
    set ^= std::size_t{1} << i;
  }
  std::ranges::copy_n(ordered.begin(), static_cast<std::ptrdiff_t>(n), mixture.begin());
}

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
  iterate(samples, prior, settings.m_step, settings.most_iterations, settings.tolerance, mixture, settings.variance);
}

}  // namespace footprint::tan_gmm
