// The order of texts and declarations in each stage, and of texture units.
#include "renderer/pipeline/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <numeric>
#include <stdexcept>

#include "renderer/bake/material_maps.hpp"
#include "renderer/core/error.hpp"
#include "renderer/pipeline/gpu_environment.hpp"
#include "renderer/pipeline/shader_contract.hpp"
#include "renderer/pipeline/shadow_maps.hpp"

namespace footprint {
namespace {

constexpr std::string_view version_line = "#version 450 core\n";
constexpr std::string_view screen_vertices =
    "void main() { gl_Position = vec4(vec2(gl_VertexID == 1 ? 3.0 : -1.0, gl_VertexID == 2 ? 3.0 : -1.0), 0.0, 1.0); "
    "}\n";

// Lights that a program shades one by one.
std::size_t punctual_lights(const ShaderVariant& v) {
  return std::reduce(v.lights.begin(), v.lights.end()) - v.lights[light_type::area];
}

std::string light_capacities(const ShaderVariant& v) {
  std::string text;
  const auto capacity = [&](std::string_view name, std::size_t count) {
    text += fmt::format("const int {}_capacity = {};\n", name, count);
  };
  for (std::size_t i = 0; i < light_types.size(); ++i) {
    const bool is_declared = i == light_type::area_point ? v.lights[i] > 0 : has(v.effects, light_types[i].effect);
    if (is_declared) capacity(light_types[i].shader_name, std::max<std::size_t>(v.lights[i], 1));
  }
  capacity("light", punctual_lights(v));
  if (v.environment_suns > 0) text += fmt::format("const int environment_sun_count = {};\n", v.environment_suns);
  if (calls_for_shadow_maps(v.effects)) capacity("shadow_view", std::max<std::size_t>(v.shadow_maps, 1));
  return text;
}

std::string fixed_trips(const std::optional<FixedTrips>& trips, const EffectSet& effects) {
  if (!trips) return {};
  std::string text = fmt::format("const int fixed_probes = {}, fixed_lobes = {}, fixed_rounds = {};\n", trips->probes,
                                 trips->lobes, trips->rounds);
  for (std::size_t i = 0; i < light_types.size(); ++i) {
    if (has(effects, light_types[i].effect))
      text += fmt::format("const int {} = {};\n", light_types[i].counter, trips->lights[i]);
  }
  return text;
}

std::string number_options(const Options& options) {
  std::string text;
  for (const OptionSpec& option : options.specs()) {
    if (option.choices.empty())
      text += fmt::format("const float option_{} = {:e};\n", option.shader_name(), options.number(option.name));
  }
  return text;
}

// A method's scalars and vectors, each behind `qualifier`.
std::string value_declarations(const Prefiltered& prefiltered, std::string_view qualifier) {
  std::string text;
  for (const auto& [name, value] : prefiltered.scalars) text += fmt::format("{}float {};\n", qualifier, name);
  for (const auto& [name, values] : prefiltered.vectors)
    text += fmt::format("{}vec2 {}[{}];\n", qualifier, name, values.size());
  return text;
}

std::string method_block(const Prefiltered& prefiltered) {
  const std::string values = value_declarations(prefiltered, "  ");
  if (values.empty()) return {};
  return fmt::format("layout(std140, binding = {}) uniform MethodBlock {{\n{}}};\n", block_binding::method, values);
}

// The textures and values of a bare module, without bindings, so that other programs find them by name.
std::string plain_declarations(const Prefiltered& prefiltered) {
  std::string text;
  for (const PrefilteredTexture& texture : prefiltered.textures)
    text += fmt::format("uniform {} {};\n", texture.layers > 0 ? "sampler2DArray" : "sampler2D", texture.name);
  return text + value_declarations(prefiltered, "uniform ");
}

// #line directives are useless in a single file.
std::string without_line_numbers(const std::string& text) {
  std::string out;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    if (text.compare(at, 6, "#line ") != 0) out.append(text, at, end - at);
    at = end;
  }
  return out;
}

void add_material_block(ShaderText& text, const ShaderFlags& flags, std::size_t facet_lobes) {
  if (flags.at("multi_lobe")) text.add(fmt::format("const int most_facet_lobes = {};\n", facet_lobes));
  text.include("surface_material.glsl");
}

// The most calls of a module's `shade` per pixel: once per light and part of a footprint.
int shade_calls(const ShaderVariant& v) {
  const std::size_t lights = punctual_lights(v) + v.environment_suns;
  const int count = v.footprint.count;
  const bool tiles = v.footprint.kind == FootprintFilterKind::shaded;
  const int parts = tiles ? count * count : is_stochastic(v.footprint) ? count : 1;
  return parts * static_cast<int>(std::max<std::size_t>(lights, 1));
}

void add_shared_functions(ShaderText& text, const ShaderFlags& flags, int calls = 1) {
  text.add(fmt::format("const int shade_calls = {};\n", calls));
  text.include("common_footprint.glsl");
  text.include("common_lobes.glsl");
  text.include("common_base_brdf.glsl");
  if (flags.at("environment_light") || flags.at("lobes_listed")) text.include("normal_lobes.glsl");
}

// The start of a stage with a module.
ShaderText module_text(const ShaderFlags& flags, const ShaderModule& module) {
  ShaderText text(flags, module);
  text.add(fmt::format("{}#line {}\n", version_line, first_shared_line));
  return text;
}

// A pass around a method's module, after everything that the module reads or calls.
void add_method_pass(ShaderText& text, const ShaderVariant& variant, const ShaderFlags& flags, const Options& options,
                     const Prefiltered& prefiltered, std::string_view pass) {
  text.add(footprint_constants(variant.footprint) + number_options(options) + method_block(prefiltered));
  add_material_block(text, flags, variant.facet_lobes);
  add_shared_functions(text, flags, shade_calls(variant));
  text.include(pass);
}

// A method's module without bindings, with the functions for its callers.
ShaderText bare_text(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                     const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options, prefiltered);
  ShaderText text(flags, module);
  text.add(plain_declarations(prefiltered) + footprint_constants(variant.footprint) + number_options(options));
  if (flags.at("multi_lobe")) text.add(fmt::format("const int most_facet_lobes = {};\n", variant.facet_lobes));
  text.include("bare_material.glsl");
  add_shared_functions(text, flags, shade_calls(variant));
  text.include("bare_module.glsl");
  require_definitions(text, module.file);
  return text;
}

