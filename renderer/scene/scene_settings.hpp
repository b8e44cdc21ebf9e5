// scene.toml as a plain value; docs/scenes.md is its reference.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "renderer/scene/camera.hpp"
#include "renderer/scene/environment_settings.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/surface.hpp"
#include "renderer/scene/toml_table.hpp"

namespace footprint {

/// A glTF file to draw: the first of `candidates` that exists.
struct ModelSettings {
  std::vector<std::filesystem::path> candidates;
  std::string package;  ///< Debian package that brings it, for the error text; may be empty
};

/// A rectangle in the xy plane with maps of its own.
struct PlaneSettings {
  glm::vec2 size{1.0F};
  std::optional<std::filesystem::path> normal_map, base_color_map, metallic_roughness_map;
  double normal_scale = 1.0;
  float roughness = 0.5F, metallic = 0.0F;
};

/// A procedural surface on its own mesh; `surface` belongs to the library that the scene was read with.
struct SurfaceContent {
  const Surface* surface;
  SurfaceSettings settings;
};

/// What [brdf] changes in every material.
struct BrdfSettings {
  std::optional<NormalDistribution> distribution;
  std::optional<GeometryTerm> geometry;
  std::optional<FresnelTerm> fresnel;
  std::optional<bool> diffuse;
  std::optional<float> lobe_parameter;
  std::vector<FacetLobe> lobes;  ///< in place of the one about the normal
  std::optional<glm::vec3> specular, base_color;
};

/// A map of the base BRDF from a file.
struct MapFile {
  std::filesystem::path file;
  std::optional<glm::vec2> uv;  ///< how often it repeats along u and v; none: as [tiling] says
};

/// What [maps] lays over every material.
struct MapSettings {
  std::optional<MapFile> roughness, lobe_parameter, specular, diffuse;  ///< at most one of the first two
};

/// Where the camera stands: the model's own (or framed, where it has none), framed, or as given.
using CameraSettings = std::variant<std::monostate, Framing, Camera>;

/// All of a scene.toml; a default value is what a bare glTF file gets.
struct SceneSettings {
  std::optional<std::string> name;  ///< else the folder's
  std::string description;          ///< for people who list scenes
  std::variant<ModelSettings, PlaneSettings, SurfaceContent> content;
  BrdfSettings brdf;
  MapSettings maps;
  std::optional<glm::ivec2> frame_size;
  std::optional<float> exposure;
  bool automatic_exposure = false;  ///< asked for by name, also with the supplied lights
  std::vector<Light> lights;
  bool keep_model_lights = true;
  std::optional<EnvironmentSettings> environment;
  CameraSettings camera;
  std::vector<double> distances{1.0};
  glm::vec2 tiling{1.0F};
};

/// What a lobe parameter may be: exponent (blinn_phong) and kappa (vmf), or alpha (beckmann, ggx).
[[nodiscard]] NumberRange lobe_range(NormalDistribution distribution);

/// The keys of a [camera] table.
[[nodiscard]] const std::vector<std::string>& camera_keys();

/// Reads a [camera] table, of a scene.toml or of whatever else places a camera. Errors (usage) as below.
[[nodiscard]] CameraSettings read_camera(const TomlTable& table);

/// Reads a scene.toml, which may name one of `surfaces`. Relative paths in it start from its folder. Errors (usage)
/// read "FILE:LINE: ...": not TOML, unknown keys with the nearest right one, wrong types, values out of range, settings
/// that exclude each other.
[[nodiscard]] SceneSettings read_scene_settings(const std::filesystem::path& file, std::span<const Surface> surfaces);

}  // namespace footprint
