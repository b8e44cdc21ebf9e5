// Moments of each texel in 64 bits, stored as 32-bit floats of what was stored before.
#include "methods/cells/cell_moments.hpp"

#include "methods/cells/gaussian.hpp"

namespace footprint::cells {
namespace {

using Channels = std::array<float, part_channels>;

// Second moments are of the rounded first ones, so that the covariance of one texel is as near to 0 as rounding allows.
Channels channels_of(const PlanePoint& point, float share, const glm::dvec2& centre) {
  const double w = point.weight * static_cast<double>(share);
  if (w <= 0.0) return {};
  const glm::dvec2 d = point.at - centre;
  const auto weight = static_cast<float>(w);
  const glm::vec2 first(w * d);
  const glm::dvec2 rounded = glm::dvec2(first) / static_cast<double>(weight);
  return {weight,
          first.x,
          first.y,
          static_cast<float>(weight * rounded.x * rounded.x),
          static_cast<float>(weight * rounded.x * rounded.y),
          static_cast<float>(weight * rounded.y * rounded.y)};
}

}  // namespace

std::array<glm::dvec2, most_parts> part_centres(std::span<const PlanePoint> points, std::span<const float> shares,
                                                std::size_t parts) {
  std::array<PlaneSums, most_parts> sums{};
  PlaneSums all;
  for (std::size_t i = 0; i < points.size(); ++i) {
    all.add(points[i].at, points[i].weight);
    for (std::size_t k = 0; k < parts; ++k)
      sums[k].add(points[i].at, points[i].weight * static_cast<double>(shares[i * parts + k]));
  }
  std::array<glm::dvec2, most_parts> centres{};
  for (std::size_t k = 0; k < parts; ++k) {
    const PlaneSums& own = sums[k].weight > 1e-9 * all.weight ? sums[k] : all;
    if (own.weight > 0.0) centres[k] = own.first / own.weight;
  }
  return centres;
}

Image moment_layer(std::span<const PlanePoint> points, std::span<const float> shares, std::size_t parts,
                   const std::array<glm::dvec2, most_parts>& centres, int width, int height, int layer) {
  Image out(width, height, 4);
  for (std::size_t i = 0; i < points.size(); ++i) {
    for (std::size_t c = 0; c < 4; ++c) {
      const std::size_t channel = 4 * static_cast<std::size_t>(layer) + c;
      const std::size_t part = channel / part_channels;
      if (part >= parts) break;
      out.texels[4 * i + c] = channels_of(points[i], shares[i * parts + part], centres[part])[channel % part_channels];
    }
  }
  return out;
}

Image variance_layer(std::span<const PlanePoint> points, std::span<const float> shares, std::size_t parts,
                     const Image& variance, int width, int height, int layer) {
  Image out(width, height, 4);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::size_t i = static_cast<std::size_t>(y) * static_cast<std::size_t>(width) + static_cast<std::size_t>(x);
      const double v = variance.at(x * variance.width / width, y * variance.height / height)[0];
      for (std::size_t c = 0; c < 4; ++c) {
        const std::size_t part = 4 * static_cast<std::size_t>(layer) + c;
        if (part >= parts) break;
        out.texels[4 * i + c] =
            static_cast<float>(points[i].weight * static_cast<double>(shares[i * parts + part]) * v);
      }
    }
  }
  return out;
}

}  // namespace footprint::cells
