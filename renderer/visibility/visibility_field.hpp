// Large-scale visibility of the environment at all vertices of a scene, compressed, and cached on disk.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/disk_cache.hpp"
#include "renderer/core/memory.hpp"
#include "renderer/core/progress.hpp"
#include "renderer/scene/environment.hpp"
#include "renderer/visibility/signed_distance.hpp"

namespace footprint {

/// The number of principal components of a vertex's signed distances, next to their mean.
inline constexpr std::size_t visibility_components = 15;

/// Texels per side of the maps of mean and components, without borders.
inline constexpr int visibility_map_edge = 16;

/// The bounds' radius over the longest edge of refined meshes.
inline constexpr float visibility_edges_in_radius = 24.0F;

/// Light from each cell of the visibility grid, in its order: radiance integrated over the solid angle.
[[nodiscard]] std::vector<glm::dvec3> visibility_light(const Environment& environment);

/// The visibility at one vertex.
struct VertexVisibility {
  std::array<float, visibility_components> weights{};
  glm::vec3 diffuse_share{1.0F};  ///< visible share of a Lambert surface's irradiance
  float hidden = 0.0F;            ///< share of uniform light that bodies hide; 0 below 0.5%
};

/// The signed distance function of vertex v at w is mean(w) + sum over k of weights[k] component_k(w), radians.
struct VisibilityField {
  std::vector<Image> layers;                          ///< RGBA, bordered octahedral maps; the first channel is the mean
  std::vector<std::vector<VertexVisibility>> meshes;  ///< per mesh and vertex of the scene
  double error = 0.0;                                 ///< root mean square error of the distances, radians
  double coarseness = 1.0;  ///< factor on the least distance of computed vertices; above 1 where memory was short
};

/// Computes the visibility (VertexSamples; 1024 rays each, TBB and Embree) at vertices at least half a refined mesh's
/// edge apart, compresses the distances by principal components, and interpolates them at the other vertices. Where the
/// computed vertices do not fit in memory, fewer are taken, farther apart. Equal scenes give equal fields at any number
/// of threads. memory: bytes that may be allocated. Throws Error (machine): too little memory for the vertices' values;
/// as `progress`.
[[nodiscard]] VisibilityField visibility_field(const Scene& scene, const Occluders& occluders,
                                               const Environment& environment, const Progress& progress,
                                               std::uint64_t memory = available_memory());

/// The key of a scene's field: a hash of this program, triangles, normals, alpha masks and the light of the
/// environment.
[[nodiscard]] std::string visibility_key(const Scene& scene, const Environment& environment);

/// The field with a checksum, in this machine's byte order. Equal fields give equal bytes.
[[nodiscard]] std::vector<std::uint8_t> to_bytes(const VisibilityField& field);

/// The field that `to_bytes` wrote. None if the bytes are truncated, too long, damaged or of another form, or do not
/// match the vertices of `scene`.
[[nodiscard]] std::optional<VisibilityField> visibility_from_bytes(const ByteSource& bytes, const Scene& scene);

/// Reads the field from `cache`, or computes it, and stores it unless memory was short. Throws as visibility_field.
/// cache: may be null.
[[nodiscard]] VisibilityField cached_visibility_field(const Scene& scene, const Environment& environment,
                                                      const DiskCache* cache, const Progress& progress);

}  // namespace footprint
