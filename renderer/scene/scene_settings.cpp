// See scene_settings.hpp.
#include "renderer/scene/scene_settings.hpp"

#include <fmt/format.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "renderer/scene/toml_table.hpp"

namespace footprint {
namespace {

constexpr NumberRange unit{0.0, 1.0};
constexpr NumberRange length{1e-6, 1e6};          // metres, above 0
constexpr NumberRange coordinate{-1e9, 1e9};      // metres
constexpr NumberRange intensity{0.0, 1e12};       // candela or lux
constexpr NumberRange field_of_view{0.1, 170.0};  // degrees
constexpr NumberRange repeats{1e-3, 1e4};         // of a map along u or v
constexpr NumberRange lobe_weight{1e-6, 1e3};

constexpr double lowest_axis = 1e-3;  // a lobe on the horizon would lie below it half of the time

const std::vector<std::string> light_types{"point", "spot", "directional"};

float radians(double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180.0); }

std::optional<glm::dvec3> vector3(const TomlTable& table, std::string_view key, NumberRange range) {
  const auto values = table.numbers(key, 3, range);
  if (!values) return std::nullopt;
  return glm::dvec3{(*values)[0], (*values)[1], (*values)[2]};
}

std::optional<glm::vec3> color(const TomlTable& table, std::string_view key) {
  const auto value = vector3(table, key, unit);
  if (!value) return std::nullopt;
  return glm::vec3{*value};
}

/// A unit vector.
std::optional<glm::dvec3> direction(const TomlTable& table, std::string_view key) {
  const auto value = vector3(table, key, coordinate);
  if (!value) return std::nullopt;
  if (glm::length(*value) < 1e-9) throw table.error_at(key, "has no length", "give a direction such as [0, 0, 1]");
  return glm::normalize(*value);
}

[[noreturn]] void missing(const TomlTable& table, std::string_view key) {
  throw table.error_at(key, "is missing", "add it (docs/scenes.md)");
}

ModelSettings read_model(const TomlTable& table, const std::filesystem::path& folder) {
  if (table.has("file") == table.has("files")) {
    throw table.error_at("file", "or `files` must be given, and only one of them", "name the glTF file to draw");
  }
  ModelSettings model;
  const auto files = table.has("file") ? std::vector{*table.word("file")} : *table.words("files");
  for (const std::string& name : files) model.candidates.push_back(folder / name);
  model.package = table.word("package").value_or("");
  return model;
}

PlaneSettings read_plane(const TomlTable& table, const std::filesystem::path& folder) {
  PlaneSettings plane;
  if (const auto size = table.numbers("size", 2, length)) plane.size = {(*size)[0], (*size)[1]};
  const auto file = [&](std::string_view key) -> std::optional<std::filesystem::path> {
    const auto name = table.word(key);
    return name ? std::optional{folder / *name} : std::nullopt;
  };
  plane.normal_map = file("normal_map");
  plane.base_color_map = file("base_color_map");
  plane.metallic_roughness_map = file("metallic_roughness_map");
  plane.normal_scale = table.number("normal_scale", {-100.0, 100.0}).value_or(plane.normal_scale);
  plane.roughness = static_cast<float>(table.number("roughness", unit).value_or(plane.roughness));
  plane.metallic = static_cast<float>(table.number("metallic", unit).value_or(plane.metallic));
  return plane;
}

// What the parameter of a distribution's lobe is called.
std::string_view lobe_key(NormalDistribution distribution) {
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return "exponent";
    case NormalDistribution::vmf:
      return "kappa";
    case NormalDistribution::beckmann:
    case NormalDistribution::ggx:
      break;
  }
  return "alpha";
}

