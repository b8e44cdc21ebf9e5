// Converts each material and image once, on first use, and warns about unsupported features.
#include "renderer/scene/gltf/material.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/glm.hpp>
#include <glm/gtc/type_ptr.hpp>
#include <nlohmann/json.hpp>
#include <optional>
#include <set>
#include <span>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "renderer/scene/model.hpp"

namespace footprint {
namespace {

using Json = nlohmann::json;
using Pointer = Json::json_pointer;  // from a material to a member; check_gltf_json has checked the types of all

const Pointer clear_coat("/extensions/KHR_materials_clearcoat");
const Pointer anisotropic("/extensions/KHR_materials_anisotropy");
const Pointer specular_glossiness("/extensions/KHR_materials_pbrSpecularGlossiness");
const Pointer base_color_texture("/pbrMetallicRoughness/baseColorTexture");
const Pointer rough_texture("/pbrMetallicRoughness/metallicRoughnessTexture");
const Pointer normal_texture("/normalTexture");
const Pointer emissive_texture("/emissiveTexture");
const Pointer occlusion_texture("/occlusionTexture");

constexpr double largest_emission = 1e6;

float checked(double value, double low, double high, const std::string& name) {
  if (!(value >= low && value <= high)) refuse_gltf(name, fmt::format("{} is not within {} to {}", value, low, high));
  return static_cast<float>(value);
}

float factor(const Json& material, const Pointer& member, double otherwise, double low = 0.0, double high = 1.0) {
  return checked(material.value(member, otherwise), low, high, member.back());
}

// A colour of `count` channels, each 0 to 1; 1 if it is missing.
glm::vec4 color_in(const Json& material, const Pointer& member, std::size_t count) {
  glm::vec4 color{1.0F};
  const auto values = material.value(member, std::vector<double>());
  for (std::size_t c = 0; c < std::min(count, values.size()); ++c)
    color[static_cast<int>(c)] = checked(values[c], 0.0, 1.0, member.back());
  return color;
}

glm::dvec2 pair(const Json& object, const char* key, double otherwise) {
  const auto values = object.value(key, std::vector{otherwise, otherwise});
  return {values[0], values[1]};
}

/// KHR_texture_transform: offset * rotation * scale. Its rotation turns counter-clockwise as seen with v downwards, as
/// its example (the lower left quadrant) and the viewers have it; the matrix printed in its text turns the other way.
void apply_transform(const Json& extension, TextureCoordinates& coordinates) {
  constexpr double largest = 1e6;
  const glm::dvec2 offset = pair(extension, "offset", 0.0), scale = pair(extension, "scale", 1.0);
  const double rotation = extension.value("rotation", 0.0);
  for (const double value : {offset.x, offset.y, scale.x, scale.y, rotation}) {
    (void)checked(value, -largest, largest, "KHR_texture_transform");
  }
  const double c = std::cos(rotation), s = std::sin(rotation);
  coordinates.transform =
      glm::mat3x2{glm::vec2{glm::dvec2{c, -s} * scale.x}, glm::vec2{glm::dvec2{s, c} * scale.y}, glm::vec2{offset}};
  coordinates.set = extension.value("texCoord", coordinates.set);
}

Wrap wrap_mode(const Json& sampler, const char* key, const std::string& place) {
  constexpr int repeat = 10497, mirrored_repeat = 33648, clamp_to_edge = 33071;
  const int mode = sampler.value(key, repeat);
  if (mode == repeat) return Wrap::repeat;
  if (mode == mirrored_repeat) return Wrap::mirrored_repeat;
  if (mode != clamp_to_edge) refuse_gltf(place, fmt::format("{} is not a wrap mode of glTF 2.0", mode));
  return Wrap::clamp_to_edge;
}

float largest_channel(const glm::vec3& color) { return std::max({color.r, color.g, color.b}); }

// Roughness is 1 - glossiness, and metalness 0.
Image decode_glossiness(const Image& stored, float glossiness_factor) {
  return mapped(to_rgba(stored), 2,
                [=](const auto& in, const auto& out) { out[0] = 1.0F - glossiness_factor * in[3]; });
}

// Decodes the texture of KHR_materials_anisotropy: red and green are a direction, blue a share of the strength s.
// Directions are axes, so that t and -t are equal: s^2 (cos 2 phi, sin 2 phi) per texel, as Material::anisotropy_map.
// factor: the strength of the whole material, and the rotation of all directions.
Image decode_anisotropy(const Image& stored, const Anisotropy& factor) {
  const double c = std::cos(2.0 * factor.rotation), s = std::sin(2.0 * factor.rotation);
  return mapped(to_rgb(stored), 2, [=](const auto& in, const auto& out) {
    const glm::dvec2 t(2.0 * in[0] - 1.0, 2.0 * in[1] - 1.0);
    const double strength = double{factor.strength} * in[2];
    const double scale = strength * strength / std::max(glm::dot(t, t), 1e-12);
    const glm::dvec2 axis = scale * glm::dvec2(t.x * t.x - t.y * t.y, 2.0 * t.x * t.y);
    out[0] = static_cast<float>(c * axis.x - s * axis.y);
    out[1] = static_cast<float>(s * axis.x + c * axis.y);
  });
}

Anisotropy mean_anisotropy(const Image& axes) {
  glm::dvec2 sum(0.0);
  for (std::size_t i = 0; i < axes.texel_count(); ++i) sum += glm::dvec2(glm::make_vec2(&axes.texels[2 * i]));
  const double squared = glm::length(sum) / static_cast<double>(axes.texel_count());
  return {static_cast<float>(std::sqrt(squared)), static_cast<float>(rotation_of_stretch(sum))};
}

bool is_uniform(const Image& image) {
  const auto channels = static_cast<std::size_t>(image.channels);
  for (std::size_t i = channels; i < image.texels.size(); ++i)
    if (image.texels[i] != image.texels[i % channels]) return false;
  return true;
}

// 1 - max specular over a whole texture.
float mean_rest(const Image& specular, const glm::vec3& factor) {
  double sum = 0.0;
  for (std::size_t i = 0; i < specular.texel_count(); ++i)
    sum += 1.0 - largest_channel(factor * glm::make_vec3(&specular.texels[3 * i]));
  return static_cast<float>(sum / static_cast<double>(specular.texel_count()));
}

// The image of an entry of `textures`: a WebP (EXT_texture_webp) before the fallback; none without either.
std::optional<std::size_t> texture_image(const Json& texture) {
  for (const Pointer& source : {Pointer("/extensions/EXT_texture_webp/source"), Pointer("/source")}) {
    if (texture.contains(source)) return texture[source].get<std::size_t>();
  }
  return std::nullopt;
}

// A texture that a material refers to.
struct Texture {
  TextureMap map;  // without texels
  std::size_t image;
};

// The maps of a material of glTF, those first whose loss would change most.
std::vector<std::optional<TextureMap>*> optional_maps(Material& material) {
  std::vector<std::optional<TextureMap>*> maps{&material.normal_map};
  if (material.coat) maps.push_back(&material.coat->normal_map);
  maps.insert(maps.end(), {&material.base_color_map, &material.metallic_roughness_map, &material.anisotropy_map,
                           &material.specular_map, &material.emission_map, &material.occlusion_map});
  if (material.coat) maps.insert(maps.end(), {&material.coat->weight_map, &material.coat->roughness_map});
  std::erase_if(maps, [](const std::optional<TextureMap>* map) { return !*map; });
  return maps;
}

// The two sets that vertices get: 0 and the other one that maps use, else the first two in the order of maps.
UvSets chosen_sets(const std::vector<std::optional<TextureMap>*>& maps) {
  std::vector<int> used;
  for (const std::optional<TextureMap>* map : maps) {
    const int set = (*map)->coordinates.set;
    if (std::ranges::find(used, set) == used.end()) used.push_back(set);
  }
  if (std::ranges::all_of(used, [](int set) { return set < 2; })) return {0, 1};
  if (used.size() == 1) return {0, used[0]};
  return used[1] == 0 ? UvSets{0, used[0]} : UvSets{used[0], used[1]};
}

// Numbers the sets of a file's maps as a mesh's two. A map of a third set is left out, with a warning.
UvSets take_sets(Material& material, std::vector<std::string>& warnings) {
  const std::vector<std::optional<TextureMap>*> maps = optional_maps(material);
  const UvSets sets = chosen_sets(maps);
  for (std::optional<TextureMap>* map : maps) {
    const int set = (*map)->coordinates.set;
    if (const auto* const slot = std::ranges::find(sets, set); slot != sets.end()) {
      (*map)->coordinates.set = static_cast<int>(slot - sets.begin());
      if ((*map)->coordinates.set != set) (*map)->coordinates.texcoord = set;
      continue;
    }
    add_once(warnings, fmt::format("`{}`: its map {} is left out: it uses TEXCOORD_{}, and vertices have two sets, {} "
                                   "and {}",
                                   material.name, (*map)->name, set, sets[0], sets[1]));
    map->reset();
  }
  return sets;
}

// Whether u and v of two maps grow in the same directions on every surface.
bool share_directions(const TextureCoordinates& a, const TextureCoordinates& b) {
  if (a.set != b.set) return false;
  for (int row = 0; row < 2; ++row) {
    const glm::vec2 one{a.transform[0][row], a.transform[1][row]}, two{b.transform[0][row], b.transform[1][row]};
    const float size = glm::length(one) * glm::length(two);
    if (!(glm::dot(one, two) >= (1.0F - 1e-6F) * size)) return false;
  }
  return true;
}

void warn_of_coat(const Material& material, std::vector<std::string>& warnings) {
  if (!material.normal_map || !material.coat || !material.coat->normal_map) return;
  if (share_directions(material.normal_map->coordinates, material.coat->normal_map->coordinates)) return;
  add_once(warnings, fmt::format("`{}`: the normal map of its coat is turned against the one below, whose tangents it "
                                 "is read with",
                                 material.name));
}

class Converter {
 public:
  Converter(const GltfDocument& document, std::vector<std::string>& warnings, std::map<std::string, MapTexels>& maps)
      : document_(document), warnings_(warnings), maps_(maps) {}

