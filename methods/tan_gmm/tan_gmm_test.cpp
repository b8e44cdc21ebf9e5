// The module of Tan's mixtures: what it recovers behind the texture filter, its NDF and its energy, against golden
// numbers, integrals and the exact NDF.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <random>
#include <string>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/methods/mixture_twin.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& tan_gmm_method();
}

namespace footprint::testing {
namespace {

using tan_gmm::Recovered;
using Given = std::map<std::string, std::string>;
using Inputs = std::vector<std::array<glm::vec4, 3>>;

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
constexpr BaseBrdf blinn_phong_tan{NormalDistribution::blinn_phong, GeometryTerm::tan, FresnelTerm::none, true};

// What follows "Effective e = ...;" in a probe whose inputs are a.xy: uv in the map, a.z: size of the footprint
// there, a.w: the lobe. Components are the paper's Gaussians where `given` does not say otherwise.
std::vector<glm::vec4> probed(const PrefilteredTexture& mixture, const Given& given, const std::string& expression,
                              const Inputs& inputs, const BaseBrdf& brdf = blinn_phong) {
  const gl::Context& context = shared_context();
  Given all = given;
  all.try_emplace("lobe", "gaussian");
  all["n"] = std::to_string(mixture.layers);
  const Options options(tan_gmm_method().info.options, all, "tan_gmm");
  ShaderVariant variant;
  variant.brdf = brdf;
  for (const Effect effect : {Effect::normal_variation, Effect::diffuse})
    variant.effects.set(static_cast<std::size_t>(effect));
  if (brdf.geometry != GeometryTerm::none) variant.effects.set(static_cast<std::size_t>(Effect::masking_shadowing));
  const GpuTexture texture = upload(mixture);
  SamplerCache samplers;
  gl::api().BindTextureUnit(0, texture.texture->name());
  gl::api().BindSampler(0, samplers.sampler(texture.coordinates, texture.sampler_state(SamplerState::trilinear)));
  const ShaderFlags flags = shader_flags(variant, options, {.textures = {mixture}, .scalars = {}});
  const std::string text =
      "layout(binding = 0) uniform sampler2DArray tan_gmm_mixture;\nconst float option_n = " + all["n"] + ".0;\n" +
      "vec4 lobe_cutoff;\n" + shared_functions(flags, tan_gmm_method().shader);
  const std::string body =
      "lobe_cutoff = vec4(a.w);\nFootprint p = Footprint(a.xy, vec2(a.z, 0.0), vec2(0.0, a.z));\n"
      "Effective e = effective(Footprints(p, p, p));\n" +
      expression;
  std::vector<glm::vec4> out = evaluate_glsl(text, body, inputs);
  context.check("evaluating tan_gmm");
  return out;
}

PrefilteredTexture texture_of(const std::vector<std::vector<Image>>& layers, Storage storage = Storage::fp32) {
  return make_array_texture("tan_gmm_mixture", layers, storage, {.wrap = {Wrap::clamp_to_edge, Wrap::clamp_to_edge}});
}

// A map of one texel, a component for each vector.
PrefilteredTexture single_texel(const std::vector<glm::vec4>& components, Storage storage = Storage::fp32) {
  std::vector<std::vector<Image>> layers;
  for (const glm::vec4& c : components) {
    Image image(1, 1, 4);
    std::copy_n(&c.x, 4, image.texels.begin());
    layers.push_back({image});
  }
  return texture_of(layers, storage);
}

PrefilteredTexture baked(const Image& normals, const Given& given = {}) {
  const Material material = square_scene(normals, {.brdf = blinn_phong}).materials[0];
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::normal_variation));
  const Options options(tan_gmm_method().info.options, given, "tan_gmm");
  return tan_gmm_method().precompute(material, options, effects, no_progress).textures.at(0);
}

// The stored form of alpha g(n; mu, sigma).
glm::vec4 stored(double alpha, const glm::dvec2& mu, double variance) {
  return glm::vec4(alpha * glm::dvec4(1.0, mu, 2.0 * variance + glm::dot(mu, mu)));
}

