// A scene as a plain value: meshes, materials, lights and camera. No GL, no files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <numbers>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "renderer/core/bytes.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// Selections by name, or by number from 0. None: the file's default (docs/reference/scenes.md).
struct ModelSelection {
  std::optional<std::string> scene{}, camera{}, variant{}, animation{};
  std::optional<double> time{};  ///< of the animation, seconds

  [[nodiscard]] bool empty() const { return !scene && !camera && !variant && !animation && !time; }
};

/// The latest and the earliest time of an animation that can be given, seconds.
inline constexpr double largest_seconds = 1e6;

/// An animation of model files that poses them.
struct Motion {
  double last_key = 0;                  ///< seconds
  std::uint64_t content = fnv1a_start;  ///< hash of all keys
};

/// The entries of one kind in a model file, and the selected one.
struct ModelChoice {
  std::string kind;                  ///< "scene", "camera", "variant", "animation"
  std::vector<std::string> names;    ///< in the file's order; "camera 2" if it has no name
  std::optional<std::size_t> taken;  ///< none: no entry, its own materials, or the pose at rest
};

/// The index of the name or number `wanted`. Throws Error (usage): unknown, with the nearest name.
[[nodiscard]] std::size_t find_choice(const ModelChoice& choice, const std::string& wanted);

/// A vertex in world space (node transforms applied), its position from Scene::origin. Tangent w is the bitangent's
/// sign (glTF 2.0).
struct Vertex {
  glm::vec3 position{0.0F};
  glm::vec3 normal{0.0F, 0.0F, 1.0F};
  glm::vec4 tangent{1.0F, 0.0F, 0.0F, 1.0F};
  glm::vec2 uv0{0.0F};
  glm::vec2 uv1{0.0F};
  glm::vec4 color{1.0F};  ///< linear RGB and alpha, 0 to 1: times the material's base colour (glTF 2.0, COLOR_0)
};

/// Triangles of one material: three indices each, into `vertices`, counter-clockwise seen from outside.
struct Mesh {
  std::string name;
  std::vector<Vertex> vertices;
  std::vector<std::uint32_t> indices;
  int material = 0;  ///< index into Scene::materials
};

/// Light from one point. Radiant units of glTF's KHR_lights_punctual: candela.
struct PointLight {
  glm::vec3 position{0.0F};
  glm::vec3 intensity{1.0F};   ///< candela per channel (colour * intensity)
  std::optional<float> range;  ///< metres; with it, KHR_lights_punctual's window applies
};

/// A point light with a cone.
struct SpotLight {
  PointLight point;
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< from the light, unit
  float inner_cone_angle = 0.0F;           ///< radians, 0 <= inner <= outer <= pi / 2
  float outer_cone_angle = 0.785398F;
};

/// Light from infinitely far.
struct DirectionalLight {
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< from the light, unit
  glm::vec3 illuminance{1.0F};             ///< lux per channel on a surface that faces it
};

/// The outline of an area light. Shaders know it by its number.
enum class AreaShape : std::int8_t { sphere = -1, disk = 0, rectangle = 1 };

/// How methods integrate an area light; the reference samples it.
enum class AreaIntegral {
  lobes,   ///< by their lobes, as linearly transformed cosines; by points where a method lists no lobes
  points,  ///< as points of light
};

/// The allowed number of points of an area light.
inline constexpr int most_area_points = 256;

/// Light from one side of a flat surface, or from a sphere, with equal radiance in all directions
/// (docs/explanation/area-lights.md).
struct AreaLight {
  AreaShape shape = AreaShape::rectangle;
  glm::vec3 position{0.0F};                ///< the centre
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< where it shines, unit; a sphere shines to all sides
  glm::vec3 across{-1.0F, 0.0F, 0.0F};     ///< unit, along two edges; cross(across, up) is `direction`
  glm::vec3 up{0.0F, 1.0F, 0.0F};          ///< unit, along the other edges
  glm::vec2 half_size{
      0.5F};  ///< from the centre to an edge along each, metres; both are the radius of a disk or a sphere
  glm::vec3 intensity{1.0F};  ///< candela per channel along `direction`: radiance times area
  AreaIntegral integral = AreaIntegral::lobes;
  int points = 16;  ///< for AreaIntegral::points, 1 to most_area_points

