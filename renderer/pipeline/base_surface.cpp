// See base_surface.hpp.
#include "renderer/pipeline/base_surface.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "renderer/bake/patch_facets.hpp"
#include "renderer/microgeometry/microgeometry.hpp"

namespace footprint {

namespace embedded {
extern const EmbeddedTexts shared_glsl;
}

namespace {

// Twins of the constants in common_lobes.glsl.
constexpr float smallest_alpha = 1e-3F;
constexpr float smallest_concentration = 1e-6F;
constexpr float largest_exponent = 2e6F;
constexpr float smallest_variance = 1e-12F;

Image one_channel(const Image& image, int channel) {
  Image out(image.width, image.height, 1);
  const auto stride = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < out.texels.size(); ++i)
    out.texels[i] = image.texels[i * stride + static_cast<std::size_t>(channel)];
  return out;
}

// Slope variance per axis of all lobes together, about the facet's normal: each lobe's own, and what its axis leans by.
float variance_about_normal(const Material& material) {
  float weight = 0.0F;
  float variance = 0.0F;
  for (const FacetLobe& lobe : material.lobes) {
    const float leaning = 0.5F * glm::dot(glm::vec2(lobe.axis), glm::vec2(lobe.axis)) / (lobe.axis.z * lobe.axis.z);
    weight += lobe.weight;
    variance += lobe.weight * (lobe_variance(material.brdf.distribution, lobe.parameter) + leaning);
  }
  return variance / weight;
}

Image normals_or_flat(const std::optional<TextureMap>& map) {
  if (map) return *map->image;
  Image flat(1, 1, 4);
  flat.texels = {0.0F, 0.0F, 1.0F, 1.0F};
  return flat;
}

class BaseSurface final : public Method {
 public:
  [[nodiscard]] const MethodInfo& info() const override { return info_; }

  [[nodiscard]] Prefiltered precompute(const Material& material, const Options& /*options*/, const EffectSet& effects,
                                       const Progress& progress) const override {
    Prefiltered out;
    if (has(effects, Effect::normal_variation)) {
      out.textures.push_back(
          make_texture("base_normal", {normal_map_of(material)}, Storage::fp32, normal_coordinates(material)));
    }
    if (has(effects, Effect::normal_layers)) {
      out.textures.push_back(
          make_texture("base_layer", {layer_map_of(material)}, Storage::fp32, layer_coordinates(material)));
    }
    if (has(effects, Effect::roughness_variation)) {
      out.textures.push_back(
          make_texture("base_roughness", {roughness_map_of(material)}, Storage::fp32, roughness_coordinates(material)));
    }
    if (has(effects, Effect::microgeometry_visibility)) {
      std::ranges::move(patch_facet_textures(material, progress), std::back_inserter(out.textures));
      out.scalars["base_has_patch"] = material.microgeometry ? 1.0F : 0.0F;
    }
    if (has(effects, Effect::microgeometry_colour)) out.textures.push_back(paint_texture(material));
    if (has(effects, Effect::tabulated_brdf)) {
      out.textures.push_back(tabulated_brdf_texture(material));
      out.scalars["base_has_table"] = material.microgeometry && material.microgeometry->brdf ? 1.0F : 0.0F;
    }
    return out;
  }

  [[nodiscard]] ShaderModule shader() const override { return module_of(embedded::shared_glsl, "base_surface.glsl"); }

 private:
  MethodInfo info_{.name = "reference",
                   .summary = "The supersampled truth: many samples a pixel, each shading one texel's own base BRDF.",
                   .paper = "",
                   .options = {},
                   .honours = EffectSet{}.set(),
                   .draws_directions = true};
};

}  // namespace

const Method& base_surface() {
  static const BaseSurface method;
  return method;
}

Image normal_map_of(const Material& material) { return normals_or_flat(material.normal_map); }

Image layer_map_of(const Material& material) { return normals_or_flat(material.layer_map); }

Image roughness_map_of(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  if (const TextureMap* map = width_map(material); map != nullptr) {
    Image roughness = one_channel(*map->image, 0);
    if (material.lobe_parameter_map) {
      std::ranges::transform(roughness.texels, roughness.texels.begin(),
                             [&](float lobe) { return roughness_from_lobe(distribution, lobe); });
    }
    return roughness;
  }
  const bool own_lobe = material.lobe_parameter || !material.lobes.empty();
  return Image(1, 1, 1, own_lobe ? roughness_from_lobe(distribution, lobe_parameter(material)) : material.roughness);
}

