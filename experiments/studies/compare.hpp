// The main job: methods against the supersampled reference over the distances of a scene, as records and pictures.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "experiments/studies/stage.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/pipeline/supersample.hpp"
#include "renderer/scene/settings/scene.hpp"
#include "renderer/scene/surface.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Samples a pixel at which plain supersampling is measured and timed beside the methods, unless other counts are
/// given.
inline constexpr std::array supersampling_counts{1, 2, 4, 8, 16, 32, 64};

/// What `footprint compare` is asked for.
struct CompareSettings {
  std::string scene;           ///< as load_scene takes it
  SceneLibrary scene_library;  ///< what it may name
  std::vector<MethodSpec> methods;
  std::vector<double> distances;   ///< factors on the camera's distance; empty: the scene's zoom path
  std::optional<glm::ivec2> size;  ///< none: the scene's own
  bool consecutive = false;        ///< the distances are frames of a zoom: flicker is measured between them
  CameraSettings camera;           ///< monostate: the scene's own
  int spp = 64;                    ///< samples a pixel of the reference, 1 to 4096
  std::vector<int> other_spp;      ///< of further references that errors are measured against
  std::vector<int> supersampling{supersampling_counts.begin(), supersampling_counts.end()};
  std::uint64_t seed = 1;
  ReferenceFilter filter = ReferenceFilter::after_shading;
  EnvironmentUse environment = EnvironmentUse::sampled;  ///< how the reference integrates one
  std::optional<float> exposure;                         ///< none: the scene's own, else automatic
  EffectSet without;                                     ///< effects that every method and the reference leave out
  int repeats = 9;                                       ///< timed frames of each method and distance in each process
  int anisotropy = 1;
  int tile = 0;
  std::optional<std::filesystem::path> cache;  ///< where slow precomputes are kept; none: they are not
  gl::ContextRequest context;
};

/// Frame times of one process: [distance][candidate][repeat], milliseconds; candidate 0 is `direct`, then the methods
/// in the order of the settings (whole frames), then the frame builds alone of those that have one, in the same order.
using FrameTimes = std::vector<std::vector<std::vector<double>>>;

/// Times frames and does nothing else: what each further process of `--processes` runs.
[[nodiscard]] FrameTimes time_frames(const CompareSettings& settings, const Progress& progress);

/// Runs the comparison and writes its pictures into FOLDER/images (made here). `further_times` are those of other
/// processes; the figures are over all of them. Results lacks tool and backend.cpu, which the program knows.
/// Errors: of scene, methods and settings (usage), of the machine, an interrupt through `progress`.
[[nodiscard]] Results run_compare(const CompareSettings& settings, const std::filesystem::path& folder,
                                  std::span<const FrameTimes> further_times, const Progress& progress);

}  // namespace footprint
