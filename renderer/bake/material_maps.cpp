// A material without a map has a constant one, 1 x 1, so that bakes need not distinguish the two.
#include "renderer/bake/material_maps.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/type_ptr.hpp>

#include "renderer/image/mipmap.hpp"

namespace footprint {
namespace {

Image one_channel(const Image& image, std::size_t channel) {
  return mapped(image, 1, [=](const auto& in, const auto& out) { out[0] = in[channel]; });
}

Image normals_or_flat(const std::optional<TextureMap>& map) {
  if (map) return map->image.decoded();
  Image flat(1, 1, 4);
  flat.texels = {0.0F, 0.0F, 1.0F, 1.0F};
  return flat;
}

TextureCoordinates coordinates_of(const std::optional<TextureMap>& map) {
  return map ? map->coordinates : TextureCoordinates{};
}

// The material's coat; one of weight 0 if it has none.
const ClearCoat& coat_of(const Material& material) {
  static const ClearCoat none{.weight = 0.0F};
  return material.coat ? *material.coat : none;
}

Image one_channel_of(const std::optional<TextureMap>& map, float constant) {
  return map ? map->image.decoded() : Image(1, 1, 1, constant);
}

// The roughness of each texel of width_map, before it is stretched.
Image own_roughness(const Material& material) {
  Image roughness = one_channel(width_map(material)->image.decoded(), 0);
  if (!material.lobe_parameter_map) return roughness;
  std::ranges::transform(roughness.texels, roughness.texels.begin(), [&](float parameter) {
    return lobe_roughness({material.brdf.distribution, parameter});
  });
  return roughness;
}

double own_alpha(const Material& material, float roughness) {
  return lobe_from_alpha(material.brdf.distribution, roughness * roughness).parameter;
}

// The anisotropy of each texel of width_map.
class Stretching {
 public:
  explicit Stretching(const Material& material) : constant_(material.anisotropy.value_or(Anisotropy{})) {
    if (material.anisotropy_map) axes_ = material.anisotropy_map->image.decoded();
  }

  [[nodiscard]] Anisotropy at(std::size_t texel) const {
    if (axes_.texels.empty()) return constant_;
    const glm::vec2 axis = glm::make_vec2(&axes_.texels[2 * texel]);
    return {std::sqrt(std::min(glm::length(axis), 1.0F)), static_cast<float>(rotation_of_stretch(axis))};
  }