constexpr glm::vec4 whole_map(float lobe) { return {0.5F, 0.5F, 1.0F, lobe}; }

const std::string component_0 =
    "Component r = recovered(fetch(tan_gmm_mixture, 0, p));\nreturn vec4(r.share, r.mean, r.spread);";

// Two texels with weights 1/4 and 3/4, blended by the sampler.
TEST(TanGmm, RecoversTheGoldenMixture) {
  for (const bool corrected : {true, false}) {
    const double factor = corrected ? 2.0 : 1.0;
    Image pair(2, 1, 4);
    const std::array<double, 8> texels{0.7, 0.7 * 0.3,  0.7 * 0.1,  0.7 * (factor * 0.01 + 0.1),
                                       0.2, 0.2 * -0.1, 0.2 * 0.05, 0.2 * (factor * 0.02 + 0.0125)};
    std::ranges::transform(texels, pair.texels.begin(), [](double v) { return static_cast<float>(v); });
    const auto out = probed(texture_of({mip_chain(pair)}), {{"moment", corrected ? "corrected" : "published"}},
                            component_0, {{glm::vec4(0.625F, 0.5F, 1e-3F, 100.0F), {}, {}}});
    EXPECT_NEAR(out[0].x, 0.325, 1e-6);
    EXPECT_NEAR(out[0].y, 0.11538461538461535, 1e-6);
    EXPECT_NEAR(out[0].z, 0.07692307692307693, 1e-6);
    EXPECT_NEAR(out[0].w, corrected ? 0.0348076923076923 : 0.055, 1e-6);
  }
}

// sigma = 0.02 at |mu| = 0.5: in 32 bits within 0.1% over 64 texels; half floats lose it, but never go below zero.
TEST(TanGmm, SmallVariancesSurviveTheFilter) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> angle(0.0, 6.28);
  Image map(8, 8, 4);
  double mean_x = 0;
  double mean_y = 0;
  std::vector<glm::dvec2> means;
  for (std::size_t i = 0; i < 64; ++i) {
    const double a = angle(random) * 1e-3;  // nearly one direction
    means.emplace_back(0.5 * std::cos(a), 0.5 * std::sin(a));
    mean_x += means.back().x / 64;
    mean_y += means.back().y / 64;
    const glm::vec4 texel = stored(1.0, means.back(), 4e-4);
    std::copy_n(&texel.x, 4, &map.texels[4 * i]);
  }
  double expected = 4e-4;
  for (const glm::dvec2& m : means) expected += (glm::dot(m, m) - mean_x * mean_x - mean_y * mean_y) / 128;
  const Inputs inputs{{whole_map(100.0F), {}, {}}};
  EXPECT_NEAR(probed(texture_of({mip_chain(map)}), {}, component_0, inputs)[0].w / expected, 1.0, 1e-3);
  EXPECT_GE(probed(texture_of({mip_chain(map)}, Storage::fp16), {{"storage", "fp16"}}, component_0, inputs)[0].w, 0.0F);
}

std::vector<glm::dvec4> random_texel(std::mt19937& random, double most_tilt) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::vector<glm::dvec4> texel;
  for (int i = 0; i < 4; ++i) {
    const double angle = 6.28 * unit(random);
    const double radius = most_tilt * std::sqrt(unit(random));
    const double alpha = i == 3 ? 0.0 : 0.05 + unit(random);  // one is not there
    texel.emplace_back(stored(alpha, radius * glm::dvec2(std::cos(angle), std::sin(angle)), 0.02 * unit(random)));
  }
  return texel;
}

std::vector<glm::vec4> as_floats(const std::vector<glm::dvec4>& texel) { return {texel.begin(), texel.end()}; }

