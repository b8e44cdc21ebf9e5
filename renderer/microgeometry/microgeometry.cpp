// Finds the highest triangle over each texel of a patch.
#include "renderer/microgeometry/microgeometry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>
#include <vector>

namespace footprint {
namespace {

constexpr std::uint32_t nothing = std::numeric_limits<std::uint32_t>::max();

bool inside(const std::array<glm::dvec3, 3>& corners, const glm::dvec2& p) {
  for (std::size_t i = 0; i < 3; ++i) {
    const glm::dvec2 a(corners.at(i)), b(corners.at((i + 1) % 3));
    if ((b.x - a.x) * (p.y - a.y) - (b.y - a.y) * (p.x - a.x) < 0.0) return false;
  }
  return true;
}

// The highest triangle over the centre of each texel.
std::vector<std::uint32_t> seen_from_above(const Patch& patch, int size) {
  const auto side = static_cast<std::size_t>(size);
  std::vector<double> heights(side * side, -std::numeric_limits<double>::infinity());
  std::vector<std::uint32_t> triangles(heights.size(), nothing);
  const auto wrapped = [size](int i) { return static_cast<std::size_t>((i % size + size) % size); };
  const glm::dvec2 scale = static_cast<double>(size) / glm::dvec2(patch.period);
  for (std::size_t triangle = 0; triangle < patch.triangles.size(); ++triangle) {
    const glm::dvec3 normal = facet_plane(patch, triangle).normal;
    if (!(normal.z > 0.0)) continue;
    std::array<glm::dvec3, 3> corners{};
    for (int i = 0; i < 3; ++i) {
      const glm::dvec3 v(patch.vertices[patch.triangles[triangle][i]]);
      corners.at(static_cast<std::size_t>(i)) = glm::dvec3(glm::dvec2(v) * scale - 0.5, v.z);  // centres are whole
    }
    const glm::ivec2 low(glm::ceil(glm::dvec2(glm::min(glm::min(corners[0], corners[1]), corners[2]))));
    const glm::ivec2 high(glm::floor(glm::dvec2(glm::max(glm::max(corners[0], corners[1]), corners[2]))));
    const glm::dvec2 slope = -glm::dvec2(normal) / normal.z / scale;
    for (int y = low.y; y <= high.y; ++y) {
      for (int x = low.x; x <= high.x; ++x) {
        if (!inside(corners, {x, y})) continue;
        const double height = corners[0].z + glm::dot(slope, glm::dvec2(x, y) - glm::dvec2(corners[0]));
        const std::size_t texel = wrapped(-1 - y) * side + wrapped(x);  // row 0 is a map's top, where y is largest
        if (height <= heights[texel]) continue;
        heights[texel] = height;
        triangles[texel] = static_cast<std::uint32_t>(triangle);
      }
    }
  }
  return triangles;
}

using std::numbers::pi;

std::size_t cell_of(double share, int cells) {
  return static_cast<std::size_t>(std::clamp(static_cast<int>(share * cells), 0, cells - 1));
}

// Cosines of both directions to the normal. wi and wo are at theta_d on opposite sides of the half vector; phi_d
// rotates their plane about it.
glm::dvec2 cosines_of(const glm::dvec3& angles) {
  const double along = std::cos(angles.x) * std::cos(angles.y);
  const double across = std::sin(angles.x) * std::sin(angles.y) * std::cos(angles.z);
  return {along - across, along + across};
}

}  // namespace

glm::vec3 TabulatedBrdf::at(double theta_h, double theta_d, double phi_d) const {
  const double turn = phi_d / pi - std::floor(phi_d / pi);
  const std::size_t h = cell_of(std::sqrt(std::max(theta_h, 0.0) / (0.5 * pi)), theta_h_cells);
  const std::size_t d = cell_of(theta_d / (0.5 * pi), theta_d_cells);
  const std::size_t p = cell_of(turn, phi_d_cells);
  return values[(h * theta_d_cells + d) * phi_d_cells + p];
}

glm::vec3 TabulatedBrdf::at(const glm::dvec3& normal, const glm::dvec3& wi, const glm::dvec3& wo) const {
  const glm::dvec3 sum = wi + wo;
  const double length = glm::length(sum);
  if (!(length > 1e-9)) return glm::vec3(0.0F);
  const glm::dvec3 h = sum / length;
  // The azimuth of a direction about the half vector relative to that of the normal.
  const glm::dvec3 up = normal - h * glm::dot(normal, h);
  const glm::dvec3 side = wi - h * glm::dot(wi, h);
  const double lengths = glm::length(up) * glm::length(side);
  const double phi = lengths > 1e-15 ? std::acos(std::clamp(-glm::dot(up, side) / lengths, -1.0, 1.0)) : 0.0;
  return at(std::atan2(glm::length(glm::cross(normal, h)), glm::dot(normal, h)),
            std::atan2(glm::length(side), glm::dot(wi, h)), phi);
}

glm::dvec3 tabulated_angles(int theta_h_cell, int theta_d_cell, int phi_d_cell) {
  const double root = (theta_h_cell + 0.5) / TabulatedBrdf::theta_h_cells;
  return {0.5 * pi * root * root, 0.5 * pi * (theta_d_cell + 0.5) / TabulatedBrdf::theta_d_cells,
          pi * (phi_d_cell + 0.5) / TabulatedBrdf::phi_d_cells};
}

TabulatedBrdf tabulate(const std::function<glm::vec3(const glm::dvec3& angles)>& brdf) {
  TabulatedBrdf table;
  table.values.reserve(TabulatedBrdf::cell_count);
  for (int h = 0; h < TabulatedBrdf::theta_h_cells; ++h) {
    for (int d = 0; d < TabulatedBrdf::theta_d_cells; ++d) {
      for (int p = 0; p < TabulatedBrdf::phi_d_cells; ++p) table.values.push_back(brdf(tabulated_angles(h, d, p)));
    }
  }
  return table;
}

TabulatedBrdf ward_brdf(const glm::vec3& diffuse, const glm::vec3& specular, double alpha) {
  return tabulate([&](const glm::dvec3& angles) {
    const glm::dvec2 cosines = cosines_of(angles);
    if (cosines.x <= 0.0 || cosines.y <= 0.0) return glm::vec3(0.0F);
    const double tangent = std::tan(angles.x) / alpha;
    const double lobe =
        std::exp(-tangent * tangent) / (4.0 * pi * alpha * alpha * std::sqrt(std::max(cosines.x * cosines.y, 1e-4)));
    return diffuse / static_cast<float>(pi) + specular * static_cast<float>(lobe);
  });
}

bool needs_colors(const Microgeometry& microgeometry) {
  return has_colors(microgeometry.patch) ||
         (microgeometry.brdf && facet_color(microgeometry.patch, 0) != glm::vec3(1.0F));
}

PatchMaps patch_maps(const Patch& patch, int size) {
  const std::vector<std::uint32_t> triangles = seen_from_above(patch, size);
  PatchMaps out{.normals = Image(size, size, 4), .mean_color = glm::vec3(0.0F)};
  glm::dvec3 sum(0.0);
  std::size_t count = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    const std::uint32_t triangle = triangles[i];
    const glm::vec4 texel = triangle == nothing ? glm::vec4(0.0F, 0.0F, 1.0F, 0.0F)
                                                : glm::vec4(glm::vec3(facet_plane(patch, triangle).normal), 1.0F);
    std::copy_n(&texel.x, 4, out.normals.texels.begin() + static_cast<std::ptrdiff_t>(4 * i));
    if (triangle == nothing) continue;
    sum += glm::dvec3(facet_color(patch, triangle));
    ++count;
  }
  if (count > 0) out.mean_color = glm::vec3(sum / static_cast<double>(count));
  return out;
}

}  // namespace footprint
