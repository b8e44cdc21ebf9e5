// Test support for `atanasov_bins`: maps and footprints, the shader's functions over them, and plain sums over texels.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <span>
#include <string>
#include <vector>

#include "tests/methods/bins_twin.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& atanasov_bins_method();
}  // namespace footprint

namespace footprint::testing {

/// The base BRDF of material_of: one Blinn-Phong lobe and nothing else.
inline constexpr BaseBrdf phong_facets{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
inline constexpr double phong_exponent = 200.0;

/// Random normals, a quarter of them equal, some invalid, none at the border of a bin.
[[nodiscard]] inline Image test_normals(int width, int height, float tilt, int m) {
  Image image = random_normals(width, height, tilt, 21);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const std::span<float> n = image.at(x, y);
      const bool same = x >= width / 2 && y >= height / 2;
      const glm::dvec3 normal = same ? glm::dvec3(0.1, -0.05, 0.99) : glm::dvec3(n[0], n[1], n[2]);
      const std::uint32_t bin = bin_of(glm::normalize(normal), m);
      const auto across = static_cast<std::uint32_t>(m);
      // 0.3 and 0.6 of the bin's edges: after rounding to 32 bits or packing, normals are in the same bin.
      const glm::vec3 inner(square_to_hemisphere((glm::dvec2(bin % across, bin / across) + glm::dvec2(0.3, 0.6)) /
                                                 static_cast<double>(m)));
      std::copy_n(&inner.x, 3, n.begin());
      n[3] = x % 5 == 2 && y % 3 == 1 ? 0.0F : 1.0F;
    }
  }
  return image;
}

/// The material of a flat square with that map.
[[nodiscard]] inline Material material_of(Image normals, Wrap wrap) {
  Material material = square_scene(normals, {.brdf = phong_facets}).materials[0];
  material.lobe_parameter = static_cast<float>(phong_exponent);
  material.normal_map->coordinates.wrap = {wrap, wrap};
  return material;
}

/// Parallelograms in texels of a map: aligned, sheared, mirrored, over its borders (sheared, larger than the map,
/// aligned), within a texel, and the whole map.
[[nodiscard]] inline std::vector<Parallelogram> footprints_on(const glm::dvec2& size) {
  return {{{0.3 * size.x, 0.4 * size.y}, {{0.2 * size.x, 0.0}, {0.0, 0.3 * size.y}}},
          {{0.5 * size.x, 0.5 * size.y}, {{0.3 * size.x, 0.1 * size.y}, {-0.05 * size.x, 0.2 * size.y}}},
          {{0.4 * size.x, 0.6 * size.y}, {{0.0, 0.5 * size.y}, {0.3 * size.x, 0.0}}},
          {{0.95 * size.x, 0.02 * size.y}, {{0.4 * size.x, -0.1 * size.y}, {0.1 * size.x, 0.3 * size.y}}},
          {{-0.7 * size.x, 1.6 * size.y}, {{1.4 * size.x, 0.3 * size.y}, {-0.4 * size.x, 1.1 * size.y}}},
          {{0.9 * size.x, 0.5 * size.y}, {{0.4 * size.x, 0.0}, {0.0, 0.3 * size.y}}},
          {{0.31 * size.x, 0.44 * size.y}, {{1.2, 0.1}, {-0.1, 1.4}}},
          {0.5 * size, {{size.x, 0.0}, {0.0, size.y}}}};
}

/// Beckmann's density of normals at h about n.
[[nodiscard]] inline double beckmann_density(double alpha, const glm::dvec3& n, const glm::dvec3& h) {
  const double c = std::max(glm::dot(n, h), 1e-3);
  return std::exp(-(1.0 / (c * c) - 1.0) / (alpha * alpha)) / (std::numbers::pi * alpha * alpha * std::pow(c, 4.0));
}

/// The input of a probe: the footprint in uv (a.xy, b) and a direction (c).
[[nodiscard]] inline std::array<glm::vec4, 3> input_of(const Parallelogram& p, const glm::dvec2& size,
                                                       const glm::dvec3& h) {
  return {glm::vec4(glm::vec2(p.centre / size), 0.0F, 0.0F),
          glm::vec4(glm::vec2(p.edges[0] / size), glm::vec2(p.edges[1] / size)), glm::vec4(glm::vec3(h), 0.0F)};
}

/// Evaluates the GLSL statements `body` for each input; `e` is the method's effective reflectance there.
[[nodiscard]] inline std::vector<glm::vec4> probe_footprints(const ProbedMethod& probed, const std::string& body,
                                                             std::span<const std::array<glm::vec4, 3>> inputs) {
  return probe_method(
      probed, "Footprint f = Footprint(a.xy, b.xy, b.zw);\ne = effective(Footprints(f, f, f));\n" + body, inputs);
}

/// The mean of value(normal) over the texels of a footprint that have a normal.
template <class Value>
[[nodiscard]] double plain_mean(const Image& normals, const Parallelogram& p, Wrap wrap, const Value& value) {
  double sum = 0.0, area = 0.0;
  for_each_texel(p, {normals.width, normals.height}, wrap, [&](int x, int y, double covered) {
    const std::span<const float> n = normals.at(x, y);
    if (n[3] < 0.5F) return;
    sum += covered * value(glm::dvec3(n[0], n[1], n[2]));
    area += covered;
  });
  return sum / area;
}

/// The share of each of m x m bins in a footprint's texels that have a normal.
[[nodiscard]] inline std::vector<double> shares_of_bins(const Image& normals, const Parallelogram& p, Wrap wrap,
                                                        int m) {
  std::vector<double> shares(static_cast<std::size_t>(m) * static_cast<std::size_t>(m), 0.0);
  double area = 0.0;
  for_each_texel(p, {normals.width, normals.height}, wrap, [&](int x, int y, double covered) {
    const std::span<const float> n = normals.at(x, y);
    if (n[3] < 0.5F) return;
    shares[bin_of(glm::normalize(glm::dvec3(n[0], n[1], n[2])), m)] += covered;
    area += covered;
  });
  for (double& share : shares) share /= area;
  return shares;
}

}  // namespace footprint::testing
