// The order in which a stage's texts and declarations follow one another.
#include "renderer/pipeline/shader_source.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "renderer/pipeline/bindings.hpp"
#include "renderer/pipeline/shadow_maps.hpp"

namespace footprint {
namespace {

constexpr std::string_view version_line = "#version 450 core\n";

// Of stages without a method.
Options no_options() { return {{}, {}, "no options"}; }

std::string light_capacities(const ShaderVariant& v) {
  std::string text;
  const auto capacity = [&](Effect effect, std::string_view name, std::size_t count) {
    if (has(v.effects, effect))
      text += fmt::format("const int {}_capacity = {};\n", name, std::max<std::size_t>(count, 1));
  };
  capacity(Effect::point_light, "point_light", v.point_lights);
  capacity(Effect::spot_light, "spot_light", v.spot_lights);
  capacity(Effect::directional_light, "directional_light", v.directional_lights);
  text += fmt::format("const int light_capacity = {};\n", v.point_lights + v.spot_lights + v.directional_lights);
  if (v.environment_suns > 0) text += fmt::format("const int environment_sun_count = {};\n", v.environment_suns);
  if (calls_for_shadow_maps(v.effects)) capacity(Effect::cast_shadow, "shadow_view", v.shadow_maps);
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

std::string scalar_declarations(const Prefiltered& prefiltered) {
  if (prefiltered.scalars.empty()) return {};
  std::string text = fmt::format("layout(std140, binding = {}) uniform MethodBlock {{\n", block_binding::method);
  for (const auto& [name, value] : prefiltered.scalars) text += fmt::format("  float {};\n", name);
  return text + "};\n";
}

// What is uploaded for a bare module: no bindings, so that whoever sets them finds them by their names.
std::string plain_declarations(const Prefiltered& prefiltered) {
  std::string text;
  for (const PrefilteredTexture& texture : prefiltered.textures)
    text += fmt::format("uniform {} {};\n", texture.layers > 0 ? "sampler2DArray" : "sampler2D", texture.name);
  for (const auto& [name, value] : prefiltered.scalars) text += fmt::format("uniform float {};\n", name);
  return text;
}

// The lines that tell a compiler whose lines follow are of no use to who has one file.
std::string without_line_numbers(const std::string& text) {
  std::string kept;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = std::min(text.find('\n', at), text.size() - 1) + 1;
    if (text.compare(at, 6, "#line ") != 0) kept.append(text, at, end - at);
    at = end;
  }
  return kept;
}

void add_material_block(ShaderText& text, const ShaderFlags& flags, std::size_t facet_lobes) {
  if (flags.at("multi_lobe")) text.add(fmt::format("const int most_facet_lobes = {};\n", facet_lobes));
  text.include("surface_material.glsl");
}

// How often a pixel calls a module's `shade` at most: for every light, in every part of a `shaded` footprint.
int shade_calls(const ShaderVariant& v) {
  const std::size_t lights = v.point_lights + v.spot_lights + v.directional_lights + v.environment_suns;
  const int parts = v.footprint.kind == FootprintFilterKind::shaded ? v.footprint.count * v.footprint.count : 1;
  return parts * static_cast<int>(std::max<std::size_t>(lights, 1));
}

void add_shared_functions(ShaderText& text, const ShaderFlags& flags, int calls = 1) {
  text.add(fmt::format("const int shade_calls = {};\n", calls));
  text.include("common_footprint.glsl");
  text.include("common_lobes.glsl");
  text.include("common_base_brdf.glsl");
  if (flags.at("environment_light")) text.include("normal_lobes.glsl");
}

// The beginning of a stage that has a module.
ShaderText begun(const ShaderFlags& flags, const ShaderModule& module) {
  ShaderText text(flags, module);
  text.add(fmt::format("{}#line {}\n", version_line, first_shared_line));
  return text;
}

// A pass around a method's module, behind what the module reads (its textures, scalars and options, the material's
// block) and may call.
void add_method_pass(ShaderText& text, const ShaderVariant& variant, const ShaderFlags& flags, const Options& options,
                     const Prefiltered& prefiltered, std::string_view pass) {
  text.add(footprint_constants(variant.footprint) + number_options(options) + scalar_declarations(prefiltered));
  add_material_block(text, flags, variant.facet_lobes);
  add_shared_functions(text, flags, shade_calls(variant));
  text.include(pass);
}

}  // namespace

// The parts are no constant: a loop whose rounds are known is unrolled, which takes compilers seconds.
std::string footprint_constants(const FootprintFilter& filter) {
  return fmt::format("const int most_probes = {0};\nuniform int footprint_parts = {0};\n", filter.count);
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

std::string vertex_shader(const ShaderVariant& variant) {
  ShaderText text(shader_flags(variant, no_options()));
  text.add(version_line);
  text.include("surface_vertex.glsl");
  return text.text();
}

ShaderText fragment_shader(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                           const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options, prefiltered);
  ShaderText text = begun(flags, module);
  text.add(forward_units(variant, prefiltered).declarations() + light_capacities(variant));
  text.include("surface_lights.glsl");
  if (calls_for_shadow_maps(variant.effects)) text.include("surface_shadows.glsl");
  add_method_pass(text, variant, flags, options, prefiltered, "surface_fragment.glsl");
  return text;
}

std::string bare_module(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                        const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options, prefiltered);
  ShaderText text(flags, module);
  text.add(plain_declarations(prefiltered) + footprint_constants(variant.footprint) + number_options(options));
  if (flags.at("multi_lobe")) text.add(fmt::format("const int most_facet_lobes = {};\n", variant.facet_lobes));
  text.include("bare_material.glsl");
  add_shared_functions(text, flags, shade_calls(variant));
  text.include("bare_module.glsl");
  return without_line_numbers(text.text());
}

