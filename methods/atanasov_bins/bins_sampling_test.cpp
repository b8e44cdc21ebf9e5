// Normals drawn from D (section 2.1) against the twin in double precision and against D itself; and environment light
// by them against the reference.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "renderer/image/metrics.hpp"
#include "renderer/scene/environment.hpp"
#include "tests/methods/bins_probe.hpp"
#include "tests/support/rendering.hpp"

namespace footprint {
const Method& exact_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

constexpr int bins_across = 15;

// The method by bins, where it draws.
ProbedMethod drawing(const Material& material, const std::string& draws = "16") {
  ProbedMethod probed{
      &atanasov_bins_method(), &material, {{"m", std::to_string(bins_across)}, {"roughness", "bin"}, {"draws", draws}}};
  probed.effects.set(static_cast<std::size_t>(Effect::environment_light));
  return probed;
}

// Numbers of [0, 1)^4 and a footprint, as `drawn_by_shader` takes them.
std::array<glm::vec4, 3> draw_input(const Parallelogram& p, const glm::dvec2& size, const glm::vec4& u) {
  std::array<glm::vec4, 3> input = input_of(p, size, {u.z, u.w, 0.0});
  input[0].z = u.x;
  input[0].w = u.y;
  return input;
}

constexpr const char* drawn_by_shader =
    "uint code = packedAt(texelAt(regionAt(e.footprint, 0), a.zw));\n"
    "return vec4(normalOf(code, c.xy), code == no_normal ? 0.0 : 1.0);";

std::vector<glm::vec4> random_numbers(std::size_t count) {
  std::mt19937 random(8);
  std::uniform_real_distribution<float> unit(0.0F, 1.0F);
  std::vector<glm::vec4> out(count);
  for (glm::vec4& u : out) u = {unit(random), unit(random), unit(random), unit(random)};
  return out;
}

TEST(AtanasovSampling, ShaderDrawsAsTheTwinDoes) {
  const glm::ivec2 size(45, 67);
  const Image normals = test_normals(size.x, size.y, 0.5F, bins_across);
  const atanasov_bins::BinMap map = atanasov_bins::bin_map(normals, bins_across, no_progress);
  const std::vector<glm::vec4> numbers = random_numbers(500);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    const Material material = material_of(normals, wrap);
    std::vector<std::array<glm::vec4, 3>> inputs;
    std::vector<std::optional<glm::dvec3>> exact;
    for (Parallelogram p : footprints_on(size)) {
      // The shader has the longer edge first.
      if (glm::length(p.edges[1]) > glm::length(p.edges[0])) std::swap(p.edges[0], p.edges[1]);
      for (const glm::vec4& u : numbers) {
        inputs.push_back(draw_input(p, size, u));
        exact.push_back(drawn_normal(map, p, wrap, u));
      }
    }
    const auto found = probe_footprints(drawing(material), drawn_by_shader, inputs);
    int others = 0;  // points that 32 bits put into the texel beside
    for (std::size_t i = 0; i < exact.size(); ++i) {
      const bool same = found[i].w == (exact[i] ? 1.0F : 0.0F) &&
                        (!exact[i] || glm::length(glm::dvec3(glm::vec3(found[i])) - *exact[i]) < 1e-5);
      if (!same) ++others;
    }
    EXPECT_LT(others, static_cast<int>(exact.size() / 500));
  }
}

// Pearson's chi-squared of counts over bins, less its degrees of freedom, in standard deviations.
double chi_squared_deviations(const std::vector<double>& counts, const std::vector<double>& shares, double samples) {
  double chi2 = 0.0, freedom = -1.0;
  for (std::size_t i = 0; i < counts.size(); ++i) {
    const double expected = samples * shares[i];
    if (expected < 5.0) continue;
    chi2 += (counts[i] - expected) * (counts[i] - expected) / expected;
    freedom += 1.0;
  }
  return (chi2 - freedom) / std::sqrt(2.0 * freedom);
}

