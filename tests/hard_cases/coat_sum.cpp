// Traces rays through the points of a pixel and evaluates the formula with the coat's texel under each.
#include "tests/hard_cases/coat_sum.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>
#include <variant>

#include "tests/hard_cases/worst.hpp"

namespace footprint::hard_cases {
namespace {

using glm::dvec3;

constexpr double narrowest = 1e-3;       // alpha of a coat, docs/explanation/base-brdf.md
constexpr double grazing_cosine = 1e-4;  // the n.v that Smith's term takes of facets that face away

// The layer's own f * cos: D G2 / (4 n.v) about its normal.
double layer(const dvec3& n, const dvec3& l, const dvec3& v, double alpha) {
  const dvec3 h = glm::normalize(l + v);
  const double nl = glm::dot(n, l), nv = std::max(glm::dot(n, v), grazing_cosine), nh = glm::dot(n, h);
  if (nl <= 0.0 || nh <= 0.0) return 0.0;
  const double a2 = alpha * alpha, t = nh * nh * (a2 - 1.0) + 1.0;
  const double g = 0.5 / (nl * std::sqrt(nv * nv * (1.0 - a2) + a2) + nv * std::sqrt(nl * nl * (1.0 - a2) + a2));
  return a2 / (std::numbers::pi * t * t) * g * nl;
}

double schlick(double cosine) { return 0.04 + 0.96 * std::pow(1.0 - std::min(std::abs(cosine), 1.0), 5.0); }

// A map that returns the texel at a point of the unit square of texture coordinates.
class Texels {
 public:
  explicit Texels(const std::optional<TextureMap>& map) {
    if (!map) return;
    image_ = map->image.decoded();
    coordinates_ = map->coordinates;
  }

  [[nodiscard]] bool none() const { return image_.texels.empty(); }
  [[nodiscard]] std::span<const float> at(const glm::dvec2& uv) const {
    const glm::dvec2 mapped = glm::dmat3x2(coordinates_.transform) * dvec3(uv, 1.0);
    return image_.at(wrapped(mapped.x, image_.width, coordinates_.wrap[0]),
                     wrapped(mapped.y, image_.height, coordinates_.wrap[1]));
  }

 private:
  static int wrapped(double at, int size, Wrap wrap) {
    const int texel = static_cast<int>(std::floor(at * size));
    return wrap == Wrap::clamp_to_edge ? std::clamp(texel, 0, size - 1) : ((texel % size) + size) % size;
  }

  Image image_;
  TextureCoordinates coordinates_;
};

class Coating {
 public:
  explicit Coating(const ClearCoat& coat)
      : weights_(coat.weight_map), roughness_(coat.roughness_map), normals_(coat.normal_map), coat_(&coat) {}

  [[nodiscard]] double weight(const glm::dvec2& uv) const {
    return weights_.none() ? coat_->weight : weights_.at(uv).front();
  }
  [[nodiscard]] double alpha(const glm::dvec2& uv) const {
    const double roughness = roughness_.none() ? coat_->roughness : roughness_.at(uv).front();
    return std::max(roughness * roughness, narrowest);
  }
  /// The mesh's own normal if the texel is invalid.
  [[nodiscard]] dvec3 normal(const glm::dvec2& uv) const {
    if (normals_.none() || normals_.at(uv)[3] < 0.5F) return {0.0, 0.0, 1.0};
    const std::span<const float> texel = normals_.at(uv);
    return glm::normalize(dvec3(texel[0], texel[1], texel[2]));
  }

 private:
  Texels weights_, roughness_, normals_;
  const ClearCoat* coat_;
};

struct Point {
  dvec3 at, to_viewer;
};

// The point in the plane z = 0 that a ray through `pixel` meets; rows count from the top.
Point seen_at(const Camera& camera, const glm::dvec2& pixel, const glm::ivec2& size) {
  const double half_height = std::tan(0.5 * camera.yfov);
  const glm::dvec2 screen(2.0 * pixel.x / size.x - 1.0, 1.0 - 2.0 * pixel.y / size.y);
  const glm::dmat4 world(camera.world);
  const dvec3 ray = glm::normalize(glm::dmat3(world) * dvec3(half_height * screen, -1.0)), eye(world[3]);
  return {eye - ray * (eye.z / ray.z), -ray};
}

// The relative difference; 0 if both are 0, as for facets without light.
double difference(double value, double from) { return value == from ? 0.0 : std::abs(value / from - 1.0); }

}  // namespace

std::vector<CoatedPixel> coat_sum(const Scene& scene, const glm::ivec2& size, int points) {
  const Coating coating(*scene.materials.front().coat);
  const auto& lamp = std::get<PointLight>(scene.lights.front());
  std::vector<CoatedPixel> sum(static_cast<std::size_t>(size.x) * static_cast<std::size_t>(size.y));
  const double part = 1.0 / (points * points);
  for (std::size_t i = 0; i < sum.size(); ++i) {
    sum[i].whole = true;
    const auto index = static_cast<int>(i);
    const glm::ivec2 pixel(index % size.x, index / size.x);
    for (int k = 0; k < points * points; ++k) {
      const glm::ivec2 cell(k % points, k / points);
      const glm::dvec2 place = glm::dvec2(pixel) + (glm::dvec2(cell) + 0.5) / static_cast<double>(points);
      const Point point = seen_at(scene.camera, place, size);
      if (std::max(std::abs(point.at.x), std::abs(point.at.y)) > 1.0) sum[i].whole = false;
      const glm::dvec2 uv(0.5 + 0.5 * point.at.x, 0.5 - 0.5 * point.at.y);
      const dvec3 normal = coating.normal(uv), to_light = dvec3(lamp.position) - point.at;
      const double share = coating.weight(uv) * schlick(glm::dot(normal, point.to_viewer));
      sum[i].share += part * share;
      if (to_light.z <= 0.0) continue;  // the horizon
      sum[i].light += part * share * layer(normal, glm::normalize(to_light), point.to_viewer, coating.alpha(uv)) *
                      lamp.intensity.r / glm::dot(to_light, to_light);
    }
  }
  return sum;
}

CoatError coat_error(const std::vector<CoatedPixel>& sum, const Image& bare, const Image& picture) {
  CoatError error;
  const auto expected = [&](std::size_t i) { return (1.0 - sum[i].share) * bare.texels[4 * i] + sum[i].light; };
  const auto width = static_cast<std::size_t>(picture.width);
  double all = 0.0, all_true = 0.0;
  for (std::size_t i = 0; i < sum.size(); ++i) {
    if (!sum[i].whole) continue;
    const double value = picture.texels[4 * i];
    all += value;
    all_true += expected(i);
    keep_worst(error.each, difference(value, expected(i)));
    for (const std::size_t next : {i + 1, i + width}) {
      if (next >= sum.size() || (next == i + 1 && next % width == 0) || !sum[next].whole) continue;
      keep_worst(error.step, difference(picture.texels[4 * next], value));
      keep_worst(error.true_step, difference(expected(next), expected(i)));
    }
  }
  error.mean = difference(all, all_true);
  return error;
}

}  // namespace footprint::hard_cases
