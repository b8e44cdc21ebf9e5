// A reader of statements, options of maps among them, and the conversion of what it found.
#include "renderer/scene/obj/mtl.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>
#include <utility>

#include "renderer/core/error.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/names.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/surface_maps.hpp"
#include "renderer/scene/model.hpp"
#include "renderer/scene/obj/statements.hpp"

namespace footprint {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t largest_mtl = std::uint64_t{1} << 26U;
constexpr float default_roughness = 0.5F, largest_number = 1e6F;

/// A value that changes a surface and is left out, unless it is `neutral`.
struct LeftOut {
  std::string_view keyword;
  float neutral;
  std::string_view warning;
};

constexpr auto left_out = std::to_array<LeftOut>({{"d", 1.0F, "transparent materials (d, Tr) are drawn opaque"},
                                                  {"tr", 0.0F, "transparent materials (d, Tr) are drawn opaque"},
                                                  {"pc", 0.0F, "clear coats (Pc) are left out"},
                                                  {"ps", 0.0F, "sheen (Ps) is left out"},
                                                  {"aniso", 0.0F, "anisotropy (aniso) is left out"}});

bool names_map(std::string_view keyword) {
  return keyword.starts_with("map_") || keyword == "bump" || keyword == "norm" || keyword == "disp" ||
         keyword == "decal" || keyword == "refl";
}

/// The key of a map that is read, in `MtlMaterial::maps`; empty for others.
std::string_view map_key(std::string_view keyword) {
  if (keyword == "norm" || keyword == "map_kn") return "norm";
  if (keyword == "bump" || keyword == "map_bump") return "bump";
  for (const char* key : {"map_kd", "map_ks", "map_ke", "map_pr", "map_pm"})
    if (keyword == key) return key;
  return {};
}

class MtlReader {
 public:
  MtlReader(const fs::path& file, std::map<std::string, MtlMaterial>& materials, std::vector<std::string>& warnings)
      : text_(file, largest_mtl), materials_(materials), warnings_(warnings) {}

  void read() {
    while (const auto statement = text_.next()) {
      line_ = statement->line;
      const std::string keyword = lower_case(std::string(statement->keyword));
      if (keyword == "newmtl") {
        const auto [entry, is_new] = materials_.try_emplace(utf8_text(statement->rest));
        current_ = is_new ? &entry->second : &repeated_;
      } else if (names_map(keyword)) {
        add_map(keyword, std::string(statement->keyword), statement->rest);
      } else {
        set_value(keyword, statement->rest);
      }
    }
  }

 private:
  MtlMaterial& current() {
    if (current_ == nullptr) throw text_.fault(line_, "a value before the first `newmtl`");
    return *current_;
  }

  void set_value(std::string_view keyword, std::string_view rest) {
    if (keyword == "kd") current().diffuse = color(keyword, rest, current().diffuse);
    if (keyword == "ks") current().specular = color(keyword, rest, current().specular.value_or(glm::vec3(0.04F)));
    if (keyword == "ke")
      current().emission = color(keyword, rest, current().emission.value_or(glm::vec3(0.0F)), largest_number);
    if (keyword == "ns") current().exponent = number(keyword, rest, largest_number);
    if (keyword == "pr") current().roughness = number(keyword, rest, 1.0F);
    if (keyword == "pm") current().metallic = number(keyword, rest, 1.0F);
    const auto* const found = std::ranges::find(left_out, keyword, &LeftOut::keyword);
    if (found != left_out.end() && differs(rest, found->neutral)) add_once(warnings_, std::string(found->warning));
  }

  // Whether any number of a statement differs from `neutral`.
  static bool differs(std::string_view rest, float neutral) {
    for (std::string_view word = next_word(rest); !word.empty(); word = next_word(rest)) {
      const auto value = wavefront_number(word);
      if (value && static_cast<float>(*value) != neutral) return true;
    }
    return false;
  }

