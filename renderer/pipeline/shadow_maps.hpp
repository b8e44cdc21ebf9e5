// The shadow maps of a scene's lights on the GPU: drawn once, since neither lights nor surfaces move.
#pragma once

#include <span>
#include <vector>

#include "renderer/effects/effects.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/shadow_views.hpp"

namespace footprint {

struct GpuBatch;
class SamplerCache;

/// Whether a scene's effects ask for shadow maps: something casts shadows, and there are lights that it may hide.
[[nodiscard]] bool calls_for_shadow_maps(const EffectSet& effects);

/// Depth maps of all lights in the layers of one array, 32-bit floats, and how to look them up. Needs the context that
/// made it to be current, also when destroyed.
class ShadowMaps {
 public:
  /// Draws them. Leaves framebuffer, viewport, depth test and culling changed. Errors (machine): more maps than the
  /// GL or the memory holds.
  ShadowMaps(const gl::ContextInfo& context, const Scene& scene, const EffectSet& effects,
             std::span<const GpuBatch> batches, SamplerCache& samplers);

  /// Binds the maps to a texture unit, and the views, for a program whose effects call for them.
  void bind(GLuint unit) const;

  [[nodiscard]] const ShadowViews& views() const { return views_; }
  [[nodiscard]] int resolution() const { return resolution_; }
  [[nodiscard]] std::size_t bytes() const;
  /// Draw calls that it took: one a map and material.
  [[nodiscard]] std::size_t draws() const { return draws_; }

 private:
  void draw(const EffectSet& effects, std::span<const GpuBatch> batches, SamplerCache& samplers);

  ShadowViews views_;
  int resolution_;
  bool both_sides_;
  std::size_t draws_ = 0;
  gl::Texture maps_;
  gl::Sampler sampler_;
  gl::Buffer view_block_;
};

}  // namespace footprint
