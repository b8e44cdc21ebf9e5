// The variant of a program, and the flags that shader texts may test.
#pragma once

#include <array>
#include <cstddef>
#include <optional>

#include "renderer/bake/method.hpp"
#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/pipeline/lights.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// How one sample filters the maps.
enum class Sampling {
  frame,          ///< the pixel's footprint, prefiltered: one sample per pixel
  after_shading,  ///< shades one texel's own base BRDF; the texel is drawn with the bilinear weights
  nearest,        ///< shades the nearest texel of the finest level
  bilinear,       ///< shades the bilinear mean of the finest level's values, so it interpolates the normal first
};

/// The words for the reference's filters.
inline constexpr auto reference_filters = std::to_array<Word<Sampling>>(
    {{Sampling::after_shading, "after_shading"}, {Sampling::nearest, "nearest"}, {Sampling::bilinear, "bilinear"}});

/// How a program integrates the light of an environment.
enum class EnvironmentUse {
  prefiltered,  ///< methods: by the module's lobes and prefiltered maps
  sampled,      ///< reference: directions drawn for each sample
  dense,        ///< reference: 6 x 32 x 32 directional lights, all of them for each sample
};

/// The words for the reference's integration of an environment.
inline constexpr auto reference_integrals =
    std::to_array<Word<EnvironmentUse>>({{EnvironmentUse::sampled, "sampled"}, {EnvironmentUse::dense, "dense"}});

/// The figures that a program writes instead of radiance.
enum class Counting {
  none,
  work,   ///< texture lookups and lobe evaluations
  trips,  ///< mean rounds of the loops over probes, over lobes, and over the parts of a method
};

/// The rounds of each loop in a program that is compiled to estimate its cost; at least 1 each.
struct FixedTrips {
  int probes = 1, lobes = 1, rounds = 1;
  PerLightType<int> lights{1, 1, 1, 1, 1};
};

/// What a program is compiled for. Equal variants give equal text.
struct ShaderVariant {
  EffectSet effects{};
  BaseBrdf brdf{};
  Sampling sampling = Sampling::frame;
  FootprintFilter footprint{};  ///< of a frame
  Counting counting = Counting::none;
  std::optional<FixedTrips> fixed_trips{};  ///< loops with constant numbers of rounds
  bool orthographic = false;
  bool horizon_open = false;         ///< light from below the vertices' plane arrives (Horizon::open)
  bool shared_coordinates = false;   ///< all maps of the scene are looked up at one uv
  bool surface_coordinates = false;  ///< the method has its own coordinates (Prefiltered::surface_coordinates)
  bool screen_derivatives = false;   ///< of a frame: MethodInfo::screen_derivatives
  bool finest_maps = false;          ///< of a frame: MethodInfo::reads_finest_level
  bool emitting = false;             ///< draws what surfaces emit, and nothing else (emitted_light.hpp)
  EnvironmentUse environment = EnvironmentUse::prefiltered;  ///< sampled only if the module draws directions
  bool sums_environment = false;                             ///< MethodInfo::sums_environment
  std::size_t environment_suns = 0;            ///< suns separated from the environment (scene/environment.hpp)
  std::size_t facet_lobes = most_facet_lobes;  ///< capacity per material; a smaller one compiles faster
  PerLightType<std::size_t> lights{};          ///< points of area lights: those that the program evaluates
  bool area_lobes = false;                     ///< integrates area lights by the module's lobes
  bool area_sampled = false;                   ///< of the reference: draws points of area lights and directions
  std::size_t shadow_maps = 0;
};

/// All flags of the shared texts and of a method's word options (`storage_fp16`), each on or off. They depend on the
/// variant, on the options, and on the kinds of the method's textures.
[[nodiscard]] ShaderFlags shader_flags(const ShaderVariant& variant, const Options& options = {{}, {}, "no options"},
                                       const Prefiltered& prefiltered = {});

}  // namespace footprint
