// LEAN through its own shader: golden moments, the lobe against its C++ twin and against sums over texels, and the
// numerically hard maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& lean_method();
}

namespace footprint::testing {
namespace {

using enum NormalDistribution;
using Words = std::map<std::string, std::string>;
using std::numbers::pi;

ProbedMethod lean(const Material& material, const Words& options = {}) {
  return {.method = &lean_method(), .material = &material, .options = options};
}

// Symmetric grooves along y with walls of slope +-`slope`.
Image v_grooves(float slope) {
  Image image(8, 2, 4, 1.0F);
  for (int y = 0; y < 2; ++y) {
    for (int x = 0; x < 8; ++x) {
      const glm::vec3 n = glm::normalize(glm::vec3(x < 4 ? slope : -slope, 0.0F, 1.0F));
      std::copy_n(&n.x, 3, image.at(x, y).begin());
    }
  }
  return image;
}

// Under an environment a long lobe is a row of round ones: of all shares one, with the grooves' own slope variance.
TEST(Lean, LongLobesAreRowsOfRoundOnes) {
  const std::array<std::array<glm::vec4, 3>, 1> input{};
  for (const auto& [slope, lobes] : {std::pair(0.05F, 1), {0.2F, 5}, {0.3F, 7}}) {
    const Material material = lobe_material(v_grooves(slope), beckmann, 0.1F);
    ProbedMethod probed = lean(material);
    probed.effects.set(static_cast<std::size_t>(Effect::environment_light));
    const auto sums = probe_method(probed,
                                   "vec4 sum = vec4(0.0);\n"
                                   "for (int i = 0; i < lobeCount(e); ++i) {\n"
                                   "  NormalLobe lobe = normalLobe(e, i);\n"
                                   "  vec2 slope = -lobe.axis.xy / lobe.axis.z;\n"
                                   "  sum += lobe.weight * vec4(1.0, slope.x * slope.x, slope.y * slope.y, 0.0);\n"
                                   "}\nreturn vec4(sum.xyz, lobeCount(e));",
                                   input);
    EXPECT_EQ(sums[0].w, static_cast<float>(lobes));
    EXPECT_NEAR(sums[0].x, 1.0, 1e-3);
    EXPECT_NEAR(sums[0].y, lobes == 1 ? 0.0 : slope * slope, 2e-3 * slope * slope);
    EXPECT_NEAR(sums[0].z, 0.0, 1e-6);
  }
}

// Golden: B and Sigma + 1/s of four texels under exponent 100, roughness at shading time or in the moments.
TEST(Lean, FourTexelsMeetTheGoldenVector) {
  const Material material = lobe_material(four_texel_normals(), blinn_phong, 100);
  const std::array<std::array<glm::vec4, 3>, 1> input{};
  for (const char* const roughness : {"shading", "moments"}) {
    const auto mean =
        probe_method(lean(material, {{"roughness", roughness}}), "return vec4(e.lobe.mean, 0, 0);", input);
    EXPECT_NEAR(mean[0].x, -0.1145833333333333, 1e-6) << roughness;
    EXPECT_NEAR(mean[0].y, 0.18749999999999997, 1e-6) << roughness;
    const auto sigma = probe_method(lean(material, {{"roughness", roughness}}),
                                    "mat2 s = inverse(e.lobe.shape); return vec4(s[0], s[1]);", input);
    EXPECT_NEAR(sigma[0].x, 0.15876302083333332, 1e-6) << roughness;
    EXPECT_NEAR(sigma[0].y, 0.02148437499999999, 1e-6) << roughness;
    EXPECT_NEAR(sigma[0].w, 0.11546874999999997, 1e-6) << roughness;
    EXPECT_NEAR(glm::determinant(glm::mat2(sigma[0].x, sigma[0].y, sigma[0].z, sigma[0].w)), 0.017870589192708335,
                1e-6);
  }
}

TEST(Lean, GlslMeetsItsTwin) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(12, 24);
  for (const auto& [distribution, lobe] :
       {std::pair{blinn_phong, 64.0F}, std::pair{vmf, 30.0F}, std::pair{beckmann, 0.3F}, std::pair{ggx, 0.25F}}) {
    for (const float tilt : {0.1F, 0.6F, 0.95F}) {
      const Material material = lobe_material(random_normals(16, 16, tilt, 3), distribution, lobe);
      const SlopeTwin twin = slope_twin_of(material);
      const double peak = std::max(twin.stretched(twin.axis()), twin.gaussian(twin.axis()));
      const auto stretched = probe_ndf(lean(material), directions);
      const auto gaussian = probe_ndf(lean(material, {{"roughness", "shading"}}), directions);
      for (std::size_t i = 0; i < directions.size(); ++i) {
        const glm::dvec3 h{glm::vec3(directions[i])};
        EXPECT_NEAR(stretched[i], twin.stretched(h), 1e-5 * peak) << tilt << " " << i;
        EXPECT_NEAR(gaussian[i], twin.gaussian(h), 1e-5 * peak) << tilt << " " << i;
      }
    }
  }
}

// Over solid angle, against the sum over the texels: the stretched lobe for every base lobe, the Gaussian for those
// whose own energy is one.
TEST(Lean, KeepsTheEnergyOfTheSumOverTexels) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(250, 250);
  const auto energy = [&](const std::vector<double>& density) {
    double sum = 0;
    for (const double d : density) sum += d;
    return sum * 2.0 * pi / static_cast<double>(directions.size());
  };
  for (const auto& [distribution, lobe] : {std::pair{blinn_phong, 64.0F}, std::pair{blinn_phong, 512.0F},
                                           std::pair{vmf, 64.0F}, std::pair{beckmann, 0.2F}, std::pair{ggx, 0.1F}}) {
    for (const Image& normals : {random_normals(4, 4, 0.4F, 5), v_grooves(0.5F)}) {
      const Material material = lobe_material(normals, distribution, lobe);
      std::vector<double> exact;
      exact.reserve(directions.size());
      for (const glm::dvec3& h : directions) exact.push_back(mean_facet_density(material, h));
      const double exact_energy = energy(exact);
      EXPECT_NEAR(energy(probe_ndf(lean(material), directions)) / exact_energy, 1.0, 0.01) << lobe;
      EXPECT_NEAR(energy(probe_ndf(lean(material, {{"variant", "clean"}}), directions)) / exact_energy, 1.0, 0.01)
          << lobe;
      if (distribution == beckmann || distribution == ggx) continue;
      EXPECT_NEAR(energy(probe_ndf(lean(material, {{"roughness", "moments"}}), directions)) / exact_energy, 1.0, 0.01)
          << lobe;
    }
  }
}

