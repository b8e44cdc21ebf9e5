// A surface's material as a plain value.
#pragma once

#include <array>
#include <glm/glm.hpp>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/lobes/lobe.hpp"
#include "renderer/scene/map_texels.hpp"

namespace footprint {

/// The channels of a stored normal map.
enum class NormalChannels {
  xyz,  ///< x and y if the file has two channels
  xy,   ///< as in BC5: z follows from unit length, and further channels of the file are ignored
};

struct Microgeometry;

enum class GeometryTerm { none, tan, smith, ward };
enum class FresnelTerm { none, schlick };

/// The base BRDF of one facet, shared by all methods and the reference (docs/explanation/base-brdf.md). f * cos is F D
/// (none), F D / (n.v) (tan), F D G2 / (4 n.v) with height-correlated G2 (smith) or F D (n.l) / (4 (v.h)^2) (ward).
struct BaseBrdf {
  NormalDistribution distribution = NormalDistribution::ggx;
  GeometryTerm geometry = GeometryTerm::smith;
  FresnelTerm fresnel = FresnelTerm::schlick;
  bool diffuse = true;  ///< a Lambert term albedo / pi, times (1 - F) with Fresnel

  friend bool operator==(const BaseBrdf&, const BaseBrdf&) = default;
};

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };

/// The coordinates of a map: transform * (u, v, 1) of the mesh's set.
struct TextureCoordinates {
  int set = 0;                                                ///< 0 or 1, of a vertex
  glm::mat3x2 transform{1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F};  ///< columns: d/du, d/dv, offset (KHR_texture_transform)
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};       ///< along u and v
  std::optional<int> texcoord{};                              ///< TEXCOORD_n of the model's file; none: `set`

  friend bool operator==(const TextureCoordinates&, const TextureCoordinates&) = default;
};

/// A map with its coordinates. Materials share its texels, which never change.
struct TextureMap {
  std::string name;  ///< file or image name, for messages
  MapTexels image;
  TextureCoordinates coordinates;
};

/// One of several lobes of a facet. Its axis turns with the facet's normal (facets.hpp).
struct FacetLobe {
  glm::vec3 axis{0.0F, 0.0F, 1.0F};  ///< unit, z > 0: x along the tangent, y along the bitangent, z along the normal
  float parameter = 1.0F;            ///< exponent (blinn_phong), alpha (beckmann, ggx), kappa (vmf)
  float weight = 1.0F;               ///< above 0; D is the sum of weighted densities

  friend bool operator==(const FacetLobe&, const FacetLobe&) = default;
};

/// The most lobes of a facet.
inline constexpr std::size_t most_facet_lobes = 8;

/// A clear layer over a material, with its own GGX facets (KHR_materials_clearcoat; docs/explanation/base-brdf.md).
/// Maps already include the factors.
struct ClearCoat {
  float weight = 1.0F;                        ///< 0..1, the coated share of the surface
  float roughness = 0.0F;                     ///< perceptual, 0..1; alpha = roughness^2
  std::optional<TextureMap> weight_map{};     ///< 1 channel, 0..1
  std::optional<TextureMap> roughness_map{};  ///< 1 channel, 0..1
  std::optional<TextureMap> normal_map{};     ///< as Material::normal_map; none: the mesh's own normals
};

/// The share of a material on a surface of several, chosen by a map of indices.
struct SurfaceShare {
  TextureMap map;     ///< 1 channel: 1 where the map of indices names this material, else 0; shares sum to 1
  bool first = true;  ///< a surface's materials are consecutive, each with a copy of its triangles
};

/// A surface's material. Maps multiply their factors, as in glTF 2.0.
struct Material {
  std::string name;
  BaseBrdf brdf;

