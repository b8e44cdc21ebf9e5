// Maps uv to directions and back, and resamples a map by the solid angle that old and new texels share.
#include "renderer/scene/environment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace footprint {
namespace {

using std::numbers::pi;

// What texels of one axis cover of another division of it: target i gets `share` of source j.
struct Overlap {
  int target, source;
  double share;
};

// Edges are positions along the axis, increasing; shares are of the target's length.
std::vector<Overlap> overlaps(const std::vector<double>& source, const std::vector<double>& target) {
  std::vector<Overlap> out;
  std::size_t j = 0;
  for (std::size_t i = 0; i + 1 < target.size(); ++i) {
    while (j + 2 < source.size() && source[j + 1] <= target[i]) ++j;
    for (std::size_t k = j; k + 1 < source.size() && source[k] < target[i + 1]; ++k) {
      const double length = std::min(source[k + 1], target[i + 1]) - std::max(source[k], target[i]);
      if (length > 0.0) out.push_back({static_cast<int>(i), static_cast<int>(k), length / (target[i + 1] - target[i])});
    }
  }
  return out;
}

std::vector<double> column_edges(int width) {
  std::vector<double> edges;
  edges.reserve(static_cast<std::size_t>(width) + 1);
  for (int i = 0; i <= width; ++i) edges.push_back(static_cast<double>(i) / width);
  return edges;
}

// In -cos theta, in which equal lengths are equal solid angles.
std::vector<double> row_edges(int height) {
  std::vector<double> edges;
  edges.reserve(static_cast<std::size_t>(height) + 1);
  for (int i = 0; i <= height; ++i) edges.push_back(-std::cos(pi * i / height));
  return edges;
}

}  // namespace

glm::dvec3 environment_direction(const Environment& environment, double u, double v) {
  const double azimuth = 2.0 * pi * (u - 0.5) - environment.rotation;
  const double polar = pi * v;
  return {std::sin(polar) * std::sin(azimuth), std::cos(polar), -std::sin(polar) * std::cos(azimuth)};
}

glm::dvec2 environment_uv(const Environment& environment, const glm::dvec3& direction) {
  const double u = 0.5 + (std::atan2(direction.x, -direction.z) + environment.rotation) / (2.0 * pi);
  return {u - std::floor(u), std::acos(std::clamp(direction.y / glm::length(direction), -1.0, 1.0)) / pi};
}

glm::vec3 environment_radiance(const Environment& environment, const glm::dvec3& direction) {
  const Image& map = *environment.radiance;
  const glm::dvec2 uv = environment_uv(environment, direction);
  const auto texel = map.at(std::min(static_cast<int>(uv.x * map.width), map.width - 1),
                            std::min(static_cast<int>(uv.y * map.height), map.height - 1));
  return {texel[0], texel[1], texel[2]};
}

std::vector<double> row_solid_angles(int width, int height) {
  std::vector<double> out;
  out.reserve(static_cast<std::size_t>(height));
  // cos a - cos b as a product: near the poles the difference would cancel.
  for (int row = 0; row < height; ++row)
    out.push_back(2.0 * pi / width * 2.0 * std::sin(pi * (row + 0.5) / height) * std::sin(0.5 * pi / height));
  return out;
}

Image resampled_environment(const Image& radiance, int width, int height) {
  if (radiance.width == width && radiance.height == height) return radiance;
  std::vector<double> rows(static_cast<std::size_t>(width) * static_cast<std::size_t>(height) * 3, 0.0);
  const std::vector<Overlap> across = overlaps(column_edges(radiance.width), column_edges(width));
  for (const Overlap& down : overlaps(row_edges(radiance.height), row_edges(height))) {
    double* const target = &rows[static_cast<std::size_t>(down.target) * static_cast<std::size_t>(width) * 3];
    for (const Overlap& o : across) {
      const auto texel = radiance.at(o.source, down.source);
      for (std::size_t c = 0; c < 3; ++c)
        target[static_cast<std::size_t>(o.target) * 3 + c] += down.share * o.share * texel[c];
    }
  }
  Image out(width, height, 3);
  std::ranges::transform(rows, out.texels.begin(), [](double value) { return static_cast<float>(value); });
  return out;
}

glm::dvec3 mean_radiance(const Image& radiance) {
  const std::vector<double> solid_angles = row_solid_angles(radiance.width, radiance.height);
  glm::dvec3 sum(0.0);
  for (int y = 0; y < radiance.height; ++y) {
    glm::dvec3 row(0.0);
    for (int x = 0; x < radiance.width; ++x) {
      const auto texel = radiance.at(x, y);
      row += glm::dvec3(texel[0], texel[1], texel[2]);
    }
    sum += solid_angles[static_cast<std::size_t>(y)] * row;
  }
  return sum / (4.0 * pi);
}

Environment constant_environment(const glm::vec3& radiance) {
  Image map(1, 1, 3);
  map.texels = {radiance.r, radiance.g, radiance.b};
  return {.name = "constant", .radiance = std::make_shared<const Image>(std::move(map))};
}

}  // namespace footprint
