// What a program is made for, and the flags that its text may ask for.
#pragma once

#include <cstddef>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/bake/shader_module.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/pipeline/environment_use.hpp"
#include "renderer/scene/footprint_filter.hpp"
#include "renderer/scene/material.hpp"

namespace footprint {

/// Which texels a sample reads.
enum class Sampling {
  frame,  ///< the pixel's footprint: one sample a pixel, prefiltered
  texel,  ///< one texel of the finest level, drawn with the bilinear weights: filter after shading
  point,  ///< the finest level at a point; the sampler decides between nearest and bilinear
};

/// What a program is made for. Equal variants give equal text.
struct ShaderVariant {
  EffectSet effects;
  BaseBrdf brdf;
  Sampling sampling = Sampling::frame;
  FootprintFilter footprint{};  ///< of a frame
  bool counting = false;        ///< writes what a pixel looks up and evaluates, in place of its radiance
  bool orthographic = false;
  bool horizon_open = false;         ///< light from below the vertices' plane arrives (Horizon::open)
  bool shared_coordinates = false;   ///< every map of the scene is looked up at one uv
  bool surface_coordinates = false;  ///< the method has coordinates of its own (Prefiltered::surface_coordinates)
  bool screen_derivatives = false;   ///< a frame whose module asks how the next pixels lie (MethodInfo)
  bool finest_coat = false;          ///< a frame of a method that filters nothing (MethodInfo::reads_finest_level)
  EnvironmentUse environment = EnvironmentUse::prefiltered;  ///< sampled: of a module with `draws_directions`
  bool sums_environment = false;                             ///< the method's (MethodInfo)
  std::size_t environment_suns = 0;                          ///< what of the environment is told apart (small_sun.hpp)
  std::size_t facet_lobes = most_facet_lobes;  ///< room for so many a material: what has less compiles faster
  std::size_t point_lights = 0, spot_lights = 0, directional_lights = 0;
  std::size_t shadow_maps = 0;
};

/// All flags of the shared texts and of a method's word options (`storage_fp16`), each on or off: what the scene, the
/// sampling and the options say, and what the shared functions must offer for the method's textures.
[[nodiscard]] ShaderFlags shader_flags(const ShaderVariant& variant, const Options& options,
                                       const Prefiltered& prefiltered = {});

}  // namespace footprint
