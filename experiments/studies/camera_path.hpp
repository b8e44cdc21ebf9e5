// What moves along an animation: for each frame where the camera stands, or where the lights are.
#pragma once

#include <vector>

#include "experiments/settings/run_settings.hpp"

namespace footprint {

/// Where an animation's path is in one frame.
struct PathFrame {
  double distance = 1;  ///< factor on the camera's distance
  double degrees = 0;   ///< that camera or lights have turned by since the first frame
};

/// The frames of a run's path over `scene`, as many as its zoom's settings say. Errors (usage): a zoom that ends where
/// it starts; a setting that the path has no use for; lights are to move and the scene has none but an environment.
[[nodiscard]] std::vector<PathFrame> path_frames(const RunSettings& settings, const Scene& scene);

/// What a path turns around, unit: the camera's up where nothing is asked for.
[[nodiscard]] glm::dvec3 turning_axis(const PathSettings& path, const Scene& scene);

/// The camera in a frame.
[[nodiscard]] Camera camera_on_path(const PathSettings& path, const Scene& scene, const PathFrame& frame);

/// The lights in a frame: turned around the centre of the bounds, positions and directions alike. The environment
/// stays.
[[nodiscard]] std::vector<Light> lights_on_path(const PathSettings& path, const Scene& scene, const PathFrame& frame);

/// The scene as a path's first frame has it, with shadows switched on where any of its frames calls for them: effects
/// are chosen once for all frames.
[[nodiscard]] Scene scene_for_path(const RunSettings& settings, Scene scene);

}  // namespace footprint