  glm::vec4 base_color{1.0F};            ///< linear RGB, alpha
  glm::vec3 dielectric_specular{0.04F};  ///< F0 for metallic = 0 (ks of materials other than glTF's)
  float metallic = 1.0F;                 ///< 0..1
  float roughness = 1.0F;                ///< perceptual, 0..1; alpha = roughness^2 (glTF 2.0, appendix B)
  /// Overrides roughness: exponent (blinn_phong), alpha (beckmann, ggx) or kappa (vmf).
  std::optional<float> lobe_parameter;
  /// Replaces the lobe about the normal, and all widths; empty: one lobe about the normal.
  std::vector<FacetLobe> lobes;
  /// Stretches the lobe about the normal (beckmann, ggx), whose widths then are those across the direction; excludes
  /// `lobes` and `microgeometry`. The mean of anisotropy_map, if there is one.
  std::optional<Anisotropy> anisotropy;

  std::optional<TextureMap> base_color_map;  ///< RGBA, linear
  /// 2 channels: roughness and metallic (0..1), already times the factors.
  std::optional<TextureMap> metallic_roughness_map;
  /// 1 channel, as lobe_parameter. Replaces metallic_roughness_map; `metallic` stays.
  std::optional<TextureMap> lobe_parameter_map;
  /// 2 channels: s^2 (cos 2 phi, sin 2 phi) for a texel's strength s and rotation phi (Anisotropy). Has the size and
  /// the coordinates of width_map, which is there.
  std::optional<TextureMap> anisotropy_map;
  std::optional<TextureMap> specular_map;  ///< RGB, linear; multiplies dielectric_specular
  glm::vec3 emission{0.0F};                ///< radiance that the surface adds, linear RGB, 0 and above
  std::optional<TextureMap> emission_map;  ///< RGB, linear; multiplies emission
  /// 1 channel, 0..1: multiplies the light of the environment.
  std::optional<TextureMap> occlusion_map;
  std::optional<TextureMap> normal_map;  ///< 4 channels: unit normal xyz (z > 0 out of the surface), weight 0 or 1
  std::optional<TextureMap> layer_map;   ///< detail over the normal map, in the same form; slopes add

  std::optional<ClearCoat> coat;  ///< a layer over everything else

  std::optional<SurfaceShare> share;  ///< none: the whole surface

  std::optional<float> alpha_cutoff;  ///< MASK: points with alpha below it are cut out
  bool double_sided = false;
  bool unlit = false;  ///< radiates its colour in all directions, whatever the light (KHR_materials_unlit)

  /// Small-scale geometry, of which the normal map is the view from above; null: none. Shared and constant.
  std::shared_ptr<const Microgeometry> microgeometry;
};

/// All maps of a material and its coat, except its share's.
[[nodiscard]] std::vector<TextureMap*> maps_of(Material& material);
[[nodiscard]] std::vector<const TextureMap*> maps_of(const Material& material);

/// The map of the lobe's width: lobe parameters, or roughness in its first channel. Null if the width is constant.
[[nodiscard]] inline const TextureMap* width_map(const Material& material) {
  if (material.lobe_parameter || !material.lobes.empty()) return nullptr;
  if (material.lobe_parameter_map) return &*material.lobe_parameter_map;
  return material.metallic_roughness_map ? &*material.metallic_roughness_map : nullptr;
}

/// The round lobe of a material with constant roughness. For a material with several lobes: one about the normal with
/// their slope variance about it, for methods without `multi_lobe`. For an anisotropic lobe: the one with its mean
/// slope variance over directions, for methods without `anisotropic_lobe`.
[[nodiscard]] Lobe lobe_of(const Material& material);

/// The alphas of an anisotropic lobe. Both are `alpha` if the material has none.
/// alpha: the material's own, across the direction of anisotropy.
[[nodiscard]] Alphas alphas_of(const Material& material, double alpha);

/// The alphas of a material with constant roughness.
[[nodiscard]] Alphas alphas_of(const Material& material);

/// The map of metalness, in its second channel. Null if it is constant.
[[nodiscard]] inline const TextureMap* metallic_map(const Material& material) {
  return material.metallic_roughness_map && !material.lobe_parameter_map ? &*material.metallic_roughness_map : nullptr;
}

}  // namespace footprint
