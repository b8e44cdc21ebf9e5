// Bakes the method, binds its textures, and evaluates its shader text with the whole map as the footprint.
#include "tests/support/method_probe.hpp"

#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"

namespace footprint::testing {

EffectSet ProbedMethod::default_effects() {
  EffectSet set;
  for (const Effect effect : {Effect::normal_variation, Effect::diffuse, Effect::fresnel, Effect::masking_shadowing})
    set.set(static_cast<std::size_t>(effect));
  return set;
}

std::vector<glm::vec4> probe_method(const ProbedMethod& probed, const std::string& body,
                                    std::span<const std::array<glm::vec4, 3>> inputs) {
  const gl::Context& context = shared_context();
  const Options options(probed.method->info.options, probed.options, probed.method->info.name);
  ShaderVariant variant;
  variant.brdf = probed.material->brdf;
  variant.effects = probed.effects;
  const Prefiltered baked = probed.method->precompute(*probed.material, options, variant.effects, no_progress);
  std::vector<GpuTexture> textures;
  textures.reserve(baked.textures.size());
  SamplerCache samplers;
  std::string text;
  for (const PrefilteredTexture& texture : baked.textures) {
    const auto unit = static_cast<GLuint>(textures.size());
    textures.push_back(upload(texture));
    gl::api().BindTextureUnit(unit, textures.back().texture->name());
    const GpuTexture& bound = textures.back();
    gl::api().BindSampler(unit, samplers.sampler(bound.coordinates, bound.sampler_state(SamplerState::trilinear)));
    text += fmt::format("layout(binding = {}) uniform sampler2D{} {};\n", unit, texture.layers > 0 ? "Array" : "",
                        texture.name);
  }
  for (const auto& [name, value] : options.all()) {
    if (const auto* number = std::get_if<double>(&value))
      text += fmt::format("const float option_{} = {:e};\n", name, *number);
  }
  for (const auto& [name, value] : baked.scalars) text += fmt::format("const float {} = {:e};\n", name, value);
  for (const auto& [name, values] : baked.vectors) {
    std::string list;
    for (const glm::vec2& v : values) list += fmt::format("{}vec2({:e}, {:e})", list.empty() ? "" : ", ", v.x, v.y);
    text += fmt::format("const vec2 {0}[{1}] = vec2[{1}]({2});\n", name, values.size(), list);
  }
  text += fmt::format("const vec4 lobe_cutoff = vec4({:e});\n", lobe_of(*probed.material).parameter) +
          shared_functions(shader_flags(variant, options, baked), probed.method->shader);
  const std::string footprint = fmt::format(
      "Footprint whole_map = Footprint(vec2(0.5), vec2(1.0, 0.0), vec2(0.0, 1.0));\n"
      "Effective e = effective(Footprints(whole_map, whole_map, whole_map{}{}));\n",
      has(variant.effects, Effect::specular_variation) ? ", whole_map" : "",
      has(variant.effects, Effect::normal_layers) ? ", whole_map" : "");
  std::vector<glm::vec4> out = evaluate_glsl(text, footprint + body, inputs);
  context.check("probing a method");
  return out;
}

std::vector<double> probe_ndf(const ProbedMethod& probed, const std::vector<glm::dvec3>& directions) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  inputs.reserve(directions.size());
  for (const glm::dvec3& h : directions) inputs.push_back({glm::vec4(glm::vec3(h), 0), glm::vec4(0), glm::vec4(0)});
  std::vector<double> out;
  for (const glm::vec4& v : probe_method(probed, "return vec4(ndf(e, a.xyz));", inputs)) out.push_back(v.x);
  return out;
}

double relative_l2(const std::vector<double>& density, const std::vector<double>& exact) {
  double sum = 0;
  double norm = 0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    sum += (density[i] - exact[i]) * (density[i] - exact[i]);
    norm += exact[i] * exact[i];
  }
  return std::sqrt(sum / norm);
}

std::vector<glm::dvec3> hemisphere_grid(int rings, int sectors) {
  std::vector<glm::dvec3> out;
  for (int ring = 0; ring < rings; ++ring) {
    const double z = (ring + 0.5) / rings;
    const double r = std::sqrt(1.0 - z * z);
    for (int sector = 0; sector < sectors; ++sector) {
      const double phi = 2.0 * std::numbers::pi * (sector + 0.5) / sectors;
      out.emplace_back(r * std::cos(phi), r * std::sin(phi), z);
    }
  }
  return out;
}

}  // namespace footprint::testing
