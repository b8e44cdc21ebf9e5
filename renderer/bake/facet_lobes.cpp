// The rotation in closed form, sums over the lobes, and checks of each before it reaches a shader.
#include "renderer/bake/facet_lobes.hpp"

#include <fmt/format.h>

#include <bit>
#include <cmath>
#include <cstdint>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

void check_lobe(const FacetLobe& lobe, std::size_t number, const Material& material) {
  constexpr float tolerance = 1e-4F;
  const bool unit = std::abs(glm::length(lobe.axis) - 1.0F) < tolerance;
  const bool positive = lobe.parameter > 0.0F && lobe.weight > 0.0F;
  if (unit && lobe.axis.z > 0.0F && positive && std::isfinite(lobe.parameter) && std::isfinite(lobe.weight)) return;
  throw Error(ErrorKind::usage, fmt::format("material {}, lobe {}", material.name, number),
              "its axis is not a unit vector above the horizon, or its parameter or weight is not above 0",
              "give every lobe an axis with z > 0, a parameter and a weight");
}

}  // namespace

glm::dvec3 turned_with_normal(const glm::dvec3& axis, const glm::dvec3& normal) {
  glm::dvec2 side(normal);
  double share = 1.0 / (1.0 + std::max(normal.z, 0.0));
  if (normal.z < 0.0) {  // 1 + z cancels; |xy|^2 = (1 + z) (1 - z)
    const double size = glm::length(side);
    side = size > 1e-150 ? side / size : glm::dvec2(1.0, 0.0);
    share = 1.0 - normal.z;
  }
  const glm::dvec2 across(axis);
  const glm::dvec2 turned = across - side * (share * glm::dot(side, across)) + glm::dvec2(normal) * axis.z;
  return {turned, normal.z * axis.z - glm::dot(glm::dvec2(normal), across)};
}

double mean_lobe_variance(const Material& material) {
  if (material.lobes.empty()) return lobe_variance(lobe_of(material));
  double weight = 0.0;
  double variance = 0.0;
  for (const FacetLobe& lobe : material.lobes) {
    weight += lobe.weight;
    variance += static_cast<double>(lobe.weight) * lobe_variance({material.brdf.distribution, lobe.parameter});
  }
  return variance / weight;
}

std::vector<glm::vec4> facet_lobe_block(const Material& material) {
  if (material.lobes.size() > most_facet_lobes) {
    throw Error(ErrorKind::usage, fmt::format("material {}", material.name),
                fmt::format("{} lobes are more than the {} there may be", material.lobes.size(), most_facet_lobes),
                "leave out the weakest");
  }
  std::vector<glm::vec4> block(1 + 2 * most_facet_lobes, glm::vec4(0.0F));
  block.front().x = std::bit_cast<float>(static_cast<std::int32_t>(material.lobes.size()));
  for (std::size_t k = 0; k < material.lobes.size(); ++k) {
    const FacetLobe& lobe = material.lobes[k];
    check_lobe(lobe, k, material);
    block[1 + 2 * k] = glm::vec4(lobe.axis, lobe.parameter);
    block[2 + 2 * k] = {lobe.weight, lobe_variance({material.brdf.distribution, lobe.parameter}), 0.0F, 0.0F};
  }
  return block;
}

}  // namespace footprint
