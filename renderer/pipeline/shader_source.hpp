// The stages of every program: the texts that they consist of, and the bindings that they declare.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "renderer/gl/context.hpp"
#include "renderer/gl/objects.hpp"
#include "renderer/pipeline/shader_flags.hpp"
#include "renderer/pipeline/shader_text.hpp"

namespace footprint {

/// The bindings of uniform blocks in the shared shaders.
namespace block_binding {
inline constexpr GLuint material = 0, method = 1, environment = 5, shadow_views = 6;  // others: light_types
}  // namespace block_binding

/// The textures of one program in the order of their units, from 0.
class TextureUnits {
 public:
  /// The textures of a method's module: the shared maps whose effects are on, then the method's own.
  TextureUnits(const EffectSet& effects, const Prefiltered& prefiltered);

  /// Assigns the next unit to a texture.
  /// sampler: its type in the shader.
  void add(std::string_view name, std::string_view sampler);

  /// A texture and its type in the shader.
  struct Texture {
    std::string name;
    std::string_view sampler;
  };
  /// In the order of the units.
  [[nodiscard]] const std::vector<Texture>& textures() const { return textures_; }
  [[nodiscard]] std::size_t size() const { return textures_.size(); }
  /// Throws std::logic_error if there is no such texture.
  [[nodiscard]] GLuint unit(std::string_view name) const;
  /// One `layout(binding) uniform` line per texture.
  [[nodiscard]] std::string declarations() const;

  /// Throws Error (machine) that names method and textures if this GL has fewer units.
  void require_room(const gl::ContextInfo& context, const std::string& method) const;
  /// Throws Error (usage) that names the method if its program reads a texture without a unit.
  void require_all_of(const gl::Program& program, const std::string& method) const;

 private:
  std::vector<Texture> textures_;
};

/// The textures of a forward pass: the module's, then those of the environment, of its visibility, and the shadow maps.
[[nodiscard]] TextureUnits forward_units(const ShaderVariant& variant, const Prefiltered& prefiltered);

/// The textures of an environment in the order of their units.
[[nodiscard]] std::vector<std::string_view> environment_textures(EnvironmentUse use);

/// The material's uniform block. It precedes the shared functions, which read it with `multi_lobe`.
[[nodiscard]] std::string material_block(const ShaderFlags& flags);

/// Lobes, base BRDF terms and footprint functions, then the module if one is given. For programs that evaluate them
/// outside of a frame. `shade_calls` is 1.
[[nodiscard]] std::string shared_functions(const ShaderFlags& flags, const ShaderModule& module = {});

/// The constants of a footprint filter. They precede the shared functions unless the filter is trilinear.
[[nodiscard]] std::string footprint_constants(const FootprintFilter& filter);

/// The stages of a forward pass.
struct ForwardShaders {
  std::string vertex;
  ShaderText fragment;
};

/// The forward pass around a method's module.
/// units: the textures that it may read (forward_units).
/// prefiltered: any material's; gives the names of the method's textures and values.
[[nodiscard]] ForwardShaders forward_shaders(const ShaderVariant& variant, const TextureUnits& units,
                                             const ShaderModule& module, const Options& options,
                                             const Prefiltered& prefiltered);

/// A method's module for other programs, without a version line. Its inputs are plain uniforms: samplers and values by
/// their names in `prefiltered`, and those of bare_material.glsl. bare_module.glsl documents the functions to call.
[[nodiscard]] std::string bare_module(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                                      const Prefiltered& prefiltered);

/// The text of bare_module behind a version line, with the entry point of bare_main.glsl: a whole fragment shader.
[[nodiscard]] std::string bare_fragment(const ShaderVariant& variant, const ShaderModule& module,
                                        const Options& options, const Prefiltered& prefiltered);

/// A pass that evaluates the module's `ndf` at listed directions for one footprint. Its vertex stage is
/// screen_vertex_shader. Arguments as in forward_shaders.
[[nodiscard]] ShaderText ndf_shader(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                                    const Prefiltered& prefiltered);

/// A stage of a frame build's pass, of any kind.
/// pass: inputs, outputs and `main`. Lobes, base BRDF terms, number options and the material's block precede it.
/// constants: further declarations in front of `pass`.
[[nodiscard]] ShaderText frame_build_shader(const ShaderVariant& variant, const ShaderModule& pass,
                                            const Options& options, std::string_view constants = {});

/// A stage of one shared file.
[[nodiscard]] std::string shared_stage(std::string_view file, const ShaderFlags& flags = {});

/// The fragments of shadow_vertex.glsl, for a shadow map.
[[nodiscard]] std::string shadow_fragment_shader(const EffectSet& effects);

/// The fragments of interior_vertex.glsl, samples for the mask of interior pixels: geometry, or with cast_shadow in
/// `variant` the unshadowed shares of lights.
/// textures: declarations of the textures that they read.
[[nodiscard]] std::string interior_fragment_shader(const ShaderVariant& variant, std::string_view textures);

/// A vertex stage that covers the whole viewport with 3 vertices, without attributes.
[[nodiscard]] std::string screen_vertex_shader();

}  // namespace footprint