// The shader and its double-precision twin, to 1e-5 of the peak, for mixtures away from the rim.
TEST(TanGmm, NdfMeetsItsTwin) {
  std::mt19937 random(2);
  std::uniform_real_distribution<float> coordinate(-0.7F, 0.7F);
  for (const float s : {16.0F, 64.0F, 512.0F, 1e4F}) {
    for (int repeat = 0; repeat < 4; ++repeat) {
      const std::vector<glm::dvec4> texel = random_texel(random, 0.6);
      Inputs inputs;
      for (int i = 0; i < 200; ++i) {
        const glm::vec2 p(coordinate(random), coordinate(random));
        const float square = glm::dot(p, p);
        if (square < 1.0F) inputs.push_back({whole_map(s), glm::vec4(p, std::sqrt(1.0F - square), 0.0F), {}});
      }
      const auto out = probed(single_texel(as_floats(texel)), {{"rim", "cut"}}, "return vec4(ndf(e, b.xyz));", inputs);
      const std::vector<Recovered> mixture = tan_gmm::recovered_mixture(texel);
      double peak = 0;
      for (const Recovered& r : mixture)
        peak = std::max(peak, r.share / (6.283 * tan_gmm::variance_over_disc(r, 1.0 / s)));
      for (std::size_t i = 0; i < inputs.size(); ++i) {
        const double expected = tan_gmm::ndf_cut_at_rim(mixture, 1.0 / s, glm::dvec3(inputs[i][1]));
        EXPECT_NEAR(out[i].x / peak, expected / peak, 1e-5) << "exponent " << s;
      }
    }
  }
}

// A Gaussian that reaches over the rim: mass and horizon by formulas, against an integral and the error function.
TEST(TanGmm, RimFactorMeetsTheIntegral) {
  Inputs inputs;
  std::vector<double> expected;
  for (const double s : {4.0, 16.0, 64.0, 512.0}) {
    for (const double radius : {0.0, 0.3, 0.6, 0.8, 0.9, 0.97, 1.0}) {
      for (const double spread : {0.0, 0.01, 0.1}) {
        const Recovered r{1.0, radius, 0.0, spread};
        const double height = tan_gmm::height_over(r);
        inputs.push_back(
            {whole_map(64.0F), glm::vec4(radius, height, tan_gmm::variance_over_disc(r, 1.0 / s), 1.0 / s), {}});
        expected.push_back(tan_gmm::rim_factor(r, 1.0 / s));
      }
    }
  }
  const auto out = probed(single_texel({glm::vec4(1, 0, 0, 0)}), {},
                          "return vec4(rimFactor(vec2(b.x, 0.0), b.z, b.y, b.w));", inputs);
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_NEAR(out[i].x / expected[i], 1.0, 0.01)
        << "mu " << inputs[i][1].x << ", variance " << inputs[i][1].z << ", base " << inputs[i][1].w;
  }
}

// A grid over the disc: h, and the area of each point.
struct Disc {
  Inputs inputs;
  double area;

  Disc(int across, float lobe) : area(4.0 / (across * across)) {
    for (int j = 0; j < across; ++j) {
      for (int i = 0; i < across; ++i) {
        const glm::dvec2 p(2.0 * (i + 0.5) / across - 1.0, 2.0 * (j + 0.5) / across - 1.0);
        const double square = glm::dot(p, p);
        if (square < 1.0) inputs.push_back({whole_map(lobe), glm::vec4(p, std::sqrt(1.0 - square), 0.0), {}});
      }
    }
  }

  // Over solid angle: the area over the cosine.
  template <typename Density>
  [[nodiscard]] double integral(Density density) const {
    double sum = 0;
    for (std::size_t i = 0; i < inputs.size(); ++i) sum += density(i) * area / static_cast<double>(inputs[i][1].z);
    return sum;
  }
};

// The exact NDF: Blinn-Phong lobes about every normal of the map.
double exact_ndf(const Image& normals, double s, const glm::dvec3& h) {
  double sum = 0;
  for (std::size_t i = 0; i < normals.texel_count(); ++i) {
    const float* const n = &normals.texels[4 * i];
    const double c = n[0] * h.x + n[1] * h.y + n[2] * h.z;
    if (c > 0.0) sum += std::pow(c, s);
  }
  return sum * (s + 1.0) / (6.283185307179586 * static_cast<double>(normals.texel_count()));
}

