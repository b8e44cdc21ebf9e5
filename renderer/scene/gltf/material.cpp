// Converts each material and image once, on first use, and warns about unsupported features.
#include "renderer/scene/gltf/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <set>
#include <span>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "renderer/scene/gltf/check.hpp"
#include "renderer/scene/model.hpp"

namespace footprint {
namespace {

float checked(double value, double low, double high, const std::string& name) {
  if (!(value >= low && value <= high)) refuse_gltf(name, fmt::format("{} is not within {} to {}", value, low, high));
  return static_cast<float>(value);
}

double number(const tinygltf::Value& object, const char* key, double otherwise) {
  return object.Has(key) ? object.Get(key).GetNumberAsDouble() : otherwise;
}

glm::dvec2 pair(const tinygltf::Value& object, const char* key, const glm::dvec2& otherwise) {
  if (!object.Has(key)) return otherwise;
  const auto& values = object.Get(key);
  return {values.Get(0).GetNumberAsDouble(), values.Get(1).GetNumberAsDouble()};
}

/// KHR_texture_transform: offset * rotation * scale. Its rotation turns counter-clockwise as seen with v downwards, as
/// its example (the lower left quadrant) and the viewers have it; the matrix printed in its text turns the other way.
void apply_transform(const tinygltf::Value& extension, TextureCoordinates& coordinates) {
  constexpr double largest = 1e6;
  const glm::dvec2 offset = pair(extension, "offset", {0.0, 0.0}), scale = pair(extension, "scale", {1.0, 1.0});
  const double rotation = number(extension, "rotation", 0.0);
  for (const double value : {offset.x, offset.y, scale.x, scale.y, rotation}) {
    (void)checked(value, -largest, largest, "KHR_texture_transform");
  }
  const double c = std::cos(rotation), s = std::sin(rotation);
  coordinates.transform =
      glm::mat3x2{glm::vec2{glm::dvec2{c, -s} * scale.x}, glm::vec2{glm::dvec2{s, c} * scale.y}, glm::vec2{offset}};
  coordinates.set = static_cast<int>(number(extension, "texCoord", coordinates.set));
}

Wrap wrap_mode(int mode, const std::string& place) {
  switch (mode) {
    case TINYGLTF_TEXTURE_WRAP_REPEAT:
      return Wrap::repeat;
    case TINYGLTF_TEXTURE_WRAP_MIRRORED_REPEAT:
      return Wrap::mirrored_repeat;
    case TINYGLTF_TEXTURE_WRAP_CLAMP_TO_EDGE:
      return Wrap::clamp_to_edge;
    default:
      refuse_gltf(place, fmt::format("{} is not a wrap mode of glTF 2.0", mode));
  }
}

std::string image_name(const tinygltf::Image& image, int index) {
  if (!image.uri.empty()) return image.uri;
  return image.name.empty() ? fmt::format("images[{}]", index) : image.name;
}

enum class MapUse { color, rough, normal, specular, coat_weight, coat_roughness };

// A texture reference in an extension. check_gltf_json has checked its members.
struct TextureReference {
  int index = -1, set = 0;
  double scale = 1.0;  // of a normal map
  tinygltf::ExtensionMap extensions;
};

TextureReference texture_in(const tinygltf::Value& extension, const char* key) {
  if (!extension.Has(key)) return {};
  const tinygltf::Value& texture = extension.Get(key);
  TextureReference out{.index = texture.Get("index").GetNumberAsInt(),
                       .set = static_cast<int>(number(texture, "texCoord", 0.0)),
                       .scale = number(texture, "scale", 1.0),
                       .extensions = {}};
  if (!texture.Has("extensions")) return out;
  const tinygltf::Value& extensions = texture.Get("extensions");
  for (const std::string& name : extensions.Keys()) out.extensions.emplace(name, extensions.Get(name));
  return out;
}

constexpr const char* clear_coat = "KHR_materials_clearcoat";
constexpr const char* anisotropic = "KHR_materials_anisotropy";
constexpr const char* specular_glossiness = "KHR_materials_pbrSpecularGlossiness";
constexpr const char* without_light = "KHR_materials_unlit";

const tinygltf::Value* extension_of(const tinygltf::Material& material, const char* name) {
  const auto found = material.extensions.find(name);
  return found == material.extensions.end() ? nullptr : &found->second;
}

// A colour of `count` channels, each 0 to 1; 1 if it is missing.
glm::vec4 color_in(const tinygltf::Value& extension, const char* key, int count) {
  glm::vec4 color{1.0F};
  if (!extension.Has(key)) return color;
  for (int c = 0; c < count; ++c) color[c] = checked(extension.Get(key).Get(c).GetNumberAsDouble(), 0.0, 1.0, key);
  return color;
}

float largest_channel(const glm::vec3& color) { return std::max({color.r, color.g, color.b}); }

// Roughness is 1 - glossiness, and metalness 0.
Image decode_glossiness(const Image& stored, float glossiness_factor) {
  const Image rgba = to_rgba(stored);
  Image map(stored.width, stored.height, 2, 0.0F);
  for (std::size_t i = 0; i < map.texel_count(); ++i)
    map.texels[2 * i] = 1.0F - glossiness_factor * rgba.texels[4 * i + 3];
  return map;
}

struct StretchTexture {
  Anisotropy mean;
  bool varies;  // by more than two codes of 8 bits
};

// Of KHR_materials_anisotropy: red and green are a direction, blue a strength s. Directions are axes, so that t and -t
// are equal. A lobe is wider along its axis by (1 - alpha) s^2, and the mean is that of s^2 (cos 2 phi, sin 2 phi).
StretchTexture read_stretch(const Image& texture) {
  const Image rgb = to_rgb(texture);
  glm::dvec2 sum(0.0);
  glm::vec3 least(1.0F), most(0.0F);
  for (std::size_t i = 0; i < rgb.texel_count(); ++i) {
    const glm::vec3 texel = glm::make_vec3(&rgb.texels[3 * i]);
    const glm::dvec2 t = 2.0 * glm::dvec2(texel) - 1.0;
    const double strength = texel.b, length = std::max(glm::dot(t, t), 1e-12);
    sum += strength * strength / length * glm::dvec2(t.x * t.x - t.y * t.y, 2.0 * t.x * t.y);
    least = glm::min(least, texel);
    most = glm::max(most, texel);
  }
  const double stretch = glm::length(sum) / static_cast<double>(rgb.texel_count());
  return {.mean = {.strength = static_cast<float>(std::sqrt(stretch)),
                   .rotation = static_cast<float>(0.5 * std::atan2(sum.y, sum.x))},
          .varies = largest_channel(most - least) > 2.5F / 255.0F};
}

// 1 - max specular over a whole texture.
float mean_rest(const Image& specular, const glm::vec3& factor) {
  double sum = 0.0;
  for (std::size_t i = 0; i < specular.texel_count(); ++i)
    sum += 1.0 - largest_channel(factor * glm::make_vec3(&specular.texels[3 * i]));
  return static_cast<float>(sum / static_cast<double>(specular.texel_count()));
}

}  // namespace

std::uint64_t decoded_map_bytes(const GltfDocument& document) {
  constexpr std::uint64_t float_bytes = 4;
  std::set<std::pair<int, MapUse>> counted;  // images and their uses
  std::uint64_t bytes = 0;
  const auto count = [&](int texture, MapUse use, std::uint64_t channels) {
    const int source = texture < 0 ? -1 : document.model.textures[static_cast<std::size_t>(texture)].source;
    if (source < 0 || !counted.emplace(source, use).second) return;
    const auto& image = document.model.images[static_cast<std::size_t>(source)];
    const std::uint64_t texels = image.image.empty() ? texels_in_header(document.file.parent_path() / image.uri)
                                                     : texels_in_header(std::span<const std::uint8_t>{image.image});
    bytes += texels * channels * float_bytes;
  };
  for (const auto& material : document.model.materials) {
    count(material.pbrMetallicRoughness.baseColorTexture.index, MapUse::color, 4);
    count(material.pbrMetallicRoughness.metallicRoughnessTexture.index, MapUse::rough, 2);
    count(material.normalTexture.index, MapUse::normal, 4);
    if (const tinygltf::Value* glossy = extension_of(material, specular_glossiness)) {
      const int specular = texture_in(*glossy, "specularGlossinessTexture").index;
      count(texture_in(*glossy, "diffuseTexture").index, MapUse::color, 4);
      count(specular, MapUse::color, 4);
      count(specular, MapUse::rough, 2);
      count(specular, MapUse::specular, 3);
    }
    if (const tinygltf::Value* coat = extension_of(material, clear_coat)) {
      count(texture_in(*coat, "clearcoatTexture").index, MapUse::coat_weight, 1);
      count(texture_in(*coat, "clearcoatRoughnessTexture").index, MapUse::coat_roughness, 1);
      count(texture_in(*coat, "clearcoatNormalTexture").index, MapUse::normal, 4);
    }
  }
  return bytes;
}

int GltfMaterials::use(int gltf_index) {
  if (const auto known = indices_.find(gltf_index); known != indices_.end()) return known->second;
  materials_.push_back(convert(gltf_index));
  const int index = static_cast<int>(materials_.size()) - 1;
  indices_.emplace(gltf_index, index);
  return index;
}

Material GltfMaterials::convert(int gltf_index) {
  if (gltf_index < 0) {
    Material material;
    material.name = "default";
    return material;
  }
  try {
    return convert_named(gltf_index);
  } catch (const Error& error) {
    const auto& name = document_.model.materials[static_cast<std::size_t>(gltf_index)].name;
    throw error.within(fmt::format("materials[{}] `{:.80}`", gltf_index, name));
  }
}

Material GltfMaterials::convert_named(int gltf_index) {
  const auto& source = document_.model.materials[static_cast<std::size_t>(gltf_index)];
  Material material;
  material.name = source.name.empty() ? fmt::format("material {}", gltf_index) : source.name;
  material.double_sided = source.doubleSided;
  convert_alpha(source, material);
  material.unlit = extension_of(source, without_light) != nullptr;
  const tinygltf::Value* const glossy = extension_of(source, specular_glossiness);
  if (glossy != nullptr && !material.unlit) {
    convert_specular_glossiness(*glossy, material);
  } else {
    convert_metallic_roughness(source, material);
  }
  if (material.unlit) return material;
  convert_normals(source, material);
  convert_coat(source, material);
  convert_anisotropy(source, material);
  warn_left_out(source);
  return material;
}

int GltfMaterials::image_of(int texture) const {
  return document_.model.textures[static_cast<std::size_t>(texture)].source;
}

void GltfMaterials::convert_metallic_roughness(const tinygltf::Material& source, Material& material) {
  const auto& pbr = source.pbrMetallicRoughness;
  for (int c = 0; c < 4; ++c) {
    material.base_color[c] = checked(pbr.baseColorFactor[static_cast<std::size_t>(c)], 0.0, 1.0, "baseColorFactor");
  }
  const auto& color = pbr.baseColorTexture;
  if ((material.base_color_map = find_map(color.index, color.texCoord, color.extensions)))
    material.base_color_map->image = base_color(image_of(color.index));
  if (material.unlit) return;  // the rest is about light
  material.metallic = checked(pbr.metallicFactor, 0.0, 1.0, "metallicFactor");
  material.roughness = checked(pbr.roughnessFactor, 0.0, 1.0, "roughnessFactor");
  if (const auto* const extension = extension_of(source, "KHR_materials_ior")) {
    // KHR_materials_ior: 0 means infinite; other values are at least 1.
    const double index = number(*extension, "ior", 1.5);
    const double ratio = index == 0.0 ? 1.0 : (checked(index, 1.0, 1e6, "ior") - 1.0) / (index + 1.0);
    material.dielectric_specular = glm::vec3{static_cast<float>(ratio * ratio)};
  }
  const auto& rough = pbr.metallicRoughnessTexture;
  if ((material.metallic_roughness_map = find_map(rough.index, rough.texCoord, rough.extensions)))
    material.metallic_roughness_map->image = metallic_roughness(image_of(rough.index), material);
}

// KHR_materials_pbrSpecularGlossiness, "Specular - Glossiness": the diffuse albedo is diffuse (1 - max specular), the
// reflectance at normal incidence is specular, and alpha is (1 - glossiness)^2. Without metalness a material has these
// three as they are, so nothing is lost, as it would be in a conversion to metalness.
void GltfMaterials::convert_specular_glossiness(const tinygltf::Value& source, Material& material) {
  material.metallic = 0.0F;
  material.base_color = color_in(source, "diffuseFactor", 4);
  material.dielectric_specular = glm::vec3(color_in(source, "specularFactor", 3));
  const float glossiness = checked(number(source, "glossinessFactor", 1.0), 0.0, 1.0, "glossinessFactor");
  material.roughness = 1.0F - glossiness;
  const TextureReference diffuse = texture_in(source, "diffuseTexture");
  if ((material.base_color_map = find_map(diffuse.index, diffuse.set, diffuse.extensions)))
    material.base_color_map->image = base_color(image_of(diffuse.index));
  const TextureReference specular = texture_in(source, "specularGlossinessTexture");
  const std::optional<TextureMap> map = find_map(specular.index, specular.set, specular.extensions);
  if (!map) {
    material.base_color *= glm::vec4(glm::vec3(1.0F - largest_channel(material.dielectric_specular)), 1.0F);
    return;
  }
  const int image = image_of(specular.index);
  material.specular_map = material.metallic_roughness_map = map;
  auto& texels = maps_[fmt::format("{} specular", image)];
  if (!texels) texels = MapTexels::packed(to_rgb(stored(image, Transfer::srgb)));
  material.specular_map->image = texels;
  auto& rough = maps_[fmt::format("{} gloss {}", image, glossiness)];
  if (!rough) rough = MapTexels::packed(decode_glossiness(stored(image, Transfer::linear), glossiness));
  material.metallic_roughness_map->image = rough;
  if (material.base_color_map && material.base_color_map->coordinates != map->coordinates) {
    const float rest = mean_rest(texels.decoded(), material.dielectric_specular);
    material.base_color *= glm::vec4(glm::vec3(rest), 1.0F);
    add_once(warnings_,
             fmt::format("{}: its two textures have coordinates of their own: what specular light leaves to the "
                         "diffuse term is the mean over the texture, {:.3g}",
                         specular_glossiness, rest));
    return;
  }
  if (!material.base_color_map) material.base_color_map = map;
  const int color = diffuse.index >= 0 && material.base_color_map->image ? image_of(diffuse.index) : -1;
  material.base_color_map->image = diffuse_beside(color, image, material.dielectric_specular);
}

void GltfMaterials::convert_normals(const tinygltf::Material& source, Material& material) {
  const auto& normal = source.normalTexture;
  if ((material.normal_map = find_map(normal.index, normal.texCoord, normal.extensions))) {
    material.normal_map->image =
        normals(image_of(normal.index), checked(normal.scale, -1e4, 1e4, "normalTexture.scale"));
  }
}

// KHR_materials_clearcoat: weight 0, the default, means no coat.
void GltfMaterials::convert_coat(const tinygltf::Material& source, Material& material) {
  const tinygltf::Value* const extension = extension_of(source, clear_coat);
  if (extension == nullptr) return;
  ClearCoat coat;
  coat.weight = checked(number(*extension, "clearcoatFactor", 0.0), 0.0, 1.0, "clearcoatFactor");
  coat.roughness = checked(number(*extension, "clearcoatRoughnessFactor", 0.0), 0.0, 1.0, "clearcoatRoughnessFactor");
  if (coat.weight == 0.0F) return;
  const TextureReference weight = texture_in(*extension, "clearcoatTexture");
  if ((coat.weight_map = find_map(weight.index, weight.set, weight.extensions)))
    coat.weight_map->image = factor(image_of(weight.index), 0, coat.weight);
  const TextureReference roughness = texture_in(*extension, "clearcoatRoughnessTexture");
  if ((coat.roughness_map = find_map(roughness.index, roughness.set, roughness.extensions)))
    coat.roughness_map->image = factor(image_of(roughness.index), 1, coat.roughness);
  const TextureReference normal = texture_in(*extension, "clearcoatNormalTexture");
  if ((coat.normal_map = find_map(normal.index, normal.set, normal.extensions))) {
    coat.normal_map->image =
        normals(image_of(normal.index), checked(normal.scale, -1e4, 1e4, "clearcoatNormalTexture.scale"));
  }
  material.coat = std::move(coat);
}

// KHR_materials_anisotropy: strength and rotation, times and turned by the mean of its texture.
void GltfMaterials::convert_anisotropy(const tinygltf::Material& source, Material& material) {
  const tinygltf::Value* const extension = extension_of(source, anisotropic);
  if (extension == nullptr) return;
  Anisotropy anisotropy{checked(number(*extension, "anisotropyStrength", 0.0), 0.0, 1.0, "anisotropyStrength"),
                        checked(number(*extension, "anisotropyRotation", 0.0), -1e6, 1e6, "anisotropyRotation")};
  const TextureReference texture = texture_in(*extension, "anisotropyTexture");
  if (const auto map = find_map(texture.index, texture.set, texture.extensions); map && anisotropy.strength > 0.0F) {
    const StretchTexture read = read_stretch(stored(image_of(texture.index), Transfer::linear));
    anisotropy.strength *= read.mean.strength;
    anisotropy.rotation += read.mean.rotation;
    if (read.varies) {
      add_once(warnings_,
               fmt::format("the anisotropy texture {} varies, and a material has one anisotropy: its mean is used, a "
                           "strength of {:.3g} at {:.3g} degrees",
                           map->name, anisotropy.strength, glm::degrees(anisotropy.rotation)));
    }
  }
  if (anisotropy.strength > 0.0F) material.anisotropy = anisotropy;
}

void GltfMaterials::convert_alpha(const tinygltf::Material& source, Material& material) {
  if (source.alphaMode == "MASK") {
    material.alpha_cutoff = checked(source.alphaCutoff, 0.0, 1e6, "alphaCutoff");
  } else if (source.alphaMode == "BLEND") {
    add_once(warnings_, "alphaMode BLEND: blended materials are drawn opaque");
  } else if (source.alphaMode != "OPAQUE") {
    refuse_gltf("alphaMode", fmt::format("`{:.40}` is none of OPAQUE, MASK, BLEND", source.alphaMode));
  }
}

void GltfMaterials::warn_left_out(const tinygltf::Material& source) {
  const bool emits = std::ranges::any_of(source.emissiveFactor, [](double value) { return value != 0.0; });
  if (emits) add_once(warnings_, "emissive light is left out");
  if (source.occlusionTexture.index >= 0) add_once(warnings_, "occlusion textures are left out");
}

std::optional<TextureMap> GltfMaterials::find_map(int texture_index, int set,
                                                  const tinygltf::ExtensionMap& extensions) {
  if (texture_index < 0) return std::nullopt;
  const auto& texture = document_.model.textures[static_cast<std::size_t>(texture_index)];
  const std::string place = fmt::format("textures[{}]", texture_index);
  if (texture.source < 0) {
    const bool basis = texture.extensions.contains("KHR_texture_basisu");
    add_once(warnings_, place + (basis ? " is a KTX2 image (KHR_texture_basisu), which is not read: it is left out"
                                       : " has no PNG or JPEG image and is left out"));
    return std::nullopt;
  }
  TextureMap map;
  map.name = image_name(document_.model.images[static_cast<std::size_t>(texture.source)], texture.source);
  map.coordinates.set = set;
  if (const auto transform = extensions.find("KHR_texture_transform"); transform != extensions.end()) {
    apply_transform(transform->second, map.coordinates);
  }
  if (map.coordinates.set < 0 || map.coordinates.set > 1) {
    add_once(warnings_, fmt::format("{} uses texture coordinate set {}, only 0 and 1 are read: it is left out", place,
                                    map.coordinates.set));
    return std::nullopt;
  }
  if (texture.sampler >= 0) {
    const auto& sampler = document_.model.samplers[static_cast<std::size_t>(texture.sampler)];
    const std::string sampler_place = fmt::format("samplers[{}]", texture.sampler);
    map.coordinates.wrap = {wrap_mode(sampler.wrapS, sampler_place), wrap_mode(sampler.wrapT, sampler_place)};
  }
  return map;
}

Image GltfMaterials::stored(int index, Transfer transfer) const {
  const auto& image = document_.model.images[static_cast<std::size_t>(index)];
  // tinygltf could not read the file. Reading it again gives the reason.
  return image.image.empty()
             ? read_image(document_.file.parent_path() / image.uri, transfer)
             : read_image(std::span<const std::uint8_t>{image.image}, image_name(image, index), transfer);
}

MapTexels GltfMaterials::base_color(int image) {
  auto& map = maps_[fmt::format("{} color", image)];
  if (!map) map = MapTexels::packed(to_rgba(stored(image, Transfer::srgb)));
  return map;
}

MapTexels GltfMaterials::metallic_roughness(int image, const Material& material) {
  auto& map = maps_[fmt::format("{} rough {} {}", image, material.roughness, material.metallic)];
  if (!map) {
    map = MapTexels::packed(
        decode_metallic_roughness(stored(image, Transfer::linear), material.roughness, material.metallic));
  }
  return map;
}

MapTexels GltfMaterials::factor(int image, int channel, float factor) {
  auto& map = maps_[fmt::format("{} channel {} {}", image, channel, factor)];
  if (!map) map = MapTexels::packed(decode_factor(stored(image, Transfer::linear), channel, factor));
  return map;
}

MapTexels GltfMaterials::diffuse_beside(int diffuse, int specular, const glm::vec3& specular_factor) {
  auto& map = maps_[fmt::format("{} beside {} {} {} {}", diffuse, specular, specular_factor.r, specular_factor.g,
                                specular_factor.b)];
  if (map) return map;
  const Image color = diffuse >= 0 ? to_rgba(stored(diffuse, Transfer::srgb)) : Image(1, 1, 4, 1.0F);
  const Image reflected = to_rgb(stored(specular, Transfer::srgb));
  Image out(std::max(color.width, reflected.width), std::max(color.height, reflected.height), 4);
  for (int y = 0; y < out.height; ++y) {
    for (int x = 0; x < out.width; ++x) {
      const auto albedo = texel_under(color, x, y, out.width, out.height);
      const auto f0 = texel_under(reflected, x, y, out.width, out.height);
      const float rest = 1.0F - largest_channel(specular_factor * glm::vec3(f0[0], f0[1], f0[2]));
      for (std::size_t c = 0; c < 3; ++c) out.at(x, y)[c] = albedo[c] * rest;
      out.at(x, y)[3] = albedo[3];
    }
  }
  return map = MapTexels::packed(out);
}

MapTexels GltfMaterials::normals(int image, double scale) {
  auto& map = maps_[fmt::format("{} normal {}", image, scale)];
  if (map) return map;
  const auto decode = [scale](const Image& texels) { return decode_normal_map(texels, scale); };
  const std::string name = image_name(document_.model.images[static_cast<std::size_t>(image)], image);
  std::vector<std::string> faults;
  map = stored_normals(stored(image, Transfer::linear), decode, name, faults);
  for (std::string& line : faults) add_once(warnings_, std::move(line));
  return map;
}

}  // namespace footprint
