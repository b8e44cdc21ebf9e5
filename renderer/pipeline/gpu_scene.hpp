// A scene on the GPU: triangles, lights and the textures that every method shares.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "renderer/effects/effects.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/gpu_environment.hpp"
#include "renderer/pipeline/prefiltered.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// How a program looks up textures.
enum class Lookup { trilinear, nearest };

/// A sampler for the wrap modes of some coordinates. Owned by GpuScene's cache: one for each of the 18 kinds.
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
  gl::Texture texture;
  TextureCoordinates coordinates;
  TextureFilter filter = TextureFilter::trilinear;

  /// The program's lookup, unless this texture's texels must not be blended.
  [[nodiscard]] Lookup lookup(Lookup wanted) const {
    return filter == TextureFilter::nearest ? Lookup::nearest : wanted;
  }
};

/// Uploads a prefiltered texture with its whole chain; of a built one it makes the storage alone. Errors (machine):
/// over the GL limits, out of memory.
[[nodiscard]] GpuTexture upload(const PrefilteredTexture& texture);

/// The triangles of one material, and what is constant over it.
struct GpuBatch {
  gl::VertexArray vertex_array;
  gl::Buffer vertices, indices, material_block;
  GLsizei index_count = 0;
  std::size_t material = 0;
  bool double_sided = false;
  std::vector<GpuTexture> shared_textures;  ///< base_color_map, metallic_map, specular_map: those whose effect is on
};

/// The whole scene. Needs the context that made it to be current, also when destroyed.
class GpuScene {
 public:
  /// Errors (usage): materials with different base BRDFs (a comparison needs one); (machine): over GL's limits.
  GpuScene(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects);

  [[nodiscard]] const std::vector<GpuBatch>& batches() const { return batches_; }
  [[nodiscard]] const EffectSet& effects() const { return effects_; }
  [[nodiscard]] const BaseBrdf& brdf() const { return brdf_; }
  /// Every map of every material is looked up at the same place.
  [[nodiscard]] bool shared_coordinates() const { return shared_coordinates_; }
  /// Bytes of what every method reads: shared textures and, once a method's program is there, the prefiltered
  /// environment.
  [[nodiscard]] std::size_t shared_bytes() const {
    return shared_bytes_ + (environment_ ? environment_->stack_bytes() : 0);
  }
  /// None without its light.
  [[nodiscard]] GpuEnvironment* environment() { return environment_ ? &*environment_ : nullptr; }
  [[nodiscard]] SamplerCache& samplers() { return samplers_; }

  /// Binds the light blocks and sets the light counts of `program`.
  void bind_lights(const gl::Program& program) const;

  struct LightCounts {
    std::size_t point = 0, spot = 0, directional = 0;
  };
  [[nodiscard]] const LightCounts& light_counts() const { return light_counts_; }

 private:
  EffectSet effects_;
  BaseBrdf brdf_;
  bool shared_coordinates_ = true;
  std::size_t shared_bytes_ = 0;
  std::vector<GpuBatch> batches_;
  gl::Buffer point_lights_, spot_lights_, directional_lights_;
  LightCounts light_counts_;
  std::optional<GpuEnvironment> environment_;
  SamplerCache samplers_;
};

}  // namespace footprint
