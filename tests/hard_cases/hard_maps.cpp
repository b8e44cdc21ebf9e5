// Maps by formula. Noise comes from a generator with the same numbers on every platform.
#include "tests/hard_cases/hard_maps.hpp"

#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "renderer/core/numbers.hpp"

namespace footprint::hard_cases {

glm::dvec3 leaning(double degrees) {
  const double angle = degrees * std::numbers::pi / 180.0;
  return {std::sin(angle), 0.0, std::cos(angle)};
}

Image tilted(double degrees) {
  return map_of(8, 8, [&](int, int) { return leaning(degrees); });
}

Image grooves(double degrees) {
  return map_of(8, 8, [&](int x, int) { return leaning(x % 2 == 0 ? degrees : -degrees); });
}

Image checkerboard(double degrees) {
  return map_of(8, 8, [&](int x, int y) {
    const glm::dvec3 n = leaning(degrees);
    return (x + y) % 2 == 0 ? n : glm::dvec3(n.y, n.x, n.z);
  });
}

Image noise(int width, int height, double most_sine, int seed) {
  std::mt19937_64 random(static_cast<std::uint64_t>(seed));
  return map_of(width, height, [&](int, int) {
    const double sine = most_sine * std::sqrt(uniform(random));
    const double turn = 2.0 * std::numbers::pi * uniform(random);
    return glm::dvec3(sine * std::cos(turn), sine * std::sin(turn), std::sqrt(1.0 - sine * sine));
  });
}

Image with_texel(Image map, const glm::vec4& texel) {
  const auto to = map.at(map.width / 2, map.height / 3);
  for (int c = 0; c < 4; ++c) to[static_cast<std::size_t>(c)] = texel[c];
  return map;
}

Material facets(Image normals, const Lobe& lobe) {
  Material material;
  material.name = "facets";
  material.brdf = {lobe.distribution, GeometryTerm::none, FresnelTerm::none, false};
  material.lobe_parameter = static_cast<float>(lobe.parameter);
  material.normal_map = TextureMap{"normals", std::make_shared<const Image>(std::move(normals)), {}};
  return material;
}

Material facets(Image normals, NormalDistribution distribution, float one, float other) {
  Image parameters(normals.width, normals.height, 1, one);
  for (int y = 0; y < parameters.height; ++y) {
    for (int x = 0; x < parameters.width; ++x) parameters.at(x, y)[0] = x % 2 == 0 ? one : other;
  }
  Material material = facets(std::move(normals), Lobe{distribution, one});
  material.lobe_parameter.reset();
  material.lobe_parameter_map = TextureMap{"parameters", std::make_shared<const Image>(std::move(parameters)), {}};
  return material;
}

}  // namespace footprint::hard_cases