  // A number clamped to 0 to `most`, as exporters write a little more.
  float number(std::string_view keyword, std::string_view& rest, float most) {
    const std::string_view word = next_word(rest);
    const auto value = wavefront_number(word);
    if (!value || !std::isfinite(*value)) throw text_.fault(line_, fmt::format("`{:.40}` is not a number", word));
    const auto given = static_cast<float>(*value);
    const float clamped = std::clamp(given, 0.0F, most);
    if (clamped != given) {
      add_once(warnings_, fmt::format("{}: {} of {:g} is taken as {:g}", text_.path().filename().string(), keyword,
                                      *value, clamped));
    }
    return clamped;
  }

  // One number is grey. Spectra and CIE XYZ are not read.
  glm::vec3 color(std::string_view keyword, std::string_view rest, const glm::vec3& otherwise, float most = 1.0F) {
    if (rest.starts_with("spectral") || rest.starts_with("xyz")) {
      add_once(warnings_, fmt::format("{} as a spectrum or as XYZ is left out", keyword));
      return otherwise;
    }
    glm::vec3 out(number(keyword, rest, most));
    if (without_blanks(rest).empty()) return out;
    out.g = number(keyword, rest, most);
    out.b = number(keyword, rest, most);
    return out;
  }

  void add_map(std::string_view keyword, const std::string& written, std::string_view rest) {
    const std::string_view key = map_key(keyword);
    if (key.empty()) {
      add_once(warnings_,
               fmt::format("the MTL statement {:.40} is not read: its maps are left out", utf8_text(written)));
      return;
    }
    MtlMap map;
    take_options(rest, map);
    std::string name(without_blanks(rest));
    if (name.size() > 1 && name.front() == '"' && name.back() == '"') name = name.substr(1, name.size() - 2);
    if (name.empty()) throw text_.fault(line_, fmt::format("{} names no picture", utf8_text(written)));
    map.file = find_named_file(text_.path().parent_path(), name);
    if (map.file.empty()) {
      add_once(warnings_, fmt::format("{}:{}: there is no picture `{:.120}`: the map is left out",
                                      text_.path().filename().string(), line_, utf8_text(name)));
      return;
    }
    current().maps.insert_or_assign(std::string(key), std::move(map));
  }

  // Takes words such as "-bm 0.5" off the start of a statement.
  void take_options(std::string_view& rest, MtlMap& map) {
    glm::vec2 scale(1.0F), offset(0.0F);
    for (std::string_view ahead = rest; ahead.starts_with('-'); ahead = rest = without_blanks(ahead)) {
      const std::string option = lower_case(std::string(next_word(ahead)));
      if (option == "-s") {
        scale = pair(ahead, 1.0F);
      } else if (option == "-o") {
        offset = pair(ahead, 0.0F);
      } else if (option == "-bm") {
        map.multiplier = number_of(next_word(ahead));
      } else if (option == "-clamp") {
        if (next_word(ahead) == "on") map.coordinates.wrap = {Wrap::clamp_to_edge, Wrap::clamp_to_edge};
      } else if (option == "-blendu" || option == "-blendv" || option == "-boost" || option == "-texres") {
        (void)next_word(ahead);  // filters of other renderers
      } else if (!skip_option(option, ahead)) {
        break;  // a name that begins with "-"
      }
    }
    // OBJ's v points up: v' = 1 - v.
    map.coordinates.transform = {scale.x, 0.0F, 0.0F, scale.y, offset.x, 1.0F - scale.y - offset.y};
  }

  // Passes an option that is left out, with its words.
  bool skip_option(const std::string& option, std::string_view& ahead) {
    if (option == "-t" || option == "-mm") {
      (void)pair(ahead, 0.0F);
    } else if (option == "-imfchan" || option == "-cc" || option == "-type") {
      (void)next_word(ahead);
    } else {
      return false;
    }
    add_once(warnings_, fmt::format("the option {} of maps in MTL files is left out", option));
    return true;
  }

