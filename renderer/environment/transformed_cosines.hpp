// Reflected lobes as linearly transformed cosines (Heitz et al. 2016), for area lights.
#pragma once

#include <compare>
#include <glm/glm.hpp>
#include <vector>

#include "renderer/image/image.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// The reflected lobe that a table is about: density of facet normals times geometry factor, above the facets' own
/// plane.
struct ReflectedLobeKind {
  NormalDistribution distribution = NormalDistribution::ggx;
  GeometryTerm geometry = GeometryTerm::smith;
  bool masked_as_ggx = true;  ///< Smith's term, otherwise that of Gaussian slopes

  friend auto operator<=>(const ReflectedLobeKind&, const ReflectedLobeKind&) = default;
};

/// `along` and `across` of the wider lobe, over those of the first.
inline constexpr double wider_cosine = 1.08;

/// The lobe of a view as a cosine lobe max(z, 0) / pi whose directions are multiplied by a matrix. In the plane of axis
/// and view, with the axis along z and the view towards -x, the matrix is R(angle) K: K has the rows (along, 0, shear),
/// (0, across, 0) and (0, 0, 1), and R turns z by `angle` towards x. GGX has the tail of such a lobe. The others have
/// none, so `excess` times a wider lobe is taken from 1 + excess times this one.
struct TransformedCosine {
  double angle = 0.0;
  double along = 1.0, across = 1.0, shear = 0.0, excess = 0.0;
  /// Integrals over light directions of density times geometry factor, and of that times Schlick's (1 - v.h)^5. The
  /// density is scaled so that its projected area is 1.
  double energy = 0.0, schlick = 0.0;
};

/// The density over solid angle of light from a unit vector, 1/sr: 0 below the plane of the axis, with integral 1
/// above.
[[nodiscard]] double transformed_density(const TransformedCosine& cosine, const glm::dvec3& w);

/// Fits a lobe by least squares. In the paper z is turned to the mean direction; here it may turn further, which halves
/// the error of wide lobes.
/// view_angle: between axis and view, 0 to pi, radians. alpha: width of the lobe, as lobe_from_alpha takes it.
/// start: of the search, such as the fit of a neighbour.
[[nodiscard]] TransformedCosine fit_transformed_cosine(const ReflectedLobeKind& kind, double view_angle, double alpha,
                                                       const TransformedCosine& start);

/// The angle of column `x`: even steps from 0 to 2 pi / 3.
[[nodiscard]] double cosine_angle(int x, int columns);
/// The alpha of row `y`: even steps of its logarithm from smallest_alpha to 1.
[[nodiscard]] double cosine_alpha(int y, int rows);

/// The fits of all views and widths: two layers of an array texture, RGBA, 32-bit floats. Columns are view angles, rows
/// widths, at the values of `cosine_angle` and `cosine_alpha`. Layer 0: angle less the view's in radians, log(along /
/// alpha), log(across / alpha), shear / alpha. Layer 1: energy, schlick and excess. Equal at any number of threads.
[[nodiscard]] std::vector<Image> make_cosine_table(const ReflectedLobeKind& kind);

}  // namespace footprint
