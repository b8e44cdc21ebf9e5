// The module with its contract, and its translations with their inputs.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <regex>

#include "renderer/baked_files/baked_files.hpp"
#include "renderer/languages/spirv.hpp"
#include "renderer/pipeline/shader_source.hpp"

namespace footprint {
namespace {

ShaderVariant variant_of(const BakeToFiles& bake) {
  std::size_t most_lobes = 1;
  for (const Material& material : bake.scene.materials) most_lobes = std::max(most_lobes, material.lobes.size());
  const EffectSet given = all_effects_but({Effect::anisotropy_variation});  // the material's uniforms have its mean
  return {.effects = bake.effects & bake.baked.method->info.honours & given,
          .brdf = bake.scene.materials.front().brdf,
          .footprint = bake.footprint,
          .horizon_open = bake.scene.horizon == Horizon::open,
          .screen_derivatives = bake.baked.method->info.screen_derivatives,
          .facet_lobes = most_lobes};
}

constexpr const char* screen_contract =
    R"(//
// This method looks at the next pixels. Between the first two lines, and instead of the last:
//
//   lookAround(at, eye, frame, world_to_camera, f);  // in every pixel of a quad, before any is discarded
//   vec3 f_cos = reflectedTowards(e, s, wi, wo, vec4(lamp, 1.0));   // vec4(direction, 0.0) of light without a place
)";

std::string contract(const BakeToFiles& bake) {
  return fmt::format(
      R"(// {} as `footprint bake` wrote it (Footprint {}), footprint filter {}.
//
// Put it behind `#version 450 core` into a fragment shader. Bind the textures by the names of the samplers below, with
// the filter and wrap modes, and set the uniforms to the values, that manifest.json gives for each material. Then:
//
//   Footprints f = footprintsAt(uv);                 // or member by member, where maps have coordinates of their own
//   Effective e = effective(f);                      // once per pixel
//   Surface s = Surface(albedo, f0);                 // diffuse albedo, reflectance at normal incidence
//   vec3 f_cos = reflectedTowards(e, s, wi, wo);     // for each light; f * cos
//
// wi and wo are unit vectors in the tangent frame (x tangent, y bitangent, z normal), towards the light and the viewer.
{})",
      bake.baked.spec.text, bake.version, footprint_filter_text(bake.footprint),
      bake.baked.method->info.screen_derivatives ? screen_contract : "");
}

// A translation, as its first lines describe it.
struct Form {
  ShaderLanguage language;
  std::string_view title;
  std::string_view places;  // where a host finds the inputs
};

constexpr std::array<Form, 4> forms{{
    {ShaderLanguage::essl, "OpenGL ES 3.1", "Texture n has binding n; uniform NAME is `uniforms.NAME`."},
    {ShaderLanguage::hlsl, "HLSL, shader model 5.0",
     "Texture n is t<n> with sampler s<n>; uniform NAME is `uniforms_NAME` in b0; attribute n is TEXCOORD<n>."},
    {ShaderLanguage::msl, "Metal 2.0",
     "Texture n is texture(n) with sampler(n); uniform NAME is `uniforms.NAME` in buffer(0); the entry point is "
     "`main0`."},
    {ShaderLanguage::spirv, "SPIR-V 1.3 for Vulkan",
     "In set 0 the uniforms are the std140 block of binding 0, and texture n has binding n + 1."},
}};

// The description of an input in the source: the comment behind its declaration, and a value that is assigned to it
// there.
std::string description(const std::string& glsl, const ShaderInput& input) {
  const std::string name = input.name.substr(0, input.name.find('['));
  const std::regex declaration(R"(\n[^\n/]*\b(?:uniform|in|out) \w+ )" + name +
                               R"((?:\[\w+\])?(?: = ([^;]*))?;(?: *// ([^\n]*))?)");
  std::smatch match;
  if (!std::regex_search(glsl, match, declaration)) return {};
  if (match[1].matched) return fmt::format("set it to {}", match[1].str());
  return match[2];
}

std::string input_line(const std::string& glsl, const ShaderInput& input, const std::string& prefix) {
  const std::string kind = input.kind == "uniform" ? input.kind : fmt::format("{} {}", input.kind, input.place);
  const std::string text = description(glsl, input);
  return fmt::format("{}  {:<12} {} {}{}{}\n", prefix, kind, input.type, input.name, text.empty() ? "" : ": ", text);
}

std::string fragment_of(const BakeToFiles& bake) {
  const BakedMethod& baked = bake.baked;
  return bare_fragment(variant_of(bake), baked.method->shader, baked.options, baked.materials.front());
}

std::string inputs_of(const std::string& glsl, const Spirv& code, ShaderLanguage language, const std::string& prefix) {
  std::string text = fmt::format("{}{}\n", prefix, std::ranges::find(forms, language, &Form::language)->places);
  for (const ShaderInput& input : shader_inputs(code)) text += input_line(glsl, input, prefix);
  return text;
}

Spirv spirv_of(const BakeToFiles& bake, const std::string& glsl) {
  return fragment_spirv(fmt::format("method {}", bake.baked.spec.text), glsl);
}

std::string introduction(const BakeToFiles& bake, ShaderLanguage language) {
  return fmt::format(
      R"(// {} as {}, by glslang and SPIRV-Cross from the GLSL of Footprint {}; footprint filter {}.
//
// The entry point draws one lamp. Other hosts call `footprintsAt` with the uv, `effective` once per pixel, and
// `reflectedTowards` once per light: f * cos. wi and wo are unit vectors in the tangent frame (x tangent, y bitangent,
// z normal), towards the light and the viewer. Textures and the values of uniforms are in the manifest.json of
// `footprint bake`.
//
)",
      bake.baked.spec.text, std::ranges::find(forms, language, &Form::language)->title, bake.version,
      footprint_filter_text(bake.footprint));
}

std::string bytes_of(const Spirv& code) {
  return {reinterpret_cast<const char*>(code.data()), code.size() * sizeof(Spirv::value_type)};
}

}  // namespace

std::string module_text(const BakeToFiles& bake) {
  const BakedMethod& baked = bake.baked;
  return contract(bake) + bare_module(variant_of(bake), baked.method->shader, baked.options, baked.materials.front());
}

std::string inputs_text(const BakeToFiles& bake, ShaderLanguage language, const std::string& prefix) {
  const std::string glsl = fragment_of(bake);
  return inputs_of(glsl, spirv_of(bake, glsl), language, prefix);
}

std::string shader_text(const BakeToFiles& bake, ShaderLanguage language) {
  if (language == ShaderLanguage::glsl) return module_text(bake);
  const std::string glsl = fragment_of(bake);
  const Spirv code = spirv_of(bake, glsl);
  if (language == ShaderLanguage::spirv) return bytes_of(code);
  std::string text = translate(code, language, glsl);
  // The version of ES must be the first line.
  const std::size_t first = text.starts_with("#version") ? text.find('\n') + 1 : 0;
  return text.insert(first, introduction(bake, language) + inputs_of(glsl, code, language, "// ") + "\n");
}

}  // namespace footprint
