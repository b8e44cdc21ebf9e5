// Directions over the upper hemisphere: a grid of equal solid angle to integrate over, and the pixels of an x-y disc.
#pragma once

#include <glm/glm.hpp>
#include <vector>

#include "renderer/ndf/base_lobe.hpp"

namespace footprint {

/// Directions with the solid angle that each stands for; the sum of all is 2 pi.
struct HemisphereGrid {
  int resolution = 0;                 ///< cells along the diameter
  std::vector<glm::vec3> directions;  ///< unit, z >= 0
  std::vector<double> solid_angles;
};

inline constexpr int smallest_resolution = 16, largest_resolution = 4096;

/// Lambert's equal-area disc in resolution x resolution cells: X^2 + Y^2 = 1 - z, each cell inside stands for the same
/// solid angle, one on the edge for the part of it that is inside, with that part's centre. The largest distance
/// between neighbours is 4 / resolution radians, at the horizon along the meridian.
[[nodiscard]] HemisphereGrid hemisphere_grid(int resolution);

/// The least resolution at which sums over the grid integrate a lobe and its square to 1e-3 or better, at most
/// `largest_resolution`: on an even grid the error of a smooth density falls off as fast as its Fourier transform.
[[nodiscard]] int resolution_for(const BaseLobe& narrowest);

/// The directions of the pixel centres of a size x size picture of the disc |(x, y)| < 1, x to the right, y up, row 0
/// on top; (0, 0, 0) outside of it.
[[nodiscard]] std::vector<glm::vec3> disc_directions(int size);

}  // namespace footprint
