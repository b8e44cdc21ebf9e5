// Reads facets from the maps, and computes the extent and the step of the lattice.
#include "methods/ndf_atlas/atlas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>
#include <numbers>

#include "renderer/bake/material_maps.hpp"
#include "renderer/image/mipmap.hpp"

namespace footprint::ndf_atlas {
namespace {

std::vector<glm::vec3> unit_normals(const Image& map) {
  std::vector<glm::vec3> normals(map.texel_count(), glm::vec3(0.0F));
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const float* const n = &map.texels[4 * i];
    const glm::dvec3 normal(n[0], n[1], n[2]);
    if (n[3] > 0.0F && glm::length(normal) >= 1e-3) normals[i] = glm::vec3(glm::normalize(normal));
  }
  return normals;
}

using std::numbers::pi;

constexpr double horizon = std::numbers::sqrt2;
constexpr double most_nodes = 1e6;

// Half the edge of a square about plane_of(normal) that contains all directions within `reach` of the normal. Across
// the tilt the plane is up to 1 / cos(tilt / 2) times as wide as the sphere.
double half_edge(const glm::dvec3& normal, double reach) {
  const double farthest = std::min(std::acos(std::clamp(normal.z, -1.0, 1.0)) + reach, 0.5 * pi);
  return 2.0 * std::sin(0.5 * reach) / std::cos(0.5 * farthest);
}

// The deviation of the Gaussian that is as curved as a lobe's peak. GGX's is narrower than its slope variance suggests:
// D = (1 + (1 / alpha^2 - 1) sin^2)^-2 of its peak has the curvature 4 / alpha^2 for narrow lobes.
double core_width(const Lobe& lobe) {
  return lobe.distribution == NormalDistribution::ggx ? 0.5 * lobe.parameter : lobe_width(lobe);
}

// The narrowest and the widest lobe; of anisotropic lobes, the round ones of the width across and along.
struct Extremes {
  Lobe narrowest, widest;
};

Extremes extremes_of(const Facets& facets) {
  const auto widths = [&](std::size_t i) {
    if (facets.stretches.empty()) return Extremes{facets.lobe(i), facets.lobe(i)};
    const auto [along, across] = facets.alphas(i);
    return Extremes{{facets.distribution, across}, {facets.distribution, along}};
  };
  Extremes found = widths(0);
  for (std::size_t i = 1; i < std::max(facets.parameters.size(), facets.stretches.size()); ++i) {
    const auto [narrow, wide] = widths(i);
    if (lobe_width(narrow) < lobe_width(found.narrowest)) found.narrowest = narrow;
    if (lobe_width(wide) > lobe_width(found.widest)) found.widest = wide;
  }
  return found;
}

// One per texel of the roughness map, or of a grid over the same area with these sides.
std::vector<glm::vec2> stretches_of(const Material& material, int width, int height) {
  if (!material.anisotropy) return {};
  Image map = stretch_map_of(material);
  if (map.texel_count() > 1) map = nearest_texels(map, width, height);
  std::vector<glm::vec2> out;
  out.reserve(map.texel_count());
  for (std::size_t i = 0; i < map.texel_count(); ++i) out.push_back(glm::make_vec2(&map.texels[2 * i]));
  return out;
}

}  // namespace

std::optional<Facets> collect_facets(const Material& material, bool rough) {
  const Image normals = normal_map_of(material);
  Facets facets{.width = normals.width,
                .height = normals.height,
                .distribution = material.brdf.distribution,
                .normals = unit_normals(normals),
                .parameters = {static_cast<float>(lobe_of(material).parameter)},
                .stretches = stretches_of(material, 1, 1)};
  if (!rough) return facets;
  const Image parameters = lobe_parameter_map_of(material);
  if (parameters.texel_count() == 1) {
    facets.parameters = parameters.texels;
    return facets;
  }
  if (!roughness_lies_on_normals(material)) return {};
  facets.parameters = nearest_texels(parameters, normals.width, normals.height).texels;
  facets.stretches = stretches_of(material, normals.width, normals.height);
  return facets;
}

glm::dvec2 plane_of(const glm::dvec3& direction) {
  return glm::dvec2(direction) * std::sqrt(2.0 / std::max(1.0 + direction.z, 1e-9));
}

glm::dvec3 direction_over(const glm::dvec2& point) {
  const double size = glm::length(point);
  const glm::dvec2 inside = size > 2.0 ? point * (2.0 / size) : point;
  const double quarter = std::min(0.25 * glm::dot(inside, inside), 1.0);
  return {inside * std::sqrt(1.0 - quarter), 1.0 - 2.0 * quarter};
}

double lobe_reach(const Lobe& lobe, double outside) {
  // Rings at u = 1 - cos, evenly spaced in log u. Solid angles are 2 pi du.
  constexpr int rings = 2000;
  const double log_least = std::log(1e-4 * lobe_width(lobe) * lobe_width(lobe));
  const double log_ring = (std::log(2.0) - log_least) / rings;
  std::array<double, rings> energy{};
  double whole = 0.0;
  for (int i = 0; i < rings; ++i) {
    const double u = std::exp(log_least + (i + 0.5) * log_ring);
    whole += energy[static_cast<std::size_t>(i)] = lobe_shape(lobe, u) * u;
  }
  double left = 0.0;
  int i = rings;
  while (i > 0 && (left += energy[static_cast<std::size_t>(i - 1)]) < outside * whole) --i;
  return std::acos(1.0 - std::min(std::exp(log_least + i * log_ring), 2.0));
}

Lattice lattice_over(const Facets& facets, double step) {
  const Extremes lobes = extremes_of(facets);
  const double longest_step = step * core_width(lobes.narrowest);
  const double limit = horizon + 2.0 * longest_step;
  Lattice lattice{.reach = lobe_reach(lobes.widest, energy_outside)};
  glm::dvec2 low(limit), high(-limit);
  for (std::size_t i = 0; i < facets.normals.size(); ++i) {
    if (!facets.is_valid(i)) continue;
    const glm::dvec3 normal(facets.normals[i]);
    const double margin = half_edge(normal, lattice.reach);
    low = glm::min(low, plane_of(normal) - margin);
    high = glm::max(high, plane_of(normal) + margin);
  }
  low = glm::max(low, glm::dvec2(-limit));
  high = glm::min(high, glm::dvec2(limit));
  if (low.x >= high.x || low.y >= high.y) return {};
  lattice.origin = low;
  for (int axis = 0; axis < 2; ++axis) {
    const double edge = high[axis] - low[axis];
    lattice.nodes[axis] = 1 + static_cast<int>(std::clamp(std::ceil(edge / longest_step), 3.0, most_nodes));
    lattice.step[axis] = edge / (lattice.nodes[axis] - 1);
  }
  return lattice;
}

}  // namespace footprint::ndf_atlas