struct NdfError {
  double energy, l2;
};

NdfError ndf_error(const Image& normals, float s, const Given& given = {}) {
  const Disc disc(160, s);
  const auto out = probed(baked(normals, given), given, "return vec4(ndf(e, b.xyz));", disc.inputs);
  std::vector<double> exact;
  for (const auto& input : disc.inputs) exact.push_back(exact_ndf(normals, s, glm::dvec3(input[1])));
  const double energy = disc.integral([&](std::size_t i) { return static_cast<double>(out[i].x); });
  const double true_energy = disc.integral([&](std::size_t i) { return exact[i]; });
  const double difference = disc.integral([&](std::size_t i) { return std::pow(out[i].x - exact[i], 2.0); });
  const double norm = disc.integral([&](std::size_t i) { return exact[i] * exact[i]; });
  return {energy / true_energy, std::sqrt(difference / norm)};
}

// Energy over solid angle, relative to the exact NDF's, within 1%: flat, tilted, spread, and as far as the rim.
TEST(TanGmm, EnergyIsThatOfTheExactNdf) {
  for (const float s : {64.0F, 512.0F}) {
    for (const float tilt : {0.0F, 0.5F, 0.8F, 0.95F}) {
      const glm::vec3 normal(tilt, 0.0F, std::sqrt(1.0F - tilt * tilt));
      for (const char* lobe : {"gaussian", "base"}) {
        const Given given{{"lobe", lobe}};
        EXPECT_NEAR(ndf_error(constant_normals(4, 4, normal), s, given).energy, 1.0, 0.01) << lobe << s << " " << tilt;
        EXPECT_NEAR(ndf_error(random_normals(16, 16, tilt, 3), s, given).energy, 1.0, 0.01) << lobe << s << " " << tilt;
      }
    }
  }
}

// With as many Gaussians as texels nothing is lost but the shape of a lobe (golden values of the exact NDF).
TEST(TanGmm, FourTexelsAreFourLobes) {
  Image map(2, 2, 4, 1.0F);
  const std::array<glm::vec3, 4> normals{{{0, 0, 1}, {0.6F, 0, 0.8F}, {0, -0.6F, 0.8F}, {-0.28F, 0, 0.96F}}};
  for (std::size_t i = 0; i < 4; ++i) std::copy_n(&normals[i].x, 3, &map.texels[4 * i]);
  const auto out =
      probed(baked(map), {}, "return vec4(ndf(e, b.xyz));", {{whole_map(100.0F), glm::vec4(0, 0, 1, 0), {}}});
  EXPECT_NEAR(out[0].x / 4.086458431324459, 1.0, 0.05);
  EXPECT_NEAR(exact_ndf(map, 100.0, {0, 0, 1}), 4.086458431324459, 1e-5);
  EXPECT_LT(ndf_error(map, 100.0F).l2, 0.1);
}

// With the base lobe itself about each mean, nothing is lost at all.
TEST(TanGmm, FourTexelsAreFourBaseLobes) {
  Image map(2, 2, 4, 1.0F);
  const std::array<glm::vec3, 4> normals{{{0, 0, 1}, {0.6F, 0, 0.8F}, {0, -0.6F, 0.8F}, {-0.28F, 0, 0.96F}}};
  for (std::size_t i = 0; i < 4; ++i) std::copy_n(&normals[i].x, 3, &map.texels[4 * i]);
  const NdfError error = ndf_error(map, 100.0F, {{"lobe", "base"}});
  EXPECT_LT(error.l2, 0.01);
  EXPECT_NEAR(error.energy, 1.0, 1e-3);
}

