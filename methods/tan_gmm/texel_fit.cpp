// Starts EM from far-apart clusters, the densest cell and the coarser texel, and keeps the likeliest, matched exactly.
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

float squared_distance(const Samples& samples, std::size_t j, const glm::vec2& p) {
  const glm::vec2 d = samples.at(j) - p;
  return glm::dot(d, d);
}

glm::vec2 mean_of(const Samples& samples) {
  glm::dvec2 sum(0.0);
  for (std::size_t j = 0; j < samples.size(); ++j)
    sum += static_cast<double>(samples.weight[j]) * glm::dvec2(samples.at(j));
  return sum / samples.total_weight();
}

// Chooses the sample farthest from the mean, then repeatedly that farthest from all centres, as long as there are any.
std::size_t farthest_first(const Samples& samples, std::span<glm::vec2> centres) {
  std::vector<float> nearest(samples.size(), std::numeric_limits<float>::max());
  glm::vec2 last = mean_of(samples);
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
    centres[count] = last = samples.at(farthest);
  }
  return centres.size();
}

// Sums over the samples of one cluster, relative to its centre.
struct Cluster {
  double weight = 0;
  glm::dvec2 offset{0.0};
  double square = 0;

  [[nodiscard]] glm::dvec2 mean() const { return offset / weight; }
};

std::array<Cluster, most_components> assigned(const Samples& samples, std::span<const glm::vec2> centres) {
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
    cluster.offset += w * glm::dvec2(samples.at(j) - centres[nearest]);
    cluster.square += w * (least + samples.spread[j]);
  }
  return clusters;
}

void move_to_means(std::span<glm::vec2> centres, std::span<const Cluster> clusters) {
  for (std::size_t i = 0; i < centres.size(); ++i) {
    if (clusters[i].weight > 0) centres[i] += glm::vec2(clusters[i].mean());
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
    c.offset += w * glm::dvec2(samples.at(j));
  }
  const Cluster& most = *std::ranges::max_element(cells, {}, &Cluster::weight);
  return {.alpha = static_cast<float>(most.weight / samples.total_weight()),
          .x = static_cast<float>(most.mean().x),
          .y = static_cast<float>(most.mean().y),
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
    const bool apart = squared_distance(samples, j, samples.at(0)) > same_point;
    if (apart || samples.spread[j] > 0.0F) return false;
  }
  return true;
}

// Assigns a normal to the component that suits the neighbours best; shared, it would be blended with several.
void give_whole(const glm::vec2& normal, const Prior& prior, std::span<Gaussian> mixture) {
  std::size_t best = 0;
  for (std::size_t i = 0; i < mixture.size(); ++i) {
    mixture[i] = {.x = static_cast<float>(prior.mean_x(i)), .y = static_cast<float>(prior.mean_y(i))};
    if (prior.log_density(i, normal.x, normal.y) > prior.log_density(best, normal.x, normal.y)) best = i;
  }
  mixture[best] = {.alpha = 1.0F, .x = normal.x, .y = normal.y, .variance = variance_floor};
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
  cluster_start(samples, start);
  match_order(prior, start);
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
  std::array<glm::vec2, most_components> storage{};
  const std::span<glm::vec2> all(storage.data(), mixture.size());
  const std::span<glm::vec2> centres = all.first(farthest_first(samples, all));
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
    const glm::dvec2 d = c.mean();
    const double variance = 0.5 * (c.square / c.weight - d.x * d.x - d.y * d.y);
    mixture[i] = {.alpha = static_cast<float>(c.weight / total),
                  .x = static_cast<float>(centres[i].x + d.x),
                  .y = static_cast<float>(centres[i].y + d.y),
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
    give_whole(samples.at(0), prior, mixture);
  } else if (settings.start == Start::clusters) {
    cluster_start(samples, mixture);
    match_order(prior, mixture);
  } else if (inherit) {
    std::ranges::copy(parent, mixture.begin());
  } else {
    start_from_best(samples, prior, parent, settings, mixture);
  }
  iterate(samples, prior, settings.m_step, settings.most_iterations, settings.tolerance, mixture, settings.variance);
}

}  // namespace footprint::tan_gmm
