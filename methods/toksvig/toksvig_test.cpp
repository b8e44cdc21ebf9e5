// Toksvig's formula, run through the module itself, against golden numbers and against the reference.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "renderer/bake/normal_chain.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& toksvig_method();
}

namespace footprint::testing {
namespace {

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};

Material material_of(const Image& normals, float exponent) {
  Material material = square_scene(normals, {.brdf = blinn_phong}).materials[0];
  material.lobe_parameter = exponent;
  return material;
}

// The module's `effective` at the coarsest level of a material: exponent, |Na| and axis.
struct Recovered {
  float lobe, consistency;
  glm::vec3 axis;
};

Recovered recovered(const Material& material, const std::map<std::string, std::string>& given = {}) {
  const gl::Context& context = shared_context();
  const Options options(toksvig_method().info.options, given, "toksvig");
  ShaderVariant variant;
  variant.brdf = blinn_phong;
  variant.effects.set(static_cast<std::size_t>(Effect::normal_variation));
  const Prefiltered baked = toksvig_method().precompute(material, options, variant.effects, no_progress);
  const GpuTexture texture = upload(baked.textures.at(0));
  SamplerCache samplers;
  gl::api().BindTextureUnit(0, texture.texture->name());
  gl::api().BindSampler(0, samplers.sampler(texture.coordinates, SamplerState::trilinear));
  const ShaderFlags flags = shader_flags(variant, options, baked);
  const std::string text =
      "layout(binding = 0) uniform sampler2D mean_normal;\nconst float option_spread = 1.0;\n"
      "vec4 lobe_cutoff;\n" +
      shared_functions(flags, toksvig_method().shader);
  const std::string body =
      "lobe_cutoff = vec4(a.x);\nFootprint p = Footprint(vec2(0.5), vec2(1.0, 0.0), vec2(0.0, 1.0));\n"
      "Effective e = effective(Footprints(p, p, p));\nreturn b.x == 0.0 ? vec4(e.facets.lobe, e.consistency, 0, 0) : "
      "vec4(e.facets.normal, 0);";
  const float s = *material.lobe_parameter;
  const std::array<std::array<glm::vec4, 3>, 2> inputs{
      {{glm::vec4(s), glm::vec4(0), {}}, {glm::vec4(s), glm::vec4(1), {}}}};
  const auto out = evaluate_glsl(text, body, inputs);
  context.check("evaluating toksvig");
  return {out[0].x, out[0].y, glm::vec3(out[1])};
}

TEST(Toksvig, FourTexelsMeetTheGoldenExponent) {
  const Recovered r = recovered(material_of(four_texel_normals(), 100));
  EXPECT_NEAR(r.consistency, 0.9060905032059435, 1e-6);
  EXPECT_NEAR(r.lobe, 8.799523815941214, 1e-4);
  EXPECT_NEAR(r.axis.x, 0.08829140104321008, 1e-6);
  EXPECT_NEAR(r.axis.y, -0.16554637695601893, 1e-6);
  EXPECT_NEAR(r.axis.z, 0.9822418366057123, 1e-6);
}

// Hard cases 23 and 24: a flat map leaves the exponent, within 1e-3 at 1e4 and 1% at 1e5, for any normal.
TEST(Toksvig, FlatMapKeepsTheExponent) {
  for (const glm::vec3& normal :
       {glm::vec3(0, 0, 1), glm::vec3(0.28F, 0, 0.96F), glm::normalize(glm::vec3(0.3F, -0.5F, 0.7F))}) {
    EXPECT_NEAR(recovered(material_of(constant_normals(8, 8, normal), 1e4F)).lobe / 1e4, 1.0, 1e-3);
    EXPECT_NEAR(recovered(material_of(constant_normals(8, 8, normal), 1e5F)).lobe / 1e5, 1.0, 1e-2);
  }
}

// Golden: |Na| alone, by two opposite tilts whose mean has the length wanted.
TEST(Toksvig, MeetsTheGoldenTable) {
  const std::vector<std::array<double, 3>> golden{
      {1, 0.5, 0.5}, {1, 0.9, 0.9}, {100, 0.9060905032059435, 8.799523815941214}};
  for (const auto& [s, length, expected] : golden) {
    const auto tilt = static_cast<float>(std::sqrt(1.0 - length * length));
    Image pair(2, 1, 4, 1.0F);
    pair.texels = {tilt, 0, static_cast<float>(length), 1, -tilt, 0, static_cast<float>(length), 1};
    EXPECT_NEAR(recovered(material_of(pair, static_cast<float>(s))).lobe / expected, 1.0, 1e-5) << s << " " << length;
  }
}

// Hard case 23: normals that cancel have no mean; the axis is then the surface's own and the lobe the widest.
TEST(Toksvig, OppositeNormalsLeaveTheSurfaceNormal) {
  Image pair(2, 1, 4, 1.0F);
  pair.texels = {1, 0, 0, 1, -1, 0, 0, 1};
  const Recovered r = recovered(material_of(pair, 100));
  EXPECT_EQ(r.axis, glm::vec3(0, 0, 1));
  EXPECT_LT(r.lobe, 1e-5F);
}

// Normals read from bytes are too long or short by up to 0.6%; undone before they are averaged, that costs nothing.
TEST(Toksvig, QuantisedUnitNormalsAreRenormalised) {
  Image map = random_normals(16, 16, 0.0F, 1);
  for (float& v : map.texels) v = std::round((v * 0.5F + 0.5F) * 255.0F) / 255.0F * 2.0F - 1.0F;
  const Image first = mean_normal_chain(material_of(map, 1)).front();
  for (std::size_t i = 0; i < first.texels.size(); i += 3)
    EXPECT_NEAR(std::hypot(first.texels[i], first.texels[i + 1], first.texels[i + 2]), 1.0F, 1e-6F);
}

// Half floats end at 1 - |Na| = 2^-11: the exponent of a mirror-like flat map falls, but stays positive and finite.
TEST(Toksvig, HalfFloatsDegradeGracefully) {
  const Recovered r = recovered(material_of(constant_normals(8, 8, glm::normalize(glm::vec3(0.3F, -0.5F, 0.7F))), 1e5F),
                                {{"storage", "fp16"}});
  EXPECT_GT(r.lobe, 500.0F);
  EXPECT_LE(r.lobe, 1.001e5F);
}

// Far away, where a pixel covers many bumps, the widened lobe is closer to the reference than the mean normal.
TEST(Toksvig, BeatsTheUnwidenedLobeFarAway) {
  Scene scene = square_scene(random_normals(256, 256, 0.4F, 9),
                             {.brdf = blinn_phong, .base_color = glm::vec3(0.0F), .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 200.0F;
  TestRenderer renderer(scene, {16, 16});
  const Image reference = renderer.reference(1024).mean;
  const auto error = [&](const std::string& text) {
    return compare_images(renderer.frame(toksvig_method(), text), reference, 1.0F).value().relative_rmse;
  };
  EXPECT_LT(error("toksvig"), 0.5 * error("toksvig:spread=0"));
}

}  // namespace
}  // namespace footprint::testing
