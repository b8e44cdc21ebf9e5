// A patch of small-scale geometry: triangles that tile the plane, and builders of grids.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"

namespace footprint {

/// Triangles over the xy plane, z out of the surface, repeated with `period` along x and y. Lengths are relative: only
/// their ratios matter. A triangle may reach over the border of [0, period): its copies fill the gap on the other side.
/// Counter-clockwise seen from outside; what faces away from a viewer is not seen.
struct Patch {
  std::string name;
  glm::vec2 period{1.0F};
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint8_t> paints;              ///< of each triangle: index into `palette`; empty: all of paint 0
  std::vector<glm::vec3> palette{glm::vec3(1)};  ///< linear RGB, 0..1: multiplies the material's base colour

  friend bool operator==(const Patch&, const Patch&) = default;
};

/// One triangle's plane: unit normal (zero for a triangle without area) and area.
struct FacetPlane {
  glm::dvec3 normal{0.0};
  double area = 0.0;
};

[[nodiscard]] FacetPlane facet_plane(const Patch& patch, std::size_t triangle);

/// The colour of a triangle.
[[nodiscard]] glm::vec3 facet_color(const Patch& patch, std::size_t triangle);

/// Whether not all of the patch has one colour.
[[nodiscard]] bool has_colors(const Patch& patch);

/// The most triangles of a patch, and the most periods that it may rise.
inline constexpr std::size_t most_patch_triangles = std::size_t{1} << 22U;
inline constexpr float most_patch_rise = 16.0F;

/// Errors (usage), naming the patch and `place`: no triangle with an area, a period that is not above 0, an index or a
/// paint out of range, a position that is not finite, too many triangles, too tall or reaching too far for its period.
void check_patch(const Patch& patch, const std::string& place);

/// Triangles of z = height(x, y) over [0, 1) x [0, 1), which `height` must repeat; columns x rows squares, each cut
/// along the diagonal from its lower left.
[[nodiscard]] Patch height_field_patch(std::string name, int columns, int rows,
                                       const std::function<double(double, double)>& height);

/// Adds the quadrilaterals between the points of a grid, two triangles each, counter-clockwise in (u, v): point(u, v)
/// for u in 0..columns, v in 0..rows. Triangles without area are left out.
void add_grid(Patch& patch, int columns, int rows, std::uint8_t paint, const std::function<glm::vec3(int, int)>& point);

/// The generators behind `patch_kinds`.
[[nodiscard]] Patch weave_patch(const Options& parameters, std::uint64_t seed);
[[nodiscard]] Patch noise_patch(const Options& parameters, std::uint64_t seed);
[[nodiscard]] Patch spheres_patch(const Options& parameters, std::uint64_t seed);

}  // namespace footprint
