// The base lobe's slope variance as methods store and fetch it: linear between texels, exact in every storage.
#include <gtest/gtest.h>

#include <array>
#include <memory>

#include "renderer/bake/normal_chain.hpp"
#include "renderer/lobes/lobe.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

EffectSet varying_roughness() {
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  return effects;
}

// Two texels beside each other: Blinn-Phong of the exponents s and t.
Material two_lobe_material(float s, float t) {
  Material material = square_scene({}, {}).materials[0];
  material.brdf = {NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  Image exponents(2, 1, 1);
  exponents.texels = {s, t};
  material.lobe_parameter_map = TextureMap{"exponents", std::make_shared<const Image>(std::move(exponents)), {}};
  return material;
}

// What baseVariance finds at u for a footprint of no size.
double variance_at(const Material& material, Storage storage, float u, RoughnessMean mean = RoughnessMean::variance) {
  const gl::Context& context = shared_context();
  const Prefiltered baked = bake_lobe_variance(material, storage, varying_roughness(), mean);
  const GpuTexture texture = upload(baked.textures.at(0));
  SamplerCache samplers;
  gl::api().BindTextureUnit(0, texture.texture->name());
  gl::api().BindSampler(0, samplers.sampler(texture.coordinates, SamplerState::trilinear));
  ShaderVariant variant;
  variant.brdf = material.brdf;
  variant.effects = varying_roughness();
  const ShaderFlags flags = shader_flags(variant, Options({}, {}, "test"), baked);
  const std::string text = "layout(binding = 0) uniform sampler2D " + stored_lobe_name(mean) +
                           ";\nvec4 lobe_cutoff;\n" +
                           shared_functions(flags, {"test.glsl", "#include \"lobe_variance.glsl\"\n"});
  const std::array<std::array<glm::vec4, 3>, 1> inputs{{{glm::vec4(u), glm::vec4(0), glm::vec4(0)}}};
  const auto out = evaluate_glsl(text,
                                 "Footprint p = Footprint(vec2(a.x, 0.5), vec2(0.0), vec2(0.0));\n"
                                 "return vec4(baseVariance(Footprints(p, p, p)));",
                                 inputs);
  context.check("fetching a variance");
  return out[0].x;
}

TEST(LobeVariance, BlendsAsVariancesDo) {
  const Material material = two_lobe_material(10.0F, 1000.0F);
  for (const Storage storage : {Storage::fp32, Storage::fp16, Storage::unorm8}) {
    // Roots that are blended and squared: 0.0302, a fifth less.
    EXPECT_NEAR(variance_at(material, storage, 0.5F) / (0.5 * (0.1 + 0.001)), 1.0, 5e-3) << storage_name(storage);
    EXPECT_NEAR(variance_at(material, storage, 0.375F) / (0.75 * 0.1 + 0.25 * 0.001), 1.0, 5e-3)
        << storage_name(storage);
  }
}

// The mean of concentrations is that of exponents: the peaks of the two lobes about one normal average to its own.
TEST(LobeVariance, BlendsAsConcentrationsDo) {
  const Material material = two_lobe_material(10.0F, 1000.0F);
  for (const Storage storage : {Storage::fp32, Storage::fp16, Storage::unorm8}) {
    EXPECT_NEAR(variance_at(material, storage, 0.5F, RoughnessMean::concentration) * 505.0, 1.0, 5e-3);
    EXPECT_NEAR(variance_at(material, storage, 0.375F, RoughnessMean::concentration) * (0.75 * 10.0 + 0.25 * 1000.0),
                1.0, 5e-3);
  }
}

TEST(LobeVariance, KeepsMirrorsInEveryStorage) {
  const Material material = two_lobe_material(1e6F, 5.0F);
  for (const Storage storage : {Storage::fp32, Storage::fp16, Storage::unorm8}) {
    for (const RoughnessMean mean : {RoughnessMean::variance, RoughnessMean::concentration})
      EXPECT_NEAR(variance_at(material, storage, 0.25F, mean) * 1e6, 1.0, 2e-3) << storage_name(storage);
  }
}

// The widest lobes that a map may store: a bound on variances would make an exponent of 1 of all below it.
TEST(LobeVariance, KeepsNearlyEvenLobesInEveryStorage) {
  const Material material = two_lobe_material(1e-3F, 0.125F);
  for (const Storage storage : {Storage::fp32, Storage::fp16, Storage::unorm8}) {
    EXPECT_NEAR(variance_at(material, storage, 0.25F) * 1e-3, 1.0, 2e-3) << storage_name(storage);
    EXPECT_NEAR(variance_at(material, storage, 0.75F) * 0.125, 1.0, 2e-3) << storage_name(storage);
    EXPECT_NEAR(variance_at(material, storage, 0.25F, RoughnessMean::concentration) * 1e-3, 1.0, 5e-3)
        << storage_name(storage);
  }
}

TEST(LobeVariance, IsNotStoredWhereTheRoughnessIsConstant) {
  EXPECT_TRUE(bake_lobe_variance(two_lobe_material(10.0F, 20.0F), Storage::fp32, EffectSet{}).textures.empty());
}

}  // namespace
}  // namespace footprint::testing
