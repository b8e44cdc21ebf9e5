// The lobes' conversions and mixtures against golden numbers, and the density that comes of them.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "tests/methods/built_map.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

// The conversions as a pass has them, with the table of `conversion=table`.
std::vector<glm::vec4> converted(const std::string& body, const ProbeInputs& inputs) {
  const Options options(xu_vmf_method().info.options, {{"conversion", "table"}}, "test");
  ShaderVariant variant;
  variant.brdf.distribution = NormalDistribution::blinn_phong;
  const ShaderFlags flags = shader_flags(variant, options);
  const BuiltMap map(blinn_phong_square(constant_normals(1, 1, {0, 0, 1}), 10), {{"conversion", "table"}});
  const GpuTexture table = upload(map.baked().textures.back());
  const gl::Sampler sampler = gl::nearest_sampler(GL_REPEAT, GL_REPEAT);
  gl::api().BindTextureUnit(0, table.texture->name());
  gl::api().BindSampler(0, sampler.name());
  ShaderModule conversions = xu_vmf_method().shader;
  conversions.text = "#include \"xu_vmf_conversion.glsl\"\n";
  return evaluate_glsl("layout(binding = 0) uniform sampler2D table;\n" + shared_functions(flags, conversions), body,
                       inputs);
}

ProbeInputs kappas(double first, double last, int count) {
  ProbeInputs inputs;
  for (int i = 0; i < count; ++i) {
    const double kappa = first * std::pow(last / first, static_cast<double>(i) / (count - 1));
    inputs.push_back({glm::vec4(static_cast<float>(kappa)), glm::vec4(0), glm::vec4(0)});
  }
  return inputs;
}

// 1 - |r| of the golden cubic, computed to 40 digits.
TEST(XuConversion, MeetsTheGoldenRoots) {
  const std::vector<std::pair<float, double>> golden{
      {1e-3F, 0.99966666669135802195},     {0.1F, 0.9666913306203034294},      {1.0F, 0.68889218253401810007},
      {2.0F, 0.47068341987116060739},      {5.0F, 0.2097187775373719208},      {10.0F, 0.10382913790591307894},
      {50.0F, 0.020191703623313614892},    {128.0F, 0.0078425337866485061951}, {512.0F, 0.0019550248707961608454},
      {1000.0F, 0.0010004989981260065655}, {1e4F, 0.00010000499899981251001},  {1e5F, 0.00001000004999899998125},
      {1e6F, 1.0000004999989999981e-6}};
  ProbeInputs inputs;
  for (const auto& [kappa, q] : golden) inputs.push_back({glm::vec4(kappa), glm::vec4(0), glm::vec4(0)});
  const auto got = converted("return vec4(shortfallOf(a.x));", inputs);
  for (std::size_t i = 0; i < golden.size(); ++i) {
    EXPECT_NEAR(got[i].x / golden[i].second, 1.0, 1e-6) << golden[i].first;
    EXPECT_NEAR(shortfall_twin(golden[i].first) / golden[i].second, 1.0, 1e-7) << golden[i].first;
  }
}

TEST(XuConversion, KappaComesBack) {
  const ProbeInputs inputs = kappas(1e-2, 1e5, 4001);
  const auto got =
      converted("return vec4(kappaOf(shortfallOf(a.x)), kappaOf(tabulatedShortfall(table, a.x)), 0, 0);", inputs);
  for (std::size_t i = 0; i < got.size(); ++i) {
    EXPECT_NEAR(got[i].x / inputs[i][0].x, 1.0F, 1e-4F) << inputs[i][0].x;
    EXPECT_NEAR(got[i].y / inputs[i][0].x, 1.0F, 1e-4F) << inputs[i][0].x;
  }
}

// The golden `vmf_storage.lut1024` of 1024 entries of 1 - |r| over log kappa, blended: the largest error of kappa by
// decade.
TEST(XuConversion, TheTableErrsAsTheGoldenOne) {
  const std::array<std::pair<double, double>, 4> golden{
      {{1.0, 3.16064e-05}, {10.0, 3.20615e-05}, {100.0, 3.13124e-05}, {1000.0, 3.10945e-05}}};
  for (const auto& [first, error] : golden) {
    const double last = first < 1000.0 ? 10.0 * first : 1e5;
    const ProbeInputs inputs = kappas(first, last, 4001);
    double largest = 0;
    for (std::size_t i = 0;
         const glm::vec4& got : converted("return vec4(kappaOf(tabulatedShortfall(table, a.x)));", inputs))
      largest = std::max(largest, std::abs(got.x / static_cast<double>(inputs[i++][0].x) - 1.0));
    EXPECT_NEAR(largest / error, 1.0, 0.1) << first;
  }
}