// Hard case 13: flat tilted maps under exponent 1e5. The determinant is positive, the lobe finite, and in 32 bits
// it is still the base lobe, whose peak is (s + 1) / 2 pi.
TEST(Lean, FlatTiltedMapsHaveAFiniteLobe) {
  for (const float slope : {0.0F, 0.5F, 1.0F, 3.0F}) {
    const glm::vec3 n = glm::normalize(glm::vec3(-slope, 0.0F, 1.0F));
    const Material material = lobe_material(constant_normals(8, 8, n), blinn_phong, 1e5F);
    for (const char* const storage : {"fp32", "fp16"}) {
      for (const char* const roughness : {"stretched", "shading", "moments"}) {
        const Words words{{"storage", storage}, {"roughness", roughness}};
        const std::array<std::array<glm::vec4, 3>, 1> input{{{glm::vec4(n, 0), {}, {}}}};
        const glm::vec4 out = probe_method(
            lean(material, words), "return vec4(ndf(e, a.xyz), determinant(e.lobe.shape), e.lobe.scale, 0);", input)[0];
        for (int c = 0; c < 3; ++c) EXPECT_TRUE(std::isfinite(out[c]) && out[c] > 0.0F) << slope << words.at("storage");
        if (words.at("storage") == "fp32" && words.at("roughness") == "stretched") {
          EXPECT_NEAR(out.x * 2.0 * pi / 1e5, 1.0, 0.05) << slope;
        }
      }
    }
  }
}

