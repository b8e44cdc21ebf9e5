// The shader's density against plain sums over texels: by bins and by lobes, over any footprint and border, with texels
// that have no normal; its pictures against those of `exact`.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "tests/methods/bins_probe.hpp"
#include "tests/support/rendering.hpp"

namespace footprint {
const Method& exact_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using atanasov_bins::bin_solid_angle;
using std::numbers::pi;

std::vector<glm::vec4> probe_footprints(const Material& material, const std::map<std::string, std::string>& options,
                                        const std::string& value, std::span<const std::array<glm::vec4, 3>> inputs) {
  return probe_footprints(ProbedMethod{&atanasov_bins_method(), &material, options}, "return " + value + ";", inputs);
}

class OverBorders : public ::testing::TestWithParam<Wrap> {};

// Every bin that has a normal, and some that have none; small maps texel by texel, large ones by lists.
TEST_P(OverBorders, BinsDensityIsAPlainSum) {
  constexpr int m = 15;
  for (const glm::ivec2& size : {glm::ivec2(1, 1), {6, 5}, {64, 64}, {45, 67}}) {
    const Image normals = test_normals(size.x, size.y, 0.5F, m);
    const std::vector<Parallelogram> footprints = footprints_on(glm::dvec2(size));
    std::vector<std::array<glm::vec4, 3>> inputs;
    std::vector<double> exact;
    for (const Parallelogram& p : footprints) {
      const std::vector<double> shares = shares_of_bins(normals, p, GetParam(), m);
      exact.insert(exact.end(), shares.begin(), shares.end());
      for (std::uint32_t bin = 0; bin < m * m; ++bin)
        inputs.push_back(input_of(p, size, square_to_hemisphere((glm::dvec2(bin % m, bin / m) + 0.5) / double{m})));
    }
    const auto found =
        probe_footprints(material_of(normals, GetParam()), {{"m", "15"}, {"roughness", "bin"}, {"border", "texels"}},
                         "vec4(ndf(e, c.xyz))", inputs);
    double energy = 0.0;
    for (std::size_t i = 0; i < exact.size(); ++i) {
      // The tolerance is a share of the largest density that there may be. The footprint has been through texture
      // coordinates in 32 bits.
      ASSERT_NEAR(found[i].x * bin_solid_angle(m), exact[i], 1e-5 * (1.0 + 2.0 * size.x / 64.0))
          << size.x << ", footprint " << i / (m * m) << ", bin " << i % (m * m);
      energy += found[i].x * bin_solid_angle(m);
      if (i % (m * m) != m * m - 1) continue;
      EXPECT_NEAR(energy, 1.0, 2e-5) << size.x << ", footprint " << i / (m * m);
      energy = 0.0;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Wraps, OverBorders,
                         ::testing::Values(Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge));

// The density of one of the map's corners with a footprint elsewhere: what the test above would see.
TEST(AtanasovBins, AFootprintElsewhereIsSeen) {
  constexpr int m = 15;
  const Image normals = test_normals(64, 64, 0.5F, m);
  const Material material = material_of(normals, Wrap::repeat);
  const Parallelogram p = footprints_on({64.0, 64.0})[1];
  const glm::dvec3 h = glm::normalize(glm::dvec3(0.1, -0.05, 0.99));
  const auto found = probe_footprints(
      material, {{"m", "15"}, {"roughness", "bin"}}, "vec4(ndf(e, c.xyz))",
      std::vector{input_of(p, {64.0, 64.0}, h), input_of({p.centre + glm::dvec2(0.5, 0.0), p.edges}, {64.0, 64.0}, h)});
  EXPECT_GT(std::abs(found[0].x - found[1].x) * bin_solid_angle(m), 1e-3);
}

// The shader's bins and packed normals are those of bin_textures.cpp.
TEST(AtanasovBins, PackedNormalsAndBinsAreTheTwins) {
  constexpr int m = 127;
  const Material material = material_of(test_normals(8, 8, 0.5F, m), Wrap::repeat);
  std::vector<std::array<glm::vec4, 3>> inputs;
  std::vector<glm::dvec3> normals;
  for (int i = 0; i < 500; ++i) {
    const double z = 1.0 - (i + 0.5) / 500.0, angle = 2.4 * i, r = std::sqrt(1.0 - z * z);
    normals.emplace_back(r * std::cos(angle), r * std::sin(angle), z);
    const std::uint32_t packed = atanasov_bins::packed_normal(normals.back(), m);
    inputs.push_back({glm::vec4(packed & 0xFFFFU, packed >> 16U, 0, 0), glm::vec4(0), glm::vec4(0)});
  }
  const ProbedMethod probed{&atanasov_bins_method(), &material, {{"roughness", "bin"}}};
  const auto found = probe_method(probed,
                                  "uint code = uint(a.x) | uint(a.y) << 16;\n"
                                  "vec3 n = unpackedNormal(code);\n"
                                  "return vec4(n, binOfPacked(code) == binIn(cellOf(n)) ? float(binOfPacked(code)) : "
                                  "-1.0);",
                                  inputs);
  for (std::size_t i = 0; i < normals.size(); ++i) {
    EXPECT_LT(glm::length(glm::dvec3(found[i]) - normals[i]), 1e-4) << i;
    EXPECT_EQ(found[i].w, static_cast<float>(bin_of(normals[i], m))) << i;
  }
}

double phong_density(const glm::dvec3& n, const glm::dvec3& h) {
  return (phong_exponent + 1.0) / (2.0 * pi) * std::pow(std::max(glm::dot(n, h), 0.0), phong_exponent);
}

const std::vector<glm::dvec3> some_directions{{0.0, 0.0, 1.0}, {0.1, -0.05, 0.99}, {0.2, 0.15, 0.9}, {-0.3, 0.1, 0.9}};

// The largest difference to the plain sum of lobes over directions and footprints, over the largest of the sums.
template <class Density>
double largest_error(const Image& normals, const std::vector<Parallelogram>& footprints,
                     const std::map<std::string, std::string>& options, const Density& density) {
  const Material material = material_of(normals, Wrap::repeat);
  const glm::dvec2 size(normals.width, normals.height);
  std::vector<std::array<glm::vec4, 3>> inputs;
  std::vector<double> exact;
  for (const Parallelogram& p : footprints) {
    for (const glm::dvec3& direction : some_directions) {
      const glm::dvec3 h = glm::normalize(direction);
      inputs.push_back(input_of(p, size, h));
      exact.push_back(plain_mean(normals, p, Wrap::repeat, [&](const glm::dvec3& n) { return density(n, h); }));
    }
  }
  const auto found = probe_footprints(material, options, "vec4(ndf(e, c.xyz))", inputs);
  double error = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) error = std::max(error, std::abs(found[i].x - exact[i]));
  return error / *std::ranges::max_element(exact);
}

TEST(AtanasovBins, LobesOfASmallFootprintAreAPlainSum) {
  const Image normals = test_normals(64, 64, 0.4F, 2047);
  const std::vector<Parallelogram> small{{{20.3, 17.1}, {{12.0, 3.0}, {-4.0, 9.0}}},
                                         {{63.2, 0.4}, {{2.0, 0.0}, {0.0, 3.0}}}};
  EXPECT_LT(largest_error(normals, small, {}, phong_density), 3e-4);
  const auto flake = [](const glm::dvec3& n, const glm::dvec3& h) { return beckmann_density(0.04, n, h); };
  EXPECT_LT(largest_error(normals, small, {{"roughness", "flakes"}, {"alpha", "0.04"}}, flake), 1e-3);
  EXPECT_GT(largest_error(normals, small, {{"roughness", "flakes"}, {"alpha", "0.03"}}, flake), 0.05);
}

// In a large one the lobe is about the mean normal of each bin, as wide as that bin's normals make it: the error is
// that of the bins, and finer ones have less.
TEST(AtanasovBins, LobesOfALargeFootprintConverge) {
  const Image normals = test_normals(256, 256, 0.4F, 2047);
  const std::vector<Parallelogram> large{{{120.3, 117.1}, {{112.0, 13.0}, {-14.0, 99.0}}},
                                         {{3.0, 250.0}, {{100.0, 0.0}, {0.0, 80.0}}}};
  const double coarse = largest_error(normals, large, {{"m", "9"}}, phong_density);
  const double fine = largest_error(normals, large, {{"m", "127"}}, phong_density);
  EXPECT_LT(fine, 0.02);
  EXPECT_GT(coarse, 3.0 * fine);
  const auto flake = [](const glm::dvec3& n, const glm::dvec3& h) { return beckmann_density(0.04, n, h); };
  // Bins 1.5 of the lobe's deviations wide move a normal by 0.43 deviations, root mean square along an axis, where a
  // Gaussian lobe's slope is 0.6 of its peak a deviation at most: a quarter of it for one texel, less for more.
  EXPECT_LT(largest_error(normals, large, {{"roughness", "flakes"}, {"alpha", "0.04"}}, flake), 0.12);
}

// A map of texels without a normal is the surface's own; normals below the horizon are those on the rim.
TEST(AtanasovBins, ToleratesInvalidNormalsAndThoseBelowTheHorizon) {
  const Parallelogram all{{32.0, 32.0}, {{64.0, 0.0}, {0.0, 64.0}}};
  Image none = random_normals(64, 64, 0.5F, 2);
  for (std::size_t i = 3; i < none.texels.size(); i += 4) none.texels[i] = 0.0F;
  const auto up = probe_footprints(material_of(none, Wrap::repeat), {{"m", "15"}, {"roughness", "bin"}},
                                   "vec4(ndf(e, c.xyz))", std::vector{input_of(all, {64.0, 64.0}, {0.0, 0.0, 1.0})});
  EXPECT_NEAR(up[0].x * bin_solid_angle(15), 1.0, 1e-5);
  const glm::vec3 below = glm::normalize(glm::vec3(0.8F, 0.1F, -0.4F));
  const auto rim = probe_footprints(
      material_of(constant_normals(64, 64, below), Wrap::repeat), {{"m", "15"}, {"roughness", "bin"}},
      "vec4(ndf(e, c.xyz))", std::vector{input_of(all, {64.0, 64.0}, glm::normalize(glm::dvec3(0.8, 0.1, 1e-3)))});
  EXPECT_NEAR(rim[0].x * bin_solid_angle(15), 1.0, 1e-5);
}

// Walter's form: D over the cosine, so that the surface's projected area is one.
TEST(AtanasovBins, MicrofacetsHaveTheDensityOverTheCosine) {
  const Image normals = test_normals(64, 64, 0.5F, 15);
  Material material = material_of(normals, Wrap::repeat);
  const Parallelogram p = footprints_on({64.0, 64.0})[1];
  const glm::dvec3 h = glm::normalize(glm::dvec3(0.1, -0.05, 0.99));
  const std::string reflected =
      "vec4(shade(e, Surface(vec3(0.0), vec3(1.0)), c.xyz, c.xyz).specular.x, "
      "ndf(e, c.xyz), 0.0, 0.0)";
  for (const char* const roughness : {"bin", "lobe", "flakes"}) {
    const auto found = probe_footprints(material, {{"m", "15"}, {"roughness", roughness}, {"surface", "microfacets"}},
                                        reflected, std::vector{input_of(p, {64.0, 64.0}, h)});
    EXPECT_NEAR(found[0].x, found[0].y / h.z, 1e-5 * found[0].y) << roughness;
    const auto facets = probe_footprints(material, {{"m", "15"}, {"roughness", roughness}}, reflected,
                                         std::vector{input_of(p, {64.0, 64.0}, h)});
    EXPECT_NEAR(facets[0].x, facets[0].y, 1e-5 * facets[0].y) << roughness;
  }
}

// ---- pictures ----

double difference(TestRenderer& renderer, const std::string& text, const std::string& exact) {
  return compare_images(renderer.frame(atanasov_bins_method(), text), renderer.frame(exact_method(), exact), 1.0F)
      .value()
      .relative_rmse;
}

// Pixels of some texels, of hundreds and of thousands, by every footprint: those of `exact`'s kernels.
TEST(AtanasovBins, PicturesAreThoseOfTheSameTexels) {
  const BaseBrdf brdf{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true};
  for (const int texels : {64, 512, 2048}) {
    TestRenderer renderer(square_scene(random_normals(texels, texels, 0.5F, 5), {.brdf = brdf, .roughness = 0.25F}),
                          {24, 24});
    // What lists stand in: means of bins, and GGX's tail without its last hundredth.
    EXPECT_LT(difference(renderer, "atanasov_bins", "exact:kernel=areas"), 5e-3) << texels;
    EXPECT_LT(difference(renderer, "atanasov_bins:footprint=filter", "exact"), 5e-3) << texels;
    if (texels == 2048) continue;  // where the kernels differ by less than that
    EXPECT_GT(difference(renderer, "atanasov_bins", "exact"), 0.01) << texels;
  }
}

// Means of normals are for diffuse light and for footprints of more than 256 texels alone: here 455, and 7 of a map
// that is 8 times smaller.
TEST(AtanasovBins, StorageRoundsWhatDiffuseLightIsReflectedAboutAndNothingElse) {
  for (const int texels : {512, 64}) {
    TestRenderer renderer(square_scene(random_normals(texels, texels, 0.5F, 5), {.brdf = {}, .roughness = 0.4F}),
                          {24, 24});
    const Image half = renderer.frame(atanasov_bins_method(), "atanasov_bins:storage=fp16");
    const Image whole = renderer.frame(atanasov_bins_method(), "atanasov_bins:storage=fp32");
    EXPECT_EQ(half == whole, texels == 64) << "whether the means are read";
    EXPECT_LT(compare_images(half, whole, 1.0F).value().relative_rmse, 5e-4);
  }
}

// So fp16 puts no highlight off, however narrow the lobe, and nothing warns of it.
TEST(AtanasovBins, StorageLeavesHighlightsAsTheyAre) {
  const BaseBrdf brdf{NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::schlick, false};
  const Scene scene = square_scene(random_normals(512, 512, 0.5F, 5), {.brdf = brdf, .roughness = 0.1F});
  TestRenderer renderer(scene, {24, 24});
  for (const std::string roughness : {"bin", "lobe", "flakes"}) {
    const std::string text = "atanasov_bins:roughness=" + roughness + ":storage=";
    EXPECT_TRUE(renderer.frame(atanasov_bins_method(), text + "fp16") ==
                renderer.frame(atanasov_bins_method(), text + "fp32"))
        << roughness;
    const BakedMethod baked = bake(atanasov_bins_method(), parse_methods(text + "fp16").front(), scene,
                                   effects_on(derive_effects(scene)), no_progress);
    EXPECT_TRUE(baked.materials.front().notes.empty()) << baked.materials.front().notes.front();
  }
}

}  // namespace
}  // namespace footprint::testing
