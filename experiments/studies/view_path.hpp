// The views of a run: its distances (given, a zoom's or the scene's own), or the frames of a path; and the scene, the
// camera and the lights in each.
#pragma once

#include <compare>
#include <cstddef>
#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "experiments/settings/run_settings.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {

/// `frames` (2 or more) factors on the camera's distance from `from` to `to` (above 0), at equal ratios: each step
/// looks like the one before.
[[nodiscard]] std::vector<double> zoom_distances(double from, double to, int frames);

/// The distances of a run that are known without its scene; empty: the scene decides.
[[nodiscard]] std::vector<double> given_distances(const ViewSettings& view);

/// The distances of a run over `scene`, one or more. Errors (usage): a zoom that ends where it starts.
[[nodiscard]] std::vector<double> run_distances(const ViewSettings& view, const Scene& scene);

/// One view of the scene.
struct RunView {
  double distance = 1;      ///< factor on the camera's distance
  double degrees = 0;       ///< that camera or lights have turned by since the first view
  double seconds = 0;       ///< time of the model file's animation, on a path that follows it
  std::uint32_t frame = 0;  ///< number on a path of several frames

  friend auto operator<=>(const RunView&, const RunView&) = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// A view in its place among those of a run.
struct PlannedView {
  RunView at;
  RunKind kind = RunKind::comparison;
  std::size_t index = 0, count = 1;

  /// In messages: "distance 4", or of an animation "frame 3 of 30".
  [[nodiscard]] std::string words() const;

  /// The file name part of something in this view: "d4_WHAT", or of an animation "WHAT_0002".
  [[nodiscard]] std::string stem(const std::string& what) const;
};

/// The views of a run over `scene`: its distances, or as many frames of its path as the settings of its zoom say.
/// Errors (usage): a zoom that ends where it starts; a setting that the path has no use for; lights are to move and the
/// scene has none but an environment.
/// first_time: seconds of the model file's animation in the first view.
[[nodiscard]] std::vector<PlannedView> plan_views(const ViewSettings& settings, double first_time, const Scene& scene);

/// Seconds of the model file's animation in the first view of a run: 0 by default.
[[nodiscard]] inline double first_time(const SceneOverrides& overrides) { return overrides.model.time.value_or(0.0); }

/// The scene of a run at any time of its animation. Its files are read once.
class ScenePoses {
 public:
  /// scene, library, overrides: as load_scene takes them.
  ScenePoses(std::string scene, SceneLibrary library, SceneOverrides overrides)
      : scene_(std::move(scene)), library_(std::move(library)), overrides_(std::move(overrides)) {}

  /// Seconds of the animation in the scene as it was asked for.
  [[nodiscard]] double first_time() const { return footprint::first_time(overrides_); }

  /// The scene as it was asked for. Errors: as load_scene.
  [[nodiscard]] Scene first() const { return load_scene(scene_, library_, overrides_); }

  /// bounds: of all frames, by which cameras and lights without a place of their own are placed.
  /// Errors: as load_scene.
  [[nodiscard]] Scene at(double seconds, const std::optional<PlacedBounds>& bounds);

 private:
  std::string scene_;
  SceneLibrary library_;
  SceneOverrides overrides_;
  SceneFiles files_{};
};

/// The scene of a run: of a path along an animation as its first frame has it, within the bounds of all frames and with
/// shadows where any frame has them.
/// Errors: as load_scene.
[[nodiscard]] Scene scene_of_run(const ViewSettings& settings, ScenePoses& poses);

/// The axis of a path, unit: the camera's up by default.
[[nodiscard]] glm::dvec3 turning_axis(const PathSettings& path, const Scene& scene);

/// The camera in a view.
[[nodiscard]] Camera camera_on_path(const PathSettings& path, const Scene& scene, const RunView& view);

/// The lights in a view: turned around the centre of the bounds, positions and directions alike. The environment
/// stays.
/// lights: those of the first view.
[[nodiscard]] std::vector<Light> lights_on_path(const PathSettings& path, const Scene& scene,
                                                const std::vector<Light>& lights, const RunView& view);

/// The scene as a path's first frame has it, with shadows switched on where any of its frames calls for them: effects
/// are chosen once for all frames.
[[nodiscard]] Scene scene_for_path(const ViewSettings& settings, Scene scene);

}  // namespace footprint