 private:
  Anisotropy constant_;
  Image axes_;
};

}  // namespace

Image normal_map_of(const Material& material) { return normals_or_flat(material.normal_map); }

Image layer_map_of(const Material& material) { return normals_or_flat(material.layer_map); }

Image roughness_map_of(const Material& material) {
  const NormalDistribution distribution = material.brdf.distribution;
  if (width_map(material) != nullptr) {
    Image roughness = own_roughness(material);
    if (!material.anisotropy) return roughness;
    const Stretching anisotropy(material);
    for (std::size_t i = 0; i < roughness.texel_count(); ++i) {
      const Alphas alphas = anisotropic_alphas(anisotropy.at(i).strength, own_alpha(material, roughness.texels[i]));
      roughness.texels[i] = lobe_roughness({distribution, round_alpha(alphas)});
    }
    return roughness;
  }
  const bool own_lobe = material.lobe_parameter || !material.lobes.empty() || material.anisotropy;
  return Image(1, 1, 1, own_lobe ? lobe_roughness(lobe_of(material)) : material.roughness);
}

Image stretch_map_of(const Material& material) {
  if (!material.anisotropy) return Image(1, 1, 2, 0.0F);
  const Stretching anisotropy(material);
  const bool constant = width_map(material) == nullptr;
  const Image across = constant ? Image(1, 1, 1) : own_roughness(material);
  Image out(across.width, across.height, 2);
  for (std::size_t i = 0; i < out.texel_count(); ++i) {
    const auto [strength, rotation] = anisotropy.at(i);
    const double alpha = constant ? alphas_of(material).across : own_alpha(material, across.texels[i]);
    const glm::vec2 stretch(stretch_of(anisotropic_alphas(strength, alpha), rotation));
    std::copy_n(&stretch.x, 2, &out.texels[2 * i]);
  }
  return out;
}

Image lobe_parameter_map_of(const Material& material) {
  if (width_map(material) == nullptr) return Image(1, 1, 1, static_cast<float>(lobe_of(material).parameter));
  if (material.lobe_parameter_map && !material.anisotropy) return material.lobe_parameter_map->image.decoded();
  Image lobes = roughness_map_of(material);
  std::ranges::transform(lobes.texels, lobes.texels.begin(), [&](float roughness) {
    return static_cast<float>(lobe_from_alpha(material.brdf.distribution, roughness * roughness).parameter);
  });
  return lobes;
}

Image base_color_map_of(const Material& material) {
  return material.base_color_map ? material.base_color_map->image.decoded() : Image(1, 1, 4, 1.0F);
}

Image material_share_of(const Material& material) {
  return material.share ? material.share->map.image.decoded() : Image(1, 1, 1, 1.0F);
}

Image metallic_map_of(const Material& material) {
  if (const TextureMap* map = metallic_map(material); map != nullptr) return one_channel(map->image.decoded(), 1);
  return Image(1, 1, 1, material.metallic);
}

Image specular_map_of(const Material& material) {
  return material.specular_map ? material.specular_map->image.decoded() : Image(1, 1, 3, 1.0F);
}

Image emission_map_of(const Material& material) {
  return material.emission_map ? material.emission_map->image.decoded() : Image(1, 1, 3, 1.0F);
}

Image occlusion_map_of(const Material& material) { return one_channel_of(material.occlusion_map, 1.0F); }

Image coat_weight_map_of(const Material& material) {
  return one_channel_of(coat_of(material).weight_map, coat_of(material).weight);
}

Image coat_width_map_of(const Material& material) {
  Image widths = one_channel_of(coat_of(material).roughness_map, coat_of(material).roughness);
  std::ranges::transform(widths.texels, widths.texels.begin(), [](float roughness) {
    const float alpha = std::max(roughness * roughness, smallest_coat_alpha);
    return alpha * alpha;
  });
  return widths;
}

Image coat_normal_map_of(const Material& material) {
  return mapped(normals_or_flat(coat_of(material).normal_map), 3, [](const auto& in, const auto& out) {
    const bool valid = in[3] > 0.5F;
    for (std::size_t c = 0; c < 3; ++c) out[c] = valid ? in[c] : (c == 2 ? 1.0F : 0.0F);
  });
}

Lobe mean_lobe(const Material& material) {
  if (width_map(material) == nullptr) return lobe_of(material);
  const float roughness = mip_chain(roughness_map_of(material)).back().texels.front();
  return lobe_from_alpha(material.brdf.distribution, roughness * roughness);
}

bool roughness_lies_on_normals(const Material& material) {
  const auto size = [](const TextureMap* map) {
    return map == nullptr ? glm::ivec2(1) : glm::ivec2(map->image.width(), map->image.height());
  };
  const glm::ivec2 roughness = size(width_map(material));
  const glm::ivec2 normals = size(material.normal_map ? &*material.normal_map : nullptr);
  return roughness_coordinates(material) == normal_coordinates(material) && roughness.x <= normals.x &&
         roughness.y <= normals.y;
}

float wrap_number(Wrap wrap) {
  if (wrap == Wrap::repeat) return 0.0F;
  return wrap == Wrap::mirrored_repeat ? 1.0F : 2.0F;
}

TextureCoordinates normal_coordinates(const Material& m) { return coordinates_of(m.normal_map); }
TextureCoordinates layer_coordinates(const Material& m) { return coordinates_of(m.layer_map); }
TextureCoordinates roughness_coordinates(const Material& m) {
  return coordinates_of(m.lobe_parameter_map ? m.lobe_parameter_map : m.metallic_roughness_map);
}
TextureCoordinates base_color_coordinates(const Material& m) { return coordinates_of(m.base_color_map); }
TextureCoordinates specular_coordinates(const Material& m) { return coordinates_of(m.specular_map); }
TextureCoordinates emission_coordinates(const Material& m) { return coordinates_of(m.emission_map); }
TextureCoordinates occlusion_coordinates(const Material& m) { return coordinates_of(m.occlusion_map); }
TextureCoordinates coat_weight_coordinates(const Material& m) { return coordinates_of(coat_of(m).weight_map); }
TextureCoordinates coat_width_coordinates(const Material& m) { return coordinates_of(coat_of(m).roughness_map); }
TextureCoordinates coat_normal_coordinates(const Material& m) { return coordinates_of(coat_of(m).normal_map); }
TextureCoordinates share_coordinates(const Material& m) {
  return m.share ? m.share->map.coordinates : TextureCoordinates{};
}

std::span<const SharedMap> shared_maps() {
  static constexpr std::array<SharedMap, 10> maps{
      {{Effect::base_color_variation, "base_color_map", base_color_map_of, base_color_coordinates},
       {Effect::metallic_variation, "metallic_map", metallic_map_of, roughness_coordinates},
       {Effect::anisotropy_variation, "stretch_map", stretch_map_of, roughness_coordinates},
       {Effect::specular_variation, "specular_map", specular_map_of, specular_coordinates},
       {Effect::coat_weight_variation, "coat_weight_map", coat_weight_map_of, coat_weight_coordinates},
       {Effect::coat_width_variation, "coat_width_map", coat_width_map_of, coat_width_coordinates},
       {Effect::coat_normal_variation, "coat_normal_map", coat_normal_map_of, coat_normal_coordinates},
       {Effect::material_index, "material_share", material_share_of, share_coordinates},
       {Effect::emission_variation, "emission_map", emission_map_of, emission_coordinates},
       {Effect::occlusion, "occlusion_map", occlusion_map_of, occlusion_coordinates}}};
  return maps;
}

Image specular_weights(const Image& colours) {
  Image weights = mapped(colours, 1, [](const auto& in, const auto& out) { out[0] = luminance(in[0], in[1], in[2]); });
  const float largest = std::max(*std::ranges::max_element(weights.texels), 1e-6F);
  for (float& weight : weights.texels) weight /= largest;
  return weights;
}

std::optional<Image> specular_over(const Material& material, const glm::ivec2& size,
                                   const TextureCoordinates& coordinates) {
  const Image own = specular_map_of(material);
  const bool elsewhere = material.specular_map && specular_coordinates(material) != coordinates;
  if (elsewhere || own.width > size.x || own.height > size.y) return {};
  return nearest_texels(own, size.x, size.y);
}

}  // namespace footprint