Image lobe_parameter_map_of(const Material& material) {
  if (width_map(material) == nullptr) return Image(1, 1, 1, lobe_parameter(material));
  if (material.lobe_parameter_map) return *material.lobe_parameter_map->image;
  Image lobes = roughness_map_of(material);
  std::ranges::transform(lobes.texels, lobes.texels.begin(), [&](float roughness) {
    return lobe_from_alpha(material.brdf.distribution, roughness * roughness);
  });
  return lobes;
}

Image metallic_map_of(const Material& material) {
  if (const TextureMap* map = metallic_map(material); map != nullptr) return one_channel(*map->image, 1);
  return Image(1, 1, 1, material.metallic);
}

Image specular_map_of(const Material& material) {
  return material.specular_map ? *material.specular_map->image : Image(1, 1, 3, 1.0F);
}

TextureCoordinates normal_coordinates(const Material& material) {
  return material.normal_map ? material.normal_map->coordinates : TextureCoordinates{};
}

TextureCoordinates layer_coordinates(const Material& material) {
  return material.layer_map ? material.layer_map->coordinates : TextureCoordinates{};
}

TextureCoordinates roughness_coordinates(const Material& material) {
  if (material.lobe_parameter_map) return material.lobe_parameter_map->coordinates;
  return material.metallic_roughness_map ? material.metallic_roughness_map->coordinates : TextureCoordinates{};
}

TextureCoordinates base_color_coordinates(const Material& material) {
  return material.base_color_map ? material.base_color_map->coordinates : TextureCoordinates{};
}

TextureCoordinates specular_coordinates(const Material& material) {
  return material.specular_map ? material.specular_map->coordinates : TextureCoordinates{};
}

float lobe_parameter(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  if (material.lobe_parameter) return *material.lobe_parameter;
  if (!material.lobes.empty()) return lobe_from_variance(distribution, variance_about_normal(material));
  const TextureMap* const map = width_map(material);
  if (map != nullptr && material.lobe_parameter_map) return map->image->texels.front();
  const float roughness = map != nullptr ? map->image->texels.front() : material.roughness;
  return lobe_from_alpha(distribution, roughness * roughness);
}

float lobe_from_alpha(NormalDistribution distribution, float alpha) {
  const float bounded = std::max(alpha, smallest_alpha);
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return 2.0F / (bounded * bounded) - 2.0F;
    case NormalDistribution::vmf:
      return 2.0F / (bounded * bounded);
    case NormalDistribution::beckmann:
    case NormalDistribution::ggx:
      break;
  }
  return bounded;
}

float lobe_alpha(NormalDistribution distribution, float lobe) {
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return std::sqrt(2.0F / (lobe + 2.0F));
    case NormalDistribution::vmf:
      return std::min(std::sqrt(2.0F / std::max(lobe, smallest_concentration)), 1.0F);
    case NormalDistribution::beckmann:
    case NormalDistribution::ggx:
      break;
  }
  return lobe;
}

float lobe_variance(NormalDistribution distribution, float lobe) {
  switch (distribution) {
    case NormalDistribution::blinn_phong:
    case NormalDistribution::vmf:
      return 1.0F / std::max(lobe, smallest_concentration);
    case NormalDistribution::beckmann:
    case NormalDistribution::ggx:
      break;
  }
  return 0.5F * lobe * lobe;
}

float lobe_from_variance(NormalDistribution distribution, float variance) {
  const float alpha = std::max(std::sqrt(2.0F * variance), smallest_alpha);
  switch (distribution) {
    case NormalDistribution::blinn_phong:
    case NormalDistribution::vmf:
      return std::min(1.0F / std::max(variance, smallest_variance), largest_exponent);
    case NormalDistribution::ggx:
      return std::min(alpha, 1.0F);
    case NormalDistribution::beckmann:
      break;
  }
  return alpha;
}

float roughness_from_lobe(NormalDistribution distribution, float lobe) {
  const double value = std::max(lobe, smallest_concentration);
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return static_cast<float>(std::sqrt(std::sqrt(2.0 / (value + 2.0))));
    case NormalDistribution::vmf:
      return static_cast<float>(std::sqrt(std::sqrt(2.0 / value)));
    case NormalDistribution::beckmann:
    case NormalDistribution::ggx:
      break;
  }
  return static_cast<float>(std::sqrt(value));
}

}  // namespace footprint