  [[nodiscard]] Material convert(int index) {
    const Json& source = document_.json["materials"][static_cast<std::size_t>(index)];
    Material material;
    material.name = gltf_material_names(document_).at(static_cast<std::size_t>(index));
    material.double_sided = source.value("doubleSided", false);
    convert_alpha(source, material);
    material.unlit = source.contains(Pointer("/extensions/KHR_materials_unlit"));
    if (source.contains(specular_glossiness) && !material.unlit) {
      convert_specular_glossiness(source, material);
    } else {
      convert_metallic_roughness(source, material);
    }
    if (material.unlit) return material;
    material.normal_map = normals(source, normal_texture);
    convert_coat(source, material);
    convert_anisotropy(source, material);
    convert_emission(source, material);
    convert_occlusion(source, material);
    return material;
  }

 private:
  void convert_alpha(const Json& source, Material& material) {
    const std::string mode = source.value("alphaMode", "OPAQUE");
    if (mode == "MASK") {
      material.alpha_cutoff = factor(source, Pointer("/alphaCutoff"), 0.5, 0.0, 1e6);
    } else if (mode == "BLEND") {
      add_once(warnings_, "alphaMode BLEND: blended materials are drawn opaque");
    } else if (mode != "OPAQUE") {
      refuse_gltf("alphaMode", fmt::format("`{:.40}` is none of OPAQUE, MASK, BLEND", mode));
    }
  }

