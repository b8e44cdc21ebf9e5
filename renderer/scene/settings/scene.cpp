// Reads frame, lights, camera, zoom, shadows and environment; parts have their own reader.
#include "renderer/scene/settings/scene.hpp"

#include <algorithm>
#include <array>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/toml_table.hpp"
#include "renderer/scene/settings/toml_values.hpp"

namespace footprint {
namespace {

// The keys of a single kind.
struct OwnKeys {
  EnvironmentKind kind;
  std::vector<std::string> keys;
};

const std::vector<OwnKeys> own_keys{{EnvironmentKind::file, {"file", "files", "package"}},
                                    {EnvironmentKind::constant, {"color"}},
                                    {EnvironmentKind::sky, {"sun_direction"}}};
const std::vector<std::string> environment_keys{"kind",    "intensity", "rotation_degrees", "file", "files",
                                                "package", "color",     "sun_direction"};

EnvironmentKind read_kind(const TomlTable& table) {
  const auto choice = table.choice("kind", {"file", "constant", "sky"});
  const EnvironmentKind kind = choice ? static_cast<EnvironmentKind>(*choice) : EnvironmentKind::file;
  for (const OwnKeys& own : own_keys) {
    for (const std::string& key : own.keys) {
      if (own.kind != kind && table.has(key))
        throw table.error_at(key, "does not belong to an environment of this kind", "leave it out, or change `kind`");
    }
  }
  return kind;
}

void read_sky(const TomlTable& table, SkySettings& sky) {
  assign(sky.sun_direction, read_vector(table, "sun_direction", coordinate_range));
  const bool below = sky.sun_direction.y < 0.0;
  if (below || glm::length(sky.sun_direction) < 1e-9) {
    throw table.error_at("sun_direction", below ? "points below the horizon" : "has no length",
                         "give a direction towards the sun such as [0.4, 0.6, 0.7]");
  }
}

Environment unscaled(const EnvironmentSettings& settings, std::vector<std::string>& warnings) {
  if (settings.kind == EnvironmentKind::constant) return constant_environment(settings.color);
  if (settings.kind == EnvironmentKind::sky) return sky_environment(settings.sky);
  std::error_code ignored;  // opening the file will fail
  for (const auto& candidate : settings.candidates) {
    if (std::filesystem::exists(candidate, ignored)) return load_environment(candidate, warnings);
  }
  throw missing_candidates(settings.candidates, "no such environment", settings.package, "check the path");
}

constexpr NumberRange intensity{0.0, 1e12};       // candela or lux
constexpr NumberRange field_of_view{0.1, 170.0};  // degrees
constexpr NumberRange shadow_resolution{smallest_shadow_map, largest_shadow_map};

// Whether a one-sided triangle also blocks light from behind.
constexpr std::array<Word<bool>, 2> shadow_sides{{{false, "drawn"}, {true, "both"}}};

constexpr auto horizons = std::to_array<Word<Horizon>>({{Horizon::cut, "cut"}, {Horizon::open, "open"}});

const std::vector<std::string> light_types{"point", "spot", "directional", "rectangle", "disk", "sphere"};

// The keys of each type besides `type`, `color` and `intensity`.
const std::vector<std::vector<std::string>> light_keys{
    {"position", "range"},
    {"position", "direction", "range", "inner_cone_degrees", "outer_cone_degrees"},
    {"direction"},
    {"position", "direction", "up", "size", "integral", "points"},
    {"position", "direction", "radius", "integral", "points"},
    {"position", "radius", "integral", "points"}};

constexpr std::array area_shapes{AreaShape::rectangle, AreaShape::disk, AreaShape::sphere};  // the types from 3 on

constexpr auto area_integrals =
    std::to_array<Word<AreaIntegral>>({{AreaIntegral::lobes, "lobes"}, {AreaIntegral::points, "points"}});
constexpr NumberRange area_size{0.0, 1e6};  // metres

float radians(double degrees) { return static_cast<float>(degrees * std::numbers::pi / 180.0); }

void read_frame(const TomlTable& table, SceneSettings& settings) {
  if (const auto size = read_pair(table, "size", {1.0, 65536.0})) {
    settings.scene.frame_size = glm::ivec2(*size);
    if (glm::dvec2(*settings.scene.frame_size) != *size)
      throw table.error_at("size", "must be whole numbers of pixels", "write it as [512, 512]");
  }
  if (const auto filter = table.word("footprint")) {
    settings.scene.footprint = at_key(table, "footprint", [&] { return parse_footprint_filter(*filter, ""); });
  }
  if (table.is_word("exposure")) {
    settings.automatic_exposure = table.choice("exposure", {"auto"}).has_value();
  } else {
    assign(settings.scene.exposure, table.number("exposure", {1e-9, 1e9}));
  }
}

/// Rejects keys that only another type of light has.
void reject_keys_of_others(const TomlTable& table, std::size_t type) {
  for (const std::vector<std::string>& keys : light_keys) {
    for (const std::string& key : keys) {
      if (table.has(key) && std::ranges::find(light_keys[type], key) == light_keys[type].end())
        throw table.error_at(key, "does not belong to a " + light_types[type] + " light", "leave it out");
    }
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

// Perpendicular to the direction of a light and as near to `up` as that allows.
glm::dvec3 upright(const TomlTable& table, const glm::dvec3& direction) {
  const auto given = read_direction(table, "up");
  const glm::dvec3 supplied =
      std::abs(direction.y) < 0.999 ? glm::dvec3(0.0, 1.0, 0.0) : glm::dvec3(0.0, 0.0, -1.0);  // a lamp in a ceiling
  const glm::dvec3 up = given.value_or(supplied);
  const glm::dvec3 across = glm::cross(up, direction);
  if (glm::length(across) < 1e-6)
    throw table.error_at("up", "is parallel to the direction of the light", "turn one of them");
  return glm::normalize(glm::cross(direction, across));
}

AreaLight read_area_light(const TomlTable& table, AreaShape shape, const glm::dvec3& direction) {
  AreaLight light{.shape = shape, .direction = glm::vec3(direction)};
  const bool is_round = shape != AreaShape::rectangle;
  const auto radius = table.number("radius", area_size);
  const auto size = read_pair(table, "size", area_size);
  if (is_round ? !radius : !size) refuse_missing(table, is_round ? "radius" : "size");
  light.half_size = glm::vec2(is_round ? glm::dvec2(*radius) : 0.5 * *size);
  const glm::dvec3 up = upright(table, direction);
  light.across = glm::vec3(glm::cross(up, direction));
  light.up = glm::vec3(up);
  assign(light.integral, read_word(table, "integral", area_integrals));
  assign(light.points, table.whole_number("points", {1.0, most_area_points}));
  return light;
}

Light read_light(const TomlTable& table) {
  const std::size_t type = required(table, "type", table.choice("type", light_types));
  reject_keys_of_others(table, type);
  const double strength = table.number("intensity", intensity).value_or(1.0);
  const glm::vec3 power = read_color(table, "color").value_or(glm::vec3{1.0F}) * static_cast<float>(strength);
  const auto towards = read_direction(table, "direction");
  const bool has_direction = std::ranges::find(light_keys[type], "direction") != light_keys[type].end();
  if (has_direction && !towards) refuse_missing(table, "direction");
  if (type == 2) return DirectionalLight{glm::vec3{*towards}, power};
  const glm::vec3 position{required(table, "position", read_vector(table, "position", coordinate_range))};
  if (type > 2) {
    AreaLight light = read_area_light(table, area_shapes.at(type - 3), towards.value_or(glm::dvec3(0.0, 0.0, -1.0)));
    light.position = position;
    light.intensity = power;
    return light;
  }
  PointLight point{position, power, std::nullopt};
  assign(point.range, table.number("range", length_range));
  if (type == 1) return read_spot(table, point, *towards);
  return point;
}

PlacedCamera read_placed_camera(const TomlTable& table) {
  PlacedCamera placed;
  placed.position = required(table, "position", read_vector(table, "position", coordinate_range));
  placed.target = required(table, "target", read_vector(table, "target", coordinate_range));
  assign(placed.up, read_direction(table, "up"));
  const double distance = glm::length(placed.position - placed.target);
  if (distance < 1e-9) {
    throw table.error_at("target", "equals the position of the camera", "move one of them");
  }
  Camera& camera = placed.lens;
  camera.yfov = radians(table.number("yfov_degrees", field_of_view).value_or(34.4));
  camera.znear = static_cast<float>(table.number("znear", length_range).value_or(0.01 * distance));
  const auto zfar = table.number("zfar", length_range);
  if (zfar && *zfar <= camera.znear) throw table.error_at("zfar", "must be beyond znear", "make it larger");
  assign(camera.zfar, zfar);
  return placed;
}

EnvironmentSettings read_environment(const TomlTable& table, const std::filesystem::path& folder) {
  EnvironmentSettings settings;
  settings.kind = read_kind(table);
  if (settings.kind == EnvironmentKind::file) {
    settings.candidates = read_candidates(table, folder, R"(name the image, or give kind = "constant" or "sky")");
    settings.package = table.word("package").value_or("");
  }
  if (settings.kind == EnvironmentKind::sky) read_sky(table, settings.sky);
  assign(settings.color, read_color(table, "color"));
  assign(settings.intensity, table.number("intensity", {0.0, 1e6}));
  assign(settings.rotation_degrees, table.number("rotation_degrees", {-360.0, 360.0}));
  return settings;
}

void read_lights(const TomlTable& root, const std::filesystem::path& folder, SceneSettings& settings) {
  for (const TomlTable& light :
       root.tables("light", {"type", "position", "direction", "color", "intensity", "range", "inner_cone_degrees",
                             "outer_cone_degrees", "up", "size", "radius", "integral", "points"})) {
    settings.scene.lights.push_back(read_light(light));
    settings.light_positions.push_back(read_vector(light, "position", coordinate_range).value_or(glm::dvec3{0.0}));
  }
  if (const auto lights = root.table("lights", {"keep"})) assign(settings.keep_model_lights, lights->boolean("keep"));
  if (const auto environment = root.table("environment", environment_keys)) {
    settings.environment = read_environment(*environment, folder);
  }
  if (const auto shadows = root.table("shadows", {"cast", "resolution", "sides"})) {
    settings.scene.shadows.cast = shadows->boolean("cast");
    assign(settings.scene.shadows.both_sides, read_word(*shadows, "sides", shadow_sides));
    assign(settings.scene.shadows.resolution, shadows->whole_number("resolution", shadow_resolution));
  }
}

void read_view(const TomlTable& root, SceneSettings& settings) {
  if (const auto frame = root.table("frame", {"size", "exposure", "footprint"})) read_frame(*frame, settings);
  if (const auto camera = root.table("camera", camera_keys())) settings.camera = read_camera(*camera);
  if (const auto zoom = root.table("zoom", {"distances"}))
    assign(settings.scene.distances, zoom->numbers("distances", 0, {smallest_distance, largest_distance}));
}

// Scenes of model files follow viewers, others the papers.
void set_rules(SceneSettings& settings) {
  const bool models = std::ranges::all_of(settings.parts, [](const PartSettings& part) {
    return part.model && !part.surface && part.microgeometry.empty();
  });
  settings.scene.horizon = models ? Horizon::open : Horizon::cut;
  settings.scene.shadows.both_sides = !models;
}

}  // namespace

Environment make_environment(const EnvironmentSettings& settings, std::vector<std::string>& warnings) {
  Environment environment = unscaled(settings, warnings);
  environment.rotation = radians(settings.rotation_degrees);
  if (settings.intensity == 1.0) return environment;
  Image scaled = *environment.radiance;
  for (float& value : scaled.texels) value = static_cast<float>(value * settings.intensity);
  environment.radiance = std::make_shared<const Image>(std::move(scaled));
  return environment;
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
  assign(framing.direction, read_direction(*framed, "direction"));
  if (const auto fov = framed->number("fov_degrees", field_of_view)) framing.yfov = radians(*fov);
  assign(framing.margin, framed->number("margin", {0.01, 1000.0}));
  return framing;
}

SceneSettings read_scene_settings(const std::filesystem::path& file, std::span<const Surface> surfaces) {
  std::vector<std::string> known{"scene", "frame", "light", "lights", "environment", "shadows", "camera", "zoom"};
  known.insert(known.end(), part_root_keys().begin(), part_root_keys().end());
  const TomlTable root(file, known);
  SceneSettings settings;
  settings.parts = read_parts(root, file.parent_path(), surfaces);
  set_rules(settings);
  if (const auto scene = root.table("scene", {"name", "description", "horizon"})) {
    assign(settings.scene.horizon, read_word(*scene, "horizon", horizons));
    assign(settings.scene.name, scene->word("name"));
    assign(settings.description, scene->word("description"));
  }
  read_lights(root, file.parent_path(), settings);
  read_view(root, settings);
  return settings;
}

}  // namespace footprint
