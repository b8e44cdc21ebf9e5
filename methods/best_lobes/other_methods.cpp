// Reads lobes out of the moments that both methods store, as their shaders do behind the filter.
#include "methods/best_lobes/other_methods.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/best_lobes/starts.hpp"
#include "methods/cells/partition.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/normal_chain.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::best_lobes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

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

// Lobes over base lobes of their own.
class Mixture {
 public:
  // base_variance: slope variance of the lobe's base lobe.
  void add(FittedLobe lobe, double base_variance, const LobeFamily& family) {
    sum_ += lobe.weight;
    const double spread = std::max(base_variance - family.variance(), 0.0);
    lobe.deviation = std::hypot(lobe.deviation, std::sqrt(spread));
    lobe.weight *= family.energy(spread);
    lobes_.push_back(lobe);
  }
  void move_to(std::vector<std::vector<FittedLobe>>& mixtures) {
    for (FittedLobe& lobe : lobes_) lobe.weight /= sum_;
    if (sum_ > 0.0) mixtures.push_back(std::move(lobes_));
  }

 private:
  std::vector<FittedLobe> lobes_;
  double sum_ = 0.0;
};

// The levels above the finest.
std::vector<Image> coarser_levels(const Image& finest) {
  std::vector<Image> levels = mip_chain(finest);
  levels.front() = {};
  return levels;
}

}  // namespace

OtherMethods::OtherMethods(const Material& material, std::size_t count, bool with_roughness, const Progress& progress)
    : count_(count) {
  const Image normals = normal_map_of(material);
  const tan_gmm::NormalField field(normals);
  for (const bool align : {true, false}) {
    mixtures_.push_back(
        tan_gmm::mixture_chain(field, {.components = count, .align = align}, tan_gmm::Moment::corrected, progress));
    for (std::vector<Image>& component : mixtures_.back()) component.front() = {};
  }
  const std::vector<cells::PlanePoint> points =
      cells::plane_points(normals, cells::Coordinates::stereographic, steepest_slope);
  const cells::PartitionSettings settings{.parts = static_cast<int>(count),
                                          .variance = lobe_variance_chain(material).back().texels[0]};
  const std::vector<double> variances =
      with_roughness ? cells::texel_variances(material, normals.width, normals.height) : std::vector<double>{};
  const std::vector<float> shares =
      with_roughness
          ? cells::partition_with_roughness(points, variances, normals.width, normals.height, settings, progress)
          : cells::partition(points, normals.width, normals.height, settings, progress);
  constexpr auto covariance = cells::Covariance::axes;
  frames_ = cells::part_frames(points, shares, count, covariance);
  const int layers = cells::layer_count(cells::part_channels(covariance) * static_cast<int>(count));
  const cells::PartedPoints map{points, shares, count, normals.width, normals.height};
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
    Mixture lobes;
    for (const std::vector<Image>& component : mixture) {
      const std::span stored = std::span(component[level].texels).subspan(4 * texel, 4);
      if (stored[0] >= least_share) lobes.add(lobe_of_component(stored), mean, family);
    }
    lobes.move_to(out);
  }
  Mixture lobes;
  for (std::size_t i = 0; i < count_; ++i) {
    std::array<double, 5> moments{};
    for (std::size_t c = 0; c < moments.size(); ++c) {
      const std::size_t channel = moments.size() * i + c;
      moments[c] = moments_[channel / 4][level].texels[4 * texel + channel % 4];
    }
    if (moments[0] < least_share) continue;
    const double own =
        part_variances_.empty() ? mean : part_variances_[i / 4][level].texels[4 * texel + i % 4] / moments[0];
    lobes.add(lobe_of_part(moments, frames_[i], family.shape()), own, family);
  }
  lobes.move_to(out);
  return out;
}

}  // namespace footprint::best_lobes