constexpr std::array<GLenum, 5> sampler_types{GL_SAMPLER_2D, GL_SAMPLER_2D_ARRAY, GL_SAMPLER_2D_ARRAY_SHADOW,
                                              GL_SAMPLER_3D, GL_SAMPLER_CUBE};

}  // namespace

// The number of parts is a uniform, because compilers take seconds to unroll loops of a constant count.
std::string footprint_constants(const FootprintFilter& filter) {
  return fmt::format(
      "const int most_probes = {0};\nuniform int footprint_parts = {0};\nconst int footprint_depth = {1};\n",
      filter.count, filter.depth);
}

std::string shared_functions(const ShaderFlags& flags, const ShaderModule& module) {
  ShaderText text(flags, module);
  add_shared_functions(text, flags);
  if (!module.file.empty()) text.include_module();
  return text.text();
}

std::string material_block(const ShaderFlags& flags) {
  ShaderText text(flags);
  add_material_block(text, flags, most_facet_lobes);
  return text.text();
}

ForwardShaders forward_shaders(const ShaderVariant& variant, const TextureUnits& units, const ShaderModule& module,
                               const Options& options, const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options, prefiltered);
  ShaderText fragment = module_text(flags, module);
  fragment.add(units.declarations() + light_capacities(variant) + fixed_trips(variant.fixed_trips, variant.effects));
  fragment.include("surface_lights.glsl");
  add_method_pass(fragment, variant, flags, options, prefiltered, "surface_fragment.glsl");
  return {shared_stage("surface_vertex.glsl", flags), std::move(fragment)};
}

std::string bare_module(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                        const Prefiltered& prefiltered) {
  return without_line_numbers(bare_text(variant, module, options, prefiltered).text());
}

std::string bare_fragment(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                          const Prefiltered& prefiltered) {
  ShaderText text = bare_text(variant, module, options, prefiltered);
  text.include("bare_main.glsl");
  return std::string(version_line) + without_line_numbers(text.text());
}

ShaderText ndf_shader(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                      const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options, prefiltered);
  ShaderText text = module_text(flags, module);
  text.add(TextureUnits(variant.effects, prefiltered).declarations());
  add_method_pass(text, variant, flags, options, prefiltered, "ndf_fragment.glsl");
  return text;
}

ShaderText frame_build_shader(const ShaderVariant& variant, const ShaderModule& pass, const Options& options,
                              std::string_view constants) {
  const ShaderFlags flags = shader_flags(variant, options);
  ShaderText text = module_text(flags, pass);
  text.add(number_options(options));
  add_material_block(text, flags, variant.facet_lobes);
  add_shared_functions(text, flags);
  text.add(constants);
  text.include_module();
  require_definitions(text, pass.file);
  return text;
}

