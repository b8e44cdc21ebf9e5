// The shadow maps of a scene's lights on the GPU.
#pragma once

#include <span>

#include "renderer/effects/effects.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/lights.hpp"

namespace footprint {

struct GpuBatch;
class SamplerCache;

/// Whether a scene's effects need shadow maps: something casts shadows, and there are lights other than environments.
[[nodiscard]] bool calls_for_shadow_maps(const EffectSet& effects);

/// Depth maps of all lights in the layers of one array of 32-bit floats. The context that created it must be current,
/// also at destruction.
class ShadowMaps {
 public:
  /// Draws the maps. Changes framebuffer, viewport, depth test and culling. Throws Error (machine): more maps than the
  /// GL or the memory supports.
  ShadowMaps(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects,
             std::span<const GpuBatch> batches, SamplerCache& samplers);

  /// Binds the maps to a texture unit, and the block of views.
  void bind(GLuint unit) const;

  [[nodiscard]] const ShadowViews& views() const { return views_; }
  [[nodiscard]] int resolution() const { return resolution_; }
  [[nodiscard]] std::size_t bytes() const;
  /// Draw calls: one per map and material.
  [[nodiscard]] std::size_t draws() const { return draws_; }

 private:
  ShadowViews views_;
  int resolution_;
  std::size_t draws_ = 0;
  gl::Texture maps_;
  gl::Sampler sampler_;
  gl::Buffer view_block_;
};

}  // namespace footprint