TEST(AtanasovSampling, ShaderDrawsAsTheDensitySays) {
  const glm::ivec2 size(64, 64);
  const Image normals = test_normals(size.x, size.y, 0.5F, bins_across);
  const Material material = material_of(normals, Wrap::repeat);
  const std::vector<glm::vec4> numbers = random_numbers(40'000);
  const std::vector<Parallelogram> footprints = footprints_on(size);
  for (const std::size_t at : {std::size_t{1}, std::size_t{3}}) {
    std::vector<std::array<glm::vec4, 3>> inputs;
    for (const glm::vec4& u : numbers) inputs.push_back(draw_input(footprints[at], size, u));
    std::vector<double> counts(static_cast<std::size_t>(bins_across * bins_across), 0.0);
    double drawn = 0.0;
    for (const glm::vec4& normal : probe_footprints(drawing(material), drawn_by_shader, inputs)) {
      if (normal.w == 0.0F) continue;
      counts[bin_of(glm::dvec3(glm::vec3(normal)), bins_across)] += 1.0;
      drawn += 1.0;
    }
    const auto deviations = [&](const Parallelogram& p) {
      return chi_squared_deviations(counts, shares_of_bins(normals, p, Wrap::repeat, bins_across), drawn);
    };
    EXPECT_LT(std::abs(deviations(footprints[at])), 5.0) << at;
    EXPECT_GT(deviations(footprints[at == 1 ? 3 : 1]), 50.0) << at;
  }
}

// The lobes that stand for the NDF: of a small footprint every texel by its area, of a large one as many as are drawn.
TEST(AtanasovSampling, LobesHoldTheShareOfEveryBin) {
  const glm::ivec2 size(64, 64);
  const Image normals = test_normals(size.x, size.y, 0.5F, bins_across);
  const Material material = material_of(normals, Wrap::repeat);
  const std::vector<Parallelogram> footprints = footprints_on(size);
  std::vector<std::array<glm::vec4, 3>> inputs;
  std::vector<double> exact;
  for (const Parallelogram& p : footprints) {
    const std::vector<double> shares = shares_of_bins(normals, p, Wrap::repeat, bins_across);
    exact.insert(exact.end(), shares.begin(), shares.end());
    for (std::size_t bin = 0; bin < shares.size(); ++bin)
      inputs.push_back(input_of(p, size, {static_cast<double>(bin), 0.0, 0.0}));
  }
  constexpr int draws = 1024;
  const auto found = probe_footprints(drawing(material, std::to_string(draws)),
                                      "float share = 0.0;\n"
                                      "for (int i = 0; i < lobeCount(e); ++i) {\n"
                                      "  NormalLobe lobe = normalLobe(e, i);\n"
                                      "  if (binIn(cellOf(lobe.axis)) == uint(c.x)) share += lobe.weight;\n"
                                      "}\nreturn vec4(share);",
                                      inputs);
  const std::size_t bins = exact.size() / footprints.size();
  for (std::size_t i = 0; i < exact.size(); ++i) {
    const Parallelogram& p = footprints[i / bins];
    const bool all = (2.0 * p.reach().x + 2.0) * (2.0 * p.reach().y + 2.0) <= draws;
    const double deviation = std::sqrt(exact[i] * (1.0 - exact[i]) / draws);
    EXPECT_NEAR(found[i].x, exact[i], all ? 3e-5 : 4.0 * deviation + 1e-3) << "footprint " << i / bins;
  }
}

// Light that has no edges, so that little is lost to the lookup by lobes.
Scene scene_under_an_even_sky(const Image& normals, const BaseBrdf& brdf) {
  Image map(64, 32, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 d = environment_direction({.name = "", .radiance = nullptr}, (x + 0.5) / 64.0, (y + 0.5) / 32.0);
      for (int c = 0; c < 3; ++c) map.at(x, y)[c] = static_cast<float>(1.0 + 0.9 * std::sin(4.0 * d[c]));
    }
  }
  Scene scene = square_scene(normals, {.brdf = brdf, .roughness = 0.4F, .specular = glm::vec3(0.9F)});
  scene.lights.clear();
  scene.environment = {.name = "even", .radiance = std::make_shared<const Image>(std::move(map)), .rotation = 0.0F};
  return scene;
}

// The reference's noise, root mean square over the picture's.
double noise_of(const Supersampled& reference) {
  double noise = 0.0, energy = 0.0;
  for (std::size_t i = 0; i < reference.mean.texel_count(); ++i) {
    for (std::size_t c = 0; c < 3; ++c) {
      noise += std::pow(reference.standard_error.texels[3 * i + c], 2.0);
      energy += std::pow(reference.mean.texels[4 * i + c], 2.0);
    }
  }
  return std::sqrt(noise / energy);
}

// Pixels of 16 x 16 texels. Where all of them are lobes nothing is left but the reference's noise, and little that the
// lookup by lobes is off by; where few are drawn their own noise shows.
TEST(AtanasovSampling, EnvironmentIsTheReferences) {
  const BaseBrdf brdf{NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::schlick, false};
  TestRenderer renderer(scene_under_an_even_sky(random_normals(256, 256, 0.5F, 5), brdf), {16, 16});
  const Supersampled reference = renderer.reference(256);
  const auto error = [&](const std::string& draws) {
    const Image picture = renderer.frame(atanasov_bins_method(), "atanasov_bins:draws=" + draws);
    return compare_images(picture, reference.mean, 1.0F).value().relative_rmse;
  };
  const double noise = noise_of(reference);
  EXPECT_LT(noise, 0.03);
  EXPECT_LT(error("512"), 1.25 * noise);
  // The same lobes, found and summed by another method.
  const Image all = renderer.frame(atanasov_bins_method(), "atanasov_bins:draws=512");
  const Image exact = renderer.frame(exact_method(), "exact:kernel=areas");
  EXPECT_LT(compare_images(all, exact, 1.0F).value().relative_rmse, 1e-3);
  const double drawn = error("16");
  EXPECT_LT(drawn, 0.15);
  EXPECT_GT(drawn, 2.0 * noise) << "nothing was drawn";
}

}  // namespace
}  // namespace footprint::testing
