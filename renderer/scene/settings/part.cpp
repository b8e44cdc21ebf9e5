// Reads each table of a part with keys and ranges, and checks conflicts by line.
#include "renderer/scene/settings/part.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <numbers>

#include "renderer/core/names.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {
namespace {

constexpr NumberRange repeats{1e-3, 1e4};  // of a map along u or v
constexpr NumberRange lobe_weight{1e-6, 1e3};
constexpr NumberRange seed_range{0.0, std::numeric_limits<std::uint32_t>::max()};

constexpr NumberRange slope_factors{-100.0, 100.0};

constexpr double lowest_axis = 1e-3;  // half of a lobe on the horizon would be below it

const std::vector<std::string> surface_keys{"name", "resolution", "seed", "parameters"};

constexpr auto normal_channels =
    std::to_array<Word<NormalChannels>>({{NormalChannels::xyz, "xyz"}, {NormalChannels::xy, "xy"}});

ModelSettings read_model(const TomlTable& table, const std::filesystem::path& folder) {
  return {.candidates = read_candidates(table, folder, "name the model file to draw"),
          .package = table.word("package").value_or(""),
          .unwrap = table.boolean("unwrap").value_or(false),
          .selection = {.scene = table.word("scene"),
                        .camera = table.word("camera"),
                        .variant = table.word("variant"),
                        .animation = table.word("animation"),
                        .time = table.number("time", {-largest_seconds, largest_seconds})}};
}

constexpr auto height_wraps =
    std::to_array<Word<Wrap>>({{Wrap::repeat, "repeat"}, {Wrap::clamp_to_edge, "clamp_to_edge"}});

// A file of heights. Its scale is required, because heights range over four powers of ten.
NormalFile read_heights(const TomlTable& table, const std::filesystem::path& folder) {
  HeightSettings heights;
  assign(heights.filter, read_word(table, "slope_filter", slope_filters));
  if (const auto wrap = read_word(table, "wrap", height_wraps)) heights.wrap = {*wrap, *wrap};
  return {.path = required(table, "file", read_path(table, "file", folder)),
          .scale = required(table, "scale", table.number("scale", slope_factors)),
          .heights = heights};
}

// The keys `normal_map` and `height_map`.
std::optional<NormalFile> read_normals(const TomlTable& table, const std::filesystem::path& folder) {
  const auto heights = table.table("height_map", {"file", "scale", "slope_filter", "wrap"});
  const auto file = read_path(table, "normal_map", folder);
  if (heights && file) throw table.error_at("height_map", "excludes `normal_map`", "give one of the two");
  if (heights) return read_heights(*heights, folder);
  return file ? std::optional(NormalFile{.path = *file}) : std::nullopt;
}

// The normals of a plane: the keys of read_normals, and those that belong to stored normals alone.
std::optional<NormalFile> read_plane_normals(const TomlTable& table, const std::filesystem::path& folder) {
  auto normals = read_normals(table, folder);
  const auto channels = read_word(table, "normal_channels", normal_channels);
  const auto scale = table.number("normal_scale", slope_factors);
  if (!normals) return normals;
  for (const char* key : {"normal_channels", "normal_scale"}) {
    if (normals->heights && table.has(key)) throw table.error_at(key, "belongs to a `normal_map`", "leave it out");
  }
  assign(normals->channels, channels);
  assign(normals->scale, scale);
  return normals;
}

PlaneSettings read_plane(const TomlTable& table, const std::filesystem::path& folder) {
  PlaneSettings plane;
  assign(plane.size, read_pair(table, "size", length_range));
  plane.normals = read_plane_normals(table, folder);
  plane.base_color_map = read_path(table, "base_color_map", folder);
  plane.metallic_roughness_map = read_path(table, "metallic_roughness_map", folder);
  assign(plane.roughness, table.number("roughness", unit_range));
  assign(plane.metallic, table.number("metallic", unit_range));
  return plane;
}

// The key of a distribution's lobe parameter.
std::string_view lobe_key(std::optional<NormalDistribution> distribution) {
  if (distribution == NormalDistribution::blinn_phong) return "exponent";
  return distribution == NormalDistribution::vmf ? "kappa" : "alpha";
}

/// The one of exponent, alpha and kappa that the table has, if any; it must be the distribution's own.
std::optional<std::string_view> find_lobe(const TomlTable& table, std::optional<NormalDistribution> distribution) {
  std::optional<std::string_view> found;
  for (const std::string_view key : {"exponent", "alpha", "kappa"}) {
    if (!table.has(key)) continue;
    if (found) throw table.error_at(key, "is one lobe parameter too many", "give one of exponent, alpha, kappa");
    if (key != lobe_key(distribution)) {
      throw table.error_at(key, "does not belong to the distribution",
                           "exponent: blinn_phong; alpha: beckmann, ggx; kappa: vmf");
    }
    found = key;
  }
  return found;
}

std::optional<float> read_lobe(const TomlTable& table, std::optional<NormalDistribution> distribution) {
  const auto key = find_lobe(table, distribution);
  if (!key) return std::nullopt;
  return static_cast<float>(*table.number(*key, lobe_range(distribution.value_or(NormalDistribution::ggx))));
}

glm::vec3 read_axis(const TomlTable& table) {
  const glm::dvec3 axis = required(table, "axis", read_direction(table, "axis"));
  if (axis.z < lowest_axis) {
    throw table.error_at("axis", "does not rise above the horizon",
                         "its z is along the normal: [0.7, 0, 0.7] leans by 45 degrees");
  }
  return glm::vec3{axis};
}

/// The lobes of [[brdf.lobe]]: all with weights, or none, which gives equal weights that sum to one.
std::vector<FacetLobe> read_lobes(const TomlTable& brdf, std::optional<NormalDistribution> distribution) {
  std::vector<FacetLobe> lobes;
  const auto tables = brdf.tables("lobe", {"axis", "exponent", "alpha", "kappa", "weight"});
  if (tables.size() > most_facet_lobes) {
    throw brdf.error_at("lobe",
                        fmt::format("appears {} times; at most {} lobes are allowed", tables.size(), most_facet_lobes),
                        "leave out the weakest");
  }
  for (const TomlTable& table : tables) {
    const float parameter = required(table, lobe_key(distribution), read_lobe(table, distribution));
    if (table.has("weight") != tables.front().has("weight")) {
      throw table.error_at("weight", "is given for some lobes only", "give every lobe a weight, or none");
    }
    const double equal = 1.0 / static_cast<double>(tables.size());
    lobes.push_back(
        {read_axis(table), parameter, static_cast<float>(table.number("weight", lobe_weight).value_or(equal))});
  }
  return lobes;
}

// Ward's BRDF is Beckmann's distribution with a geometry term of its own.
constexpr std::size_t ward_distribution = 4;

/// The settings that all parts share.
BrdfSettings read_common_brdf(const TomlTable& table) {
  BrdfSettings brdf;
  const auto distribution = table.choice("distribution", {"blinn_phong", "beckmann", "ggx", "vmf", "ward"});
  assign(brdf.geometry, table.choice("geometry", {"none", "tan", "smith"}));
  if (distribution == ward_distribution) {
    if (brdf.geometry)
      throw table.error_at("geometry", "excludes Ward's distribution, which has its own", "leave it out");
    brdf.distribution = NormalDistribution::beckmann;
    brdf.geometry = GeometryTerm::ward;
  } else {
    assign(brdf.distribution, distribution);
  }
  assign(brdf.fresnel, table.choice("fresnel", {"none", "schlick"}));
  brdf.diffuse = table.boolean("diffuse");
  return brdf;
}

// Anisotropy by its strength, with the lobe's own alpha across its direction.
std::optional<Anisotropy> read_anisotropy(const TomlTable& table) {
  const auto strength = table.number("anisotropy", unit_range);
  const auto degrees = table.number("anisotropy_rotation_degrees", {-360.0, 360.0});
  if (!strength && !degrees) return std::nullopt;
  if (!strength && !table.has("alpha_x")) refuse_missing(table, "anisotropy");
  return Anisotropy{static_cast<float>(strength.value_or(0.0)),
                    static_cast<float>(degrees.value_or(0.0) * std::numbers::pi / 180.0)};
}

// The lobe by alpha along the tangent and along the bitangent, before any rotation: the strength that leads from the
// smaller to the larger one.
void read_two_alphas(const TomlTable& table, BrdfSettings& brdf) {
  const auto x = table.number("alpha_x", lobe_range(NormalDistribution::ggx));
  const auto y = table.number("alpha_y", lobe_range(NormalDistribution::ggx));
  if (!x && !y) return;
  for (const char* other : {"alpha", "anisotropy"}) {
    if (table.has(other)) throw table.error_at(other, "excludes `alpha_x` and `alpha_y`", "give one of the two forms");
  }
  const auto [across, along] = std::minmax({required(table, "alpha_x", x), required(table, "alpha_y", y)});
  Anisotropy stretch = brdf.anisotropy.value_or(Anisotropy{});
  if (along > across) stretch.strength = static_cast<float>(std::sqrt((along - across) / (1.0 - across)));
  if (*y > *x) stretch.rotation += static_cast<float>(0.5 * std::numbers::pi);
  brdf.lobe_parameter = static_cast<float>(across);
  brdf.anisotropy = stretch;
}

// The key that makes a lobe anisotropic, if there is one.
std::optional<std::string_view> anisotropy_key(const TomlTable& table) {
  for (const std::string_view key : {"anisotropy", "alpha_x", "alpha_y", "anisotropy_rotation_degrees"}) {
    if (table.has(key)) return key;
  }
  return std::nullopt;
}

bool can_be_stretched(NormalDistribution distribution) {
  return distribution == NormalDistribution::ggx || distribution == NormalDistribution::beckmann;
}

/// The settings of one part, next to the `common` ones.
BrdfSettings read_own_brdf(const TomlTable& table, const BrdfSettings& common) {
  BrdfSettings brdf = common;
  if (const auto key = anisotropy_key(table)) {
    if (!can_be_stretched(brdf.distribution.value_or(NormalDistribution::ggx)))
      throw table.error_at(*key, "needs the distribution ggx, beckmann or ward", "leave it out, or give one of them");
    if (table.has("lobe")) throw table.error_at(*key, "excludes [[brdf.lobe]]", "give one of them");
  }
  brdf.lobe_parameter = read_lobe(table, brdf.distribution);
  brdf.anisotropy = read_anisotropy(table);
  read_two_alphas(table, brdf);
  brdf.lobes = read_lobes(table, brdf.distribution);
  if (brdf.lobe_parameter && !brdf.lobes.empty()) {
    throw table.error_at("lobe", "excludes a lobe parameter of [brdf]", "give each lobe its own alone");
  }
  brdf.specular = read_color(table, "specular");
  brdf.base_color = read_color(table, "base_color");
  return brdf;
}

std::optional<MapFile> read_map(const TomlTable& maps, std::string_view key, const std::filesystem::path& folder) {
  const auto table = maps.table(key, {"file", "uv"});
  if (!table) return std::nullopt;
  return MapFile{required(*table, "file", read_path(*table, "file", folder)), read_pair(*table, "uv", repeats)};
}

// The normals that replace those of all materials: `normal` or `height`.
std::optional<NormalFile> read_laid_normals(const TomlTable& maps, const std::filesystem::path& folder) {
  const auto heights = maps.table("height", {"file", "uv", "scale", "slope_filter", "wrap"});
  const auto normals = maps.table("normal", {"file", "uv", "scale", "channels"});
  if (heights && normals) throw maps.error_at("height", "excludes `normal`", "give one of the two");
  if (!heights && !normals) return std::nullopt;
  NormalFile laid;
  if (heights) {
    laid = read_heights(*heights, folder);
  } else {
    laid.path = required(*normals, "file", read_path(*normals, "file", folder));
    assign(laid.scale, normals->number("scale", slope_factors));
    assign(laid.channels, read_word(*normals, "channels", normal_channels));
  }
  laid.uv = read_pair(heights ? *heights : *normals, "uv", repeats);
  return laid;
}

MapSettings read_maps(const TomlTable& table, const BrdfSettings& brdf, const std::filesystem::path& folder) {
  MapSettings maps;
  const auto lobe = find_lobe(table, brdf.distribution);
  const auto refuse_width = [&](bool refused, const std::string& message, const std::string& hint) {
    const std::string_view key = lobe.value_or("roughness");
    if (refused && table.has(key)) throw table.error_at(key, message, hint);
  };
  refuse_width(lobe && table.has("roughness"), "excludes a map of roughness", "give one of the two");
  refuse_width(brdf.lobe_parameter.has_value(), "excludes a lobe parameter of [brdf]", "leave one of them out");
  refuse_width(!brdf.lobes.empty(), "excludes [[brdf.lobe]]", "lobes have their own parameters: leave one of them out");
  if (table.has("normal_kappa") && !brdf.lobes.empty())
    throw table.error_at("normal_kappa", "excludes [[brdf.lobe]]", "give the facets one lobe, or leave the map out");
  if (lobe) maps.lobe_parameter = read_map(table, *lobe, folder);
  maps.roughness = read_map(table, "roughness", folder);
  maps.specular = read_map(table, "specular", folder);
  maps.diffuse = read_map(table, "diffuse", folder);
  maps.normals = read_laid_normals(table, folder);
  maps.normal_kappa = read_map(table, "normal_kappa", folder);
  maps.material = read_map(table, "material", folder);
  return maps;
}

/// The key `parameters`, with each number and word checked.
std::map<std::string, std::string> read_parameters(const TomlTable& table, const std::vector<OptionSpec>& specs) {
  std::vector<std::string> names;
  names.reserve(specs.size());
  for (const OptionSpec& spec : specs) names.push_back(spec.name);
  std::map<std::string, std::string> given;
  const auto parameters = table.table("parameters", names);
  if (!parameters) return given;
  for (const OptionSpec& spec : specs) {
    if (!spec.choices.empty()) {
      if (const auto i = parameters->choice(spec.name, spec.choices)) given[spec.name] = spec.choices[*i];
    } else if (spec.integer) {
      if (const auto number = parameters->whole_number(spec.name, {spec.minimum, spec.maximum})) {
        given[spec.name] = fmt::format("{}", *number);
      }
    } else if (const auto number = parameters->number(spec.name, {spec.minimum, spec.maximum})) {
      given[spec.name] = fmt::format("{}", *number);
    }
  }
  return given;
}

SurfaceContent read_surface(const TomlTable& table, std::span<const Surface> surfaces) {
  std::vector<std::string> names;
  for (const Surface& surface : surfaces) names.push_back(surface.name);
  const Surface& surface = surfaces[required(table, "name", table.choice("name", names))];
  SurfaceSettings settings = surface_settings(surface, read_parameters(table, surface.parameters));
  assign(settings.resolution, table.whole_number("resolution", {1.0, largest_surface_resolution}));
  assign(settings.seed, table.whole_number("seed", seed_range));
  return {&surface, std::move(settings)};
}

WardSettings read_ward(const TomlTable& table) {
  WardSettings ward;
  assign(ward.alpha, table.number("alpha", {1e-2, 1.0}));
  assign(ward.specular, read_color(table, "specular"));
  assign(ward.diffuse, read_color(table, "diffuse"));
  return ward;
}

MicrogeometrySettings read_microgeometry(const TomlTable& table, const std::filesystem::path& folder) {
  if (table.has("kind") == table.has("model")) {
    throw table.error_at("kind", "or `model` must be given, and only one of them", "add kind = \"weave\"");
  }
  MicrogeometrySettings settings;
  std::vector<std::string> names;
  for (const PatchKind& kind : patch_kinds()) names.push_back(kind.name);
  if (const auto index = table.choice("kind", names)) {
    settings.kind = &patch_kinds()[*index];
    settings.parameters = read_parameters(table, settings.kind->parameters);
  } else {
    settings.model = folder / *table.word("model");
    if (table.has("parameters")) throw table.error_at("parameters", "belongs to a kind", "leave it out");
  }
  assign(settings.period, read_pair(table, "period", length_range));
  if (settings.period && settings.kind != nullptr) throw table.error_at("period", "belongs to a model", "leave it out");
  settings.measured = read_path(table, "measured", folder);
  if (const auto ward = table.table("ward", {"alpha", "specular", "diffuse"})) {
    if (settings.measured) throw table.error_at("ward", "excludes `measured`", "give one of the two");
    settings.ward = read_ward(*ward);
  }
  assign(settings.seed, table.whole_number("seed", seed_range));
  assign(settings.resolution, table.whole_number("resolution", {1.0, 4096.0}));
  return settings;
}

// [microgeometry], or several [[microgeometry]] with the map that chooses among them.
std::vector<MicrogeometrySettings> read_patches(const TomlTable& table, const MapSettings& maps,
                                                const std::filesystem::path& folder) {
  const std::vector<std::string> keys{"kind", "model", "period",     "measured",
                                      "ward", "seed",  "resolution", "parameters"};
  std::vector<MicrogeometrySettings> patches;
  if (table.is_table("microgeometry")) {
    patches.push_back(read_microgeometry(*table.table("microgeometry", keys), folder));
  } else {
    const auto several = table.tables("microgeometry", keys);
    for (const TomlTable& one : several) patches.push_back(read_microgeometry(one, folder));
  }
  if (patches.size() > most_surface_materials) {
    throw table.error_at(
        "microgeometry",
        fmt::format("appears {} times; a map of indices has at most {}", patches.size(), most_surface_materials),
        "leave some out");
  }
  if (patches.size() > 1 && !maps.material) {
    throw table.error_at("microgeometry", "appears several times without a map of indices",
                         "add [maps] material = { file = \"INDICES.png\" }");
  }
  if (patches.size() < 2 && maps.material) {
    throw table.error_at("maps", "has a map of indices and nothing that it could choose among",
                         "write several [[microgeometry]]");
  }
  return patches;
}

Placement read_placement(const TomlTable& table) {
  Placement placement;
  assign(placement.translation, read_vector(table, "translate", coordinate_range));
  assign(placement.rotation, read_vector(table, "rotate_degrees", {-360.0, 360.0}));
  placement.rotation = glm::radians(placement.rotation);
  assign(placement.scale, table.number("scale", length_range));
  return placement;
}

void read_content(const TomlTable& table, const std::filesystem::path& folder, std::span<const Surface> surfaces,
                  PartSettings& part) {
  const auto model =
      table.table("model", {"file", "files", "package", "unwrap", "scene", "camera", "variant", "animation", "time"});
  const auto plane = table.table("plane", {"size", "normal_map", "normal_channels", "normal_scale", "height_map",
                                           "base_color_map", "metallic_roughness_map", "roughness", "metallic"});
  const auto surface = table.table("surface", surface_keys);
  if (!model && !plane && !surface) {
    throw table.error_at("model", "or `plane` or `surface` must be given", "add model = { file = \"NAME.gltf\" }");
  }
  if (plane && (model || surface)) {
    throw table.error_at("plane", "excludes `model` and `surface`", "give one of them, or each its own [[part]]");
  }
  if (model) part.model = read_model(*model, folder);
  if (plane) part.plane = read_plane(*plane, folder);
  if (surface) part.surface = read_surface(*surface, surfaces);
}

const std::vector<std::string> common_brdf_keys{"distribution", "geometry", "fresnel", "diffuse"};
const std::vector<std::string> own_brdf_keys{
    "exponent", "alpha",      "kappa", "alpha_x", "alpha_y", "anisotropy", "anisotropy_rotation_degrees",
    "specular", "base_color", "lobe"};

LayerSettings read_layer(const TomlTable& table, const std::filesystem::path& folder,
                         std::span<const Surface> surfaces) {
  const auto surface = table.table("surface", surface_keys);
  if (table.has("bump_map") + table.has("normal_map") + surface.has_value() != 1) {
    throw table.error_at("bump_map", "or `normal_map` or `surface` must be given, and only one of them",
                         "name the file of heights or of normals, or a surface");
  }
  LayerSettings layer;
  if (surface) layer.content = read_surface(*surface, surfaces);
  assign(layer.uv, read_pair(table, "uv", repeats));
  assign(layer.strength, table.number("strength", slope_factors));
  const auto filter = read_word(table, "slope_filter", slope_filters);
  if (const auto file = read_path(table, "normal_map", folder)) layer.content = NormalFile{*file, layer.strength};
  if (const auto file = read_path(table, "bump_map", folder)) {
    if (!table.has("strength")) refuse_missing(table, "strength");  // as the scale of read_heights
    layer.content = NormalFile{.path = *file,
                               .scale = layer.strength,
                               .heights = HeightSettings{.filter = filter.value_or(SlopeFilter::central)}};
  } else if (filter) {
    throw table.error_at("slope_filter", "belongs to a `bump_map`", "leave it out");
  }
  return layer;
}

CoatSettings read_coat(const TomlTable& table, const std::filesystem::path& folder) {
  CoatSettings coat;
  assign(coat.weight, table.number("weight", unit_range));
  assign(coat.roughness, table.number("roughness", unit_range));
  coat.normals = read_normals(table, folder);
  return coat;
}

// A normal map of [maps] replaces a model's, but not one that the same file describes.
void require_no_normals(const TomlTable& part, const TomlTable& maps, const std::optional<PlaneSettings>& plane) {
  const std::string_view key = maps.has("height") ? "height" : "normal";
  if (plane && plane->normals)
    throw maps.error_at(key, "excludes the `normal_map` or `height_map` of [plane]", "give one of them");
  for (const char* other : {"surface", "microgeometry"}) {
    if (part.has(other))
      throw maps.error_at(key, fmt::format("excludes [{}], which has normals of its own", other), "give one of them");
  }
}

// Patches and spreads within a texel are of round lobes.
void require_round_lobes(const TomlTable& table, const PartSettings& part) {
  if (!part.brdf.anisotropy || part.brdf.anisotropy->strength == 0.0F) return;
  if (!part.microgeometry.empty())
    throw table.error_at("microgeometry", "excludes anisotropy in [brdf]", "give one of them");
  if (part.maps.normal_kappa)
    throw table.error_at("maps", "with `normal_kappa` excludes anisotropy in [brdf]", "give one of them");
}

/// A part's content, layer, maps, coat and tiling, with a BRDF that is read already.
PartSettings read_part(const TomlTable& table, const BrdfSettings& brdf, const std::filesystem::path& folder,
                       std::span<const Surface> surfaces) {
  PartSettings part;
  read_content(table, folder, surfaces, part);
  part.brdf = brdf;
  if (const auto layer =
          table.table("layer", {"bump_map", "slope_filter", "normal_map", "surface", "uv", "strength"})) {
    part.layer = read_layer(*layer, folder, surfaces);
  }
  if (const auto maps = table.table("maps", {"roughness", "exponent", "alpha", "kappa", "specular", "diffuse", "normal",
                                             "height", "normal_kappa", "material"})) {
    part.maps = read_maps(*maps, part.brdf, folder);
    if (part.maps.normals) require_no_normals(table, *maps, part.plane);
    if (part.maps.normal_kappa && table.has("microgeometry")) {
      throw maps->error_at("normal_kappa", "excludes [microgeometry], whose facets spread the normals",
                           "give one of them");
    }
  }
  if (const auto coat = table.table("clear_coat", {"weight", "roughness", "normal_map", "height_map"}))
    part.coat = read_coat(*coat, folder);
  part.microgeometry = read_patches(table, part.maps, folder);
  require_round_lobes(table, part);
  if (const auto tiling = table.table("tiling", {"uv"})) assign(part.tiling, read_pair(*tiling, "uv", repeats));
  return part;
}

/// The file itself as the only part.
PartSettings read_only_part(const TomlTable& root, const std::filesystem::path& folder,
                            std::span<const Surface> surfaces) {
  std::vector<std::string> keys = common_brdf_keys;
  keys.insert(keys.end(), own_brdf_keys.begin(), own_brdf_keys.end());
  const auto brdf = root.table("brdf", keys);
  return read_part(root, brdf ? read_own_brdf(*brdf, read_common_brdf(*brdf)) : BrdfSettings{}, folder, surfaces);
}

}  // namespace