TEST(TanGmm, ForeshorteningGains) {
  const Image map = constant_normals(2, 2, glm::vec3(0.7F, 0.0F, std::sqrt(0.51F)));
  for (const float s : {64.0F, 512.0F})
    EXPECT_LT(ndf_error(map, s).l2, 0.7 * ndf_error(map, s, {{"foreshorten", "off"}}).l2);
}

// Tilts of 0.3 left and right: two lobes that a single one, of any width, cannot be.
TEST(TanGmm, TwoFlanksNeedTwoGaussians) {
  Image map(16, 16, 4, 1.0F);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) {
      const glm::vec3 n(x % 4 < 2 ? 0.3F : -0.3F, 0.0F, std::sqrt(0.91F));
      std::copy_n(&n.x, 3, map.at(x, y).begin());
    }
  }
  for (const float s : {64.0F, 512.0F}) {
    EXPECT_LT(ndf_error(map, s, {{"n", "2"}}).l2, 0.1);
    EXPECT_GT(ndf_error(map, s, {{"n", "1"}}).l2, 0.5);
  }
}

// Nothing is where a component's weight is 0 or rounds to it, and nothing at all is a flat facet.
TEST(TanGmm, EmptyComponentsLeaveTheOthers) {
  const glm::vec4 one = stored(1.0, {0.2, 0.1}, 0.01);
  const Inputs inputs{{whole_map(64.0F), glm::vec4(0.25F, 0.1F, std::sqrt(0.9275F), 0), {}}};
  const std::string density = "return vec4(ndf(e, b.xyz));";
  const float alone = probed(single_texel({one}), {}, density, inputs)[0].x;
  EXPECT_EQ(probed(single_texel({one, glm::vec4(0.0F)}), {}, density, inputs)[0].x, alone);
  EXPECT_EQ(probed(single_texel({one, stored(1e-6, {0.9, 0.0}, 0.0)}), {}, density, inputs)[0].x, alone);
  EXPECT_NEAR(probed(single_texel({0.25F * one, glm::vec4(0.0F)}), {}, density, inputs)[0].x, alone, 1e-5F * alone);
  const float flat = probed(single_texel({stored(1.0, {0, 0}, 0)}), {}, density, inputs)[0].x;
  EXPECT_EQ(probed(single_texel({glm::vec4(0.0F), glm::vec4(0.0F)}), {}, density, inputs)[0].x, flat);
}

// mu.v -> 0, normals on the rim, opposite directions, mirrors.
TEST(TanGmm, GrazingStaysFinite) {
  Inputs inputs;
  for (const float elevation : {1.57F, 0.5F, 0.01F, 1.7e-4F, 0.0F}) {
    for (const float azimuth : {0.0F, 1.0F, 3.14159265F}) {
      const glm::vec3 wo(std::cos(elevation) * std::cos(azimuth), std::cos(elevation) * std::sin(azimuth),
                         std::sin(elevation));
      for (const glm::vec3& wi : {glm::vec3(0, 0, 1), glm::vec3(0.8F, 0, 0.6F), glm::vec3(-1, 0, 1e-4F), -wo})
        for (const float s : {1.0F, 64.0F, 2e6F}) inputs.push_back({whole_map(s), glm::vec4(wi, 0), glm::vec4(wo, 0)});
    }
  }
  const std::string shaded =
      "Reflected r = shade(e, Surface(vec3(1.0), vec3(1.0)), b.xyz, c.xyz);\n"
      "return vec4(r.specular.x, r.diffuse.x, ndf(e, b.xyz), 0.0);";
  for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(1, 0, 0), glm::vec3(0.6F, 0, 0.8F)}) {
    for (const glm::vec4& v : probed(baked(constant_normals(2, 2, normal)), {}, shaded, inputs, blinn_phong_tan)) {
      for (int i = 0; i < 3; ++i) EXPECT_TRUE(std::isfinite(v[i]) && v[i] >= 0.0F) << v[i];
    }
  }
}

