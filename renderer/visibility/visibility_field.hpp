// Large-scale visibility of the environment at all vertices of a scene, compressed, and cached on disk.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/disk_cache.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/visibility/signed_distance.hpp"

namespace footprint {

/// Components that stand for a vertex's signed distance function, beside the mean of all.
inline constexpr std::size_t visibility_components = 15;

/// Texels per side of the maps of mean and components, without their border.
inline constexpr int visibility_map_edge = 16;

/// Edges of refined meshes are at most the bounds' radius over this.
inline constexpr float visibility_edges_in_radius = 24.0F;

/// The most vertices of a scene.
inline constexpr std::size_t most_visibility_vertices = std::size_t{1} << 22U;

/// Light from each cell of the visibility grid: radiance integrated over its solid angle, in the order of
/// visibility_directions.
[[nodiscard]] std::vector<glm::dvec3> visibility_light(const Environment& environment);

/// One vertex.
struct VertexVisibility {
  std::array<float, visibility_components> weights{};
  glm::vec3 diffuse_share{1.0F};  ///< of a Lambert surface's irradiance: what is visible over what is above the horizon
  float hidden = 0.0F;            ///< of even light, what bodies hide of the irradiance; 0 below 0.5%
};

/// The signed distance function of vertex v at w is mean(w) + sum over k of weights[k] component_k(w), radians.
struct VisibilityField {
  std::vector<Image> layers;  ///< RGBA, bordered octahedral maps; the first channel of all is the mean
  std::vector<std::vector<VertexVisibility>> meshes;  ///< as the meshes of the scene, a value per vertex
  double error = 0.0;                                 ///< what the components leave out, root mean square, radians
};

/// Asks the visibility of vertices at least half a refined mesh's edge apart (VertexSamples; 1024 rays each, TBB and
/// Embree), compresses the distances by principal components and interpolates them at the other vertices. Equal scenes
/// give equal fields at any number of threads. Throws (machine) too many vertices, or too little memory for them;
/// those of `progress`.
[[nodiscard]] VisibilityField visibility_field(const Scene& scene, const Occluders& occluders,
                                               const Environment& environment, const Progress& progress);

/// Names a scene's field by all that it depends on: this very program, triangles and normals, what alpha masks cut out
/// of them, and the light of the environment. Texture coordinates, materials and lights do not count else.
[[nodiscard]] std::string visibility_key(const Scene& scene, const Environment& environment);

/// The field with a checksum, in this machine's byte order. Equal fields give equal bytes.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(const VisibilityField& field);

/// The field that `to_bytes` wrote; none where the bytes are cut short, overlong, damaged, of another form, or do not
/// have a value for each vertex of `scene`.
[[nodiscard]] std::optional<VisibilityField> visibility_from_bytes(const ByteSource& bytes, const Scene& scene);

/// From `cache`, or asked of the scene and then kept there; without a cache asked. Throws as visibility_field.
[[nodiscard]] VisibilityField cached_visibility_field(const Scene& scene, const Environment& environment,
                                                      const DiskCache* cache, const Progress& progress);

}  // namespace footprint
