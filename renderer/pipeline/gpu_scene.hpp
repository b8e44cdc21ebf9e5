// A scene on the GPU: triangles, lights and the textures that every method shares.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/hash.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/gpu_environment.hpp"
#include "renderer/pipeline/gpu_visibility.hpp"
#include "renderer/pipeline/light_blocks.hpp"
#include "renderer/pipeline/shadow_maps.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

class TextureUnits;

/// How a program's samplers look textures up.
struct Lookup {
  bool blends = true;  ///< trilinear; else the nearest texel of the nearest level
  int probes = 1;      ///< of the sampler's own anisotropic filter, at most

  friend bool operator==(const Lookup&, const Lookup&) = default;
  static const Lookup trilinear, nearest;
};
inline constexpr Lookup Lookup::trilinear{.blends = true, .probes = 1};
inline constexpr Lookup Lookup::nearest{.blends = false, .probes = 1};

/// A sampler for the wrap modes of some coordinates. Owned by GpuScene's cache: one for each kind.
class SamplerCache {
 public:
  [[nodiscard]] GLuint sampler(const TextureCoordinates& coordinates, Lookup lookup);

 private:
  struct Entry {
    std::array<Wrap, 2> wrap;
    Lookup lookup;
    gl::Sampler sampler;
  };
  std::vector<Entry> entries_;
};

/// A texture bound with the sampler that its coordinates and its filter ask for.
struct GpuTexture {
  std::shared_ptr<const gl::Texture> texture;  ///< never null; materials of the same texels share it
  TextureCoordinates coordinates;
  TextureFilter filter = TextureFilter::trilinear;

  /// The program's lookup, unless this texture says itself whether its texels are blended.
  [[nodiscard]] Lookup lookup(Lookup wanted) const {
    if (filter == TextureFilter::linear) return Lookup::trilinear;
    if (filter == TextureFilter::by_level) return {.blends = wanted.blends, .probes = 1};
    return filter == TextureFilter::nearest ? Lookup::nearest : wanted;
  }
};

/// Whether two maps are looked up at the same uv.
[[nodiscard]] bool same_uv(const TextureCoordinates& a, const TextureCoordinates& b);

/// Uploads a prefiltered texture with its whole chain; of a built one it makes the storage alone. Errors (machine):
/// over the GL limits, out of memory.
[[nodiscard]] gl::Texture upload_texels(const PrefilteredTexture& texture);
[[nodiscard]] GpuTexture upload(const PrefilteredTexture& texture);

/// Takes the texels of `from`, which has the sizes of `into`'s levels, into it: a built texture counts as baked then.
void read_texels(const gl::Texture& from, PrefilteredTexture& into);

/// Uploads textures, those of the same texels once. What a frame build writes is never shared.
class SharedUploads {
 public:
  /// As `upload`; `bytes` grow by what was not there before.
  [[nodiscard]] GpuTexture upload(const PrefilteredTexture& texture);
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::map<std::uint64_t, std::shared_ptr<const gl::Texture>> kept_;
  std::size_t bytes_ = 0;
};

/// A vertex array over vertices and indices, and over one pair of surface coordinates a vertex where `surface` is
/// given.
[[nodiscard]] gl::VertexArray vertex_array(const gl::Buffer& vertices, const gl::Buffer& indices,
                                           const gl::Buffer* surface = nullptr);

/// Adds the visibility of the environment to a vertex array: five vectors a vertex.
void add_visibility(const gl::VertexArray& array, const gl::Buffer& visibility);

/// Hashes of what a scene's parts hold: one that differs tells that the part has changed.
struct SceneContent {
  std::uint64_t geometry = fnv1a_start, materials = fnv1a_start, lights = fnv1a_start;

  friend bool operator==(const SceneContent&, const SceneContent&) = default;
};

/// The triangles of one material, and what is constant over it.
struct GpuBatch {
  gl::VertexArray vertex_array;
  gl::Buffer visibility;  ///< of the environment, at the vertices; none where nothing hides it
  gl::Buffer vertices, indices, material_block;
  GLsizei index_count = 0;
  std::size_t vertex_count = 0;
  std::size_t material = 0;
  bool double_sided = false;
  bool adds = false;                        ///< to what the material before it left on the same triangles
  TextureCoordinates coordinates;           ///< of the normal map, or where it would be looked up
  std::vector<GpuTexture> shared_textures;  ///< of the rows of shared_maps() whose effects are on
};

