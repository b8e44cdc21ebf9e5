// Lloyd's rounds over seeds drawn without the library's distributions, which differ between platforms; EM with
// Gaussians; lobes out of the moments that other methods store, as their shaders read them behind the filter.
#include "methods/best_lobes/starts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>
#include <utility>

#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::best_lobes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr int lloyd_rounds = 5;
constexpr int em_rounds = 30;

// Weighted normals of one cluster or component.
struct ClusterSums {
  double weight = 0.0;
  Vector2d first{0.0, 0.0};
  Vector3d second{0.0, 0.0, 0.0};  // xx, xy, yy

  void add(double w, const PlaneNormal& normal) {
    const double own = normal.spread * plane_variance(normal.at);
    weight += w;
    first += w * normal.at;
    second += w * Vector3d(normal.at.x() * normal.at.x() + own, normal.at.x() * normal.at.y(),
                           normal.at.y() * normal.at.y() + own);
  }
};

FittedLobe lobe_of_sums(const ClusterSums& sums, Shape shape) {
  const Vector2d mean = sums.first / sums.weight;
  const Vector3d spread =
      sums.second / sums.weight - Vector3d(mean.x() * mean.x(), mean.x() * mean.y(), mean.y() * mean.y());
  return lobe_of_spread(sums.weight, mean, spread, shape);
}

std::size_t nearest_of(const std::vector<Vector2d>& centres, const Vector2d& p) {
  const auto nearest = std::ranges::min_element(centres, {}, [&](const Vector2d& c) { return (c - p).squaredNorm(); });
  return static_cast<std::size_t>(nearest - centres.begin());
}

// k-means++ (Arthur and Vassilvitskii 2007).
std::vector<Vector2d> seeds_of_clusters(const std::vector<PlaneNormal>& normals, std::size_t count,
                                        std::uint64_t seed) {
  std::mt19937_64 random(seed);
  std::vector<double> costs(normals.size());
  std::vector<double> nearest(normals.size(), std::numeric_limits<double>::infinity());
  std::vector<Vector2d> centres;
  while (centres.size() < count) {
    double sum = 0.0;
    for (std::size_t i = 0; i < normals.size(); ++i) {
      if (!centres.empty()) nearest[i] = std::min(nearest[i], (normals[i].at - centres.back()).squaredNorm());
      costs[i] = normals[i].weight * (centres.empty() ? 1.0 : nearest[i]);
      sum += costs[i];
    }
    double left = static_cast<double>(random() >> 11U) * 0x1p-53 * sum;
    std::size_t chosen = 0;
    for (; chosen + 1 < normals.size() && left >= costs[chosen]; ++chosen) left -= costs[chosen];
    centres.push_back(normals[chosen].at);
  }
  return centres;
}

// A Gaussian over the plane: the spread of a lobe and of the base lobe together.
class Blurred {
 public:
  Blurred(const FittedLobe& lobe, const LobeFamily& family) : mean_(lobe.mean) {
    const double scale = plane_variance(lobe.mean);
    const double base = (family.variance() + lobe.deviation * lobe.deviation) * scale;
    const Vector3d s = lobe.spread();
    const double xx = s.x() + base;
    const double yy = s.z() + base;
    const double determinant = xx * yy - s.y() * s.y();
    inverse_ = Vector3d(yy, -s.y(), xx) / determinant;
    constant_ = std::log(std::max(lobe.weight, 1e-300)) - 0.5 * std::log(determinant);
  }

  [[nodiscard]] double log_density(const Vector2d& p) const {
    const Vector2d d = p - mean_;
    return constant_ -
           0.5 * (inverse_.x() * d.x() * d.x() + 2.0 * inverse_.y() * d.x() * d.y() + inverse_.z() * d.y() * d.y());
  }

 private:
  Vector2d mean_;
  Vector3d inverse_;
  double constant_;
};

constexpr double least_share = 1e-4;  // of both shaders

// A component of tan_gmm, about the normal over its mean on the disc. Its spread grows by the cosine (tan_gmm.glsl).
FittedLobe lobe_of_component(std::span<const float> stored) {
  const double alpha = stored[0];
  Vector2d mean = Vector2d(stored[1], stored[2]) / alpha;
  const double spread = std::max(0.5 * (stored[3] / alpha - mean.squaredNorm()), 0.0);
  mean /= std::max(mean.norm(), 1.0);
  const double height = std::sqrt(std::max(1.0 - mean.squaredNorm(), 0.0));
  FittedLobe lobe{.weight = alpha, .mean = mean / (1.0 + height)};
  if (spread > 0.0) lobe.deviation = std::sqrt(spread / std::max(height, std::sqrt(spread)));
  return lobe;
}

