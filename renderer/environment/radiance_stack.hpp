// What methods look up of an environment: octahedral maps of its means over lobes, and a table of base lobes as von
// Mises-Fisher lobes.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/core/progress.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/environment.hpp"

namespace footprint {

/// Octahedral maps of the environment's means over von Mises-Fisher lobes, in world directions. Map 2 l + i is level l
/// of layer i of an array texture. All are square RGBA, alpha 1, with a border of one texel that continues across the
/// edge. Each map's lobe has half the sharpness of the one before.
struct RadianceStack {
  std::vector<std::vector<Image>> layers;  ///< two; each a chain whose sizes halve from level to level
  float finest_sharpness = 0.0F;           ///< kappa of map 0
  Image irradiance;                        ///< irradiance over pi by normal: bordered octahedral, RGBA
  glm::vec3 mean{0.0F};                    ///< radiance over all directions

  [[nodiscard]] int map_count() const { return static_cast<int>(2 * layers.front().size()); }
};

/// Equal environments give equal stacks at any number of threads. The finest map has up to 512 texels per side (about
/// one per texel of the environment) and a lobe with a deviation of two texels. Texels are sharpened to compensate for
/// linear interpolation.
/// progress: may throw.
[[nodiscard]] RadianceStack prefilter_environment(const Environment& environment, const Progress& progress);

/// The geometry factors of f * cos in the table, for facets with their own horizon (docs/explanation/base-brdf.md):
/// Smith's for alphas in even steps from 0 to the lobe's own, Tan's, and none.
inline constexpr int smith_steps = 4, tan_geometry = smith_steps + 1, no_geometry = smith_steps + 2;

/// Cosine of the angle between view and axis, -1 to 1, of column `x`; columns are denser at grazing views.
[[nodiscard]] double lobe_view(int x, int columns);
/// GGX's alpha at row `y` of `rows`, 0.001 to 1: even steps of its square root.
[[nodiscard]] double lobe_width(int y, int rows);

/// GGX's geometry factor G2 / (4 n.l n.v) times n.l, the axis along z (Heitz 2014, equation 99).
[[nodiscard]] double smith_factor(double alpha2, double nl, double nv);
/// Tan 2005 under the bound of a V-cavity's masking.
[[nodiscard]] double tan_factor(double nh, double oh, double nv);
/// The mean of max(h.wo, 0) over GGX's normals, c the cosine of view and axis (Walter 2007's Smith term).
[[nodiscard]] double visible_area(double c, double alpha2);
/// A visible normal of GGX for u and azimuth on the cap about the view, stretched to alpha 1 (Dupuy and Benyoub 2023).
[[nodiscard]] glm::dvec3 visible_normal(const glm::dvec3& stretched, double alpha, double u, double azimuth);

/// Layers of one array texture, RGBA, 32-bit floats. Layer 2 g + p is part p of geometry g: part 0 the half of a lobe's
/// visible normals nearest to its axis, part 1 its tail. Columns are views, rows widths, at the values of `lobe_view`
/// and `lobe_width`. Red and green: energies of the terms 1 - x and x of Schlick's f0 (1 - x) + x. Blue: the angle from
/// the mirror direction of the view about the axis to the mean direction, towards the view. Alpha: log2(kappa alpha^2),
/// kappa of the vMF lobe with the same mean direction and spread. Equal at any number of threads; takes about 50 ms of
/// one core.
[[nodiscard]] std::vector<Image> make_lobe_table();

/// The position of a direction, of any length but 0, on the unit square.
[[nodiscard]] glm::dvec2 octahedral_uv(const glm::dvec3& direction);

/// The unit direction at a position. Positions up to half outside of the unit square continue across the edge.
[[nodiscard]] glm::dvec3 octahedral_direction(const glm::dvec2& uv);

/// The direction of texel (x, y) in a map of `size` x `size` texels with a border of one texel that continues across
/// the edge.
[[nodiscard]] glm::dvec3 bordered_texel_direction(int size, int x, int y);

/// The solid angle per area of the unit square at a direction.
[[nodiscard]] double octahedral_stretch(const glm::dvec3& direction);

}  // namespace footprint
