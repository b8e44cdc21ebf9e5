// One scene on one context, drawn by any method, for tests of the pipeline and of methods.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>

#include "renderer/gl/context.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/supersample.hpp"

namespace footprint::testing {

/// The EGL surfaceless context that all tests of a binary share; made on the first call.
[[nodiscard]] const gl::Context& shared_context();

/// A scene uploaded with its own effects, or with `effects` if given. Bakes and compiled programs are reused, so a
/// second image of the same method costs only its frame.
class TestRenderer {
 public:
  explicit TestRenderer(const Scene& scene, const glm::ivec2& size = {64, 64}, std::optional<EffectSet> effects = {},
                        const gl::Context& context = shared_context());

  /// The frames of a method: the same object on each call.
  [[nodiscard]] const FrameRenderer& frames(const Method& method, const std::string& text,
                                            const FootprintFilter& filter, int tile = 0,
                                            EnvironmentUse environment = EnvironmentUse::sampled);
  [[nodiscard]] Image frame(const Method& method, const std::string& text = {}, const FootprintFilter& filter = {},
                            int tile = 0, double distance = 1.0, EnvironmentUse environment = EnvironmentUse::sampled);
  /// The mean of the first frames of a sequence, each with draws of its own, in double precision.
  [[nodiscard]] Image mean_frame(const Method& method, const std::string& text, const FootprintFilter& filter,
                                 std::uint32_t frames, std::uint64_t seed = 1, int tile = 0);
  /// Texture lookups and lobe evaluations per pixel of that frame.
  [[nodiscard]] PixelWork work(const Method& method, const std::string& text, const FootprintFilter& filter);
  [[nodiscard]] Supersampled supersampled(const Method& method, int spp, std::uint64_t seed = 1,
                                          Sampling filter = Sampling::after_shading, int tile = 0,
                                          EnvironmentUse environment = EnvironmentUse::sampled,
                                          TexelUse texels = TexelUse::filtered);
  [[nodiscard]] Supersampled reference(int spp, std::uint64_t seed = 1, Sampling filter = Sampling::after_shading,
                                       int tile = 0, EnvironmentUse environment = EnvironmentUse::sampled,
                                       TexelUse texels = TexelUse::filtered);
  [[nodiscard]] std::string fragment_text(const Method& method);
  /// Replaces the scene by another of the same parts (GpuScene::update).
  void update(const Scene& scene);
  [[nodiscard]] const GpuScene& gpu_scene() const { return gpu_scene_; }

 private:
  struct Prepared;

  [[nodiscard]] BakedMethod baked(const Method& method, const std::string& text) const;
  /// The method baked and uploaded, on the first call for `text`.
  [[nodiscard]] Prepared& prepared(const Method& method, const std::string& text);

  const gl::Context* context_;
  glm::ivec2 size_;
  EffectSet effects_;
  Scene scene_;
  GpuScene gpu_scene_;
  std::map<std::pair<const Method*, std::string>, std::shared_ptr<Prepared>> prepared_;
};

/// The renderer of `key`, made from scene() and `size` on the first call. Tests of several methods share its scene and
/// environment on the GPU. A key has one scene in a test program.
[[nodiscard]] TestRenderer& shared_renderer(const std::string& key, const std::function<Scene()>& scene,
                                            const glm::ivec2& size = {64, 64});

/// The largest absolute difference of any channel; infinite for different sizes or a NaN.
[[nodiscard]] double largest_difference(const Image& a, const Image& b);

/// The relative RMSE of an image over the pixels of a reference.
[[nodiscard]] double error_of(const Image& picture, const Image& reference);

/// A filter from its text: "box:3".
[[nodiscard]] FootprintFilter filter_of(const std::string& text);

/// The mean of the three colour channels over the pixels of four channels that are wholly covered; NaN where none is.
[[nodiscard]] double covered_mean(const Image& picture);

}  // namespace footprint::testing