// Where the table ends, the root's own limits go on.
TEST(XuConversion, TheTableGoesOnBeyondItsEnds) {
  for (const auto& [first, last] : {std::pair(1e-6, 9.9e-3), std::pair(1.01e5, 1e6)}) {
    const ProbeInputs inputs = kappas(first, last, 101);
    for (std::size_t i = 0; const glm::vec4& got : converted("return vec4(tabulatedShortfall(table, a.x));", inputs)) {
      const float kappa = inputs[i++][0].x;
      EXPECT_NEAR(got.x / shortfall_twin(kappa), 1.0, 5e-7) << kappa;
    }
  }
}

// The map that is built and what it reflects are finite, from lobes that know no direction to such as no float can
// follow.
TEST(XuDensity, IsFiniteForEveryKappa) {
  std::vector<glm::dvec3> directions = hemisphere_grid(8, 16);
  const Image normals = random_normals(5, 3, 0.9F, 17);
  for (int x = 0; x < 5; ++x) directions.emplace_back(normals.at(x, 1)[0], normals.at(x, 1)[1], normals.at(x, 1)[2]);
  for (const float kappa : {0.0F, 1e-6F, 1e6F}) {
    Scene scene = blinn_phong_square(normals, kappa);
    scene.materials[0].brdf.distribution = NormalDistribution::vmf;
    for (const Words& words : {Words{{"space", "camera"}}, Words{{"j", "8"}, {"storage", "fp16"}},
                               Words{{"lobe", "vmf"}, {"conversion", "table"}}}) {
      for (const double density : BuiltMap(scene, words).densities(directions))
        EXPECT_TRUE(std::isfinite(density) && density >= 0.0) << kappa << " " << words.begin()->second;
    }
  }
}

TEST(XuConversion, IsFiniteForEveryKappa) {
  ProbeInputs inputs = kappas(1e-30, 1e6, 2001);
  inputs.push_back({glm::vec4(0), glm::vec4(0), glm::vec4(0)});
  for (const glm::vec4& got : converted("float q = max(shortfallOf(a.x), tabulatedShortfall(table, a.x)); float k = "
                                        "kappaOf(clamp(q, 5e-7, 1.0)); float s = lobeOfKappa(k);\n"
                                        "return vec4(q, k, s, lobeDensity(s, vec3(0, 0, 1), vec3(0, 0.6, 0.8)));",
                                        inputs)) {
    for (int c = 0; c < 4; ++c) ASSERT_TRUE(std::isfinite(got[c]) && got[c] >= 0.0F) << c;
    EXPECT_LE(got.x, 1.0F);
  }
}

// The golden `four_texel_vector.xu_mixture`: an exponent of 100 over four normals.
TEST(XuMixture, IsTheGoldenOne) {
  const MapLobe whole{1.0, {0.08829140104321008, -0.16554637695601893, 0.9822418366057123}, 10.08583615695044};
  const MapLobe pair{0.5, {0.31622776601683794, 0.0, 0.9486832980505139}, 16.88308542566846};
  const MapLobe left{0.25, {-0.28, 0.0, 0.96}, 101.0};
  const MapLobe down{0.25, {0.0, -0.6, 0.8}, 101.0};
  const MapLobe up{0.25, {0.0, 0.0, 1.0}, 101.0};
  const MapLobe right{0.25, {0.6, 0.0, 0.8}, 101.0};
  const std::vector<std::pair<std::string, std::vector<MapLobe>>> golden{
      {"1", {whole}}, {"4", {pair, left, down}}, {"8", {up, right, left, down}}};
  for (const auto& [j, expected] : golden) {
    const std::vector<MapLobe> got = BuiltMap(blinn_phong_square(four_texel_normals(), 100), {{"j", j}}).lobes();
    ASSERT_EQ(got.size(), expected.size()) << j;
    for (std::size_t i = 0; i < got.size(); ++i) {
      EXPECT_NEAR(got[i].share, expected[i].share, 1e-6) << j;
      EXPECT_LT(glm::length(got[i].mean - expected[i].mean), 1e-5) << j;
      EXPECT_NEAR(got[i].kappa / expected[i].kappa, 1.0, 2e-4) << j;
    }
  }
}