  void convert_metallic_roughness(const Json& source, Material& material) {
    const Pointer pbr("/pbrMetallicRoughness");
    material.base_color = color_in(source, pbr / "baseColorFactor", 4);
    material.base_color_map = map(source, base_color_texture, "color", Transfer::srgb, color_channels, to_rgba);
    if (material.unlit) return;  // the rest is about light
    material.metallic = factor(source, pbr / "metallicFactor", 1.0);
    material.roughness = factor(source, pbr / "roughnessFactor", 1.0);
    if (const Pointer ior("/extensions/KHR_materials_ior"); source.contains(ior)) {
      // 0 means infinite; other values are at least 1.
      const double index = source.value(ior / "ior", 1.5);
      const double ratio = index == 0.0 ? 1.0 : (checked(index, 1.0, 1e6, "ior") - 1.0) / (index + 1.0);
      material.dielectric_specular = glm::vec3{static_cast<float>(ratio * ratio)};
    }
    material.metallic_roughness_map = map(
        source, rough_texture, fmt::format("rough {} {}", material.roughness, material.metallic), Transfer::linear,
        roughness_channels,
        [&](const Image& image) { return decode_metallic_roughness(image, material.roughness, material.metallic); });
  }

  // KHR_materials_pbrSpecularGlossiness, "Specular - Glossiness": the diffuse albedo is diffuse (1 - max specular), the
  // reflectance at normal incidence is specular, and alpha is (1 - glossiness)^2. Without metalness a material has
  // these three as they are, so nothing is lost, as it would be in a conversion to metalness.
  void convert_specular_glossiness(const Json& source, Material& material) {
    material.metallic = 0.0F;
    material.base_color = color_in(source, specular_glossiness / "diffuseFactor", 4);
    material.dielectric_specular = glm::vec3(color_in(source, specular_glossiness / "specularFactor", 3));
    const float glossiness = factor(source, specular_glossiness / "glossinessFactor", 1.0);
    material.roughness = 1.0F - glossiness;
    const Pointer diffuse = specular_glossiness / "diffuseTexture",
                  specular = specular_glossiness / "specularGlossinessTexture";
    material.base_color_map = map(source, diffuse, "color", Transfer::srgb, color_channels, to_rgba);
    material.specular_map = map(source, specular, "specular", Transfer::srgb, color_channels, to_rgb);
    if (!material.specular_map) {
      material.base_color *= glm::vec4(glm::vec3(1.0F - largest_channel(material.dielectric_specular)), 1.0F);
      return;
    }
    material.metallic_roughness_map = map(source, specular, fmt::format("gloss {}", glossiness), Transfer::linear, {},
                                          [&](const Image& image) { return decode_glossiness(image, glossiness); });
    if (material.base_color_map && material.base_color_map->coordinates != material.specular_map->coordinates) {
      const float rest = mean_rest(material.specular_map->image.decoded(), material.dielectric_specular);
      material.base_color *= glm::vec4(glm::vec3(rest), 1.0F);
      add_once(warnings_,
               fmt::format("{}: its two textures have coordinates of their own: what specular light leaves to the "
                           "diffuse term is the mean over the texture, {:.3g}",
                           specular_glossiness.back(), rest));
      return;
    }
    const std::optional<Texture> color = texture(source, diffuse);
    if (!color) material.base_color_map = material.specular_map;
    material.base_color_map->image =
        diffuse_beside(color, texture(source, specular)->image, material.dielectric_specular);
  }