  // One to three numbers, of which the first two count.
  glm::vec2 pair(std::string_view& ahead, float otherwise) {
    glm::vec2 out(otherwise);
    for (int i = 0; i < 3; ++i) {
      std::string_view after = ahead;
      const std::string_view word = next_word(after);
      if (without_blanks(after).empty() || !wavefront_number(word)) break;  // the last word names the picture
      if (i < 2) out[i] = number_of(word);
      ahead = after;
    }
    return out;
  }

  [[nodiscard]] float number_of(std::string_view word) const {
    const auto value = wavefront_number(word);
    if (!value || !(std::abs(*value) <= largest_number))
      throw text_.fault(line_, fmt::format("`{:.40}` is not a number within 1e6", word));
    return static_cast<float>(*value);
  }

  WavefrontFile text_;
  std::map<std::string, MtlMaterial>& materials_;
  std::vector<std::string>& warnings_;
  MtlMaterial repeated_;  // values of a name that exists
  MtlMaterial* current_ = nullptr;
  std::size_t line_ = 0;
};

// The perceptual roughness of a Blinn-Phong exponent: alpha^2 = 2 / (n + 2) (Walter et al. 2007, section 5.2).
float roughness_of_exponent(float exponent) { return std::pow(2.0F / (exponent + 2.0F), 0.25F); }

bool is_grey(const Image& image) {
  if (image.channels < 3) return true;
  const auto stride = static_cast<std::size_t>(image.channels);
  for (std::size_t i = 0; i < image.texels.size(); i += stride) {
    const auto [least, most] = std::minmax({image.texels[i], image.texels[i + 1], image.texels[i + 2]});
    if (most - least > 2.5F / 255.0F) return false;  // what JPEG does to grey
  }
  return true;
}

// Both maps in one grid, the larger, with the nearest texel of the other. None of one is its factor, constant.
Image beside(const std::optional<Image>& roughness, const std::optional<Image>& metallic, const MtlMaterial& source) {
  const Image rough = roughness ? decode_factor(*roughness, 0, source.roughness.value_or(1.0F))
                                : Image(1, 1, 1, source.roughness.value_or(default_roughness));
  const Image metal = metallic ? decode_factor(*metallic, 0, source.metallic.value_or(1.0F))
                               : Image(1, 1, 1, source.metallic.value_or(0.0F));
  Image out(std::max(rough.width, metal.width), std::max(rough.height, metal.height), 2);
  for_each_texel(out, [&](int x, int y) {
    out.at(x, y)[0] = texel_under(rough, x, y, out.width, out.height)[0];
    out.at(x, y)[1] = texel_under(metal, x, y, out.width, out.height)[0];
  });
  return out;
}

const MtlMap* find_map(const MtlMaterial& source, const char* key) {
  const auto found = source.maps.find(key);
  return found == source.maps.end() ? nullptr : &found->second;
}

}  // namespace

void MtlLibrary::read(const fs::path& file) { MtlReader(file, sources_, warnings_).read(); }

template <class Make>
TextureMap MtlLibrary::decoded(const MtlMap& map, const std::string& use, const Make& make) {
  MapTexels& texels = texels_[fmt::format("{} {}", use, map.file.string())];
  if (!texels) {
    const std::uint64_t bytes = texels_in_header(map.file) * 4 * sizeof(float);
    require_memory(bytes, "decoding the model's maps", "scale its textures down, or free memory");
    texels = make();
  }
  return {utf8_text(map.file.filename().string()), texels, map.coordinates};
}

// Ks is the reflectance at normal incidence. Files with roughness or metalness write it by habit, as 0.5 or 1.
void MtlLibrary::add_specular(const MtlMaterial& source, Material& material) {
  const bool is_metallic_rough = source.roughness || source.metallic || find_map(source, "map_pr") != nullptr ||
                                 find_map(source, "map_pm") != nullptr;
  if (is_metallic_rough) return;
  const MtlMap* const map = find_map(source, "map_ks");
  if (source.specular || map != nullptr) material.dielectric_specular = source.specular.value_or(glm::vec3(1.0F));
  if (map == nullptr) return;
  material.specular_map =
      decoded(*map, "rgb", [&] { return MapTexels::packed(to_rgb(read_image(map->file, Transfer::srgb))); });
}

