// Separates suns and lamps that are too small for lobe lookups from the rest of an environment.
#pragma once

#include <vector>

#include "renderer/scene/environment.hpp"

namespace footprint {

/// A small sun as a directional light.
struct SmallSun {
  glm::dvec3 direction{0.0};   ///< towards it: unit, world, rotation applied
  glm::dvec3 irradiance{0.0};  ///< on a surface that faces it
  double share = 0.0;          ///< of the environment's light, over all directions and channels
};

/// An environment without its small suns, and the suns.
struct SunsApart {
  std::vector<SmallSun> suns;  ///< brightest first, at most most_small_suns
  Environment rest;            ///< suns are replaced by the radiance around them
};

/// The largest number of suns; each is one more light for methods.
inline constexpr std::size_t most_small_suns = 4;

/// Separates small suns, starting at the brightest texel. A sun is the surroundings of that texel, half a degree or a
/// texel and a half, if their radiance above the ring around them has 1/100 of all light, and the texel is ten times as
/// bright as that ring. There are none in a black environment, in a sky with a soft sun, or if texels are larger than
/// 1.3 degrees.
[[nodiscard]] SunsApart suns_apart(const Environment& environment);

}  // namespace footprint
