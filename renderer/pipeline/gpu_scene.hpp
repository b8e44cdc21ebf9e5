// A scene on the GPU: triangles, lights, and the textures that all methods share.
#pragma once

#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/bytes.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/gpu_environment.hpp"
#include "renderer/pipeline/lights.hpp"
#include "renderer/pipeline/shadow_maps.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

class EmittedLight;
class TextureUnits;
struct View;

/// How a program's samplers filter.
struct SamplerState {
  bool linear = true;      ///< trilinear; else the nearest texel of the nearest level
  int max_anisotropy = 1;  ///< of the sampler's own filter; 1: isotropic

  friend bool operator==(const SamplerState&, const SamplerState&) = default;
  static const SamplerState trilinear, nearest;
};
inline constexpr SamplerState SamplerState::trilinear{.linear = true, .max_anisotropy = 1};
inline constexpr SamplerState SamplerState::nearest{.linear = false, .max_anisotropy = 1};

/// Samplers by wrap modes and state, each created once.
class SamplerCache {
 public:
  [[nodiscard]] GLuint sampler(const TextureCoordinates& coordinates, SamplerState state);

 private:
  struct Entry {
    std::array<Wrap, 2> wrap;
    SamplerState state;
    gl::Sampler sampler;
  };
  std::vector<Entry> entries_;
};

/// A texture with the coordinates and the filter that select its sampler.
struct GpuTexture {
  std::shared_ptr<const gl::Texture> texture;  ///< never null; shared by materials with the same texels
  TextureCoordinates coordinates;
  TextureFilter filter = TextureFilter::trilinear;

  /// The program's state, unless this texture's own filter replaces it.
  [[nodiscard]] SamplerState sampler_state(SamplerState wanted) const {
    if (filter == TextureFilter::linear) return SamplerState::trilinear;
    if (filter == TextureFilter::by_level) return {.linear = wanted.linear, .max_anisotropy = 1};
    return filter == TextureFilter::nearest ? SamplerState::nearest : wanted;
  }
};

/// Whether two maps are looked up at the same uv.
[[nodiscard]] bool same_uv(const TextureCoordinates& a, const TextureCoordinates& b);

/// Uploads a texture with its whole chain. Of a built one it only allocates the storage. Throws Error (machine): over
/// the GL limits, out of memory.
[[nodiscard]] gl::Texture upload_texels(const PrefilteredTexture& texture);
[[nodiscard]] GpuTexture upload(const PrefilteredTexture& texture);

/// Reads the texels of `from`, which has the sizes of `into`'s levels, into `into`, which then counts as baked.
void read_texels(const gl::Texture& from, PrefilteredTexture& into);

/// Uploads textures, those with the same texels once. Textures of a frame build are never shared.
class SharedUploads {
 public:
  /// Uploads like the function `upload`; `bytes` grows only by new texels.
  [[nodiscard]] GpuTexture upload(const PrefilteredTexture& texture);
  [[nodiscard]] std::size_t bytes() const { return bytes_; }

 private:
  std::map<std::uint64_t, std::shared_ptr<const gl::Texture>> uploaded_;
  std::size_t bytes_ = 0;
};

/// A vertex array over vertices and indices.
/// surface: one pair of surface coordinates per vertex, or null.
[[nodiscard]] gl::VertexArray vertex_array(const gl::Buffer& vertices, const gl::Buffer& indices,
                                           const gl::Buffer* surface = nullptr);

/// Adds the visibility of the environment to a vertex array: five vectors per vertex.
void add_visibility(const gl::VertexArray& array, const gl::Buffer& visibility);

/// Hashes of a scene's parts, to detect changes.
struct SceneContent {
  std::uint64_t geometry = fnv1a_start, materials = fnv1a_start, lights = fnv1a_start;

  friend bool operator==(const SceneContent&, const SceneContent&) = default;
};

/// The triangles of one material, and its constants.
struct GpuBatch {
  gl::VertexArray vertex_array;
  gl::Buffer visibility;  ///< of the environment, at the vertices; none if nothing hides it
  gl::Buffer vertices, indices, material_block;
  GLsizei index_count = 0;
  std::size_t vertex_count = 0;
  std::size_t index = 0;  ///< among the scene's batches
  std::size_t material = 0;
  bool double_sided = false;
  bool adds = false;                        ///< adds its share to the material before it, on the same triangles
  TextureCoordinates coordinates;           ///< of the normal map, or of a missing one
  std::vector<GpuTexture> shared_textures;  ///< those of shared_maps() whose effects are on
};

