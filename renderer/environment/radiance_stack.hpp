// What methods look up of an environment: octahedral maps of its means over lobes, and a table of base lobes as von
// Mises-Fisher lobes.
#pragma once

#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"
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

/// Equal environments give equal stacks, at any number of threads. The finest map has up to 512 texels per side (about
/// one for each texel of the environment), and a lobe whose deviation is two of them. Texels are narrowed by what
/// linear interpolation between them widens. `progress` may throw.
[[nodiscard]] RadianceStack prefilter_environment(const Environment& environment, const Progress& progress);

/// Geometry factors of f * cos that facets have in turn, all with their own horizon (docs/base-brdf.md): Smith's of
/// alphas from 0 to the lobe's own in even steps, since spread facets mask as single ones do; Tan's; none.
inline constexpr int smith_steps = 4, tan_geometry = smith_steps + 1, no_geometry = smith_steps + 2;

/// Layers of one array texture, RGBA, 32-bit floats: layer 2 g + p is part p of geometry g, part 0 the half of a lobe's
/// visible normals that is nearest to its axis, part 1 its tail. Columns are views, rows widths: `lobe_view` and
/// `lobe_width` are the values at their centres. Red and green: energies that the terms 1 - x and x of Schlick's
/// f0 (1 - x) + x reflect. Blue: the angle from the mirror image of the view about the axis to the mean direction,
/// towards the view. Alpha: log2(kappa alpha^2), kappa of the vMF lobe with that mean direction and spread.
struct LobeTable {
  std::vector<Image> layers;
};

/// Cosine of the angle between view and axis, -1 to 1, at column `x` of `columns`: denser around grazing views.
[[nodiscard]] double lobe_view(int x, int columns);
/// GGX's alpha at row `y` of `rows`, 0.001 to 1: even steps of its square root.
[[nodiscard]] double lobe_width(int y, int rows);

/// Equal at any number of threads; takes about 50 ms of one core.
[[nodiscard]] LobeTable make_lobe_table();

}  // namespace footprint