std::string shared_stage(std::string_view file, const ShaderFlags& flags) {
  ShaderText text(flags);
  text.add(version_line);
  text.include(file);
  return text.text();
}

std::string shadow_fragment_shader(const EffectSet& effects) {
  const ShaderFlags flags = shader_flags({.effects = effects});
  ShaderText text(flags);
  text.add(version_line);
  if (has(effects, Effect::alpha_mask)) {
    if (has(effects, Effect::base_color_variation)) text.add("layout(binding = 0) uniform sampler2D base_color_map;\n");
    add_material_block(text, flags, most_facet_lobes);
  }
  text.include("shadow_fragment.glsl");
  return text.text();
}

std::string interior_fragment_shader(const ShaderVariant& variant, std::string_view textures) {
  const ShaderFlags flags = shader_flags(variant);
  ShaderText text(flags);
  text.add(version_line);
  text.add(std::string(textures) + light_capacities(variant));
  add_material_block(text, flags, variant.facet_lobes);
  if (calls_for_shadow_maps(variant.effects)) text.include("surface_lights.glsl");
  text.include("interior_fragment.glsl");
  return text.text();
}

std::string screen_vertex_shader() { return std::string(version_line).append(screen_vertices); }

TextureUnits::TextureUnits(const EffectSet& effects, const Prefiltered& prefiltered) {
  for (const SharedMap& map : shared_maps()) {
    if (has(effects, map.effect)) add(map.name, "sampler2D");
  }
  for (const PrefilteredTexture& texture : prefiltered.textures)
    add(texture.name, texture.layers > 0 ? "sampler2DArray" : "sampler2D");
}

void TextureUnits::add(std::string_view name, std::string_view sampler) {
  textures_.push_back({std::string(name), sampler});
}

GLuint TextureUnits::unit(std::string_view name) const {
  const auto found = std::ranges::find(textures_, name, &Texture::name);
  if (found == textures_.end()) throw std::logic_error(fmt::format("no texture unit is given to `{}`", name));
  return static_cast<GLuint>(found - textures_.begin());
}

std::string TextureUnits::declarations() const {
  std::string text;
  for (std::size_t unit = 0; unit < textures_.size(); ++unit)
    text += fmt::format("layout(binding = {}) uniform {} {};\n", unit, textures_[unit].sampler, textures_[unit].name);
  return text;
}

void TextureUnits::require_room(const gl::ContextInfo& context, const std::string& method) const {
  if (size() <= static_cast<std::size_t>(context.max_texture_units)) return;
  std::string names;
  for (const Texture& texture : textures_) names += (names.empty() ? "" : ", ") + texture.name;
  throw Error(ErrorKind::machine, fmt::format("method {}", method),
              fmt::format("its program reads {} textures ({})", size(), names),
              fmt::format("this GL has {} units: pack the method's textures into fewer", context.max_texture_units));
}

void TextureUnits::require_all_of(const gl::Program& program, const std::string& method) const {
  for (const auto& [name, uniform] : program.uniforms()) {
    if (std::ranges::find(sampler_types, uniform.type) == sampler_types.end()) continue;
    if (std::ranges::find(textures_, name, &Texture::name) != textures_.end()) continue;
    throw Error(ErrorKind::usage, fmt::format("method {}", method),
                fmt::format("its program reads the texture `{}`, which has no unit", name),
                "bake it in the precompute, or give it a row in renderer/bake/material_maps.cpp");
  }
}

TextureUnits forward_units(const ShaderVariant& variant, const Prefiltered& prefiltered) {
  TextureUnits units(variant.effects, prefiltered);
  if (has(variant.effects, Effect::environment_light)) {
    for (const std::string_view name : environment_textures(variant.environment))
      units.add(name, name == "environment_stack" || name == "environment_lobes" ? "sampler2DArray" : "sampler2D");
  }
  if (hides_environment(variant.effects)) units.add("visibility_maps", "sampler2DArray");
  if (variant.area_lobes) units.add("area_cosines", "sampler2DArray");
  if (calls_for_shadow_maps(variant.effects)) units.add("shadow_maps", "sampler2DArrayShadow");
  return units;
}

std::vector<std::string_view> environment_textures(EnvironmentUse use) {
  switch (use) {
    case EnvironmentUse::prefiltered:
      break;
    case EnvironmentUse::sampled:
      return {"environment_radiance", "environment_sums"};
    case EnvironmentUse::dense:
      return {"environment_lights", "environment_directions"};
  }
  return {"environment_stack", "environment_irradiance", "environment_lobes"};
}

}  // namespace footprint
