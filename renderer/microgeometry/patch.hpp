// A patch of small-scale geometry: triangles that tile the plane, functions that build grids, and the kinds of
// scene.toml.
#pragma once

#include <cstddef>
#include <cstdint>
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