// A part of cells out of its five moments.
FittedLobe lobe_of_part(const std::array<double, 5>& moments, const cells::PartFrame& frame, Shape shape) {
  const Vector2d along(frame.axis.x, frame.axis.y);
  const Vector2d across(-along.y(), along.x());
  const Vector2d own = Vector2d(moments[1], moments[2]) / moments[0];
  const double a = std::max(moments[3] / moments[0] - own.x() * own.x(), 0.0);
  const double b = std::max(moments[4] / moments[0] - own.y() * own.y(), 0.0);
  const Vector3d spread(a * along.x() * along.x() + b * across.x() * across.x(), (a - b) * along.x() * along.y(),
                        a * along.y() * along.y() + b * across.y() * across.y());
  return lobe_of_spread(moments[0], Vector2d(frame.centre.x, frame.centre.y) + own.x() * along + own.y() * across,
                        spread, shape);
}

// A lobe, and the slope variance of the base lobe that it is over.
using OwnLobe = std::pair<FittedLobe, double>;

// Adds the mixture of lobes over the family's base lobe, unless it is without weight.
void add_mixture(const std::vector<OwnLobe>& lobes, const LobeFamily& family,
                 std::vector<std::vector<FittedLobe>>& mixtures) {
  double sum = 0.0;
  for (const auto& [lobe, base_variance] : lobes) sum += lobe.weight;
  if (sum <= 0.0) return;
  std::vector<FittedLobe>& mixture = mixtures.emplace_back();
  for (auto [lobe, base_variance] : lobes) {
    const double spread = std::max(base_variance - family.variance(), 0.0);
    lobe.deviation = std::hypot(lobe.deviation, std::sqrt(spread));
    lobe.weight = lobe.weight * family.energy(spread) / sum;
    mixture.push_back(lobe);
  }
}

std::vector<Image> coarser_levels(const Image& finest) {
  std::vector<Image> levels = mip_chain(finest);
  levels.front() = {};
  return levels;
}

}  // namespace

std::vector<PlaneNormal> plane_normals(std::span<const fournier::Peak> target) {
  std::vector<PlaneNormal> out;
  out.reserve(target.size());
  double total = 0.0;
  for (const fournier::Peak& peak : target) total += peak.weight;
  for (const fournier::Peak& peak : target) {
    Vector2d at = plane_from_direction(peak.axis);
    at /= std::max(at.norm(), 1.0);  // normals below the horizon are moved onto it
    out.push_back({peak.weight / total, at, peak.spread});
  }
  return out;
}

FittedLobe lobe_of_spread(double weight, const Vector2d& mean, const Vector3d& spread, Shape shape) {
  FittedLobe lobe{.weight = weight, .mean = mean};
  if (shape == Shape::round) {
    lobe.deviation = std::sqrt(std::max(0.5 * (spread.x() + spread.z()) / plane_variance(mean), 0.0));
    return lobe;
  }
  lobe.root.x() = std::sqrt(std::max(spread.x(), 0.0));
  lobe.root.y() = lobe.root.x() > 0.0 ? spread.y() / lobe.root.x() : 0.0;
  lobe.root.z() = std::sqrt(std::max(spread.z() - lobe.root.y() * lobe.root.y(), 0.0));
  return lobe;
}

std::vector<FittedLobe> clusters(const std::vector<PlaneNormal>& normals, std::size_t count, const LobeFamily& family,
                                 std::uint64_t seed) {
  std::vector<Vector2d> centres = seeds_of_clusters(normals, count, seed);
  std::vector<ClusterSums> sums;
  for (int round = 0; round < lloyd_rounds; ++round) {
    sums.assign(count, {});
    for (const PlaneNormal& normal : normals) sums[nearest_of(centres, normal.at)].add(normal.weight, normal);
    for (std::size_t i = 0; i < count; ++i)
      if (sums[i].weight > 0.0) centres[i] = sums[i].first / sums[i].weight;
  }
  std::vector<FittedLobe> lobes;
  for (std::size_t i = 0; i < count; ++i)
    lobes.push_back(sums[i].weight > 0.0 ? lobe_of_sums(sums[i], family.shape())
                                         : lobe_of_spread(1e-3, centres[i], Vector3d::Zero(), family.shape()));
  return lobes;
}