// |r| of the whole is 0.89 < 0.95: it is subdivided. That of the pair is 0.94: above 0.85 it stays, above 0.95 not.
TEST(XuMixture, SubdividesWhereThresholdsSay) {
  const Scene scene = blinn_phong_square(four_texel_normals(), 100);
  EXPECT_EQ(BuiltMap(scene, {{"eps0", "0.85"}}).lobes().size(), 1U);
  EXPECT_EQ(BuiltMap(scene).lobes().size(), 3U);
  EXPECT_EQ(BuiltMap(scene, {{"eps1", "0.95"}}).lobes().size(), 4U);
}

// Blended, the step becomes a ramp of 0.02 below the threshold: |r| of the whole is 0.897.
TEST(XuMixture, BlendsBelowAThreshold) {
  const Scene scene = blinn_phong_square(four_texel_normals(), 100);
  const auto shares = [&](const std::string& eps0) {
    std::vector<MapLobe> lobes = BuiltMap(scene, {{"thresholds", "blended"}, {"eps0", eps0}}).lobes();
    double sum = 0;
    for (const MapLobe& lobe : lobes) sum += lobe.share;
    EXPECT_NEAR(sum, 1.0, 1e-6);
    return lobes;
  };
  EXPECT_EQ(shares("0.88").size(), 1U);
  EXPECT_EQ(shares("0.92").size(), 3U);
  const std::vector<MapLobe> both = shares("0.9");
  ASSERT_EQ(both.size(), 4U);
  EXPECT_NEAR(both[0].share, (0.897074 - 0.88) / 0.02, 1e-3);
  EXPECT_NEAR(both[0].kappa, 10.0858, 0.01);
}

// Hard case 19: a map that is half empty has the lobes of its other half, at full energy; an empty one is flat.
TEST(XuMixture, CountsCoveredTexelsAlone) {
  Image half = constant_normals(8, 8, {0.28F, 0, 0.96F});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 4; ++x) half.at(x, y)[3] = 0.0F;
  for (const std::string j : {"1", "4", "8", "adaptive"}) {
    const std::vector<MapLobe> lobes = BuiltMap(blinn_phong_square(half, 100), {{"j", j}}).lobes();
    ASSERT_EQ(lobes.size(), 1U);
    EXPECT_NEAR(lobes[0].share, 1.0, 1e-6);
    EXPECT_LT(glm::length(lobes[0].mean - glm::dvec3(0.28, 0, 0.96)), 1e-5);
    EXPECT_NEAR(lobes[0].kappa, 101.0, 0.01);
  }
  Image empty = half;
  for (std::size_t i = 3; i < empty.texels.size(); i += 4) empty.texels[i] = 0.0F;
  const std::vector<MapLobe> flat = BuiltMap(blinn_phong_square(empty, 100)).lobes();
  ASSERT_EQ(flat.size(), 1U);
  EXPECT_NEAR(flat[0].mean.z, 1.0, 1e-6);
  EXPECT_NEAR(flat[0].kappa, 101.0, 0.01);
}

// Hard case 8 in 32-bit floats: kappa of a constant map, which comes back through |r| alone.
TEST(XuMixture, KeepsKappaOverAConstantMap) {
  for (const float kappa : sweep(std::array{2.0F, 1e5F, 512.0F, 50.0F, 1e4F}, 3)) {
    const BuiltMap map(blinn_phong_square(constant_normals(16, 16, {0.28F, -0.1F, 0.95F}), kappa - 1.0F));
    for (const MapLobe& lobe : map.lobes()) EXPECT_NEAR(lobe.kappa / kappa, 1.0, 0.01) << kappa;
  }
}

// Hard case 8 in half floats: the dead zone holds what the digits cannot, and the texels' own 1 - |r| bounds it.
TEST(XuMixture, KeepsKappaOverAConstantMapInHalfFloats) {
  for (const float kappa : sweep(std::array{8.0F, 6e4F, 512.0F, 128.0F, 4096.0F}, 2)) {
    for (const bool varies : {false, true}) {
      const Image normals = constant_normals(16, 16, {0.28F, -0.1F, 0.95F});
      const float alpha2 = 2.0F / (kappa + 1.0F);  // of the exponent kappa - 1
      const Scene scene = varies ? rough_square(normals, Image(4, 4, 1, std::pow(alpha2, 0.25F)))
                                 : blinn_phong_square(normals, kappa - 1.0F);
      for (const std::string j : {"1", "8"}) {
        for (const MapLobe& lobe : BuiltMap(scene, {{"storage", "fp16"}, {"j", j}}).lobes())
          EXPECT_NEAR(lobe.kappa / kappa, 1.0, 0.01) << kappa << j << varies;
      }
    }
  }
}

