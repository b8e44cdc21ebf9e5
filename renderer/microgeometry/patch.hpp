// A patch of small-scale geometry: triangles that tile the plane, functions that build grids, and the kinds of
// scene.toml.
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <glm/glm.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"

namespace footprint {

/// Triangles over the xy plane with z pointing out of the surface, repeated with `period` along x and y. Only ratios of
/// lengths matter. Triangles may cross the border of [0, period); their copies fill the opposite side. Vertices are
/// counter-clockwise seen from outside; back faces are invisible.
struct Patch {
  std::string name;
  glm::vec2 period{1.0F};
  std::vector<glm::vec3> vertices;
  std::vector<glm::uvec3> triangles;
  std::vector<std::uint8_t> paints;              ///< per triangle, index into `palette`; empty means paint 0
  std::vector<glm::vec3> palette{glm::vec3(1)};  ///< linear RGB, 0..1: multiplies the material's base colour

  friend bool operator==(const Patch&, const Patch&) = default;
};

/// The plane of a triangle: unit normal (zero for a degenerate triangle) and area.
struct FacetPlane {
  glm::dvec3 normal{0.0};
  double area = 0.0;
};

[[nodiscard]] FacetPlane facet_plane(const Patch& patch, std::size_t triangle);

/// The colour of a triangle.
[[nodiscard]] glm::vec3 facet_color(const Patch& patch, std::size_t triangle);

/// Whether the patch has more than one colour.
[[nodiscard]] bool has_colors(const Patch& patch);

/// Limits of a patch: the number of triangles, and the height in periods.
inline constexpr std::size_t most_patch_triangles = std::size_t{1} << 22U;
inline constexpr float most_patch_rise = 16.0F;

/// Throws Error (usage) that names the patch and `place`: no triangle with an area, a non-positive period, an index or
/// paint out of range, a position that is not finite, too many triangles, or an extent too large for the period.
void check_patch(const Patch& patch, const std::string& place);

/// Builds triangles of the height field z = height(x, y) over [0, 1) x [0, 1). `height` must have period 1. Each of the
/// columns x rows squares is cut along the diagonal from its lower left corner.
[[nodiscard]] Patch height_field_patch(std::string name, int columns, int rows,
                                       const std::function<double(double, double)>& height);

/// Adds a grid of quadrilaterals, two triangles each, counter-clockwise in (u, v). `point(u, v)` is called for u in
/// 0..columns and v in 0..rows. Degenerate triangles are omitted.
void add_grid(Patch& patch, int columns, int rows, std::uint8_t paint, const std::function<glm::vec3(int, int)>& point);

/// The generators of `patch_kinds`.
[[nodiscard]] Patch weave_patch(const Options& parameters, std::uint64_t seed);
[[nodiscard]] Patch noise_patch(const Options& parameters, std::uint64_t seed);
[[nodiscard]] Patch spheres_patch(const Options& parameters, std::uint64_t seed);

/// A kind of patch. Parameters that are lengths are in periods.
struct PatchKind {
  std::string name;
  std::string summary;  ///< one sentence
  std::vector<OptionSpec> parameters;
  /// Deterministic for its parameters and seed.
  Patch (*build)(const Options& parameters, std::uint64_t seed) = nullptr;
};

/// `flat`, `grooves`, `pyramids`, `spheres`, `weave` and `noise`.
[[nodiscard]] std::span<const PatchKind> patch_kinds();

/// Finds a kind by name. Throws Error (usage) with the nearest name if it is unknown.
[[nodiscard]] const PatchKind& find_patch_kind(const std::string& name);

/// Builds a patch of a kind with the `given` parameters. Throws Error (usage) as Options does.
[[nodiscard]] Patch make_patch(const PatchKind& kind, const std::map<std::string, std::string>& given,
                               std::uint64_t seed = 1);

}  // namespace footprint