void MtlLibrary::add_bump(const MtlMap& map, Material& material) {
  const Image stored = read_image(map.file, Transfer::linear);
  NormalFile file{.path = map.file, .scale = map.multiplier};
  if (is_grey(stored)) {
    // Texels are the unit in which -bm has its usual values, 0 to 1.
    file.scale = map.multiplier / static_cast<float>(stored.width);
    file.heights.emplace().wrap = map.coordinates.wrap;
  } else {
    add_once(warnings_, fmt::format("the bump map {} is coloured: it is taken for normals",
                                    utf8_text(map.file.filename().string())));
  }
  add_normals(map, file, material);
}

void MtlLibrary::add_normals(const MtlMap& map, const NormalFile& file, Material& material) {
  const std::string use = fmt::format("{} {}", file.heights ? "heights" : "normals", map.multiplier);
  material.normal_map = decoded(map, use, [&] {
    std::vector<std::string> faults;
    MapTexels texels = read_normals(file, faults);
    for (std::string& line : faults) add_once(warnings_, std::move(line));
    return texels;
  });
}

void MtlLibrary::add_roughness(const MtlMaterial& source, Material& material) {
  const MtlMap* const rough = find_map(source, "map_pr");
  const MtlMap* metal = find_map(source, "map_pm");
  if (rough == nullptr && metal == nullptr) return;
  if (rough != nullptr && metal != nullptr && rough->coordinates != metal->coordinates) {
    add_once(warnings_, "map_Pm has other options than map_Pr: it is left out");
    metal = nullptr;
  }
  const auto picture = [](const MtlMap* map) {
    return map != nullptr ? std::optional(read_image(map->file, Transfer::linear)) : std::nullopt;
  };
  MtlMaterial factors = source;
  factors.roughness = rough != nullptr ? source.roughness : std::optional(material.roughness);
  const std::string use = fmt::format("rough {} {} {}", factors.roughness.value_or(1.0F),
                                      source.metallic.value_or(-1.0F), metal != nullptr ? metal->file.string() : "");
  material.metallic_roughness_map = decoded(rough != nullptr ? *rough : *metal, use, [&] {
    return MapTexels::packed(beside(picture(rough), picture(metal), factors));
  });
}

void MtlLibrary::add_maps(const MtlMaterial& source, Material& material) {
  if (const MtlMap* const map = find_map(source, "map_kd")) {
    material.base_color_map =
        decoded(*map, "color", [&] { return MapTexels::packed(to_rgba(read_image(map->file, Transfer::srgb))); });
  }
  const MtlMap* const emission = find_map(source, "map_ke");
  if (source.emission || emission != nullptr) material.emission = source.emission.value_or(glm::vec3(1.0F));
  if (emission != nullptr && material.emission != glm::vec3(0.0F)) {
    material.emission_map = decoded(
        *emission, "rgb", [&] { return MapTexels::packed(to_rgb(read_image(emission->file, Transfer::srgb))); });
  }
  add_roughness(source, material);
  const MtlMap *const normals = find_map(source, "norm"), *const bump = find_map(source, "bump");
  if (normals != nullptr) {
    add_normals(*normals, {.path = normals->file, .scale = normals->multiplier}, material);
    if (bump != nullptr) add_once(warnings_, "bump maps beside a normal map are left out");
  } else if (bump != nullptr) {
    add_bump(*bump, material);
  }
}

Material MtlLibrary::material(const std::string& name) {
  Material material;
  material.name = name;
  material.roughness = default_roughness;
  material.metallic = 0.0F;
  const auto found = sources_.find(name);
  if (found == sources_.end()) return material;
  const MtlMaterial& source = found->second;
  material.base_color = glm::vec4(source.diffuse, 1.0F);
  add_specular(source, material);
  if (source.exponent) material.roughness = roughness_of_exponent(*source.exponent);
  material.roughness = source.roughness.value_or(material.roughness);
  material.metallic = source.metallic.value_or(0.0F);
  add_maps(source, material);
  return material;
}

}  // namespace footprint