/// The whole scene. The context that created it must be current, also at destruction.
class GpuScene {
 public:
  /// progress: called while the visibility of an environment is computed; may throw.
  /// cache: stores that visibility; may be null.
  /// same: the same scene with other effects, whose environment and visibility are shared; may be null.
  /// Throws Error (usage): materials with different base BRDFs; (machine): over the GL limits.
  GpuScene(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects,
           const Progress& progress = no_progress, const DiskCache* cache = nullptr, const GpuScene* same = nullptr);

  /// Uploads the vertices, lights and material constants of the next frame of an animated scene. Maps, environment and
  /// base BRDF stay; visibility is computed again if vertices moved. Throws Error (usage): another number of materials,
  /// vertices or lights of a kind than before.
  void update(const Scene& scene);
  [[nodiscard]] const SceneContent& content() const { return content_; }

  [[nodiscard]] const std::vector<GpuBatch>& batches() const { return batches_; }
  [[nodiscard]] const gl::ContextInfo& context() const { return *context_; }
  [[nodiscard]] const EffectSet& effects() const { return effects_; }
  [[nodiscard]] const BaseBrdf& brdf() const { return brdf_; }
  [[nodiscard]] Horizon horizon() const { return horizon_; }
  /// Whether all maps of all materials are looked up at the same uv.
  [[nodiscard]] bool shared_coordinates() const { return shared_coordinates_; }
  /// None if the effect is off, or without point, spot and directional lights.
  [[nodiscard]] const std::optional<ShadowMaps>& shadow_maps() const { return shadow_maps_; }
  /// Bytes that every method reads: shared textures, shadow maps, the environment's visibility and, once a method's
  /// program exists, the prefiltered environment and the table for area lights.
  [[nodiscard]] std::size_t shared_bytes() const {
    return shared_bytes_ + (environment_ ? environment_->stack_bytes() : 0) +
           (area_cosines_ && *area_cosines_ ? (*area_cosines_)->bytes : 0);
  }
  /// Null without environment light.
  [[nodiscard]] const GpuEnvironment* environment() const { return environment_.get(); }
  [[nodiscard]] GpuEnvironment* environment() { return environment_.get(); }
  /// Null if nothing hides a part of the environment.
  [[nodiscard]] const GpuVisibility* visibility() const { return visibility_.get(); }
  [[nodiscard]] SamplerCache& samplers() { return samplers_; }
  /// The table of lobes for area lights, fitted on the first call.
  [[nodiscard]] const SampledTexture& area_cosines();

  /// Adds the light that surfaces emit (emitted_light.hpp) to an image of the view; nothing without the effect.
  void add_emitted(Image& picture, const View& view);

  /// Binds the light blocks and the shadow maps at their unit of `units`, and sets the light counts of `program`.
  /// area_by_lobes: whether the program integrates area lights by lobes, if the light allows it.
  void bind_lights(const gl::Program& program, const TextureUnits& units, bool area_by_lobes = false) const;

  struct LightCounts {
    PerLightType<std::size_t> of{};
    std::size_t area_by_lobes = 0, points_alone = 0;  ///< as in LightBlocks
    std::size_t shadow_maps = 0;
  };
  [[nodiscard]] const LightCounts& light_counts() const { return light_counts_; }
  /// The largest number of lobes per facet of any material, at least 1.
  [[nodiscard]] std::size_t facet_lobes() const { return facet_lobes_; }

 private:
  const gl::ContextInfo* context_;
  EffectSet effects_;
  BaseBrdf brdf_;
  Horizon horizon_;
  bool shared_coordinates_ = true;
  std::size_t shared_bytes_ = 0;
  std::vector<GpuBatch> batches_;
  PerLightType<gl::Buffer> light_buffers_;
  LightCounts light_counts_;
  std::size_t facet_lobes_ = 1;
  std::shared_ptr<GpuEnvironment> environment_;
  std::shared_ptr<std::optional<SampledTexture>> area_cosines_;
  std::shared_ptr<const GpuVisibility> visibility_;
  std::shared_ptr<EmittedLight> emitted_;  // null before the first use
  SamplerCache samplers_;
  SceneContent content_;
  std::optional<ShadowMaps> shadow_maps_;

  [[nodiscard]] LightBlocks blocks_of(std::span<const Light> lights) const;
  void make_lights(const gl::ContextInfo& context, const Scene& scene);
  void make_visibility(const Scene& scene, const Progress& progress, const DiskCache* cache);
  void take_visibility(const Scene& scene, std::shared_ptr<const GpuVisibility> visibility);
};

}  // namespace footprint
