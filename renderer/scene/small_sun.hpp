// Suns and lamps that take up so small a part of an environment that no lookup by lobes finds them: told apart from the
// rest.
#pragma once

#include <vector>

#include "renderer/scene/environment.hpp"

namespace footprint {

/// What a small sun lights, as a directional light.
struct SmallSun {
  glm::dvec3 direction{0.0};   ///< towards it: unit, world, rotation applied
  glm::dvec3 irradiance{0.0};  ///< on a surface that faces it
  double share = 0.0;          ///< of the environment's light, over all directions and channels
};

/// An environment in parts, whose light together is all of it.
struct SunsApart {
  std::vector<SmallSun> suns;  ///< the brightest texel's first; most_small_suns at most
  Environment rest;            ///< no texel of a sun's is brighter than the ring around it
};

/// How many are told apart: methods take each as one more light.
inline constexpr std::size_t most_small_suns = 4;

/// The brightest texel's surroundings, half a degree or a texel and a half, where what is brighter there than in the
/// ring about them has a hundredth of all light, and the brightest texel is ten times as bright as that ring; then
/// those of the brightest texel that is left, until one is no such sun. None in a black environment, in a sky with a
/// soft sun, and where a texel is larger than 1.3 degrees.
[[nodiscard]] SunsApart suns_apart(const Environment& environment);

}  // namespace footprint
