// Everything that a run over one scene holds on the GPU: context, scene, and the methods ready to draw.
#pragma once

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "renderer/gl/context.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/supersample.hpp"

namespace footprint {

/// What decides which programs and targets are made.
struct StageSettings {
  std::vector<MethodSpec> methods;
  std::optional<glm::ivec2> size;  ///< none: the scene's own, or 512 wide in the camera's aspect
  ReferenceFilter filter = ReferenceFilter::after_shading;
  EnvironmentUse environment = EnvironmentUse::sampled;  ///< how the reference integrates one
  int anisotropy = 1;                                    ///< probes along the major axis, at most
  int tile = 0;                                          ///< pixels a side drawn at once; 0: as many as fit
  EffectSet without = {};                           ///< effects that are left out, by every method and the reference
  std::optional<std::filesystem::path> cache = {};  ///< folder where slow precomputes are kept; none: they are not
  int pictures = 3;  ///< as large as the frame, that are held at once: the frame, and two while it is written
};

/// The size of a frame: `wanted`, else scene.toml's, else 512 wide in the aspect of the camera (square without one).
/// Errors (usage): a side below 1.
[[nodiscard]] glm::ivec2 frame_size(const Scene& scene, const std::optional<glm::ivec2>& wanted);

/// Errors (machine): so many pictures (RGBA, 32-bit floats) of this size are more than memory holds.
void require_pictures(const glm::ivec2& size, int count);

/// A method ready to draw frames. Pinned: each part keeps the address of those before it.
class StagedMethod {
 public:
  StagedMethod(const gl::ContextInfo& context, GpuScene& scene, const Scene& values, const EffectSet& effects,
               const MethodSpec& spec, const glm::ivec2& size, const StageSettings& settings, const Progress& progress);

  [[nodiscard]] const BakedMethod& baked() const { return *baked_; }
  [[nodiscard]] const GpuMethod& gpu() const { return *gpu_; }
  [[nodiscard]] const FrameRenderer& frames() const { return *frames_; }

 private:
  std::unique_ptr<BakedMethod> baked_;
  std::unique_ptr<GpuMethod> gpu_;
  std::unique_ptr<FrameRenderer> frames_;
};

/// A scene with its methods and its reference on one context. Everything is made in the constructor.
class Stage {
 public:
  /// Errors of the parts: usage (scene, method, option), machine (no GL, limits, memory).
  Stage(const gl::ContextRequest& request, Scene scene, const StageSettings& settings, const Progress& progress);

  [[nodiscard]] const gl::Context& context() const { return context_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] const std::vector<EffectDecision>& decisions() const { return decisions_; }
  [[nodiscard]] const EffectSet& effects() const { return effects_; }
  [[nodiscard]] const GpuScene& gpu_scene() const { return *gpu_scene_; }
  [[nodiscard]] const std::vector<StagedMethod>& methods() const { return methods_; }
  [[nodiscard]] const Supersampler& reference() const { return *reference_; }
  [[nodiscard]] View view(double distance) const;

  /// A method's own finest level, supersampled as the reference is.
  [[nodiscard]] Supersampler finest_level(const StagedMethod& method) const;

 private:
  gl::Context context_;
  Scene scene_;
  StageSettings settings_;
  glm::ivec2 size_;
  std::vector<EffectDecision> decisions_;
  EffectSet effects_;
  std::unique_ptr<GpuScene> gpu_scene_;
  std::vector<StagedMethod> methods_;
  std::unique_ptr<BakedMethod> base_;
  std::unique_ptr<GpuMethod> gpu_base_;
  std::unique_ptr<Supersampler> reference_;
};

}  // namespace footprint