  // KHR_materials_clearcoat: weight 0, the default, means no coat.
  void convert_coat(const Json& source, Material& material) {
    ClearCoat coat;
    coat.weight = factor(source, clear_coat / "clearcoatFactor", 0.0);
    coat.roughness = factor(source, clear_coat / "clearcoatRoughnessFactor", 0.0);
    if (coat.weight == 0.0F) return;
    const auto one_channel = [&](const char* name, int channel, float scale) {
      const std::array counted{static_cast<std::size_t>(channel)};
      return map(source, clear_coat / name, fmt::format("channel {} {}", channel, scale), Transfer::linear, counted,
                 [=](const Image& image) { return decode_factor(image, channel, scale); });
    };
    coat.weight_map = one_channel("clearcoatTexture", 0, coat.weight);
    coat.roughness_map = one_channel("clearcoatRoughnessTexture", 1, coat.roughness);
    coat.normal_map = normals(source, clear_coat / "clearcoatNormalTexture");
    material.coat = std::move(coat);
  }

  // Also KHR_materials_emissive_strength. The factor 0, the default, means no light, whatever the texture.
  void convert_emission(const Json& source, Material& material) {
    const Pointer member("/emissiveFactor"), strength("/extensions/KHR_materials_emissive_strength/emissiveStrength");
    if (!source.contains(member)) return;
    material.emission = glm::vec3(color_in(source, member, 3)) *
                        static_cast<float>(factor(source, strength, 1.0, 0.0, largest_emission));
    if (material.emission == glm::vec3(0.0F)) return;
    material.emission_map = map(source, emissive_texture, "emission", Transfer::srgb, color_channels, to_rgb);
  }

  // 1 + strength (texel - 1), of red (glTF 2.0, section 3.9.3).
  void convert_occlusion(const Json& source, Material& material) {
    const float strength = factor(source, occlusion_texture / "strength", 1.0);
    if (strength == 0.0F) return;
    constexpr std::array<std::size_t, 1> red{0};
    const auto decode = [=](const Image& image) {
      return mapped(decode_factor(image, 0, 1.0F), 1,
                    [=](const auto& in, const auto& out) { out[0] = 1.0F + strength * (in[0] - 1.0F); });
    };
    material.occlusion_map =
        map(source, occlusion_texture, fmt::format("occlusion {}", strength), Transfer::linear, red, decode);
  }

