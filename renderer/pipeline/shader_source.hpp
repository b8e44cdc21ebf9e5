// The stages of every program: which texts they are put together from, and what they declare.
#pragma once

#include <string>
#include <string_view>

#include "renderer/pipeline/shader_flags.hpp"
#include "renderer/pipeline/shader_text.hpp"

namespace footprint {

/// The material's uniform block, in front of the shared functions: with `multi_lobe` they read it.
[[nodiscard]] std::string material_block(const ShaderFlags& flags);

/// The lobes, base BRDF terms and footprint functions, and behind them a module's own where one is given: for programs
/// that evaluate them outside of a frame. `shade_calls` is 1.
[[nodiscard]] std::string shared_functions(const ShaderFlags& flags, const ShaderModule& module = {});

/// The numbers of a footprint filter, in front of the shared functions where it is not trilinear.
[[nodiscard]] std::string footprint_constants(const FootprintFilter& filter);

[[nodiscard]] std::string vertex_shader(const ShaderVariant& variant);

/// The forward pass around a method's module; `prefiltered` (any material's) gives the names of its textures and
/// scalars.
[[nodiscard]] ShaderText fragment_shader(const ShaderVariant& variant, const ShaderModule& module,
                                         const Options& options, const Prefiltered& prefiltered);

/// A method's module for programs of others, without a version line: what it reads are plain uniforms (samplers by the
/// names of its textures, scalars by theirs, what bare_material.glsl has), and bare_module.glsl says what to call.
[[nodiscard]] std::string bare_module(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                                      const Prefiltered& prefiltered);

/// A pass that evaluates the module's `ndf` at listed directions for one footprint; its vertices are
/// screen_vertex_shader's. The arguments are fragment_shader's.
[[nodiscard]] ShaderText ndf_shader(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                                    const Prefiltered& prefiltered);

/// A stage of a frame build's pass, of any kind: `pass` has its inputs, outputs and `main`; in front of it stand the
/// lobes and base BRDF terms, the number options, the material's block and `constants`, declarations of the caller's.
[[nodiscard]] ShaderText frame_build_shader(const ShaderVariant& variant, const ShaderModule& pass,
                                            const Options& options, std::string_view constants = {});

/// The stages that draw a shadow map.
[[nodiscard]] std::string shadow_vertex_shader(const EffectSet& effects);
[[nodiscard]] std::string shadow_fragment_shader(const EffectSet& effects);

/// The stages that draw the samples of the mask of interior pixels: pieces of surface, or where `variant` has
/// cast_shadow the shares of lights. `textures` declares what they read.
[[nodiscard]] std::string interior_vertex_shader(const ShaderVariant& variant);
[[nodiscard]] std::string interior_fragment_shader(const ShaderVariant& variant, std::string_view textures);
/// The stage that compares the samples of a pixel.
[[nodiscard]] std::string interior_compare_shader(bool shadows);

/// A vertex stage that covers the whole viewport by 3 vertices, without attributes.
[[nodiscard]] std::string screen_vertex_shader();
/// The stage that adds a pass of samples to the reference's sums.
[[nodiscard]] std::string resolve_shader();

}  // namespace footprint
