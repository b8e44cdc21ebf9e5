// Small normal maps and materials of the hard cases.
#pragma once

#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::hard_cases {

/// A map whose normal at column x and row y is normal_at(x, y), of any length. All weights are 1.
template <class NormalAt>
[[nodiscard]] Image map_of(int width, int height, NormalAt normal_at) {
  Image image(width, height, 4, 1.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const glm::dvec3 n = glm::normalize(glm::dvec3(normal_at(x, y)));
      for (int c = 0; c < 3; ++c) image.at(x, y)[static_cast<std::size_t>(c)] = static_cast<float>(n[c]);
    }
  }
  return image;
}

/// The unit normal that leans by `degrees` from z towards x.
[[nodiscard]] glm::dvec3 leaning(double degrees);

[[nodiscard]] Image tilted(double degrees);        ///< 8 x 8 equal texels
[[nodiscard]] Image grooves(double degrees);       ///< 8 x 8; columns lean to alternate sides
[[nodiscard]] Image checkerboard(double degrees);  ///< 8 x 8; texels lean along x and along y in turn
[[nodiscard]] Image noise(int width, int height, double most_sine, int seed);  ///< random directions up to that tilt

/// A copy of the map with one texel replaced; weight 0 makes it invalid.
[[nodiscard]] Image with_texel(Image map, const glm::vec4& texel);

/// A metal with that map and lobe, without geometry or Fresnel term, so that only the distribution of normals counts.
[[nodiscard]] Material facets(Image normals, const Lobe& lobe);

/// Such a metal with a map of the lobe's parameter that alternates between two values.
[[nodiscard]] Material facets(Image normals, NormalDistribution distribution, float one, float other);

}  // namespace footprint::hard_cases