  // KHR_materials_anisotropy: strength and rotation, and a texture of both.
  void convert_anisotropy(const Json& source, Material& material) {
    const Anisotropy factor_of{factor(source, anisotropic / "anisotropyStrength", 0.0),
                               factor(source, anisotropic / "anisotropyRotation", 0.0, -1e6, 1e6)};
    if (factor_of.strength == 0.0F) return;
    material.anisotropy = factor_of;
    material.anisotropy_map =
        map(source, anisotropic / "anisotropyTexture",
            fmt::format("anisotropy {} {}", factor_of.strength, factor_of.rotation), Transfer::linear, color_channels,
            [&](const Image& image) { return decode_anisotropy(image, factor_of); });
    if (!material.anisotropy_map) return;
    const Image axes = material.anisotropy_map->image.decoded();
    material.anisotropy = mean_anisotropy(axes);
    if (!is_uniform(axes)) return;
    material.anisotropy_map.reset();
    if (material.anisotropy->strength == 0.0F) material.anisotropy.reset();
  }

  // None without the member, or for a texture that cannot be used.
  [[nodiscard]] std::optional<Texture> texture(const Json& material, const Pointer& member) {
    if (!material.contains(member)) return std::nullopt;
    const Json& reference = material[member];
    const auto index = reference["index"].get<std::size_t>();
    const Json& source = document_.json["textures"][index];
    const std::string place = fmt::format("textures[{}]", index);
    const std::optional<std::size_t> image = texture_image(source);
    if (!image) {
      const bool basis = source.contains(Pointer("/extensions/KHR_texture_basisu"));
      add_once(warnings_, place + (basis ? " is a KTX2 image (KHR_texture_basisu), which is not read: it is left out"
                                         : " has no image that is read and is left out"));
      return std::nullopt;
    }
    Texture out{.map = {}, .image = *image};
    TextureCoordinates& coordinates = out.map.coordinates;
    out.map.name = gltf_image_name(document_, out.image);
    coordinates.set = reference.value("texCoord", 0);
    if (const Pointer transform("/extensions/KHR_texture_transform"); reference.contains(transform))
      apply_transform(reference[transform], coordinates);
    if (source.contains("sampler")) {
      const auto number = source["sampler"].get<std::size_t>();
      const Json& sampler = document_.json["samplers"][number];
      const std::string sampler_place = fmt::format("samplers[{}]", number);
      coordinates.wrap = {wrap_mode(sampler, "wrapS", sampler_place), wrap_mode(sampler, "wrapT", sampler_place)};
    }
    return out;
  }

  [[nodiscard]] FileImage stored(std::size_t index, Transfer transfer) const {
    const GltfImage image = gltf_image(document_, index);
    if (!image.fault.empty()) refuse_gltf(image.file.string(), image.fault, "check the path");
    return image.file.empty() ? read_file_image(image.bytes, gltf_image_name(document_, index), transfer)
                              : read_file_image(image.file, transfer);
  }

  // The image of values that mean 0 to 1, in some of its channels.
  [[nodiscard]] Image unit_values(std::size_t index, Transfer transfer, std::span<const std::size_t> channels) {
    FileImage file = stored(index, transfer);
    for (std::string& line : describe_unit_values(file, channels, gltf_image_name(document_, index)))
      add_once(warnings_, std::move(line));
    return std::move(file.image);
  }

  // The texels of a use of an image, made once.
  template <class Make>
  MapTexels cached(const std::string& use, const Make& make) {
    MapTexels& texels = maps_[use];
    if (!texels) texels = make();
    return texels;
  }

  template <class Decode>
  std::optional<TextureMap> map(const Json& material, const Pointer& member, const std::string& use, Transfer transfer,
                                std::span<const std::size_t> channels, const Decode& decode) {
    std::optional<Texture> found = texture(material, member);
    if (!found) return std::nullopt;
    found->map.image = cached(fmt::format("{} {}", found->image, use),
                              [&] { return MapTexels::packed(decode(unit_values(found->image, transfer, channels))); });
    return std::move(found->map);
  }

  std::optional<TextureMap> normals(const Json& material, const Pointer& member) {
    std::optional<Texture> found = texture(material, member);
    if (!found) return std::nullopt;
    const double scale = checked(material.value(member / "scale", 1.0), -1e4, 1e4, member.back() + ".scale");
    found->map.image = cached(fmt::format("{} normal {}", found->image, scale), [&] {
      const FileImage file = stored(found->image, Transfer::linear);
      try {
        return decoded_normals(file, scale, found->map.name);
      } catch (const Error& error) {
        throw error.within(found->map.name);
      }
    });
    return std::move(found->map);
  }

  MapTexels decoded_normals(const FileImage& file, double scale, const std::string& name) {
    if (file.floats) require_encoded_normals(file.image, NormalChannels::xyz);
    const auto decode = [scale](const Image& texels) { return decode_normal_map(texels, scale); };
    std::vector<std::string> faults;
    MapTexels texels = stored_normals(file, decode, name, faults);
    for (std::string& line : faults) add_once(warnings_, std::move(line));
    return texels;
  }