// Facets of narrow lobes, whose energy is one (but for 0.002 of GGX), spread so far that the lobes that stand for them
// are wide.
Scene spread_facets(NormalDistribution distribution) {
  Scene scene = blinn_phong_square(random_normals(16, 16, 0.65F, 12), 300);
  scene.materials[0].brdf.distribution = distribution;
  scene.materials[0].lobe_parameter = static_cast<float>(lobe_from_alpha(distribution, 0.04F).parameter);
  return scene;
}

double ggx_energy(double alpha) {
  const double t = std::sqrt(1.0 - alpha * alpha);
  return 1.0 + alpha * alpha * std::atanh(t) / t;
}

constexpr std::array distributions{NormalDistribution::blinn_phong, NormalDistribution::vmf,
                                   NormalDistribution::beckmann, NormalDistribution::ggx};

// All ways to divide the hemisphere.
const std::vector<Words>& divisions() {
  static const std::vector<Words> all = [] {
    std::vector<Words> out;
    for (const char* const partition : {"azimuth", "latitude"}) {
      for (const char* const j : {"1", "4", "8", "adaptive"}) out.push_back({{"j", j}, {"partition", partition}});
    }
    return out;
  }();
  return all;
}

TEST(XuDensity, HasUnitEnergyHoweverTheHemisphereIsCut) {
  for (std::size_t i = 0; i < distributions.size(); ++i) {
    const Scene scene = spread_facets(distributions[i]);
    for (const Words& words : sweep(divisions(), 2, 2 * i)) {
      EXPECT_NEAR(BuiltMap(scene, words).energy(), 1.0, 0.01)
          << static_cast<int>(distributions[i]) << " " << words.at("j") << " " << words.at("partition");
    }
  }
}

TEST(XuDensity, HasUnitEnergyWithThePapersLobes) {
  const Scene scene = spread_facets(NormalDistribution::ggx);  // whose width they take
  for (Words words : sweep(divisions(), 3, 1)) {
    words["lobe"] = "vmf";
    EXPECT_NEAR(BuiltMap(scene, words).energy(), 1.0, 0.01) << words.at("j") << " " << words.at("partition");
  }
}

TEST(XuDensity, HasUnitEnergyHoweverItIsBuilt) {
  const std::vector<Words> ways{{{"thresholds", "blended"}},
                                {{"storage", "fp16"}, {"conversion", "table"}},
                                {{"space", "camera"}},
                                {{"space", "camera"}, {"storage", "fp16"}, {"j", "8"}}};
  for (std::size_t i = 0; i < distributions.size(); ++i) {
    const Scene scene = spread_facets(distributions[i]);
    for (const Words& words : sweep(ways, 1, i))
      EXPECT_NEAR(BuiltMap(scene, words).energy(), 1.0, 0.01)
          << static_cast<int>(distributions[i]) << " " << words.begin()->second;
  }
}

// Algorithm 1 as printed adds every lobe whole, also those near the rim, part of which lies below the horizon.
// `adaptive` adds its first four cells for each of the four coarse parts.
TEST(XuDensity, HasAsMuchEnergyAsAlgorithm1AddsLobes) {
  struct Count {
    std::string j;
    std::size_t lobes;
    double energy;
  };
  const std::vector<Count> counts{{"1", 1, 1.0}, {"4", 4, 4.0}, {"8", 8, 8.0}, {"adaptive", 4, 16.0}};
  for (std::size_t i = 0; i < distributions.size(); ++i) {
    const NormalDistribution distribution = distributions[i];
    const Scene scene = spread_facets(distribution);
    for (const Count& count : sweep(counts, 1, i)) {
      const BuiltMap listed(scene, {{"j", count.j}, {"variant", "algorithm1"}});
      EXPECT_NEAR(listed.energy_over_sphere() / count.energy, 1.0, 0.01)
          << static_cast<int>(distribution) << " " << count.j;
      EXPECT_EQ(listed.lobes().size(), count.lobes) << count.j;
    }
  }
}

