// The set-up of frame times: methods over Khronos' ClearCoatTest, or another scene, at 512 x 512, on one context, and
// their yardstick: the least that shades the same triangles from a normal map under a light.
#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "experiments/studies/stage.hpp"
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

inline constexpr glm::ivec2 frame_pixels{512, 512};
inline constexpr int reference_spp = 64;
inline constexpr std::uint64_t reference_seed = 1;

/// ClearCoatTest without its coats under the supplied lamps alone, as it has always been timed; the file must exist.
[[nodiscard]] Scene load_bench_model();

/// The scene of a name or path; ClearCoatTest where `name` is empty: none where its package (assimp-testmodels) is not
/// installed, after a line on stderr that says so. Errors: those of load_scene.
[[nodiscard]] std::optional<Scene> load_bench_scene(const std::string& name);

/// The frames of footprint_bench at 512 x 512: `direct` and the methods of a comma-separated list; of an empty one
/// all whose precompute takes no seconds. Errors (usage): unknown method or option.
[[nodiscard]] RunSettings bench_settings(const std::string& methods);

/// The scene, its methods, its reference and the bare yardstick, ready to draw at the camera's own distance.
class BenchScene {
 public:
  /// Errors: those of Stage.
  BenchScene(Scene scene, const RunSettings& settings);

  [[nodiscard]] const Stage& stage() const { return stage_; }

  void draw_bare() const { bare_.draw(view_); }
  void draw(const StagedMethod& method) const { method.frames().draw(view_); }
  /// The reference at 64 samples per pixel, not read back.
  void draw_reference() const;
  /// The staged method as written, options included. Errors (usage): it is none of those staged.
  [[nodiscard]] const StagedMethod& method(const std::string& text) const;

 private:
  Stage stage_;
  View view_;
  BareFrame bare_;
};

}  // namespace footprint::bench
