// What scene.toml draws: the parts of a scene as plain values; docs/reference/scenes.md is its reference.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/glm.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "renderer/core/names.hpp"
#include "renderer/core/toml_table.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "renderer/scene/material.hpp"
#include "renderer/scene/scene.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// The derivative of a height field: differences of the two neighbours along an axis, over their distance of two
/// texels, as weighted means over three rows.
enum class SlopeFilter {
  central,  ///< the texel's own row alone
  sobel,    ///< rows weighted 1, 2, 1: OpenImageIO's `maketx --bumpslopes`
  scharr,   ///< rows weighted 3, 10, 3
};

inline constexpr auto slope_filters = std::to_array<Word<SlopeFilter>>(
    {{SlopeFilter::central, "central"}, {SlopeFilter::sobel, "sobel"}, {SlopeFilter::scharr, "scharr"}});

/// How heights become slopes.
struct HeightSettings {
  SlopeFilter filter = SlopeFilter::central;
  std::array<Wrap, 2> wrap{Wrap::repeat, Wrap::repeat};  ///< neighbours beyond the border, along u and v
};

/// A file of normals, or of heights in its first channel.
struct NormalFile {
  std::filesystem::path path;
  double scale = 1.0;  ///< factor on slopes; for heights, the height of value 1 in widths of the map
  NormalChannels channels = NormalChannels::xyz;
  std::optional<HeightSettings> heights{};  ///< none: the file stores normals
  std::optional<glm::vec2> uv{};            ///< of [maps], as MapFile's
};

/// A model file: the first of `candidates` that exists.
struct ModelSettings {
  std::vector<std::filesystem::path> candidates;
  std::string package;  ///< Debian package of the file, for the error message; may be empty
  bool unwrap = false;  ///< replaces the file's texture coordinates (charts.hpp)
  ModelSelection selection;
};

/// A rectangle in the xy plane with its own maps.
struct PlaneSettings {
  glm::vec2 size{1.0F};
  std::optional<NormalFile> normals;
  std::optional<std::filesystem::path> base_color_map, metallic_roughness_map;
  float roughness = 0.5F, metallic = 0.0F;
};

/// A procedural surface on its own mesh; `surface` is in the library that the scene was read with.
struct SurfaceContent {
  const Surface* surface;
  SurfaceSettings settings;
};

/// A detail layer over the normal map of every material of a part.
struct LayerSettings {
  std::variant<NormalFile, SurfaceContent> content;
  glm::vec2 uv{1.0F};     ///< tiles over the mesh's first texture coordinates
  double strength = 1.0;  ///< factor on slopes of a surface
};

/// Overrides of [brdf] for all materials.
struct BrdfSettings {
  std::optional<NormalDistribution> distribution;
  std::optional<GeometryTerm> geometry;
  std::optional<FresnelTerm> fresnel;
  std::optional<bool> diffuse;
  std::optional<float> lobe_parameter;
  std::vector<FacetLobe> lobes;          ///< replace the one about the normal
  std::optional<Anisotropy> anisotropy;  ///< strength 0 removes that of the materials
  std::optional<glm::vec3> specular, base_color;
};

/// A map of the base BRDF from a file.
struct MapFile {
  std::filesystem::path file;
  std::optional<glm::vec2> uv;  ///< repetitions along u and v; none: those of [tiling]
};

/// Maps of [maps] for all materials.
struct MapSettings {
  std::optional<MapFile> roughness, lobe_parameter, specular, diffuse;  ///< at most one of the first two
  std::optional<NormalFile> normals;                                    ///< replace the materials' own
  std::optional<MapFile> normal_kappa;                                  ///< concentration of the normals within a texel
  std::optional<MapFile> material;  ///< indices of the patches, if there are several
};

/// A clear coat that replaces the materials' coats; weight 0 removes them.
struct CoatSettings {
  float weight = 1.0F, roughness = 0.0F;
  std::optional<NormalFile> normals;  ///< none: the mesh's own
};

/// Ward's isotropic BRDF (1992).
struct WardSettings {
  double alpha = 0.1;
  glm::vec3 specular{1.0F}, diffuse{0.0F};
};

/// The largest number of materials of one surface.
inline constexpr std::size_t most_surface_materials = 16;

/// The small-scale geometry of a part's materials: a patch of a kind, or a model's triangles.
struct MicrogeometrySettings {
  const PatchKind* kind = nullptr;                ///< null: `model`
  std::map<std::string, std::string> parameters;  ///< given parameters of the kind
  std::filesystem::path model;                    ///< glTF file; its y axis points out of the surface
  std::optional<glm::vec2> period;                ///< of the model's tiles; none: its bounds
  std::optional<std::filesystem::path> measured;  ///< MERL file that replaces the base BRDF of the facets
  std::optional<WardSettings> ward;               ///< or Ward's BRDF
  std::uint64_t seed = 1;
  int resolution = 256;  ///< texels per side of the normal map for methods without patches
};

/// The placement of a part: scaled, then rotated about the world's x, y and z axes in this order, then translated.
struct Placement {
  glm::dvec3 translation{0.0};  ///< metres
  glm::dvec3 rotation{0.0};     ///< radians, right-handed
  double scale = 1.0;
};

/// One part of a scene: its content, materials and placement.
struct PartSettings {
  std::string name;  ///< prefix of the names of meshes and materials; may be empty
  /// One of them, or a model's triangles with the maps of a surface instead of its own materials.
  std::optional<ModelSettings> model;
  std::optional<PlaneSettings> plane;
  std::optional<SurfaceContent> surface;
  std::optional<LayerSettings> layer;
  BrdfSettings brdf;
  MapSettings maps;
  std::optional<CoatSettings> coat;                  ///< none: the materials' own
  std::vector<MicrogeometrySettings> microgeometry;  ///< none, one, or several that a map of indices selects
  glm::vec2 tiling{1.0F};  ///< factor on the texture coordinates of all maps without their own
  Placement placement;
};

/// The range of a lobe parameter: exponent (blinn_phong), kappa (vmf), or alpha (beckmann, ggx).
[[nodiscard]] NumberRange lobe_range(NormalDistribution distribution);

/// The parts of a scene.toml: those of [[part]], or the file itself as the only one. Throws as read_scene_settings.
[[nodiscard]] std::vector<PartSettings> read_parts(const TomlTable& root, const std::filesystem::path& folder,
                                                   std::span<const Surface> surfaces);

/// The keys of the whole file that read_parts reads.
[[nodiscard]] const std::vector<std::string>& part_root_keys();

}  // namespace footprint