// At a grazing view the geometry term of Tan's paper is bounded: f cos <= 2 D (n.h) / (v.h).
TEST(TanGmm, GrazingViewKeepsTheBound) {
  const float elevation = 1.7e-4F;  // 89.99 degrees from the normal
  const glm::vec3 wo(std::cos(elevation), 0.0F, std::sin(elevation));
  const Inputs inputs{{whole_map(64.0F), glm::vec4(0, 0, 1, 0), glm::vec4(wo, 0)}};
  const auto out = probed(baked(constant_normals(2, 2, glm::vec3(0, 0, 1))), {},
                          "vec3 h = halfVector(b.xyz, c.xyz);\nreturn vec4(shade(e, Surface(vec3(0.0), vec3(1.0)), "
                          "b.xyz, c.xyz).specular.x, "
                          "2.0 * ndf(e, h) * h.z / dot(c.xyz, h), 0.0, 0.0);",
                          inputs, blinn_phong_tan);
  EXPECT_GT(out[0].x, 0.0F);
  EXPECT_LE(out[0].x, out[0].y * 1.0001F);
}

double picture_error(TestRenderer& renderer, const Image& reference, const std::string& text, double distance = 1.0) {
  return compare_images(renderer.frame(tan_gmm_method(), text, {}, 0, distance), reference, 1.0F).value().relative_rmse;
}

// Where a pixel covers many grooves, two lobes and not one; between texels, aligned ones.
TEST(TanGmm, PicturesOfGroovesNeedAlignedMixtures) {
  Image map(256, 256, 4, 1.0F);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x) {
      const glm::vec3 n =
          glm::normalize(glm::vec3(x % 12 < 6 ? 0.3F : -0.3F, 0.1F * std::sin(0.9F * static_cast<float>(y)), 1.0F));
      std::copy_n(&n.x, 3, map.at(x, y).begin());
    }
  }
  Scene scene = square_scene(map, {.brdf = blinn_phong, .base_color = glm::vec3(0.0F), .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 100.0F;
  TestRenderer renderer(scene, {40, 40});
  const Image reference = renderer.reference(1024).mean;
  const double aligned = picture_error(renderer, reference, "tan_gmm");
  EXPECT_LT(aligned, 0.5 * picture_error(renderer, reference, "tan_gmm:align=off"));
  EXPECT_LT(aligned, 0.5 * picture_error(renderer, reference, "tan_gmm:n=1"));
  EXPECT_LT(picture_error(renderer, reference, "tan_gmm:storage=fp16"), 1.2 * aligned);
}

// A base lobe that varies enters as the mean of its variance: stripes of two roughnesses, two texels to a pixel, are
// the one of alpha^2 = (0.3^4 + 0.7^4) / 2.
TEST(TanGmm, HonoursVaryingRoughness) {
  Scene striped = square_scene(random_normals(64, 64, 0.3F, 5), {.brdf = {}, .roughness = 1.0F});
  auto stripes = std::make_shared<Image>(64, 64, 2);
  for (int i = 0; i < 64 * 64; ++i) stripes->at(i % 64, i / 64)[0] = i % 2 == 0 ? 0.3F : 0.7F;
  striped.materials[0].metallic_roughness_map = TextureMap{"roughness", stripes, {}};
  Scene even = striped;
  even.materials[0].metallic_roughness_map.reset();
  const auto picture = [](const Scene& scene, const char* text) {
    return TestRenderer(scene, {32, 32}).frame(tan_gmm_method(), text);
  };
  for (const char* const text : {"tan_gmm", "tan_gmm:lobe=gaussian"}) {
    const Image expected = picture(striped, text);
    const auto difference = [&](float roughness) {
      even.materials[0].roughness = roughness;
      return compare_images(picture(even, text), expected, 1.0F).value().relative_rmse;
    };
    EXPECT_LT(difference(std::pow(0.5F * (std::pow(0.3F, 4.0F) + std::pow(0.7F, 4.0F)), 0.25F)), 1e-3) << text;
    EXPECT_GT(difference(0.5F), 0.02) << text;  // the mean roughness
  }
}

}  // namespace
}  // namespace footprint::testing
