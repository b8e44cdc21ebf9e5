// An environment prefiltered for lobes of falling sharpness (Kautz et al. 2000), and for Lambert's term.
#pragma once

#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/scene/environment.hpp"

namespace footprint {

/// Octahedral maps of the environment's means over von Mises-Fisher lobes, in the world's directions (rotation
/// applied). Map 2 l + i is level l of layer i, as the levels and layers of an array texture; all are RGBA, alpha 1,
/// square, with a border of one texel that repeats what lies across the edge. Every map's lobe is half as sharp as that
/// of the one before it.
struct RadianceStack {
  std::vector<std::vector<Image>> layers;  ///< two; each a chain whose sizes halve from level to level
  float finest_sharpness = 0.0F;           ///< kappa of map 0
  Image irradiance;                        ///< irradiance over pi by normal: bordered octahedral, RGBA
  glm::vec3 mean{0.0F};                    ///< radiance over all directions

  [[nodiscard]] int map_count() const { return static_cast<int>(2 * layers.front().size()); }
};

/// Equal environments give equal stacks, at any number of threads. The finest map has up to 512 texels a side (about
/// one for each texel of the environment), and a lobe whose deviation is two of them. Texels are narrowed by what
/// linear interpolation between them widens. `progress` may throw.
[[nodiscard]] RadianceStack prefilter_environment(const Environment& environment, const Progress& progress);

}  // namespace footprint
