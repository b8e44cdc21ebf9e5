// The yardstick of the frame times: the least that shades the same triangles from a normal map under a light.
#pragma once

#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint::bench {

/// One fetch of the normal map at its finest level and one GGX lobe under one light, by a program that knows nothing of
/// effects, footprints, materials or light lists. Draws the batches of a GpuScene into a target of its own.
class BareFrame {
 public:
  BareFrame(const Scene& scene, const GpuScene& gpu_scene, const glm::ivec2& size);

  /// Draws a view of a perspective camera; the pixels stay on the GPU.
  void draw(const View& view) const;

 private:
  const GpuScene* gpu_scene_;
  std::vector<GpuTexture> normal_maps_;  // one a batch
  gl::Sampler sampler_;
  gl::Program program_;
  gl::RenderTarget target_;
};

}  // namespace footprint::bench