// A lobe that nothing widens keeps its own energy, which is above one for rough GGX: nothing changes there.
TEST(XuDensity, LeavesAConstantMapItsEnergy) {
  Scene scene = blinn_phong_square(constant_normals(8, 8, {0.0F, 0.0F, 1.0F}), 300);
  scene.materials[0].brdf.distribution = NormalDistribution::ggx;
  scene.materials[0].lobe_parameter = 0.5F;
  EXPECT_NEAR(BuiltMap(scene).energy(), ggx_energy(0.5), 0.005);
}

// Facets of two roughnesses, one in every other column: alpha 0.04 and 0.2.
Scene facets_of_two_roughnesses(const Image& normals) {
  Image roughness(normals.width, normals.height, 1, std::sqrt(0.04F));
  for (int y = 0; y < roughness.height; ++y)
    for (int x = 0; x < roughness.width; x += 2) roughness.at(x, y)[0] = std::sqrt(0.2F);
  Scene scene = rough_square(normals, roughness);
  scene.materials[0].brdf.distribution = NormalDistribution::ggx;
  return scene;
}

TEST(XuDensity, KeepsTheMeanEnergyOfFacetsOfTwoRoughnesses) {
  const Scene scene = facets_of_two_roughnesses(random_normals(16, 16, 0.5F, 12));
  const double truth = 0.5 * (ggx_energy(0.04) + ggx_energy(0.2));
  for (const Words& words : {Words{{"j", "1"}}, Words{{"j", "4"}}, Words{{"j", "8"}}, Words{},
                             Words{{"storage", "fp16"}}, Words{{"space", "camera"}}})
    EXPECT_NEAR(BuiltMap(scene, words).energy() / truth, 1.0, 0.01) << (words.empty() ? "" : words.begin()->second);
}

// What diffuse light sees: the facets' mean normal, as long as it is, however rough they are.
TEST(XuMeanNormal, IsThatOfTheFacets) {
  const Image normals = random_normals(16, 16, 0.65F, 12);
  glm::dvec3 truth(0.0);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) truth += glm::dvec3(normals.at(x, y)[0], normals.at(x, y)[1], normals.at(x, y)[2]);
  truth /= 256.0;
  ASSERT_LT(glm::length(truth), 0.95);
  const std::string sum =
      "vec3 sum = vec3(0.0);\nfor (int i = 0; i < e.count; ++i) sum += weights[i].y * lobes[i].xyz;\n"
      "return vec4(sum / e.covered, 0.0);";
  for (const Scene& scene : {facets_of_two_roughnesses(normals), blinn_phong_square(normals, 30)}) {
    for (const std::string j : {"1", "4", "8", "adaptive"}) {
      const glm::dvec3 got(glm::vec3(BuiltMap(scene, {{"j", j}}).probe(sum, {{}}).front()));
      EXPECT_LT(glm::length(got - truth), 0.005) << j << ", lengths " << glm::length(got) << ", " << glm::length(truth);
    }
  }
}

double squared_distance(const std::vector<double>& a, const std::vector<double>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += (a[i] - b[i]) * (a[i] - b[i]);
  return sum;
}

// V-grooves: two slopes. Four sectors hold one each and are exact; one lobe and rings lie between them.
TEST(XuDensity, SeparatesTheSidesOfGrooves) {
  Image grooves = constant_normals(8, 8, {0.6F, 0, 0.8F});
  for (int y = 0; y < 8; ++y)
    for (int x = 0; x < 4; ++x) grooves.at(x, y)[0] = -0.6F;
  const double s = 200;
  const std::vector<glm::dvec3> directions = hemisphere_grid(64, 128);
  std::vector<double> truth;
  for (const glm::dvec3& h : directions) {
    double sum = 0;
    for (const double x : {-0.6, 0.6}) sum += std::pow(std::max(glm::dot(glm::dvec3(x, 0, 0.8), h), 0.0), s);
    truth.push_back(0.5 * (s + 1) / (2 * std::numbers::pi) * sum);
  }
  const std::vector<double> nothing(truth.size(), 0.0);
  const auto error = [&](const Words& words) {
    const BuiltMap map(blinn_phong_square(grooves, static_cast<float>(s)), words);
    return std::sqrt(squared_distance(map.densities(directions), truth) / squared_distance(truth, nothing));
  };
  EXPECT_LT(error({{"j", "4"}}), 1e-3);
  EXPECT_LT(error({}), 1e-3);
  EXPECT_GT(error({{"j", "1"}}), 0.5);
  EXPECT_GT(error({{"j", "4"}, {"partition", "latitude"}}), 0.5);
}

}  // namespace
}  // namespace footprint::testing
