// The settings of a run over a scene, from the command line or from an experiment's file.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>
#include <vector>

#include "renderer/core/names.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/pipeline/history_settings.hpp"
#include "renderer/pipeline/shader_flags.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// The origin of an exposure.
enum class ExposureSource { scene, automatic, command_line, experiment };

/// The words for it in reports.
inline constexpr std::array<Word<ExposureSource>, 4> exposure_sources{{
    {ExposureSource::scene, "scene"},
    {ExposureSource::automatic, "automatic"},
    {ExposureSource::command_line, "command line"},
    {ExposureSource::experiment, "experiment"},
}};
constexpr const auto& words_of(ExposureSource /*source*/) { return exposure_sources; }

/// A factor on radiance, above 0, and who set it.
struct Exposure {
  float factor = 1;
  ExposureSource source = ExposureSource::automatic;
};

/// Frames at equal ratios of the camera's distance.
struct ZoomSettings {
  int frames = 0;              ///< 0: no zoom; else 2 or more
  std::optional<double> from;  ///< factor on the camera's distance; none: the first of the scene's zoom path
  std::optional<double> to;    ///< none: the last of it, or 8 times `from` if it has only one
};

/// The part that moves from frame to frame of an animation.
enum class AnimationPath {
  zoom,      ///< the camera along its own axis
  orbit,     ///< the camera around the centre of the bounds
  light,     ///< all lights together, around it
  animation  ///< meshes, camera and lights of the model file, by its keys
};

/// The words for it in options and files.
inline constexpr auto animation_paths = std::to_array<Word<AnimationPath>>({{AnimationPath::zoom, "zoom"},
                                                                            {AnimationPath::orbit, "orbit"},
                                                                            {AnimationPath::light, "light"},
                                                                            {AnimationPath::animation, "animation"}});
constexpr const auto& words_of(AnimationPath /*path*/) { return animation_paths; }

/// The path of an animation. ZoomSettings has the number of frames and the ends of a zoom.
struct PathSettings {
  std::optional<AnimationPath> kind;  ///< none: not an animation
  std::optional<double> degrees;      ///< angle from the first frame to the last; none: 60
  std::optional<glm::dvec3> axis;     ///< of the rotation, unit, in world space; none: the camera's up
  std::optional<double> until;        ///< seconds of an animation at its last frame; none: its last key
};

/// The views of the scene.
struct ViewSettings {
  std::optional<glm::ivec2> size;        ///< pixels; none: the scene's own, else 512 wide in the camera's aspect ratio
  std::optional<glm::ivec2> quick_size;  ///< of a quick run; none: a quarter of `size`
  std::vector<double> distances;         ///< factors on the camera's distance; empty: the scene's zoom path
  ZoomSettings zoom;                     ///< instead of `distances`; flicker is measured between its frames
  PathSettings path;                     ///< of an animation
  std::optional<Exposure> exposure;      ///< none: the scene's own, else automatic
  /// The error at the top of the scale of every error image, to compare several runs; none: derived from the run.
  std::optional<double> error_scale;
};

/// Whether `exact` is rendered too, which separates the footprint filter's error from the methods' own.
enum class BoundUse {
  automatic,  ///< on as many pixels as are cheap
  on,         ///< on all of them
  off
};

/// The words for it in options and files.
inline constexpr std::array<Word<BoundUse>, 3> bound_uses{{
    {BoundUse::automatic, "auto"},
    {BoundUse::on, "on"},
    {BoundUse::off, "off"},
}};
constexpr const auto& words_of(BoundUse /*use*/) { return bound_uses; }
constexpr const auto& words_of(Sampling /*sampling*/) { return reference_filters; }
constexpr const auto& words_of(EnvironmentUse /*use*/) { return reference_integrals; }

/// The reference that errors are measured against.
struct ReferenceSettings {
  int spp = 64;                 ///< samples per pixel, 1 to 4096; the first ones if `by_noise`
  bool by_noise = false;        ///< refine it tile by tile, up to `spp_max` samples, until the noise floor is `noise`
  bool fixed_spp = false;       ///< `spp` was given, and overrides `by_noise`
  std::optional<double> noise;  ///< normalised colour error; none: a fifth of the smallest difference between methods
  int spp_max = 4096;
  std::vector<int> other_spp;                              ///< of further references that errors are measured against
  std::vector<int> supersampling{1, 2, 4, 8, 16, 32, 64};  ///< samples per pixel of the measured curve
  std::uint64_t seed = 1;                                  ///< same seed, same bytes
  Sampling filter = Sampling::after_shading;
  EnvironmentUse environment = EnvironmentUse::sampled;  ///< how it integrates an environment
  BoundUse bound = BoundUse::automatic;
  /// Whether the errors of representation, filtering and the environment's lookup are measured, which needs further
  /// images besides each method's frame.
  bool by_cause = true;
};

inline constexpr std::array<Word<bool>, 2> switch_words{{{true, "on"}, {false, "off"}}};

/// The timing of frames.
struct TimingSettings {
  int repeats = 9;                      ///< timed frames of each method and distance in each process
  int processes = 1;                    ///< one after the other
  std::optional<FootprintFilter> unit;  ///< of the `direct` frame that costs 1; none: that of the methods
};

/// The backend of a run.
struct BackendSettings {
  gl::ContextRequest context;
  int tile = 0;  ///< side of the tiles in pixels; 0: as large as fits
};

/// What a run prints and writes, and what it discards before.
struct OutputSettings {
  bool verbose = false;  ///< prints all of table.md
  bool video = false;    ///< writes the film of an animation
  bool fresh = false;    ///< discards finished work of earlier runs
};

/// All settings of a run; each study uses those that concern it. setting.hpp defines how users write them.
struct RunSettings {
  std::string scene;           ///< as load_scene takes it
  SceneLibrary scene_library;  ///< the scenes and surfaces that have names
  SceneOverrides overrides;    ///< of the scene's own settings
  std::vector<MethodSpec> methods;
  std::filesystem::path
      method_folder{};  ///< where relative paths of methods' files start; empty: the working directory
  std::vector<std::filesystem::path> bakes{};  ///< folders of `footprint bake` whose maps methods take
  bool by_material = false;                    ///< also measure errors by material
  EffectSet without;                           ///< effects that every method and the reference leave out
  ViewSettings view;
  std::optional<FootprintFilter> footprint;  ///< none: the scene's own, else default_footprint_filter
  HistorySettings history;                   ///< of the methods' frames
  ReferenceSettings reference;
  TimingSettings timing;
  std::vector<std::string> gpus;  ///< whose cost is estimated, by name
  BackendSettings backend;
  OutputSettings output;
  std::optional<std::filesystem::path> cache;  ///< folder of cached bakes; none: they are not cached
};

/// What a run measures over its views.
enum class RunKind : std::uint8_t {
  comparison,  ///< errors and times at distances
  zoom,        ///< errors and times at the distances of a path, and flicker from each to the next
  animation    ///< images, errors and flicker of the frames of a path, without times
};

[[nodiscard]] inline RunKind kind_of(const ViewSettings& view) {
  if (view.path.kind) return RunKind::animation;
  return view.zoom.frames > 0 ? RunKind::zoom : RunKind::comparison;
}

}  // namespace footprint
