// A sun that takes up so small a part of an environment that no lookup by lobes finds it: told apart from the rest.
#pragma once

#include <optional>

#include "renderer/scene/environment.hpp"

namespace footprint {

/// What a small sun lights, as a directional light.
struct SmallSun {
  glm::dvec3 direction{0.0};   ///< towards it: unit, world, rotation applied
  glm::dvec3 irradiance{0.0};  ///< on a surface that faces it
  double share = 0.0;          ///< of the environment's light, over all directions and channels
};

/// An environment in two parts, whose light together is all of it.
struct SunApart {
  SmallSun sun;
  Environment rest;  ///< no texel of the sun's is brighter than the ring around it
};

/// The brightest texel's surroundings, half a degree or a texel and a half, where what is brighter there than in the
/// ring about them has a hundredth of all light, and the brightest texel is ten times as bright as that ring. None in a
/// black environment, in a sky with a soft sun, and where a texel is larger than 1.3 degrees.
[[nodiscard]] std::optional<SunApart> sun_apart(const Environment& environment);

}  // namespace footprint
