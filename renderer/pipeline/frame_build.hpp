// What a method rebuilds on the GPU each frame, before shading.
#pragma once

#include <span>

namespace footprint {

struct GpuBatch;
struct GpuTexture;

/// The passes of a method's frame build, compiled for one scene. They fill the textures that the precompute declared
/// with make_built_texture. A pass may change the program, texture units, image units and uniform blocks that are
/// bound, which every draw sets for itself, and nothing else of the GL: compute passes need no more.
class FrameBuild {
 public:
  FrameBuild() = default;
  FrameBuild(const FrameBuild&) = delete;
  FrameBuild& operator=(const FrameBuild&) = delete;
  virtual ~FrameBuild() = default;

  /// Issues the passes for one material. `textures` are those of the precompute, in its order, as they lie on the GPU;
  /// `batch` has the material's block and triangles. Whoever calls it puts memory barriers before and
  /// behind it.
  virtual void run(const GpuBatch& batch, std::span<const GpuTexture> textures) const = 0;
};

}  // namespace footprint
