// Small normal maps and materials that hard cases are made of.
#pragma once

#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/material.hpp"

namespace footprint::stability {

/// Every texel by its column and row: a normal, which need not be unit, of weight 1.
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

[[nodiscard]] Image tilted(double degrees);        ///< 8 x 8, all the same
[[nodiscard]] Image grooves(double degrees);       ///< 8 x 8: columns lean one way and the other
[[nodiscard]] Image checkerboard(double degrees);  ///< 8 x 8: along x and along y
[[nodiscard]] Image noise(int width, int height, double most_sine, int seed);  ///< any direction up to that tilt

/// One texel of a map replaced; weight 0: invalid.
[[nodiscard]] Image with_texel(Image map, const glm::vec4& texel);

/// A metal of that map and lobe, without geometry term or Fresnel's: its distribution of normals is all there is.
[[nodiscard]] Material facets(Image normals, const Lobe& lobe);

/// The same with the lobe's parameter from a map of two values in turn.
[[nodiscard]] Material facets(Image normals, NormalDistribution distribution, float one, float other);

}  // namespace footprint::stability
