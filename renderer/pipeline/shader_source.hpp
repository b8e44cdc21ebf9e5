// Shader text: put together from the shared files and a method's module, without what the scene does not call for.
#pragma once

#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/core/options.hpp"
#include "renderer/effects/effects.hpp"
#include "renderer/pipeline/environment_use.hpp"
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
  int max_probes = 1;  ///< anisotropic probes along the major axis; 1: isotropic
  bool orthographic = false;
  bool shared_coordinates = false;   ///< every map of the scene is looked up at one place
  bool surface_coordinates = false;  ///< the method has coordinates of its own (Prefiltered::surface_coordinates)
  EnvironmentUse environment = EnvironmentUse::prefiltered;  ///< the others need a module with `draws_directions`
  std::size_t facet_lobes = most_facet_lobes;  ///< room for so many a material: what has less compiles faster
  std::size_t point_lights = 0, spot_lights = 0, directional_lights = 0;
  std::size_t shadow_maps = 0;
};

using ShaderFlags = std::set<std::string, std::less<>>;

/// The text without the parts whose flags are off, and without the directives (renderer/shaders/README.md). `numbered`:
/// `#line` directives keep the compiler's line numbers those of `text`. Errors (usage) name `file` and line: a
/// directive that is unknown or not closed, an `include` of what is no shared text.
[[nodiscard]] std::string select_text(std::string_view text, const ShaderFlags& flags, std::string_view file,
                                      bool numbered = false);

/// In a fragment shader the lines of the method's module have the numbers of its own file; all others are numbered from
/// here, out of their way. (Source strings would tell them apart, but Mesa's messages always name string 0.)
inline constexpr int first_shared_line = 10001;

/// The flags of a variant and of a method's word options.
[[nodiscard]] ShaderFlags shader_flags(const ShaderVariant& variant, const Options& options);

/// What the shared functions must offer for a method's textures: `texture_arrays`, `texel_lookups`.
[[nodiscard]] ShaderFlags texture_flags(const Prefiltered& prefiltered);

/// The material's uniform block, in front of the shared functions: with `multi_lobe` they read it, and it has room for
/// `facet_lobes`.
[[nodiscard]] std::string material_block(const ShaderFlags& flags, std::size_t facet_lobes = most_facet_lobes);

/// The lobes, base BRDF terms and footprint functions alone, for programs that evaluate a module outside of a frame.
[[nodiscard]] std::string shared_functions(const ShaderFlags& flags);

[[nodiscard]] std::string vertex_shader(const ShaderVariant& variant);

/// `module` is the method's text; `prefiltered` (any material's) gives the names of its textures and scalars.
[[nodiscard]] std::string fragment_shader(const ShaderVariant& variant, std::string_view module,
                                          std::string_view module_name, const Options& options,
                                          const Prefiltered& prefiltered);

/// A pass that evaluates the module's `ndf` at listed directions for one footprint; its vertices are
/// screen_vertex_shader's. The arguments are fragment_shader's.
[[nodiscard]] std::string ndf_shader(const ShaderVariant& variant, std::string_view module,
                                     std::string_view module_name, const Options& options,
                                     const Prefiltered& prefiltered);

/// A stage of a frame build's pass, of any kind: `pass` has its inputs, outputs and `main`; in front of it stand the
/// lobes and base BRDF terms, the number options and the material's block, and the flags are fragment_shader's and
/// `own`.
[[nodiscard]] std::string frame_build_shader(const ShaderVariant& variant, std::string_view pass,
                                             std::string_view pass_name, const Options& options,
                                             const ShaderFlags& own = {});

/// The stages that draw a shadow map.
[[nodiscard]] std::string shadow_vertex_shader(const EffectSet& effects);
[[nodiscard]] std::string shadow_fragment_shader(const EffectSet& effects);

/// A vertex stage that covers the whole viewport by 3 vertices, without attributes.
[[nodiscard]] std::string screen_vertex_shader();
/// The stage that adds a pass of samples to the reference's sums.
[[nodiscard]] std::string resolve_shader();

}  // namespace footprint