// Hard case 28: slopes have a pole at the horizon.
TEST(Lean, NormalsAtTheHorizonStayFinite) {
  Image normals = random_normals(4, 4, 0.9F, 6);
  const glm::vec3 sideways(1, 0, 0);
  std::copy_n(&sideways.x, 3, normals.at(2, 1).begin());
  for (const Image& map : {normals, constant_normals(4, 4, sideways)}) {
    for (const float lobe : {1.0F, 64.0F, 1e5F}) {
      const Material material = lobe_material(map, blinn_phong, lobe);
      for (const char* const roughness : {"stretched", "shading", "moments"}) {
        for (const double d : probe_ndf(lean(material, {{"roughness", roughness}}), hemisphere_grid(20, 20)))
          EXPECT_TRUE(std::isfinite(d) && d >= 0.0) << lobe << " " << roughness;
      }
    }
  }
}

// One of 16384 texels at the horizon, where slopes have a pole: as steep as it is it would spread the lobe over all.
TEST(Lean, OneSteepTexelDoesNotOutweighThousands) {
  const auto peak = [](bool spoilt, const char* steepest) {
    Image normals = random_normals(128, 128, 0.1F, 4);
    const glm::vec3 steep(0.9999F, 0.0F, 0.0141F);
    if (spoilt) std::copy_n(&steep.x, 3, normals.at(40, 50).begin());
    const Material material = lobe_material(normals, blinn_phong, 64.0F);
    return std::ranges::max(probe_ndf(lean(material, {{"steepest", steepest}}), hemisphere_grid(40, 40)));
  };
  const double whole = peak(false, "3");
  EXPECT_NEAR(peak(true, "3") / whole, 1.0, 0.03);
  EXPECT_LT(peak(true, "50") / whole, 0.7) << "the gate: unbounded it does";
}

// Grooves have spread across and none along: one slope variance for both axes blurs what two keep apart.
TEST(Lean, IsNearerToGroovesThanItsScalarVariant) {
  const Material material = lobe_material(v_grooves(0.3F), blinn_phong, 64);
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  const auto error = [&](const Words& words) {
    const std::vector<double> density = probe_ndf(lean(material, words), directions);
    double sum = 0;
    double norm = 0;
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const double exact = mean_facet_density(material, directions[i]);
      sum += (density[i] - exact) * (density[i] - exact);
      norm += exact * exact;
    }
    return std::sqrt(sum / norm);
  };
  EXPECT_LT(error({}), 0.8 * error({{"variant", "clean"}}));
}

