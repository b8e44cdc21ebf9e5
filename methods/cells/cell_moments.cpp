// Computes moments in 64 bits from the rounded 32-bit first moments that are stored.
#include "methods/cells/partition.hpp"

#include <cmath>

#include "renderer/image/mipmap.hpp"

namespace footprint::cells {
namespace {

using Channels = std::array<float, part_channels(Covariance::full)>;

// Computes second moments from the rounded first ones, so that the covariance of a single texel is as close to 0 as
// rounding allows.
Channels channels_of(const PlanePoint& point, float share, const PartFrame& frame, Covariance covariance) {
  const double w = point.weight * static_cast<double>(share);
  if (w <= 0.0) return {};
  const glm::dvec2 from_centre = point.at - frame.centre;
  const glm::dvec2 d(glm::dot(from_centre, frame.axis), glm::dot(from_centre, glm::dvec2(-frame.axis.y, frame.axis.x)));
  const auto weight = static_cast<float>(w);
  const glm::vec2 first(w * d);
  const glm::dvec2 rounded = glm::dvec2(first) / static_cast<double>(weight);
  const auto along = static_cast<float>(weight * rounded.x * rounded.x);
  const auto across = static_cast<float>(weight * rounded.y * rounded.y);
  if (covariance == Covariance::axes) return {weight, first.x, first.y, along, across, 0.0F};
  return {weight, first.x, first.y, along, static_cast<float>(weight * rounded.x * rounded.y), across};
}

// The eigenvector of the larger eigenvalue.
glm::dvec2 principal_axis(const PlaneSums& sums) {
  const glm::dvec2 mean = sums.first / sums.weight;
  const double xx = sums.second.x / sums.weight - mean.x * mean.x;
  const double xy = sums.second.y / sums.weight - mean.x * mean.y;
  const double yy = sums.second.z / sums.weight - mean.y * mean.y;
  const double angle = 0.5 * std::atan2(2.0 * xy, xx - yy);
  return {std::cos(angle), std::sin(angle)};
}

}  // namespace

PartedPoints parted_points(const Image& normals, double steepest, std::span<const double> variances,
                           const PartitionSettings& settings, const Progress& progress) {
  PartedPoints out{plane_points(normals, Coordinates::stereographic, steepest),
                   {},
                   static_cast<std::size_t>(settings.parts),
                   normals.width,
                   normals.height};
  out.shares = partition_with_roughness(out.points, variances, out.width, out.height, settings, progress);
  return out;
}

std::array<PartFrame, most_parts> part_frames(const PartedPoints& map, Covariance covariance) {
  std::array<PlaneSums, most_parts> sums{};
  PlaneSums all;
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    const PlanePoint& point = map.points[i];
    all.add(point.at, point.weight);
    for (std::size_t k = 0; k < map.parts; ++k)
      sums[k].add(point.at, point.weight * static_cast<double>(map.shares[i * map.parts + k]));
  }
  std::array<PartFrame, most_parts> frames{};
  for (std::size_t k = 0; k < map.parts; ++k) {
    const PlaneSums& own = sums[k].weight > 1e-9 * all.weight ? sums[k] : all;
    if (own.weight <= 0.0) continue;
    frames[k].centre = own.first / own.weight;
    if (covariance == Covariance::axes) frames[k].axis = principal_axis(own);
  }
  return frames;
}

Image moment_layer(const PartedPoints& map, const std::array<PartFrame, most_parts>& frames, Covariance covariance,
                   int layer) {
  Image out(map.width, map.height, 4);
  const auto per_part = static_cast<std::size_t>(part_channels(covariance));
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t channel = 4 * static_cast<std::size_t>(layer) + c;
      const std::size_t part = channel / per_part;
      if (part >= map.parts) break;
      const float share = map.shares[i * map.parts + part];
      out.texels[4 * i + c] = channels_of(map.points[i], share, frames[part], covariance)[channel % per_part];
    }
  }
  return out;
}

Image value_layer(const PartedPoints& map, const Image& values, int layer) {
  const Image own = nearest_texels(values, map.width, map.height);
  Image out(map.width, map.height, 4);
  for (std::size_t i = 0; i < map.points.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t part = 4 * static_cast<std::size_t>(layer) + c;
      if (part >= map.parts) break;
      const auto share = static_cast<double>(map.shares[i * map.parts + part]);
      out.texels[4 * i + c] = static_cast<float>(map.points[i].weight * share * static_cast<double>(own.texels[i]));
    }
  }
  return out;
}

std::vector<std::vector<Image>> layer_chains(int layers, const std::function<Image(int)>& finest) {
  std::vector<std::vector<Image>> chains;
  chains.reserve(static_cast<std::size_t>(layers));
  for (int layer = 0; layer < layers; ++layer) chains.push_back(mip_chain(finest(layer)));
  return chains;
}

std::vector<std::vector<Image>> moment_chains(const PartedPoints& map, const std::array<PartFrame, most_parts>& frames,
                                              Covariance covariance) {
  return layer_chains(layer_count(part_channels(covariance) * static_cast<int>(map.parts)),
                      [&](int layer) { return moment_layer(map, frames, covariance, layer); });
}

}  // namespace footprint::cells
