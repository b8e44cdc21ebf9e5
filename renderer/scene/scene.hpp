// A scene as a plain value: meshes, materials, lights and camera. No GL, no files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <glm/glm.hpp>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "renderer/core/hash.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// Each by its name or by its number from 0; none: the file's own choice (docs/scenes.md).
struct ModelSelection {
  std::optional<std::string> scene, camera, variant;

  [[nodiscard]] bool empty() const { return !scene && !camera && !variant; }
};

/// What a file offers of one kind, and which of it is taken.
struct ModelChoice {
  std::string kind;                  ///< "scene", "camera", "variant"
  std::vector<std::string> names;    ///< in the file's order; "camera 2" for one without a name
  std::optional<std::size_t> taken;  ///< none: the file has none to take, or its own materials are taken
};

/// The place in `choice` of what `wanted` names. Throws Error (usage): neither a name nor a number of it, with the
/// nearest.
[[nodiscard]] std::size_t find_choice(const ModelChoice& choice, const std::string& wanted);

/// A vertex in world space (node transforms applied). Tangent w is the bitangent's sign (glTF 2.0).
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
  std::optional<float> range;  ///< metres; KHR_lights_punctual's window where given
};

/// A point light with a cone.
struct SpotLight {
  PointLight point;
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< where the light shines, unit
  float inner_cone_angle = 0.0F;           ///< radians, 0 <= inner < outer <= pi / 2
  float outer_cone_angle = 0.785398F;
};

/// Light from infinitely far.
struct DirectionalLight {
  glm::vec3 direction{0.0F, 0.0F, -1.0F};  ///< where the light shines, unit
  glm::vec3 illuminance{1.0F};             ///< lux per channel on a surface that faces it
};

using Light = std::variant<PointLight, SpotLight, DirectionalLight>;

/// A camera as glTF defines it: looks along its own -z, y up.
struct Camera {
  glm::mat4 world{1.0F};  ///< camera to world, rigid (scale removed)
  bool orthographic = false;
  float yfov = 0.6F;  ///< radians, perspective
  float ymag = 1.0F;  ///< half the height seen, orthographic
  float znear = 0.01F;
  std::optional<float> zfar;    ///< none: infinite (perspective only)
  std::optional<float> aspect;  ///< width / height where the file gives one; sets the default frame shape

  friend bool operator==(const Camera&, const Camera&) = default;
};

/// Axis-aligned bounds of all vertices.
struct Bounds {
  glm::vec3 lower{0.0F};
  glm::vec3 upper{0.0F};
  [[nodiscard]] glm::vec3 centre() const { return 0.5F * (lower + upper); }
  [[nodiscard]] float radius() const { return 0.5F * glm::length(upper - lower); }
};

/// The texels per side that a shadow map may have.
inline constexpr int smallest_shadow_map = 16, largest_shadow_map = 16384;

/// What a scene says about large-scale visibility (docs/shadows.md).
struct ShadowSettings {
  std::optional<bool> cast;  ///< none: where something stands between a surface and a light
  bool both_sides = false;   ///< a one-sided triangle keeps light from behind too, from where it is not drawn
  int resolution = 2048;     ///< texels per side of each shadow map
};

/// What becomes of light from below the plane of a vertex normal, where a facet of the normal map still faces it.
enum class Horizon {
  cut,   ///< none arrives: the surface's own large shape hides it
  open,  ///< it arrives: each facet knows its own horizon alone, as in engines and glTF viewers
};

/// The factors on the camera's distance that a zoom may take.
inline constexpr double smallest_distance = 1e-3, largest_distance = 1e6;

/// What the scene file left open and the loader filled in, in words for the output ("camera: framed on the bounds").
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
  std::optional<FootprintFilter> footprint;  ///< that its images are meant for; none: default_footprint_filter
  std::optional<float> exposure;  ///< multiplies radiance before display and the clamped measures; none: automatic
  std::vector<double> distances{
      1.0};  ///< the default zoom path: factors on the camera's distance to the bounds' centre
  std::optional<glm::ivec2> frame_size;  ///< where scene.toml gives one
  std::vector<ModelChoice> choices;      ///< scenes, cameras and variants of its model files, where there are any
  std::vector<std::string> defaults;     ///< what was supplied because the input has none, one line each
  std::vector<std::string> warnings;     ///< what the input has and Footprint leaves out, one line each
};

/// Counts everything of a material but the names in it: materials that differ in any field give different hashes.
void add_content(ContentHash& hash, const Material& material);

/// Counts everything of a loaded scene, the names and notes that reports print too, but for where it was loaded from
/// and the choices that its model files offered.
void add_content(ContentHash& hash, const Scene& scene);

}  // namespace footprint