/// The one of exponent, alpha and kappa that the table has, if any; it must be the distribution's own.
std::optional<std::string_view> find_lobe(const TomlTable& table, std::optional<NormalDistribution> distribution) {
  std::optional<std::string_view> found;
  for (const std::string_view key : {"exponent", "alpha", "kappa"}) {
    if (!table.has(key)) continue;
    if (found) throw table.error_at(key, "is one lobe parameter too many", "give one of exponent, alpha, kappa");
    if (key != lobe_key(distribution.value_or(NormalDistribution::ggx))) {
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
  const auto axis = direction(table, "axis");
  if (!axis) missing(table, "axis");
  if (axis->z < lowest_axis) {
    throw table.error_at("axis", "does not rise above the horizon",
                         "its z is along the normal: [0.7, 0, 0.7] leans by 45 degrees");
  }
  return glm::vec3{*axis};
}

/// The lobes of [[brdf.lobe]]: all with a weight, or none, and then the weights are equal and sum to one.
std::vector<FacetLobe> read_lobes(const TomlTable& brdf, std::optional<NormalDistribution> distribution) {
  std::vector<FacetLobe> lobes;
  const auto tables = brdf.tables("lobe", {"axis", "exponent", "alpha", "kappa", "weight"});
  if (tables.size() > most_facet_lobes) {
    throw brdf.error_at("lobe", fmt::format("are {}, more than the {} there may be", tables.size(), most_facet_lobes),
                        "leave out the weakest");
  }
  for (const TomlTable& table : tables) {
    const auto parameter = read_lobe(table, distribution);
    if (!parameter) missing(table, lobe_key(distribution.value_or(NormalDistribution::ggx)));
    if (table.has("weight") != tables.front().has("weight")) {
      throw table.error_at("weight", "stands in some lobes and not in others", "give every lobe a weight, or none");
    }
    const double equal = 1.0 / static_cast<double>(tables.size());
    lobes.push_back(
        {read_axis(table), *parameter, static_cast<float>(table.number("weight", lobe_weight).value_or(equal))});
  }
  return lobes;
}

BrdfSettings read_brdf(const TomlTable& table) {
  BrdfSettings brdf;
  if (const auto i = table.choice("distribution", {"blinn_phong", "beckmann", "ggx", "vmf"})) {
    brdf.distribution = static_cast<NormalDistribution>(*i);
  }
  if (const auto i = table.choice("geometry", {"none", "tan", "smith"})) brdf.geometry = static_cast<GeometryTerm>(*i);
  if (const auto i = table.choice("fresnel", {"none", "schlick"})) brdf.fresnel = static_cast<FresnelTerm>(*i);
  brdf.diffuse = table.boolean("diffuse");
  brdf.lobe_parameter = read_lobe(table, brdf.distribution);
  brdf.lobes = read_lobes(table, brdf.distribution);
  if (brdf.lobe_parameter && !brdf.lobes.empty()) {
    throw table.error_at("lobe", "excludes a lobe parameter of [brdf]", "give each lobe its own alone");
  }
  brdf.specular = color(table, "specular");
  brdf.base_color = color(table, "base_color");
  return brdf;
}

std::optional<MapFile> read_map(const TomlTable& maps, std::string_view key, const std::filesystem::path& folder) {
  const auto table = maps.table(key, {"file", "uv"});
  if (!table) return std::nullopt;
  const auto name = table->word("file");
  if (!name) missing(*table, "file");
  MapFile map{folder / *name, std::nullopt};
  if (const auto uv = table->numbers("uv", 2, repeats)) map.uv = {(*uv)[0], (*uv)[1]};
  return map;
}

MapSettings read_maps(const TomlTable& table, const BrdfSettings& brdf, const std::filesystem::path& folder) {
  MapSettings maps;
  const auto lobe = find_lobe(table, brdf.distribution);
  const auto refuse_width = [&](bool refused, const std::string& message, const std::string& mend) {
    const std::string_view key = lobe.value_or("roughness");
    if (refused && table.has(key)) throw table.error_at(key, message, mend);
  };
  refuse_width(lobe && table.has("roughness"), "excludes a map of roughness", "give one of the two");
  refuse_width(brdf.lobe_parameter.has_value(), "excludes a lobe parameter of [brdf]", "leave one of them out");
  refuse_width(!brdf.lobes.empty(), "excludes [[brdf.lobe]]", "lobes have their own parameters: leave one of them out");
  if (lobe) maps.lobe_parameter = read_map(table, *lobe, folder);
  maps.roughness = read_map(table, "roughness", folder);
  maps.specular = read_map(table, "specular", folder);
  maps.diffuse = read_map(table, "diffuse", folder);
  return maps;
}

void read_frame(const TomlTable& table, SceneSettings& settings) {
  if (const auto size = table.numbers("size", 2, {1.0, 65536.0})) {
    if ((*size)[0] != std::floor((*size)[0]) || (*size)[1] != std::floor((*size)[1])) {
      throw table.error_at("size", "must be whole numbers of pixels", "write it as [512, 512]");
    }
    settings.frame_size = glm::ivec2{static_cast<int>((*size)[0]), static_cast<int>((*size)[1])};
  }
  if (table.is_word("exposure")) {
    settings.automatic_exposure = table.choice("exposure", {"auto"}).has_value();
  } else if (const auto exposure = table.number("exposure", {1e-9, 1e9})) {
    settings.exposure = static_cast<float>(*exposure);
  }
}

/// Rejects keys that another type of light has.
void reject(const TomlTable& table, std::initializer_list<std::string_view> keys, const std::string& type) {
  for (const std::string_view key : keys) {
    if (table.has(key)) throw table.error_at(key, "does not belong to a " + type + " light", "leave it out");
  }
}

SpotLight read_spot(const TomlTable& table, const PointLight& point, const glm::dvec3& towards) {
  constexpr NumberRange cone{0.0, 90.0};
  SpotLight spot{point, glm::vec3{towards}};
  spot.inner_cone_angle = radians(table.number("inner_cone_degrees", cone).value_or(0.0));
  spot.outer_cone_angle = radians(table.number("outer_cone_degrees", cone).value_or(45.0));
  if (spot.inner_cone_angle >= spot.outer_cone_angle) {
    throw table.error_at("inner_cone_degrees", "must be less than outer_cone_degrees", "swap or change them");
  }
  return spot;
}

Light read_light(const TomlTable& table) {
  const auto type = table.choice("type", light_types);
  if (!type) missing(table, "type");
  const double strength = table.number("intensity", intensity).value_or(1.0);
  const glm::vec3 power = color(table, "color").value_or(glm::vec3{1.0F}) * static_cast<float>(strength);
  const bool needs_direction = *type != 0;
  const auto towards = direction(table, "direction");
  if (needs_direction && !towards) missing(table, "direction");
  if (*type != 1) reject(table, {"inner_cone_degrees", "outer_cone_degrees"}, light_types[*type]);
  if (*type == 2) {
    reject(table, {"position", "range"}, light_types[*type]);
    return DirectionalLight{glm::vec3{*towards}, power};
  }
  const auto position = vector3(table, "position", coordinate);
  if (!position) missing(table, "position");
  PointLight point{glm::vec3{*position}, power, std::nullopt};
  if (const auto range = table.number("range", length)) point.range = static_cast<float>(*range);
  if (*type == 1) return read_spot(table, point, *towards);
  reject(table, {"direction"}, light_types[*type]);
  return point;
}

Camera read_placed_camera(const TomlTable& table) {
  const auto position = vector3(table, "position", coordinate), target = vector3(table, "target", coordinate);
  if (!position) missing(table, "position");
  if (!target) missing(table, "target");
  if (glm::length(*position - *target) < 1e-9) {
    throw table.error_at("target", "is where the camera stands", "move one of them");
  }
  Camera camera;
  camera.world = look_at(*position, *target, direction(table, "up").value_or(glm::dvec3{0.0, 1.0, 0.0}));
  camera.yfov = radians(table.number("yfov_degrees", field_of_view).value_or(34.4));
  const double distance = glm::length(*position - *target);
  camera.znear = static_cast<float>(table.number("znear", length).value_or(0.01 * distance));
  if (const auto zfar = table.number("zfar", length)) {
    if (*zfar <= camera.znear) throw table.error_at("zfar", "must be beyond znear", "make it larger");
    camera.zfar = static_cast<float>(*zfar);
  }
  return camera;
}

/// The parameters of [surface], each checked where it stands.
std::map<std::string, std::string> read_parameters(const TomlTable& table, const Surface& surface) {
  std::vector<std::string> names;
  for (const OptionSpec& spec : surface.parameters) names.push_back(spec.name);
  std::map<std::string, std::string> given;
  const auto parameters = table.table("parameters", names);
  if (!parameters) return given;
  for (const OptionSpec& spec : surface.parameters) {
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
  const auto place = table.choice("name", names);
  if (!place) missing(table, "name");
  const Surface& surface = surfaces[*place];
  SurfaceSettings settings = surface_settings(surface, read_parameters(table, surface));
  if (const auto resolution = table.whole_number("resolution", {1.0, largest_surface_resolution})) {
    settings.resolution = static_cast<int>(*resolution);
  }
  if (const auto seed = table.whole_number("seed", {0.0, std::numeric_limits<std::uint32_t>::max()})) {
    settings.seed = static_cast<std::uint32_t>(*seed);
  }
  return {&surface, std::move(settings)};
}

/// What is drawn: exactly one of the three.
void read_content(const TomlTable& root, const std::filesystem::path& folder, std::span<const Surface> surfaces,
                  SceneSettings& settings) {
  const auto model = root.table("model", {"file", "files", "package"});
  const auto plane = root.table("plane", {"size", "normal_map", "normal_scale", "base_color_map",
                                          "metallic_roughness_map", "roughness", "metallic"});
  const auto surface = root.table("surface", {"name", "resolution", "seed", "parameters"});
  if (model.has_value() + plane.has_value() + surface.has_value() != 1) {
    throw root.error_at("model", "or `plane` or `surface` must be given, and only one of them",
                        "add [model] file = \"NAME.gltf\"");
  }
  if (model) settings.content = read_model(*model, folder);
  if (plane) settings.content = read_plane(*plane, folder);
  if (surface) settings.content = read_surface(*surface, surfaces);
  if (const auto brdf = root.table("brdf", {"distribution", "geometry", "fresnel", "diffuse", "exponent", "alpha",
                                            "kappa", "specular", "base_color", "lobe"})) {
    settings.brdf = read_brdf(*brdf);
  }
  if (const auto maps = root.table("maps", {"roughness", "exponent", "alpha", "kappa", "specular", "diffuse"})) {
    settings.maps = read_maps(*maps, settings.brdf, folder);
  }
  if (const auto tiling = root.table("tiling", {"uv"})) {
    if (const auto uv = tiling->numbers("uv", 2, repeats)) settings.tiling = {(*uv)[0], (*uv)[1]};
  }
}

void read_lights(const TomlTable& root, const std::filesystem::path& folder, SceneSettings& settings) {
  for (const TomlTable& light : root.tables("light", {"type", "position", "direction", "color", "intensity", "range",
                                                      "inner_cone_degrees", "outer_cone_degrees"})) {
    settings.lights.push_back(read_light(light));
  }
  if (const auto lights = root.table("lights", {"keep"})) {
    settings.keep_model_lights = lights->boolean("keep").value_or(true);
  }
  if (const auto environment = root.table("environment", environment_keys())) {
    settings.environment = read_environment(*environment, folder);
  }
}

void read_view(const TomlTable& root, SceneSettings& settings) {
  if (const auto frame = root.table("frame", {"size", "exposure"})) read_frame(*frame, settings);
  if (const auto camera = root.table("camera", camera_keys())) settings.camera = read_camera(*camera);
  if (const auto zoom = root.table("zoom", {"distances"})) {
    if (auto distances = zoom->numbers("distances", 0, {smallest_distance, largest_distance}))
      settings.distances = std::move(*distances);
  }
}

}  // namespace

NumberRange lobe_range(NormalDistribution distribution) {
  return lobe_key(distribution) == "alpha" ? NumberRange{1e-4, 1.0} : NumberRange{1e-3, 1e6};
}

const std::vector<std::string>& camera_keys() {
  static const std::vector<std::string> keys{"frame_bounds", "position", "target", "up",
                                             "yfov_degrees", "znear",    "zfar"};
  return keys;
}

CameraSettings read_camera(const TomlTable& table) {
  const auto framed = table.table("frame_bounds", {"direction", "fov_degrees", "margin"});
  if (!framed) return read_placed_camera(table);
  for (const char* key : {"position", "target", "up", "yfov_degrees", "znear", "zfar"}) {
    if (table.has(key)) throw table.error_at(key, "excludes frame_bounds", "give one or the other");
  }
  Framing framing;
  framing.direction = direction(*framed, "direction").value_or(framing.direction);
  if (const auto fov = framed->number("fov_degrees", field_of_view)) framing.yfov = radians(*fov);
  framing.margin = framed->number("margin", {0.01, 1000.0}).value_or(framing.margin);
  return framing;
}

SceneSettings read_scene_settings(const std::filesystem::path& file, std::span<const Surface> surfaces) {
  const toml::table parsed = parse_toml_file(file);
  const TomlTable root(parsed, file, "",
                       {"scene", "model", "plane", "surface", "brdf", "maps", "frame", "light", "lights", "environment",
                        "camera", "zoom", "tiling"});
  SceneSettings settings;
  if (const auto scene = root.table("scene", {"name", "description"})) {
    settings.name = scene->word("name");
    settings.description = scene->word("description").value_or("");
  }
  read_content(root, file.parent_path(), surfaces, settings);
  read_lights(root, file.parent_path(), settings);
  read_view(root, settings);
  return settings;
}

}  // namespace footprint
