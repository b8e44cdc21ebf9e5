// What a run over a scene is asked for, whoever asks: the command line or an experiment's file.
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
#include "renderer/pipeline/shader_flags.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/surface.hpp"

namespace footprint {

/// Who set an exposure.
enum class ExposureSource { scene, automatic, command_line, experiment };

/// As reports write it.
inline constexpr std::array<Word<ExposureSource>, 4> exposure_sources{{
    {ExposureSource::scene, "scene"},
    {ExposureSource::automatic, "automatic"},
    {ExposureSource::command_line, "command line"},
    {ExposureSource::experiment, "experiment"},
}};

/// A factor on radiance, above 0, and who set it.
struct Exposure {
  float factor = 1;
  ExposureSource source = ExposureSource::automatic;
};

/// Frames at equal ratios of the camera's distance.
struct ZoomSettings {
  int frames = 0;              ///< 0: there is no zoom; else 2 or more
  std::optional<double> from;  ///< factor on the camera's distance; none: the first of the scene's zoom path
  std::optional<double> to;    ///< none: the last of it; 8 times `from` where it has one only
};

/// What moves from frame to frame of an animation.
enum class AnimationPath {
  zoom,   ///< the camera along its own axis
  orbit,  ///< the camera around the centre of the bounds
  light   ///< all lights around it, together
};

/// As users write it.
inline constexpr std::array<Word<AnimationPath>, 3> animation_paths{{
    {AnimationPath::zoom, "zoom"},
    {AnimationPath::orbit, "orbit"},
    {AnimationPath::light, "light"},
}};

/// The path of an animation; how many frames it has, and from where to where a zoom leads, says ZoomSettings.
struct PathSettings {
  AnimationPath kind = AnimationPath::zoom;
  std::optional<double> degrees;   ///< from the first frame to the last, of what turns; none: 60
  std::optional<glm::dvec3> axis;  ///< of the turn, unit, in the world; none: the camera's up
};

/// What is seen of the scene.
struct ViewSettings {
  std::optional<glm::ivec2> size;        ///< pixels; none: the scene's own, or 512 wide in the camera's aspect
  std::optional<glm::ivec2> quick_size;  ///< of a run that is cut short; none: a quarter of `size`
  std::vector<double> distances;         ///< factors on the camera's distance; empty: the scene's zoom path
  ZoomSettings zoom;                 ///< in place of `distances`; consecutive frames, between which flicker is measured
  std::optional<Exposure> exposure;  ///< none: the scene's own, else automatic
  /// The error at the top of every error picture, for pictures of several runs on one scale; none: what the run calls
  /// for.
  std::optional<double> error_scale;
};

/// Whether the picture of the method `exact` is drawn beside the others: what the footprint filter leaves of the error.
enum class BoundUse {
  automatic,  ///< of as many pixels as are cheap
  on,         ///< of all of them
  off
};

/// As users write it.
inline constexpr std::array<Word<BoundUse>, 3> bound_uses{{
    {BoundUse::automatic, "auto"},
    {BoundUse::on, "on"},
    {BoundUse::off, "off"},
}};

/// What errors are measured against.
struct ReferenceSettings {
  int spp = 64;                 ///< samples a pixel, 1 to 4096; where `by_noise`, those to begin with
  bool by_noise = false;        ///< goes on tile by tile, 4096 samples at most, until the noise floor is `noise`
  bool fixed_spp = false;       ///< `spp` was asked for, so that `by_noise` has no say
  std::optional<double> noise;  ///< normalised colour error; none: a fifth of the least difference between methods
  int spp_max = 4096;
  std::vector<int> other_spp;                              ///< of further references that errors are measured against
  std::vector<int> supersampling{1, 2, 4, 8, 16, 32, 64};  ///< samples a pixel of the measured curve
  std::uint64_t seed = 1;                                  ///< same seed, same bytes
  ReferenceFilter filter = ReferenceFilter::after_shading;
  EnvironmentUse environment = EnvironmentUse::sampled;  ///< how it integrates one
  BoundUse bound = BoundUse::automatic;
  /// Whether the errors of representation, filtering and the environment's lookup are measured, for which more is drawn
  /// than a method's frame.
  bool by_cause = true;
};

/// How frame times are taken.
struct TimingSettings {
  int repeats = 9;                      ///< timed frames of each method and distance in each process
  int processes = 1;                    ///< one after the other
  std::optional<FootprintFilter> unit;  ///< of the `direct` that ratios are taken to; none: that of the methods
};

/// Where a run is drawn.
struct BackendSettings {
  gl::ContextRequest context;
  int tile = 0;  ///< pixels a side drawn at once; 0: as many as fit
};

/// All that a run over a scene can be asked for; each study heeds what it has a use for. setting.hpp has the words
/// that users write for it.
struct RunSettings {
  std::string scene;           ///< as load_scene takes it
  SceneLibrary scene_library;  ///< what it may name
  SceneOverrides overrides;    ///< of the scene's own words
  std::vector<MethodSpec> methods;
  bool by_material = false;  ///< errors are told by material too
  EffectSet without;         ///< effects that every method and the reference leave out
  ViewSettings view;
  PathSettings path;
  std::optional<FootprintFilter> footprint;  ///< none: the scene's own, else default_footprint_filter
  ReferenceSettings reference;
  TimingSettings timing;
  BackendSettings backend;
  std::optional<std::filesystem::path> cache;  ///< folder where slow precomputes are kept; none: they are not
};

}  // namespace footprint