  // diffuse (1 - max specular) of KHR_materials_pbrSpecularGlossiness. diffuse: none is white.
  MapTexels diffuse_beside(const std::optional<Texture>& diffuse, std::size_t specular, const glm::vec3& factor) {
    const std::string images = diffuse ? fmt::format("{} {}", diffuse->image, specular) : fmt::format("{}", specular);
    return cached(fmt::format("beside {} {} {} {}", images, factor.r, factor.g, factor.b), [&] {
      const Image color = diffuse ? to_rgba(stored(diffuse->image, Transfer::srgb).image) : Image(1, 1, 4, 1.0F);
      const Image reflected = to_rgb(stored(specular, Transfer::srgb).image);
      Image out(std::max(color.width, reflected.width), std::max(color.height, reflected.height), 4);
      for_each_texel(out, [&](int x, int y) {
        const auto albedo = texel_under(color, x, y, out.width, out.height);
        const auto f0 = texel_under(reflected, x, y, out.width, out.height);
        const float rest = 1.0F - largest_channel(factor * glm::make_vec3(f0.data()));
        for (std::size_t c = 0; c < 3; ++c) out.at(x, y)[c] = albedo[c] * rest;
        out.at(x, y)[3] = albedo[3];
      });
      return MapTexels::packed(out);
    });
  }

  const GltfDocument& document_;
  std::vector<std::string>& warnings_;
  std::map<std::string, MapTexels>& maps_;
};

}  // namespace

std::vector<std::string> gltf_material_names(const GltfDocument& document) {
  std::vector<std::string> names;
  for (const Json& material : document.json.value("materials", Json::array())) {
    const std::string name = material.value("name", "");
    names.push_back(name.empty() ? fmt::format("material {}", names.size()) : name);
  }
  return told_apart(std::move(names));
}

std::uint64_t decoded_map_bytes(const GltfDocument& document) {
  struct Use {
    Pointer texture;
    std::string_view name;
    std::uint64_t channels;  // of all maps
  };
  const std::vector<Use> uses{{base_color_texture, "color", 4},
                              {rough_texture, "rough", 2},
                              {normal_texture, "normal", 4},
                              {emissive_texture, "emission", 3},
                              {occlusion_texture, "occlusion", 1},
                              {specular_glossiness / "diffuseTexture", "color", 4},
                              {specular_glossiness / "specularGlossinessTexture", "specular", 4 + 2 + 3},
                              {anisotropic / "anisotropyTexture", "anisotropy", 2},
                              {clear_coat / "clearcoatTexture", "coat weight", 1},
                              {clear_coat / "clearcoatRoughnessTexture", "coat roughness", 1},
                              {clear_coat / "clearcoatNormalTexture", "normal", 4}};
  std::set<std::pair<std::size_t, std::string_view>> counted;  // images and their uses
  std::uint64_t bytes = 0;
  for (const Json& material : document.json.value("materials", Json::array())) {
    for (const auto& [texture, name, channels] : uses) {
      if (!material.contains(texture)) continue;
      const Json& source = document.json["textures"][material[texture]["index"].get<std::size_t>()];
      const std::optional<std::size_t> index = texture_image(source);
      if (!index || !counted.emplace(*index, name).second) continue;
      const GltfImage image = gltf_image(document, *index);
      const std::uint64_t texels = image.file.empty() ? texels_in_header(image.bytes) : texels_in_header(image.file);
      bytes += texels * channels * sizeof(float);
    }
  }
  return bytes;
}

int GltfMaterials::use(int gltf_index) {
  const auto [entry, is_new] = indices_.emplace(gltf_index, static_cast<int>(materials_.size()));
  if (!is_new) return entry->second;
  Material& material = materials_.emplace_back();
  UvSets& sets = sets_.emplace_back(UvSets{0, 1});
  material.name = "default";
  if (gltf_index < 0) return entry->second;
  try {
    material = Converter(document_, warnings_, maps_).convert(gltf_index);
    sets = take_sets(material, warnings_);
    warn_of_coat(material, warnings_);
  } catch (const Error& error) {
    const std::string name = document_.json["materials"][static_cast<std::size_t>(gltf_index)].value("name", "");
    throw error.within(fmt::format("materials[{}] `{:.80}`", gltf_index, name));
  }
  return entry->second;
}

}  // namespace footprint
