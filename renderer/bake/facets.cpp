// Rotations in closed form, sums over lobes, facets sorted by normal, and their visibility as 24 bits per channel.
#include "renderer/bake/facets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <numeric>

#include "renderer/core/error.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/facet_visibility.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

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

// Twins of the constants in patch_facets.glsl.
constexpr std::size_t facets_per_row = 128;
constexpr int visibility_side = 32;
constexpr std::size_t bits_per_channel = 24, bits_per_texel = 4 * bits_per_channel;
constexpr std::size_t texels_per_facet =
    (static_cast<std::size_t>(visibility_side) * visibility_side + bits_per_texel - 1) / bits_per_texel;

constexpr std::size_t facet_count = 128 * facets_per_row;
constexpr std::uint64_t facet_seed = 1;

// The bits of x and y in turn: points near each other in the order are near each other in the square.
std::uint32_t interleaved(const glm::dvec2& point) {
  constexpr int bits = 12;
  std::uint32_t out = 0;
  for (int axis = 0; axis < 2; ++axis) {
    const auto value = static_cast<std::uint32_t>(std::clamp(point[axis], 0.0, 1.0) * ((1 << bits) - 1));
    for (int bit = 0; bit < bits; ++bit) out |= ((value >> bit) & 1U) << (2 * bit + axis);
  }
  return out;
}

// Facets whose neighbours in the order have about the same normal, so that equal shares of them are equal shares of
// the normals.
FacetSamples ordered_facets(const Patch& patch) {
  const FacetSamples samples = sample_facets(patch, facet_count, facet_seed);
  std::vector<std::uint32_t> keys;
  for (const std::uint32_t t : samples.triangles) {
    keys.push_back(interleaved(hemisphere_to_square(facet_plane(patch, t).normal)));
  }
  std::vector<std::size_t> order(samples.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::ranges::stable_sort(order, {}, [&](std::size_t i) { return keys[i]; });
  FacetSamples out;
  out.facet_area = samples.facet_area;
  for (const std::size_t i : order) {
    out.positions.push_back(samples.positions[i]);
    out.triangles.push_back(samples.triangles[i]);
  }
  return out;
}

Image facet_image(const Patch& patch, const FacetSamples& facets) {
  Image image(facets_per_row, static_cast<int>(facets.size() / facets_per_row), 4);
  for (std::size_t i = 0; i < facets.size(); ++i) {
    const std::uint32_t t = facets.triangles[i];
    const glm::vec4 texel(glm::vec3(facet_plane(patch, t).normal),
                          patch.paints.empty() ? 0.0F : static_cast<float>(patch.paints[t]));
    std::copy_n(&texel.x, 4, image.texels.begin() + static_cast<std::ptrdiff_t>(4 * i));
  }
  return image;
}

Image visibility_image(const FacetVisibility& visibility, std::size_t facets) {
  Image image(static_cast<int>(facets_per_row * texels_per_facet), static_cast<int>(facets / facets_per_row), 4);
  for (std::size_t i = 0; i < facets; ++i) {
    float* const words = image.texels.data() + i * texels_per_facet * 4;
    for (std::size_t d = 0; d < visibility.directions(); ++d) {
      if (visibility.visible(d, i)) words[d / bits_per_channel] += static_cast<float>(1U << (d % bits_per_channel));
    }
  }
  return image;
}

// a_v over the facets' whole area and the cosine of the direction.
Image area_image(const Patch& patch, const FacetSamples& facets, const FacetVisibility& visibility,
                 std::span<const glm::dvec3> directions) {
  Image image(visibility_side, visibility_side, 1);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    double sum = 0.0;
    for (std::size_t i = 0; i < facets.size(); ++i) {
      if (visibility.visible(d, i)) sum += glm::dot(facet_plane(patch, facets.triangles[i]).normal, directions[d]);
    }
    image.texels[d] = static_cast<float>(sum / (static_cast<double>(facets.size()) * directions[d].z));
  }
  return image;
}