NumberRange lobe_range(NormalDistribution distribution) {
  return lobe_key(distribution) == "alpha" ? NumberRange{smallest_alpha, 1.0} : NumberRange{1e-3, 1e6};
}

const std::vector<std::string>& part_root_keys() {
  static const std::vector<std::string> keys{"part", "model", "plane",      "surface",       "layer",
                                             "brdf", "maps",  "clear_coat", "microgeometry", "tiling"};
  return keys;
}

std::vector<PartSettings> read_parts(const TomlTable& root, const std::filesystem::path& folder,
                                     std::span<const Surface> surfaces) {
  if (!root.has("part")) return {read_only_part(root, folder, surfaces)};
  for (const char* key : {"model", "plane", "surface", "layer", "maps", "clear_coat", "microgeometry", "tiling"}) {
    if (root.has(key)) throw root.error_at(key, "excludes [[part]]", "move it into a [[part]]");
  }
  const auto common_table = root.table("brdf", common_brdf_keys);
  const BrdfSettings common = common_table ? read_common_brdf(*common_table) : BrdfSettings{};
  std::vector<PartSettings> parts;
  for (const TomlTable& table : root.tables("part", {"name", "model", "plane", "surface", "layer", "brdf", "maps",
                                                     "clear_coat", "microgeometry", "tiling", "place"})) {
    const auto own = table.table("brdf", own_brdf_keys);
    PartSettings& part =
        parts.emplace_back(read_part(table, own ? read_own_brdf(*own, common) : common, folder, surfaces));
    part.name = table.word("name").value_or("");
    if (const auto place = table.table("place", {"translate", "rotate_degrees", "scale"})) {
      part.placement = read_placement(*place);
    }
  }
  if (parts.empty()) throw root.error_at("part", "is empty", "write at least one [[part]]");
  return parts;
}

}  // namespace footprint