ShaderText ndf_shader(const ShaderVariant& variant, const ShaderModule& module, const Options& options,
                      const Prefiltered& prefiltered) {
  const ShaderFlags flags = shader_flags(variant, options, prefiltered);
  ShaderText text = begun(flags, module);
  text.add(TextureUnits(variant.effects, prefiltered).declarations());
  add_method_pass(text, variant, flags, options, prefiltered, "ndf_fragment.glsl");
  return text;
}

ShaderText frame_build_shader(const ShaderVariant& variant, const ShaderModule& pass, const Options& options,
                              std::string_view constants) {
  const ShaderFlags flags = shader_flags(variant, options);
  ShaderText text = begun(flags, pass);
  text.add(number_options(options));
  add_material_block(text, flags, variant.facet_lobes);
  add_shared_functions(text, flags);
  text.add(constants);
  text.include_module();
  return text;
}

std::string shadow_vertex_shader(const EffectSet& effects) {
  ShaderText text(shader_flags({.effects = effects, .brdf = {}}, no_options()));
  text.add(version_line);
  text.include("shadow_vertex.glsl");
  return text.text();
}

std::string shadow_fragment_shader(const EffectSet& effects) {
  const ShaderFlags flags = shader_flags({.effects = effects, .brdf = {}}, no_options());
  ShaderText text(flags);
  text.add(version_line);
  if (has(effects, Effect::alpha_mask)) {
    if (has(effects, Effect::base_color_variation)) text.add("layout(binding = 0) uniform sampler2D base_color_map;\n");
    add_material_block(text, flags, most_facet_lobes);
  }
  text.include("shadow_fragment.glsl");
  return text.text();
}

std::string interior_vertex_shader(const ShaderVariant& variant) {
  ShaderText text(shader_flags(variant, no_options()));
  text.add(version_line);
  text.include("interior_vertex.glsl");
  return text.text();
}

std::string interior_fragment_shader(const ShaderVariant& variant, std::string_view textures) {
  const ShaderFlags flags = shader_flags(variant, no_options());
  ShaderText text(flags);
  text.add(version_line);
  text.add(std::string(textures) + light_capacities(variant));
  add_material_block(text, flags, variant.facet_lobes);
  if (calls_for_shadow_maps(variant.effects)) {
    text.include("surface_lights.glsl");
    text.include("surface_shadows.glsl");
  }
  text.include("interior_fragment.glsl");
  return text.text();
}

std::string interior_compare_shader(bool shadows) {
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::cast_shadow), shadows);
  ShaderText text(shader_flags({.effects = effects, .brdf = {}}, no_options()));
  text.add(version_line);
  text.include("interior_compare.glsl");
  return text.text();
}

std::string screen_vertex_shader() {
  ShaderText text({});
  text.add(version_line);
  text.include("screen_vertex.glsl");
  return text.text();
}

std::string resolve_shader() {
  ShaderText text({});
  text.add(version_line);
  text.include("resolve_samples.glsl");
  return text.text();
}

}  // namespace footprint