// Row 0: factors of the specular term; row 1: of the diffuse.
Image paint_image(std::span<const PaintFactors> paints) {
  Image image(static_cast<int>(paints.size()), 2, 3);
  for (std::size_t i = 0; i < paints.size(); ++i) {
    std::copy_n(&paints[i].specular.x, 3, image.at(static_cast<int>(i), 0).begin());
    std::copy_n(&paints[i].diffuse.x, 3, image.at(static_cast<int>(i), 1).begin());
  }
  return image;
}

// The reflectance of a material at normal incidence for a base colour.
glm::vec3 reflectance(const Material& material, const glm::vec3& base_color) {
  return glm::mix(material.dielectric_specular, base_color, material.metallic);
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

glm::vec4 anisotropy_of(const Material& material) {
  const Alphas alphas = alphas_of(material);
  const double rotation = material.anisotropy.value_or(Anisotropy{}).rotation;
  return glm::dvec4(alphas.along, alphas.across, std::cos(rotation), std::sin(rotation));
}

float squared_strength(const Material& material) {
  const float strength = material.anisotropy.value_or(Anisotropy{}).strength;
  return strength * strength;
}

std::vector<PaintFactors> paint_factors(const Material& material) {
  if (!material.microgeometry) return {{}};
  constexpr glm::vec3 least(1e-6F);  // a channel that is black in the mean is black in every paint
  const glm::vec3 base(material.base_color);
  const glm::vec3 mean = glm::max(material.microgeometry->mean_color, least);
  const glm::vec3 own = glm::max(reflectance(material, base), least);
  std::vector<PaintFactors> factors;
  for (const glm::vec3& paint : material.microgeometry->patch.palette) {
    if (material.microgeometry->brdf) {
      factors.push_back({paint, paint});
      continue;
    }
    factors.push_back({reflectance(material, base * paint / mean) / own, paint / mean});
  }
  return factors;
}

std::vector<PrefilteredTexture> patch_facet_textures(const Material& material, const Progress& progress) {
  Image facets(1, 1, 4), visibility(1, 1, 4), area(1, 1, 1);
  if (material.microgeometry) {
    const Patch& patch = material.microgeometry->patch;
    const FacetSamples samples = ordered_facets(patch);
    const std::vector<glm::dvec3> directions = direction_grid(visibility_side);
    const FacetVisibility seen = facet_visibility(patch, samples, directions, progress);
    facets = facet_image(patch, samples);
    visibility = visibility_image(seen, samples.size());
    area = area_image(patch, samples, seen, directions);
  }
  std::vector<PrefilteredTexture> textures{make_texture("base_facets", {facets}, Storage::fp32, {}),
                                           make_texture("base_visibility", {visibility}, Storage::fp32, {}),
                                           make_texture("base_visible_area", {area}, Storage::fp32, {})};
  textures[2].filter = TextureFilter::linear;
  return textures;
}

PrefilteredTexture paint_texture(const Material& material) {
  return make_texture("base_paints", {paint_image(paint_factors(material))}, Storage::fp32, {});
}

PrefilteredTexture tabulated_brdf_texture(const Material& material) {
  std::vector<std::vector<Image>> layers;
  if (material.microgeometry && material.microgeometry->brdf) {
    const std::vector<glm::vec3>& values = material.microgeometry->brdf->values;
    constexpr int width = TabulatedBrdf::theta_d_cells, height = TabulatedBrdf::theta_h_cells;
    for (std::size_t p = 0; p < TabulatedBrdf::phi_d_cells; ++p) {
      Image image(width, height, 3);
      for (std::size_t i = 0; i < image.texel_count(); ++i) {
        const glm::vec3& value = values[i * TabulatedBrdf::phi_d_cells + p];
        std::copy_n(&value.x, 3, &image.texels[3 * i]);
      }
      layers.push_back({std::move(image)});
    }
  } else {
    layers.push_back({Image(1, 1, 3)});
  }
  return make_array_texture("base_table", std::move(layers), Storage::fp32, {});
}

}  // namespace footprint