std::vector<FittedLobe> by_em(const std::vector<PlaneNormal>& normals, std::vector<FittedLobe> lobes,
                              const LobeFamily& family) {
  std::vector<double> shares(lobes.size());
  for (int round = 0; round < em_rounds; ++round) {
    std::vector<Blurred> components;
    for (const FittedLobe& lobe : lobes) components.emplace_back(lobe, family);
    std::vector<ClusterSums> sums(lobes.size());
    for (const PlaneNormal& normal : normals) {
      for (std::size_t i = 0; i < lobes.size(); ++i) shares[i] = components[i].log_density(normal.at);
      const double most = *std::ranges::max_element(shares);
      double total = 0.0;
      for (double& share : shares) total += share = std::exp(share - most);
      for (std::size_t i = 0; i < lobes.size(); ++i) sums[i].add(normal.weight * shares[i] / total, normal);
    }
    for (std::size_t i = 0; i < lobes.size(); ++i)
      if (sums[i].weight > 1e-6) lobes[i] = lobe_of_sums(sums[i], family.shape());
  }
  return lobes;
}

RoughnessGroups roughness_groups(const Material& material, int width, int height) {
  constexpr double bins_per_octave = 1024.0;
  struct Bin {
    std::uint32_t group;
    double sum, count;
  };
  const std::vector<double> variances = cells::texel_variances(material, width, height);
  std::map<double, Bin> bins;
  RoughnessGroups out{.narrowest = std::numeric_limits<double>::infinity(), .of_texels = {}, .spreads = {}};
  for (const double variance : variances) {
    const double key = std::floor(bins_per_octave * std::log2(std::max(variance, 1e-12)));
    Bin& bin = bins.try_emplace(key, static_cast<std::uint32_t>(bins.size()), 0.0, 0.0).first->second;
    bin.sum += variance;
    bin.count += 1.0;
    out.of_texels.push_back(bin.group);
  }
  for (const auto& [key, bin] : bins) out.narrowest = std::min(out.narrowest, bin.sum / bin.count);
  out.spreads.resize(bins.size());
  for (const auto& [key, bin] : bins) out.spreads[bin.group] = bin.sum / bin.count - out.narrowest;
  return out;
}

OtherMethods::OtherMethods(const Material& material, std::size_t count, bool with_roughness, const Progress& progress)
    : count_(count) {
  const Image normals = normal_map_of(material);
  const tan_gmm::NormalField field(normals);
  for (const bool align : {true, false}) {
    mixtures_.push_back(
        tan_gmm::mixture_chain(field, {.components = count, .align = align}, tan_gmm::Moment::corrected, progress));
    for (std::vector<Image>& component : mixtures_.back()) component.front() = {};
  }
  const cells::PartitionSettings settings{.parts = static_cast<int>(count),
                                          .variance = lobe_variance_chain(material).back().texels[0]};
  const std::vector<double> variances =
      with_roughness ? cells::texel_variances(material, normals.width, normals.height) : std::vector<double>{};
  const cells::PartedPoints map = cells::parted_points(normals, steepest_slope, variances, settings, progress);
  constexpr auto covariance = cells::Covariance::axes;
  frames_ = cells::part_frames(map, covariance);
  const int layers = cells::layer_count(cells::part_channels(covariance) * static_cast<int>(count));
  for (int layer = 0; layer < layers; ++layer)
    moments_.push_back(coarser_levels(cells::moment_layer(map, frames_, covariance, layer)));
  if (!with_roughness) return;
  Image finest(normals.width, normals.height, 1);
  std::ranges::copy(variances, finest.texels.begin());
  for (int layer = 0; layer < cells::layer_count(static_cast<int>(count)); ++layer)
    part_variances_.push_back(coarser_levels(cells::value_layer(map, finest, layer)));
  variances_ = coarser_levels(finest);
}

std::vector<std::vector<FittedLobe>> OtherMethods::at(std::size_t level, std::size_t texel,
                                                      const LobeFamily& family) const {
  std::vector<std::vector<FittedLobe>> out;
  const double mean = variances_.empty() ? family.variance() : variances_[level].texels[texel];
  for (const tan_gmm::MixtureChain& mixture : mixtures_) {
    std::vector<OwnLobe> lobes;
    for (const std::vector<Image>& component : mixture) {
      const std::span stored = std::span(component[level].texels).subspan(4 * texel, 4);
      if (stored[0] >= least_share) lobes.emplace_back(lobe_of_component(stored), mean);
    }
    add_mixture(lobes, family, out);
  }
  std::vector<OwnLobe> lobes;
  for (std::size_t i = 0; i < count_; ++i) {
    std::array<double, 5> moments{};
    for (std::size_t c = 0; c < moments.size(); ++c) {
      const std::size_t channel = moments.size() * i + c;
      moments[c] = moments_[channel / 4][level].texels[4 * texel + channel % 4];
    }
    if (moments[0] < least_share) continue;
    const double own =
        part_variances_.empty() ? mean : part_variances_[i / 4][level].texels[4 * texel + i % 4] / moments[0];
    lobes.emplace_back(lobe_of_part(moments, frames_[i], family.shape()), own);
  }
  add_mixture(lobes, family, out);
  return out;
}

}  // namespace footprint::best_lobes
