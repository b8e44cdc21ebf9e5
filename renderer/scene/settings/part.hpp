// What scene.toml draws: the parts of a scene as plain values; docs/scenes.md is its reference.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "renderer/core/toml_table.hpp"
#include "renderer/microgeometry/patch_kinds.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// A model file to draw: the first of `candidates` that exists.
struct ModelSettings {
  std::vector<std::filesystem::path> candidates;
  std::string package;  ///< Debian package that brings it, for the error text; may be empty
  bool unwrap = false;  ///< new texture coordinates instead of the file's (charts.hpp)
  ModelSelection selection;
};

/// A rectangle in the xy plane with maps of its own.
struct PlaneSettings {
  glm::vec2 size{1.0F};
  std::optional<std::filesystem::path> normal_map, base_color_map, metallic_roughness_map;
  NormalChannels normal_channels = NormalChannels::xyz;
  double normal_scale = 1.0;
  float roughness = 0.5F, metallic = 0.0F;
};

/// A procedural surface on its own mesh; `surface` belongs to the library that the scene was read with.
struct SurfaceContent {
  const Surface* surface;
  SurfaceSettings settings;
};

/// An image file of heights, or of normals.
struct LayerFile {
  std::filesystem::path path;
  bool heights = false;
};

/// A detail layer over the normal map of every material of a part.
struct LayerSettings {
  std::variant<LayerFile, SurfaceContent> content;
  glm::vec2 uv{1.0F};     ///< tiles over the mesh's first texture coordinates
  double strength = 1.0;  ///< factor on the slopes; of heights, the height of 1 over 0 in widths of the map
};

/// What [brdf] changes in every material.
struct BrdfSettings {
  std::optional<NormalDistribution> distribution;
  std::optional<GeometryTerm> geometry;
  std::optional<FresnelTerm> fresnel;
  std::optional<bool> diffuse;
  std::optional<float> lobe_parameter;
  std::vector<FacetLobe> lobes;  ///< instead of the one about the normal
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
  std::optional<MapFile> material;  ///< whole numbers that choose among several patches; there where there are several
};

/// A clear coat instead of what the materials have: weight 0 takes it off.
struct CoatSettings {
  float weight = 1.0F, roughness = 0.0F;
  std::optional<std::filesystem::path> normal_map;  ///< none: the mesh's own normals
};

/// Ward's isotropic BRDF (1992).
struct WardSettings {
  double alpha = 0.1;
  glm::vec3 specular{1.0F}, diffuse{0.0F};
};

/// The most materials of a surface.
inline constexpr std::size_t most_surface_materials = 16;

/// The small-scale geometry of a part's materials: a patch of a kind, or a model's triangles.
struct MicrogeometrySettings {
  const PatchKind* kind = nullptr;                ///< null: `model`
  std::map<std::string, std::string> parameters;  ///< of the kind, those that are given
  std::filesystem::path model;                    ///< glTF file; its y axis points out of the surface
  std::optional<glm::vec2> period;                ///< of the model's tiles; else its bounds
  std::optional<std::filesystem::path> measured;  ///< MERL file instead of the base BRDF of the facets
  std::optional<WardSettings> ward;               ///< or Ward's BRDF
  std::uint64_t seed = 1;
  int resolution = 256;  ///< texels per side of the normal map that methods see which know no patches
};

/// A model's triangles under the maps of a surface, instead of the model's own materials.
struct DressedModel {
  ModelSettings model;
  SurfaceContent surface;
};

/// Where a part stands: scaled, then turned about the world's x, y and z axes in this order, then moved.
struct Placement {
  glm::dvec3 translation{0.0};  ///< metres
  glm::dvec3 rotation{0.0};     ///< radians, right-handed
  double scale = 1.0;
};

/// One part of a scene: what is drawn, of what, and where.
struct PartSettings {
  std::string name;  ///< before the names of its meshes and materials; may be empty
  std::variant<ModelSettings, PlaneSettings, SurfaceContent, DressedModel> content;
  std::optional<LayerSettings> layer;
  BrdfSettings brdf;
  MapSettings maps;
  std::optional<CoatSettings> coat;                  ///< none: the materials' own
  std::vector<MicrogeometrySettings> microgeometry;  ///< none, one, or several that a map chooses among
  glm::vec2 tiling{1.0F};  ///< on the texture coordinates of all maps but those that say their own
  Placement placement;
};

/// What a lobe parameter may be: exponent (blinn_phong) and kappa (vmf), or alpha (beckmann, ggx).
[[nodiscard]] NumberRange lobe_range(NormalDistribution distribution);

/// The parts of a scene.toml: those of [[part]], or the one that the file itself is. Throws as read_scene_settings.
[[nodiscard]] std::vector<PartSettings> read_parts(const TomlTable& root, const std::filesystem::path& folder,
                                                   std::span<const Surface> surfaces);

/// The keys that read_parts takes of the whole file.
[[nodiscard]] const std::vector<std::string>& part_root_keys();

}  // namespace footprint