/// The whole scene. Needs the context that made it to be current, also when destroyed.
class GpuScene {
 public:
  /// Errors (usage): materials with different base BRDFs (a comparison needs one); (machine): over GL's limits; those
  /// of `progress`, which is called where the visibility of an environment takes time. It is kept in `cache`, where
  /// there is one. The environment and its visibility are those of `same`, where that is given: the same scene with
  /// other effects.
  GpuScene(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects,
           const Progress& progress = no_progress, const DiskCache* cache = nullptr, const GpuScene* same = nullptr);

  /// Takes over vertices, lights and the constants of materials as `scene` has them: the next frame of what moves.
  /// Maps, environment and base BRDF stay; visibility is asked anew where vertices moved. Errors (usage): another
  /// number of materials, vertices or lights of a kind than before.
  void update(const Scene& scene);
  [[nodiscard]] const SceneContent& content() const { return content_; }

  [[nodiscard]] const std::vector<GpuBatch>& batches() const { return batches_; }
  [[nodiscard]] const gl::ContextInfo& context() const { return *context_; }
  [[nodiscard]] const EffectSet& effects() const { return effects_; }
  [[nodiscard]] const BaseBrdf& brdf() const { return brdf_; }
  [[nodiscard]] Horizon horizon() const { return horizon_; }
  /// Every map of every material is looked up at the same uv.
  [[nodiscard]] bool shared_coordinates() const { return shared_coordinates_; }
  /// None where the effect is off, or without lights but an environment.
  [[nodiscard]] const std::optional<ShadowMaps>& shadow_maps() const { return shadow_maps_; }
  /// Bytes of what every method reads: shared textures, shadow maps, the environment's visibility and, once a method's
  /// program is there, the prefiltered environment.
  [[nodiscard]] std::size_t shared_bytes() const {
    return shared_bytes_ + (environment_ ? environment_->stack_bytes() : 0);
  }
  /// None without its light.
  [[nodiscard]] const GpuEnvironment* environment() const { return environment_.get(); }
  [[nodiscard]] GpuEnvironment* environment() { return environment_.get(); }
  /// None where nothing hides a part of the environment.
  [[nodiscard]] const GpuVisibility* visibility() const { return visibility_.get(); }
  [[nodiscard]] SamplerCache& samplers() { return samplers_; }

  /// Binds the light blocks, their shadow maps at their unit of `units`, and sets the light counts of `program`.
  void bind_lights(const gl::Program& program, const TextureUnits& units) const;

  struct LightCounts {
    std::size_t point = 0, spot = 0, directional = 0;
    std::size_t shadow_maps = 0;
  };
  [[nodiscard]] const LightCounts& light_counts() const { return light_counts_; }
  /// The most lobes that a facet of any material has, at least 1.
  [[nodiscard]] std::size_t facet_lobes() const { return facet_lobes_; }

 private:
  const gl::ContextInfo* context_;
  EffectSet effects_;
  BaseBrdf brdf_;
  Horizon horizon_;
  bool shared_coordinates_ = true;
  std::size_t shared_bytes_ = 0;
  std::vector<GpuBatch> batches_;
  gl::Buffer point_lights_, spot_lights_, directional_lights_;
  LightCounts light_counts_;
  std::size_t facet_lobes_ = 1;
  std::shared_ptr<GpuEnvironment> environment_;
  std::shared_ptr<const GpuVisibility> visibility_;
  SamplerCache samplers_;
  SceneContent content_;
  std::optional<ShadowMaps> shadow_maps_;

  [[nodiscard]] LightBlocks blocks_of(std::span<const Light> lights) const;
  void make_lights(const gl::ContextInfo& context, const Scene& scene);
  void make_visibility(const Scene& scene, const Progress& progress, const DiskCache* cache);
  void take_visibility(const Scene& scene, std::shared_ptr<const GpuVisibility> visibility);
};

}  // namespace footprint
