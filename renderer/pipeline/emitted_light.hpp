// The light that surfaces emit, as one image per view. Every image of that view has the same one added, so no error
// contains it.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>

#include "renderer/bake/baked_method.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/pipeline/view.hpp"

namespace footprint {

/// The method that draws emitted light: it reflects nothing.
[[nodiscard]] const Method& emitted_surface();

/// Draws emitted light, and stores the image of the last view.
class EmittedLight {
 public:
  /// scene: must outlive this.
  explicit EmittedLight(GpuScene& scene);
  EmittedLight(const EmittedLight&) = delete;
  EmittedLight& operator=(const EmittedLight&) = delete;

  /// Adds the emitted light to the pixels of an image that are covered.
  /// picture: RGBA of the view's size.
  /// Throws as Supersampler::render.
  void add_to(Image& picture, const View& view);

 private:
  struct Drawn {
    Camera camera;
    SceneContent content;
    Image light;
  };
  [[nodiscard]] const Image& light_in(const View& view);

  GpuScene* scene_;
  BakedMethod baked_;
  GpuMethod method_;
  std::optional<Supersampler> sampler_;
  std::optional<bool> orthographic_;  // of the sampler
  std::optional<Drawn> drawn_;
};

}  // namespace footprint
