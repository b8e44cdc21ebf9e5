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

/// What the channels of a stored normal map are.
enum class NormalChannels {
  xyz,  ///< of a file of two channels none the less x and y
  xy,   ///< as BC5 has it: z is what makes the normal a unit vector, and what the file has beyond y does not count
};

struct Microgeometry;

enum class GeometryTerm { none, tan, smith };
enum class FresnelTerm { none, schlick };

/// The base BRDF of one facet, the same for every method and for the reference (docs/base-brdf.md). All forms give
/// f * cos: none: F D; tan: F D / (n.v); smith: F D G2 / (4 n.v) with G2 height-correlated.
struct BaseBrdf {
  NormalDistribution distribution = NormalDistribution::ggx;
  GeometryTerm geometry = GeometryTerm::smith;
  FresnelTerm fresnel = FresnelTerm::schlick;
  bool diffuse = true;  ///< a Lambert term albedo / pi, times (1 - F) where fresnel is not none

  friend bool operator==(const BaseBrdf&, const BaseBrdf&) = default;
};

enum class Wrap { repeat, mirrored_repeat, clamp_to_edge };

/// Where on a map a surface point looks: texture coordinates = transform * (u, v, 1) of the mesh's set.
struct TextureCoordinates {
  int set = 0;                                                ///< TEXCOORD_0 or TEXCOORD_1
  glm::mat3x2 transform{1.0F, 0.0F, 0.0F, 1.0F, 0.0F, 0.0F};  ///< columns: d/du, d/dv, offset (KHR_texture_transform)
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};       ///< along u and v

  friend bool operator==(const TextureCoordinates&, const TextureCoordinates&) = default;
};

/// A map and where it is looked up. The texels are shared by the materials that use it and never changed.
struct TextureMap {
  std::string name;  ///< file or image name, for messages
  MapTexels image;
  TextureCoordinates coordinates;
};

/// One of several lobes that a facet reflects with. Its axis turns with the facet's normal (facets.hpp).
struct FacetLobe {
  glm::vec3 axis{0.0F, 0.0F, 1.0F};  ///< unit, z > 0: x along the tangent, y along the bitangent, z along the normal
  float parameter = 1.0F;            ///< exponent (blinn_phong), alpha (beckmann, ggx), kappa (vmf)
  float weight = 1.0F;               ///< above 0: D is the sum of weight times the lobe's density

  friend bool operator==(const FacetLobe&, const FacetLobe&) = default;
};

/// The most lobes of a facet.
inline constexpr std::size_t most_facet_lobes = 8;

/// A clear layer over a material: facets of their own, always GGX ones (KHR_materials_clearcoat; docs/base-brdf.md).
/// Without a map the factor alone counts; a map holds what is left of the factor already.
struct ClearCoat {
  float weight = 1.0F;                      ///< 0..1: the share of the surface that is coated
  float roughness = 0.0F;                   ///< perceptual, 0..1; alpha = roughness^2
  std::optional<TextureMap> weight_map;     ///< 1 channel, 0..1, already times the factor
  std::optional<TextureMap> roughness_map;  ///< 1 channel, 0..1, likewise
  std::optional<TextureMap> normal_map;     ///< as Material::normal_map; none: the mesh's own normals
};

/// Where a material is on a surface that has several, chosen by a map of indices.
struct SurfaceShare {
  TextureMap map;     ///< 1 channel: 1 where the map of indices names this material, 0 elsewhere; they sum to 1
  bool first = true;  ///< the materials of a surface follow one another, each with a copy of its triangles
};

/// A surface's material. Without a map the factor alone counts; with one, factor * map as in glTF 2.0.
struct Material {
  std::string name;
  BaseBrdf brdf;

  glm::vec4 base_color{1.0F};            ///< linear RGB, alpha
  glm::vec3 dielectric_specular{0.04F};  ///< F0 where metallic = 0 (ks of a material that is not glTF's)
  float metallic = 1.0F;                 ///< 0..1
  float roughness = 1.0F;                ///< perceptual, 0..1; alpha = roughness^2 (glTF 2.0, appendix B)
  std::optional<float>
      lobe_parameter;            ///< overrides roughness: exponent (blinn_phong), alpha (beckmann, ggx), kappa (vmf)
  std::vector<FacetLobe> lobes;  ///< instead of the one lobe about the normal; empty: that lobe. Overrides all width

  std::optional<TextureMap> base_color_map;  ///< RGBA, linear
  std::optional<TextureMap>
      metallic_roughness_map;  ///< 2 channels: roughness, metallic (0..1), already times the factors
  std::optional<TextureMap>
      lobe_parameter_map;  ///< 1 channel, as lobe_parameter: instead of metallic_roughness_map, `metallic` stays
  std::optional<TextureMap> specular_map;  ///< RGB, linear: times dielectric_specular
  std::optional<TextureMap> normal_map;    ///< 4 channels: unit normal xyz (z > 0 out of the surface), weight 0 or 1
  std::optional<TextureMap> layer_map;     ///< detail over the normal map, of the same kind: their slopes add

  std::optional<ClearCoat> coat;  ///< over all that the rest says; none: bare

  std::optional<SurfaceShare> share;  ///< none: all of its surface

  std::optional<float> alpha_cutoff;  ///< MASK: a point with alpha below it is not there
  bool double_sided = false;

  /// The small-scale geometry that the normal map is a view of from above; null where there is none. Shared, never
  /// changed.
  std::shared_ptr<const Microgeometry> microgeometry;
};

/// The maps that a material has, its coat's among them and but for its share's: what is done to all of them goes
/// through here.
[[nodiscard]] std::vector<TextureMap*> maps_of(Material& material);
[[nodiscard]] std::vector<const TextureMap*> maps_of(const Material& material);

/// The map that a material's lobe widens and narrows by: of lobe parameters, or of roughness in its first channel. Null
/// where the width is constant.
[[nodiscard]] inline const TextureMap* width_map(const Material& material) {
  if (material.lobe_parameter || !material.lobes.empty()) return nullptr;
  if (material.lobe_parameter_map) return &*material.lobe_parameter_map;
  return material.metallic_roughness_map ? &*material.metallic_roughness_map : nullptr;
}

/// The lobe of a material whose roughness does not vary. Of one whose lobes have axes of their own that of one lobe
/// about the normal, with the slope variance that they have about it: what a method takes that leaves `multi_lobe` out.
[[nodiscard]] Lobe lobe_of(const Material& material);

/// The map that a material's metalness varies by, in its second channel. Null where it is constant.
[[nodiscard]] inline const TextureMap* metallic_map(const Material& material) {
  return material.metallic_roughness_map && !material.lobe_parameter_map ? &*material.metallic_roughness_map : nullptr;
}

}  // namespace footprint
