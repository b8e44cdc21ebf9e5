// Lloyd's rounds over seeds drawn without the library's distributions, which differ between platforms; EM with
// Gaussians.
#include "methods/best_lobes/starts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>
#include <random>

#include "methods/cells/partition.hpp"

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

}  // namespace footprint::best_lobes