  /// Square metres; of a sphere the area of its outline.
  [[nodiscard]] float area() const {
    return (shape == AreaShape::rectangle ? 4.0F : std::numbers::pi_v<float>)*half_size.x * half_size.y;
  }
};

using Light = std::variant<PointLight, SpotLight, DirectionalLight, AreaLight>;

/// The position of a light; null for one that has none.
[[nodiscard]] inline glm::vec3* position_in(Light& light) {
  const auto find = [](auto& own) -> glm::vec3* {
    if constexpr (requires { own.point; }) return &own.point.position;
    if constexpr (requires { own.position; }) return &own.position;
    return nullptr;
  };
  return std::visit(find, light);
}

/// A camera as glTF defines it: looks along its own -z, y up.
struct Camera {
  glm::mat4 world{1.0F};  ///< camera to world, rigid (scale removed)
  bool orthographic = false;
  float yfov = 0.6F;  ///< radians, perspective
  float ymag = 1.0F;  ///< half the height seen, orthographic
  float znear = 0.01F;
  std::optional<float> zfar;    ///< none: infinite (perspective only)
  std::optional<float> aspect;  ///< width / height if the file gives one; sets the default frame size

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// Axis-aligned bounds of all vertices.
struct Bounds {
  glm::vec3 lower{0.0F};
  glm::vec3 upper{0.0F};
  [[nodiscard]] glm::vec3 centre() const { return 0.5F * (lower + upper); }
  [[nodiscard]] float radius() const { return 0.5F * glm::length(upper - lower); }
};

/// The allowed texels per side of a shadow map.
inline constexpr int smallest_shadow_map = 16, largest_shadow_map = 16384;

/// Large-scale visibility (docs/explanation/shadows.md).
struct ShadowSettings {
  std::optional<bool> cast;  ///< none: if anything can hide a light from a surface
  bool both_sides = false;   ///< a one-sided triangle also blocks light from behind
  int resolution = 2048;     ///< texels per side of each shadow map
};

/// Light from below the plane of a vertex normal that a facet of the normal map still faces.
enum class Horizon {
  cut,   ///< does not arrive, because the large shape of the surface hides it
  open,  ///< arrives: each facet only has its own horizon, as in engines and glTF viewers
};

/// The range of a zoom's factors on the camera's distance.
inline constexpr double smallest_distance = 1e-3, largest_distance = 1e6;

/// A whole scene.
struct Scene {
  std::string name;    ///< folder or file stem
  std::string source;  ///< path as given
  std::vector<Mesh> meshes;
  std::vector<Material> materials;
  std::vector<Light> lights;
  ShadowSettings shadows;
  Horizon horizon = Horizon::cut;
  std::optional<Environment> environment;
  Camera camera;
  Bounds bounds;
  glm::dvec3 origin{0.0};  ///< the place in the user's coordinates that all positions above are measured from
  std::optional<FootprintFilter> footprint;  ///< for its images; none: default_footprint_filter
  std::optional<float> exposure;             ///< multiplies radiance for display and clamped measures; none: automatic
  std::vector<double> distances{1.0};    ///< the default zoom: factors on the camera's distance to the bounds' centre
  std::optional<glm::ivec2> frame_size;  ///< if scene.toml has one
  std::vector<ModelChoice> choices;      ///< scenes, cameras and variants of its model files
  std::optional<Motion> motion;          ///< none: a pose at rest
  std::vector<std::string>
      defaults;  ///< things that the loader supplied, one line each ("camera: framed on the bounds")
  std::vector<std::string> warnings;  ///< things of the input that Footprint leaves out, one line each
};

/// Hashes all fields of a material except names.
void add_content(ContentHash& hash, const Material& material);

/// Hashes all fields of a scene, including names and notes for reports, except its source and its files' choices.
void add_content(ContentHash& hash, const Scene& scene);

}  // namespace footprint
