// The part of a run over one scene that is on the GPU: context, scene, and the methods ready to draw.
#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "experiments/studies/frame_setup.hpp"
#include "experiments/studies/view_path.hpp"
#include "renderer/core/disk_cache.hpp"
#include "renderer/core/error.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/image/image.hpp"
#include "renderer/pipeline/frame.hpp"
#include "renderer/pipeline/interior.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/scene/scene.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// How a stage is set up.
struct StageOptions {
  int pictures = pictures_of_a_frame;  ///< as large as the frame, in memory at once
  /// Whether it has `direct` as the unit that frame times and samples are counted in: the settings' own, or one more
  /// where they have none under the filter of TimingSettings::unit.
  bool has_unit = false;
  /// Whether a method that exceeds memory, or whose textures or program OpenGL refuses, is staged without maps or
  /// frames and says why (StagedMethod::refusal); else it is an error, as it is of a unit that the settings do not
  /// have.
  bool records_refusals = false;
};

/// Runs `action`. Returns its error, with its place within the method; none where it succeeds. GL errors that it leaves
/// are cleared. Errors: an interrupt, or a lost context, after which nothing else draws.
[[nodiscard]] std::optional<Error> catch_failure(const gl::Context& context, const MethodSpec& method,
                                                 const std::function<void()>& action);

/// The cache in a folder; none without one.
[[nodiscard]] std::optional<DiskCache> cache_in(const std::optional<std::filesystem::path>& folder);

/// The maps of a method, from the cache in a folder if it has them.
[[nodiscard]] BakedMethod bake_by_cache(const std::optional<std::filesystem::path>& cache, const MethodSpec& spec,
                                        const Scene& scene, const EffectSet& effects, const Progress& progress);

/// The maps of a method in memory and on the GPU, which serve frames of every size under every footprint filter.
struct PreparedMethod {
  std::unique_ptr<BakedMethod> baked;
  std::unique_ptr<GpuMethod> gpu;
};

/// Shared by stages over one scene: its context, its maps and meshes on the GPU, and the methods that were prepared
/// for them. The first stage fills it.
struct PreparedScene {
  /// poses: of an animation; null: it is loaded for its frames.
  /// Errors (usage): as require_given_bakes.
  PreparedScene(Scene loaded, const RunSettings& settings, std::shared_ptr<ScenePoses> poses = nullptr);

  gl::Context context;
  Scene scene;
  std::size_t triangles;  ///< that were given
  std::vector<EffectDecision> decisions;
  EffectSet effects;
  std::shared_ptr<ScenePoses> poses;  ///< of an animation
  std::unique_ptr<GpuScene> gpu;      ///< null before the first stage
  /// By name and options of their maps; methods that differ in their history share them.
  std::map<std::string, std::shared_ptr<const PreparedMethod>> methods{};
  PreparedMethod base{};  ///< what the reference draws
};

/// A method as it is to be drawn.
struct StagedFrames {
  MethodSpec spec;
  FootprintFilter filter{};
  HistorySettings history{};
};

/// A method ready to draw frames. Pinned: each part keeps the address of those before it.
class StagedMethod {
 public:
  /// gpu_scene: of `scene`; must outlive the method.
  StagedMethod(const gl::ContextInfo& context, GpuScene& gpu_scene, const Scene& scene,
               std::shared_ptr<const PreparedMethod> prepared, const StagedFrames& wanted, const glm::ivec2& size,
               int tile);

  /// A method that cannot be drawn, for the reason given: it has options, but no maps and no frames.
  StagedMethod(const MethodSpec& spec, const Error& refusal);

  /// Why the method cannot be drawn; none where it can.
  [[nodiscard]] const std::optional<Error>& refusal() const { return refusal_; }

  [[nodiscard]] const BakedMethod& baked() const { return *prepared_->baked; }
  [[nodiscard]] const GpuMethod& gpu() const { return *prepared_->gpu; }
  [[nodiscard]] const FrameRenderer& frames() const { return *frames_; }
  [[nodiscard]] const MethodSpec& spec() const { return drawn_.spec; }
  /// The method's text, as written.
  [[nodiscard]] const std::string& text() const { return drawn_.spec.text; }
  [[nodiscard]] const FootprintFilter& filter() const { return drawn_.filter; }
  [[nodiscard]] const HistorySettings& history() const { return drawn_.history; }

 private:
  std::shared_ptr<const PreparedMethod> prepared_;
  std::unique_ptr<FrameRenderer> frames_;
  StagedFrames drawn_;
  std::optional<Error> refusal_;
};