// Far away, where a pixel covers many bumps, only the noise of 1024 texels per pixel remains.
TEST(Lean, FollowsTheReferenceFarAway) {
  const BaseBrdf brdf{blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  Scene scene = square_scene(gaussian_slope_normals(512, 0.3F), {.brdf = brdf, .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 50.0F;
  TestRenderer renderer(scene, {16, 16});
  const Image reference = renderer.reference(1024).mean;
  for (const char* const text : {"lean", "lean:roughness=shading", "lean:roughness=moments:storage=fp16"}) {
    EXPECT_LT(compare_images(renderer.frame(lean_method(), text), reference, 1.0F).value().relative_rmse, 0.1) << text;
  }
}

// Grooves that run away from the viewer: probes along the long side of a pixel's footprint leave the short side sharp.
TEST(Lean, ProbesSharpenAnObliqueView) {
  TestRenderer renderer(receding_grooves());
  const Image reference = renderer.reference(256).mean;
  const auto error = [&](const char* filter) {
    return compare_images(renderer.frame(lean_method(), {}, parse_footprint_filter(filter, "")), reference, 1.0F)
        .value()
        .relative_rmse;
  };
  EXPECT_LT(error("anisotropic:8"), 0.6 * error("trilinear"));
}

// A roughness that varies, in the moments or beside them: one Gaussian.
TEST(Lean, RoughnessInTheMomentsIsThatAtShadingTime) {
  Material material = lobe_material(random_normals(8, 8, 0.5F, 7), ggx, 0.0F);
  material.lobe_parameter.reset();
  Image roughness(8, 8, 2, 0.3F);
  for (std::size_t i = 0; i < roughness.texels.size(); i += 6) roughness.texels[i] = 0.7F;
  material.metallic_roughness_map = TextureMap{"roughness", std::make_shared<const Image>(roughness), {}};
  ProbedMethod probed = lean(material, {{"roughness", "shading"}});
  probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  const std::vector<double> at_shading = probe_ndf(probed, hemisphere_grid(10, 10));
  probed.options["roughness"] = "moments";
  const std::vector<double> in_moments = probe_ndf(probed, hemisphere_grid(10, 10));
  for (std::size_t i = 0; i < at_shading.size(); ++i) EXPECT_NEAR(in_moments[i], at_shading[i], 1e-4);

  material.metallic_roughness_map->coordinates.set = 1;
  EXPECT_THROW((void)probe_ndf(probed, {{0, 0, 1}}), Error);
}

// Two roughnesses in equal shares average to the mean of their variances, of them, or of their alphas.
TEST(Lean, AveragesTheRoughnessAsAsked) {
  Image roughness(8, 8, 2, 0.2F);
  for (std::size_t i = 0; i < roughness.texels.size(); i += 4) roughness.texels[i] = 0.6F;
  Material material = lobe_material(constant_normals(8, 8, {0.0F, 0.0F, 1.0F}), beckmann, 0.0F);
  material.lobe_parameter.reset();
  material.metallic_roughness_map = TextureMap{"roughness", std::make_shared<const Image>(roughness), {}};
  const std::array<std::array<glm::vec4, 3>, 1> input{};
  for (const auto& [averages, variance] :
       {std::pair("variance", 0.25 * (0.04 * 0.04 + 0.36 * 0.36)), std::pair("roughness", 0.5 * 0.16 * 0.16),
        std::pair("lobe", 0.5 * 0.2 * 0.2)}) {
    for (const char* const shape : {"stretched", "shading"}) {
      ProbedMethod probed = lean(material, {{"averages", averages}, {"roughness", shape}});
      probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation));
      EXPECT_NEAR(probe_method(probed, "return vec4(e.lobe.base);", input)[0].x / variance, 1.0, 1e-4) << averages;
    }
  }
  ProbedMethod probed = lean(material, {{"averages", "lobe"}, {"roughness", "moments"}});
  probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  EXPECT_THROW((void)probe_ndf(probed, {{0, 0, 1}}), Error);
}

// What an effect or an option does not need is not stored.
TEST(Lean, StoresWhatIsCalledFor) {
  const Material material = lobe_material(random_normals(4, 4, 0.5F, 8), ggx, 0.3F);
  const auto channels = [&](const Words& words, std::initializer_list<Effect> effects) {
    EffectSet set;
    for (const Effect effect : effects) set.set(static_cast<std::size_t>(effect));
    const Options options(lean_method().info.options, words, "lean");
    int count = 0;
    for (const PrefilteredTexture& texture : lean_method().precompute(material, options, set, no_progress).textures)
      count += texture.channels;
    return count;
  };
  EXPECT_EQ(channels({}, {}), 0);
  EXPECT_EQ(channels({}, {Effect::normal_variation}), 5);
  EXPECT_EQ(channels({}, {Effect::normal_variation, Effect::diffuse}), 8);
  EXPECT_EQ(channels({{"variant", "clean"}}, {Effect::normal_variation}), 3);
  EXPECT_EQ(channels({{"variant", "clean"}}, {Effect::normal_variation, Effect::diffuse}), 6);
  EXPECT_EQ(channels({}, {Effect::normal_variation, Effect::roughness_variation}), 6);
  EXPECT_EQ(channels({{"roughness", "moments"}}, {Effect::normal_variation, Effect::roughness_variation}), 5);
  EXPECT_EQ(channels({{"averages", "lobe"}}, {Effect::normal_variation, Effect::roughness_variation}), 6);
}

}  // namespace
}  // namespace footprint::testing
