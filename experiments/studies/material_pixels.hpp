// Which pixels show which material of a scene.
#pragma once

#include <memory>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/pipeline/frame.hpp"

namespace footprint {

/// Draws the scene once more, each material in a colour that tells its number, lit from the camera.
class MaterialFinder {
 public:
  /// Errors (machine): as of GpuScene and FrameRenderer.
  MaterialFinder(const gl::ContextInfo& context, const Scene& scene, const glm::ivec2& size, int tile);

  /// A mask for each material, one channel: the pixels of `interior` whose centre shows it and nothing else. Pixels
  /// that several materials share by a map of indices, and those that turn away from the camera by their shading
  /// normal, are in none.
  [[nodiscard]] std::vector<Image> masks(const View& view, const Image& interior);

 private:
  Scene scene_;
  std::unique_ptr<GpuScene> gpu_scene_;
  std::unique_ptr<BakedMethod> baked_;
  std::unique_ptr<GpuMethod> gpu_;
  std::unique_ptr<FrameRenderer> frames_;
};

}  // namespace footprint