/// A scene with its methods and its reference on one context. Everything is made in the constructor.
class Stage {
 public:
  /// The settings' methods over `scene`, which need not be the settings' own.
  /// Errors of the parts: usage (scene, method, option), machine (no GL, limits, memory).
  Stage(Scene scene, const RunSettings& settings, const Progress& progress, const StageOptions& options = {});

  /// The settings' methods over a scene that other stages may have prepared: what they have is taken from there, and
  /// what is made is left there for those that follow. Their settings differ in methods, footprint filter and size
  /// alone.
  Stage(std::shared_ptr<PreparedScene> scene, const RunSettings& settings, const Progress& progress,
        const StageOptions& options = {});

  [[nodiscard]] const gl::Context& context() const { return prepared_->context; }
  [[nodiscard]] const Scene& scene() const { return prepared_->scene; }
  /// The scene for the head of a report: its triangles as they were given, not as visibility at vertices cuts them.
  [[nodiscard]] SceneInfo info() const;
  [[nodiscard]] const std::vector<EffectDecision>& decisions() const { return prepared_->decisions; }
  [[nodiscard]] const EffectSet& effects() const { return prepared_->effects; }
  [[nodiscard]] const GpuScene& gpu_scene() const { return *prepared_->gpu; }
  /// In the order of the settings; last a unit that they do not have themselves.
  [[nodiscard]] const std::vector<StagedMethod>& methods() const { return methods_; }
  /// The methods of the settings, without a unit that they do not have.
  [[nodiscard]] std::span<const StagedMethod> requested_methods() const;
  /// The place of the unit among them. Only of a stage that has one.
  [[nodiscard]] std::size_t unit() const { return unit_.value(); }
  [[nodiscard]] bool has_unit() const { return unit_.has_value(); }
  [[nodiscard]] const Supersampler& reference() const { return *reference_; }
  [[nodiscard]] View view(double distance) const;

  /// Moves the lights to where they are in a view, and what an animation moves, shadows included, and returns the
  /// camera of that view. Errors: as ScenePoses::at and GpuScene::update.
  [[nodiscard]] View move_to(const RunView& view);

  /// The first method over the scene with other effects.
  /// gpu_scene: of those effects; must outlive the method.
  [[nodiscard]] StagedMethod stage_with(const EffectSet& effects, GpuScene& gpu_scene) const;

  /// Another method over the same scene.
  [[nodiscard]] StagedMethod stage(const MethodSpec& method, const Progress& progress) const;

  /// Finds the pixels in which the reference sees one smooth piece of surface.
  [[nodiscard]] InteriorFinder interior_finder() const;

  /// A method's frames with the environment as directional lights, each of which is shaded: the sum that
  /// the lookup by lobes approximates.
  [[nodiscard]] FrameRenderer dense_frames(const StagedMethod& method) const;

  /// A method's frames whose pixels are counts (PixelWork, PixelTrips).
  [[nodiscard]] FrameRenderer counting_frames(const StagedMethod& method, Counting counting) const;

  /// The texts of a method's frames with constant numbers of rounds in their loops.
  [[nodiscard]] ForwardProgram program_for_cost(const StagedMethod& method, const FixedTrips& trips) const;

  /// A method's own finest level, supersampled as the reference is.
  [[nodiscard]] Supersampler finest_level(const StagedMethod& method) const;

 private:
  [[nodiscard]] std::vector<StagedFrames> wanted_methods(bool has_unit);
  [[nodiscard]] StagedMethod staged(const StagedFrames& method, const Progress& progress) const;
  // Bakes a method, unless a folder or the cache of the settings has its maps, and uploads it.
  [[nodiscard]] std::shared_ptr<const PreparedMethod> prepared(const MethodSpec& spec, const EffectSet& effects,
                                                               const GpuScene& gpu_scene,
                                                               const Progress& progress) const;
  void pose_at(double seconds);

  std::shared_ptr<PreparedScene> prepared_;
  RunSettings settings_;
  std::vector<Light> lights_;   // of the first view
  std::vector<Mesh> shapes_{};  // of an animation: the meshes of the first view, not refined
  std::optional<double> posed_at_{};
  glm::ivec2 size_;
  std::vector<StagedMethod> methods_;
  std::optional<std::size_t> unit_;
  std::unique_ptr<Supersampler> reference_;
};

}  // namespace footprint
