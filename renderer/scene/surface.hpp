// Procedural surfaces as the scene loader takes them: values that its caller passes, since the renderer knows none.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/options.hpp"
#include "renderer/image/image.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// The largest texels per side of a surface's maps, as of texture files.
inline constexpr int largest_surface_resolution = 16384;

/// The inputs of a surface's maps and mesh.
struct SurfaceSettings {
  int resolution = 512;    ///< texels per side, 1 to `largest_surface_resolution`
  std::uint32_t seed = 1;  ///< same seed, same bytes, at any number of threads
  Options parameters;      ///< of the surface's own table
};

/// One kind of surface. Make its maps by `surface_map`, which checks the settings.
struct Surface {
  std::string name;
  std::string summary;  ///< one sentence
  std::vector<OptionSpec> parameters;
  int default_resolution = 512;
  /// A square map as Material::normal_map has it: unit normals, z > 0, weight 1, computed in double precision.
  Image (*normals)(const SurfaceSettings&) = nullptr;
  /// Linear RGBA of any size; null if the surface has one colour.
  Image (*base_color)(const SurfaceSettings&) = nullptr;
  /// Linear RGB of any size, reflectance at normal incidence; null if it does not vary.
  Image (*specular)(const SurfaceSettings&) = nullptr;
  /// One channel of any size, the parameter of a lobe of `distribution`; null if the surface has no lobe of its own.
  Image (*lobe_parameter)(const SurfaceSettings&) = nullptr;
  /// Lobes of `distribution` about their own axes, 1 to most_facet_lobes; excludes lobe_parameter.
  std::vector<FacetLobe> (*lobes)(const SurfaceSettings&) = nullptr;
  NormalDistribution distribution = NormalDistribution::ggx;  ///< of lobe_parameter and lobes
  /// How often base_color, specular and lobe_parameter repeat over the mesh's texture coordinates; null: once.
  glm::vec2 (*map_tiling)(const SurfaceSettings&) = nullptr;
  /// The mesh, with normals, tangents and texture coordinates; material 0.
  Mesh (*mesh)(const SurfaceSettings&) = nullptr;
};

/// The folder of named scenes, and the surfaces that a scene.toml may name.
struct SceneLibrary {
  std::filesystem::path folder;
  std::span<const Surface> surfaces;
};

/// The surface of a name. Throws Error (usage): unknown, with the nearest right one.
[[nodiscard]] const Surface& find_surface(std::span<const Surface> surfaces, std::string_view name);

/// The default settings of a surface, with `given` parameters by name. Throws Error (usage): as of Options.
[[nodiscard]] SurfaceSettings surface_settings(const Surface& surface, const std::map<std::string, std::string>& given);

/// A map of a surface, such as &Surface::base_color; empty if it has none. Throws Error (usage): a resolution out of
/// range; (machine): more than memory.
[[nodiscard]] Image surface_map(const Surface& surface, const SurfaceSettings& settings,
                                Image (*Surface::*map)(const SurfaceSettings&));

/// The normal map. Throws as `surface_map`.
[[nodiscard]] inline Image surface_normals(const Surface& surface, const SurfaceSettings& settings) {
  return surface_map(surface, settings, &Surface::normals);
}

}  // namespace footprint
