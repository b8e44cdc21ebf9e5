// What a frame build wrote on the GPU, as texels again: for a bake that is to be whole without one.
#pragma once

#include "renderer/bake/baked_method.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// Whether textures of `baked` wait for a frame build.
[[nodiscard]] bool waits_for_build(const BakedMethod& baked);

/// Runs the frame build of `baked`, which is of `scene` and its `effects`, and takes what it wrote into the textures:
/// none is `built` afterwards. A material without a triangle loses its textures. Errors (usage): what is built is a
/// view's own; (machine): those of GpuScene.
void take_built_maps(const gl::Context& context, const Scene& scene, const EffectSet& effects, BakedMethod& baked);

}  // namespace footprint
