// Reads lobes out of the moments that both methods store, as their shaders do behind the filter.
#include "methods/best_lobes/other_methods.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "methods/best_lobes/starts.hpp"
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

void add_mixture(std::vector<FittedLobe> lobes, std::vector<std::vector<FittedLobe>>& mixtures) {
  double sum = 0.0;
  for (const FittedLobe& lobe : lobes) sum += lobe.weight;
  for (FittedLobe& lobe : lobes) lobe.weight /= sum;
  if (sum > 0.0) mixtures.push_back(std::move(lobes));
}

}  // namespace

OtherMethods::OtherMethods(const Material& material, std::size_t count, const Progress& progress) : count_(count) {
  const Image normals = normal_map_of(material);
  const tan_gmm::NormalField field(normals);
  for (const bool align : {true, false}) {
    mixtures_.push_back(
        tan_gmm::mixture_chain(field, {.components = count, .align = align}, tan_gmm::Moment::corrected, progress));
    for (std::vector<Image>& component : mixtures_.back()) component.front() = {};
  }
  const std::vector<cells::PlanePoint> points =
      cells::plane_points(normals, cells::Coordinates::stereographic, steepest_slope);
  const std::vector<float> shares = cells::partition(
      points, normals.width, normals.height,
      {.parts = static_cast<int>(count), .variance = lobe_variance_chain(material).back().texels[0]}, progress);
  constexpr auto covariance = cells::Covariance::axes;
  frames_ = cells::part_frames(points, shares, count, covariance);
  const int layers = cells::layer_count(cells::part_channels(covariance) * static_cast<int>(count));
  for (int layer = 0; layer < layers; ++layer) {
    moments_.push_back(mip_chain(
        cells::moment_layer({points, shares, count, normals.width, normals.height}, frames_, covariance, layer)));
    moments_.back().front() = {};
  }
}

std::vector<std::vector<FittedLobe>> OtherMethods::at(std::size_t level, std::size_t texel, Shape shape) const {
  std::vector<std::vector<FittedLobe>> out;
  for (const tan_gmm::MixtureChain& mixture : mixtures_) {
    std::vector<FittedLobe> lobes;
    for (const std::vector<Image>& component : mixture) {
      const std::span stored = std::span(component[level].texels).subspan(4 * texel, 4);
      if (stored[0] >= least_share) lobes.push_back(lobe_of_component(stored));
    }
    add_mixture(std::move(lobes), out);
  }
  std::vector<FittedLobe> lobes;
  for (std::size_t i = 0; i < count_; ++i) {
    std::array<double, 5> moments{};
    for (std::size_t c = 0; c < moments.size(); ++c) {
      const std::size_t channel = moments.size() * i + c;
      moments[c] = moments_[channel / 4][level].texels[4 * texel + channel % 4];
    }
    if (moments[0] >= least_share) lobes.push_back(lobe_of_part(moments, frames_[i], shape));
  }
  add_mixture(std::move(lobes), out);
  return out;
}

}  // namespace footprint::best_lobes
