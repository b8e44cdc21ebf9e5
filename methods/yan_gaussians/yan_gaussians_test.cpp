// The sum over elements through its own shader: against 4D Gaussians added up one by one without a hierarchy, against
// the limits that are known of them, and what is said where a sum cannot be whole.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "renderer/bake/prefiltered.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& yan_gaussians_method();
}

namespace footprint::testing {
namespace {

using Words = std::map<std::string, std::string>;
using std::numbers::pi;
constexpr double seed_variance = 1.0 / (8.0 * std::numbers::ln2);

Material material_of(const Image& normals, const Lobe& lobe = {NormalDistribution::beckmann, 0.1},
                     const std::array<Wrap, 2>& wrap = {Wrap::repeat, Wrap::repeat}) {
  const BaseBrdf brdf{lobe.distribution, GeometryTerm::none, FresnelTerm::none, false};
  Material material = square_scene(normals, {.brdf = brdf}).materials[0];
  material.lobe_parameter = static_cast<float>(lobe.parameter);
  material.normal_map->coordinates.wrap = wrap;
  return material;
}

// A pixel's parallelogram on the map, in texture coordinates.
struct Pixel {
  glm::dvec2 centre, dx, dy;
};

// The method's density at directions, one list for each pixel.
std::vector<std::vector<double>> densities(const Material& material, const Words& options,
                                           const std::vector<Pixel>& pixels,
                                           const std::vector<glm::dvec3>& directions) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  for (const Pixel& pixel : pixels) {
    for (const glm::dvec3& h : directions) {
      inputs.push_back({glm::vec4(glm::vec2(pixel.centre), 0, 0), glm::vec4(glm::vec2(pixel.dx), glm::vec2(pixel.dy)),
                        glm::vec4(glm::vec3(h), 0)});
    }
  }
  const auto values = probe_method({.method = &yan_gaussians_method(), .material = &material, .options = options},
                                   "Footprint pixel = Footprint(a.xy, b.xy, b.zw);\n"
                                   "return vec4(ndf(effective(Footprints(pixel, pixel, pixel)), c.xyz));",
                                   inputs);
  std::vector<std::vector<double>> out(pixels.size());
  for (std::size_t i = 0; i < values.size(); ++i) out[i / directions.size()].push_back(values[i].x);
  return out;
}

// Smooth waves of both coordinates, leaning up to 30 degrees; the sizes need be no powers of two.
Image waves(int width, int height) {
  Image map(width, height, 4, 1.0F);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double u = 2.0 * pi * (x + 0.5) / width, v = 2.0 * pi * (y + 0.5) / height;
      const glm::dvec2 disc{0.3 * std::sin(3.0 * u + std::cos(2.0 * v)), 0.3 * std::cos(2.0 * u) * std::sin(3.0 * v)};
      const glm::vec3 n(glm::dvec3(disc, std::sqrt(1.0 - glm::dot(disc, disc))));
      std::copy_n(&n.x, 3, map.at(x, y).begin());
    }
  }
  return map;
}

// ---- the exact density: every element as one 4D Gaussian of (u, s), its position spread by the footprint ----

class BruteForce {
 public:
  BruteForce(Image map, const Pixel& pixel, double sigma_r, bool jacobians)
      : map_(std::move(map)), sigma_r_(sigma_r), jacobians_(jacobians) {
    const glm::dvec2 size(map_.width, map_.height);
    centre_ = (pixel.centre - glm::floor(pixel.centre)) * size;
    const glm::dvec2 dx = pixel.dx * size, dy = pixel.dy * size;
    spread_ = (glm::outerProduct(dx, dx) + glm::outerProduct(dy, dy)) / 12.0 + glm::dmat2(seed_variance);
    inverse_ = glm::inverse(spread_);
  }

  // Over copies of the map to either side as well.
  [[nodiscard]] double density(const glm::dvec3& h, int copies = 1) const {
    double sum = 0.0, weight = 0.0;
    for (int y = -copies * map_.height; y < (copies + 1) * map_.height; ++y) {
      for (int x = -copies * map_.width; x < (copies + 1) * map_.width; ++x) {
        const glm::dvec2 d = centre_ - (glm::dvec2(x, y) + 0.5);
        const double share = std::exp(-0.5 * glm::dot(d, inverse_ * d));
        weight += share;
        if (share > 1e-16) sum += element(x, y, d, h);
      }
    }
    return h.z * sum * 2.0 * pi * std::sqrt(glm::determinant(spread_)) / weight;
  }

 private:
  [[nodiscard]] glm::dvec2 disc(int x, int y) const {
    const auto wrapped = [](int i, int n) { return (i % n + n) % n; };
    const auto texel = map_.at(wrapped(x, map_.width), wrapped(y, map_.height));
    return {texel[0], texel[1]};
  }

  [[nodiscard]] double element(int x, int y, const glm::dvec2& d, const glm::dvec3& h) const {
    glm::dmat2 slopes(0.0);  // columns: by u and by v
    if (jacobians_) slopes = {0.5 * (disc(x + 1, y) - disc(x - 1, y)), 0.5 * (disc(x, y + 1) - disc(x, y - 1))};
    const glm::dmat2 crossed = seed_variance * slopes;
    const glm::dmat2 normals = glm::dmat2(sigma_r_ * sigma_r_) + crossed * glm::transpose(slopes);
    glm::dmat4 covariance(0.0);
    for (int i = 0; i < 2; ++i) {
      for (int j = 0; j < 2; ++j) {
        covariance[i][j] = spread_[i][j];
        covariance[i][2 + j] = crossed[i][j];
        covariance[2 + j][i] = crossed[i][j];
        covariance[2 + i][2 + j] = normals[i][j];
      }
    }
    const glm::dvec4 offset(d, glm::dvec2(h) - disc(x, y));
    const double q = glm::dot(offset, glm::inverse(covariance) * offset);
    return std::exp(-0.5 * q) / (4.0 * pi * pi * std::sqrt(glm::determinant(covariance)));
  }

  Image map_;
  double sigma_r_;
  bool jacobians_;
  glm::dvec2 centre_{0.0};
  glm::dmat2 spread_{1.0}, inverse_{1.0};
};

std::vector<glm::dvec3> directions() {
  std::vector<glm::dvec3> out;
  for (double y = -0.4; y <= 0.41; y += 0.1) {
    for (double x = -0.4; x <= 0.41; x += 0.1) out.emplace_back(x, y, std::sqrt(1.0 - x * x - y * y));
  }
  return out;
}

// Upright, sheared, over the border and a corner, under a texel at a centre and at a corner of texels.
std::vector<Pixel> some_pixels() {
  return {{{0.5, 0.5}, {0.1, 0.0}, {0.0, 0.08}},    {{0.3, 0.6}, {0.12, 0.05}, {-0.02, 0.06}},
          {{0.99, 0.4}, {0.1, 0.0}, {0.03, 0.1}},   {{1.0, 0.0}, {0.06, 0.0}, {0.0, 0.06}},
          {{-3.2, 7.7}, {0.05, 0.0}, {0.0, 0.05}},  {{0.25, 0.25}, {1e-4, 0.0}, {0.0, 1e-4}},
          {{0.254, 0.2575}, {0.0, 0.0}, {0.0, 0.0}}};
}

// The largest difference from the sum over all elements, as a share of its largest density.
double worst_difference(const Image& map, const std::vector<Pixel>& pixels, double sigma_r, const Words& options,
                        int copies = 1) {
  Words words = options;
  words["roughness"] = "intrinsic";
  words["sigma_r"] = std::to_string(sigma_r);
  const bool jacobians = !words.contains("jacobian") || words["jacobian"] == "central";
  const auto found = densities(material_of(map), words, pixels, directions());
  double worst = 0.0;
  for (std::size_t i = 0; i < pixels.size(); ++i) {
    const BruteForce exact(map, pixels[i], sigma_r, jacobians);
    double peak = 0.0, difference = 0.0;
    for (std::size_t j = 0; j < directions().size(); ++j) {
      const double expected = exact.density(directions()[j], copies);
      peak = std::max(peak, expected);
      if (!std::isfinite(expected) || !std::isfinite(found[i][j])) return std::nan("");
      difference = std::max(difference, std::abs(found[i][j] - expected));
    }
    worst = std::max(worst, difference / peak);
  }
  return worst;
}

TEST(YanGaussians, AreTheSumOverAllElements) {
  for (const double sigma_r : {0.02, 0.1}) {
    EXPECT_LT(worst_difference(waves(61, 37), some_pixels(), sigma_r, {{"cutoff", "6"}}), 2e-5) << sigma_r;
    EXPECT_LT(worst_difference(waves(61, 37), some_pixels(), sigma_r, {{"jacobian", "none"}, {"cutoff", "6"}}), 2e-5);
  }
  EXPECT_LT(worst_difference(random_normals(32, 16, 0.5F, 3), some_pixels(), 0.05, {{"cutoff", "6"}}), 2e-5);
}

// What the cut-off leaves out, as the README states it.
TEST(YanGaussians, LoseWhatTheCutoffSays) {
  const auto lost = [](const std::string& cutoff) {
    return worst_difference(waves(61, 37), some_pixels(), 0.02, {{"cutoff", cutoff}});
  };
  EXPECT_LT(lost("5"), 2e-5);
  EXPECT_LT(lost("4"), 1e-3);
  EXPECT_GT(lost("2"), 0.05);  // the hierarchy does leave elements out
}

// Footprints as wide as the map and wider, whose tails come round to it again and again.
TEST(YanGaussians, KeepFootprintsWiderThanTheMap) {
  const std::vector<Pixel> wide{{{0.5, 0.5}, {1.0, 0.0}, {0.0, 1.0}}, {{0.3, 0.1}, {0.5, 0.2}, {0.0, 0.9}}};
  EXPECT_LT(worst_difference(waves(61, 37), wide, 0.05, {}, 2), 0.01);
  const std::vector<Pixel> wider{{{0.5, 0.5}, {40.0, 0.0}, {0.0, 7.0}}};
  const auto over_all =
      densities(material_of(waves(61, 37)), {{"roughness", "intrinsic"}, {"sigma_r", "0.05"}}, wider, directions());
  const BruteForce even(waves(61, 37), {{0.5, 0.5}, {3.0, 0.0}, {0.0, 3.0}}, 0.05, true);  // even over the map by now
  for (std::size_t i = 0; i < directions().size(); ++i)
    EXPECT_NEAR(over_all[0][i], even.density(directions()[i], 4), 0.05 * even.density(directions()[i], 4) + 1e-3);
}

// A map without bumps has the Gaussian itself under any footprint, leaning or not.
TEST(YanGaussians, OfAFlatMapAreTheIntrinsicGaussian) {
  for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0.28F, 0, 0.96F)}) {
    const auto found = densities(material_of(constant_normals(16, 8, normal)),
                                 {{"roughness", "intrinsic"}, {"sigma_r", "0.1"}}, some_pixels(), directions());
    for (std::size_t i = 0; i < found.size(); ++i) {
      for (std::size_t j = 0; j < directions().size(); ++j) {
        const glm::dvec3 h = directions()[j];
        const glm::dvec2 d = glm::dvec2(h) - glm::dvec2(normal);
        const double expected = h.z * std::exp(-0.5 * glm::dot(d, d) / 0.01) / (2.0 * pi * 0.01);
        EXPECT_NEAR(found[i][j], expected, 2e-5 * 16.0) << "pixel " << i;
      }
    }
  }
}

// Over all normals an NDF is one: all of the footprint's mass.
TEST(YanGaussians, IntegrateToOne) {
  constexpr double step = 0.04;  // on the disc, where a sum over points of Gaussians of 0.05 is exact to 1e-13
  std::vector<glm::dvec3> grid;
  for (double y = -1.0; y < 1.0; y += step) {
    for (double x = -1.0; x < 1.0; x += step) {
      if (x * x + y * y < 0.98) grid.emplace_back(x, y, std::sqrt(1.0 - x * x - y * y));
    }
  }
  const auto found =
      densities(material_of(waves(61, 37)), {{"roughness", "intrinsic"}, {"sigma_r", "0.05"}}, some_pixels(), grid);
  for (std::size_t i = 0; i < found.size(); ++i) {
    double sum = 0.0;
    for (std::size_t j = 0; j < grid.size(); ++j) sum += found[i][j] / grid[j].z * step * step;
    EXPECT_NEAR(sum, 1.0, 1e-4) << "pixel " << i;
  }
}

// With the base lobe and no Jacobian: the lobes of the texels, weighed by the footprint's Gaussian.
TEST(YanGaussians, AreTheTexelsLobesWhereNormalsAreSteps) {
  const Image map = random_normals(24, 40, 0.5F, 9);
  using enum NormalDistribution;
  for (const Lobe& lobe : {Lobe{beckmann, 0.1}, {blinn_phong, 200}, {vmf, 300}, {ggx, 0.2}}) {
    const auto found = densities(material_of(map, lobe), {{"jacobian", "none"}}, some_pixels(), directions());
    for (std::size_t i = 0; i < found.size(); ++i) {
      const glm::dvec2 size(map.width, map.height);
      const Pixel pixel = some_pixels()[i];
      const glm::dvec2 dx = pixel.dx * size, dy = pixel.dy * size;
      const glm::dmat2 spread =
          glm::inverse((glm::outerProduct(dx, dx) + glm::outerProduct(dy, dy)) / 12.0 + glm::dmat2(seed_variance));
      std::vector<double> expected(directions().size(), 0.0);
      double weight = 0.0;
      for (int y = 0; y < map.height; ++y) {
        for (int x = 0; x < map.width; ++x) {
          glm::dvec2 d = pixel.centre * size - (glm::dvec2(x, y) + 0.5);
          d -= size * glm::round(d / size);
          const double share = std::exp(-0.5 * glm::dot(d, spread * d));
          weight += share;
          const auto texel = map.at(x, y);
          const glm::dvec3 n = glm::normalize(glm::dvec3(texel[0], texel[1], texel[2]));
          for (std::size_t j = 0; j < expected.size(); ++j)
            expected[j] += share * base_density(lobe.distribution, lobe.parameter, n, directions()[j]);
        }
      }
      for (std::size_t j = 0; j < expected.size(); ++j)
        EXPECT_NEAR(found[i][j], expected[j] / weight,
                    1e-4 * base_density(lobe.distribution, lobe.parameter, {0, 0, 1}, {0, 0, 1}))
            << lobe_text(lobe) << ", pixel " << i;
    }
  }
}

// A map that does not repeat goes on as its mirror image: near a border it sees no texel of the far side.
TEST(YanGaussians, SeeNothingOfTheFarSideOfAMapThatDoesNotRepeat) {
  Image halves = constant_normals(32, 32, {0.28F, 0, 0.96F});
  for (int y = 0; y < 32; ++y) {
    for (int x = 16; x < 32; ++x) halves.at(x, y)[0] = -0.28F;
  }
  const std::vector<Pixel> border{{{0.0, 0.5}, {0.1, 0.0}, {0.0, 0.1}}, {{-0.02, 0.5}, {0.02, 0.0}, {0.0, 0.02}}};
  const std::vector<glm::dvec3> near_and_far{{0.28, 0.0, 0.96}, {-0.28, 0.0, 0.96}};
  const Lobe lobe{NormalDistribution::beckmann, 0.05};
  const double peak = base_density(lobe.distribution, lobe.parameter, {0, 0, 1}, {0, 0, 1});
  for (const Wrap wrap : {Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    for (const auto& found : densities(material_of(halves, lobe, {wrap, wrap}), {}, border, near_and_far)) {
      EXPECT_NEAR(found[0], peak, 1e-3 * peak);
      EXPECT_NEAR(found[1], 0.0, 1e-6 * peak);
    }
  }
  const auto repeated = densities(material_of(halves, lobe), {}, border, near_and_far);
  EXPECT_GT(repeated[0][1], 0.1 * peak);
}

// The sum over all elements of a footprint by its texels' lobes, without Jacobians.
std::vector<double> texel_lobes(const Image& map, const Lobe& lobe, const Pixel& pixel,
                                const std::vector<glm::dvec3>& at) {
  const glm::dvec2 size(map.width, map.height);
  const glm::dvec2 dx = pixel.dx * size, dy = pixel.dy * size;
  const glm::dmat2 inverse =
      glm::inverse((glm::outerProduct(dx, dx) + glm::outerProduct(dy, dy)) / 12.0 + glm::dmat2(seed_variance));
  std::vector<double> sums(at.size(), 0.0);
  double weight = 0.0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      glm::dvec2 d = pixel.centre * size - (glm::dvec2(x, y) + 0.5);
      d -= size * glm::round(d / size);
      const double share = std::exp(-0.5 * glm::dot(d, inverse * d));
      weight += share;
      if (share < 1e-6) continue;
      const auto n = map.at(x, y);
      for (std::size_t j = 0; j < sums.size(); ++j)
        sums[j] += share * base_density(lobe.distribution, lobe.parameter, glm::dvec3(n[0], n[1], n[2]), at[j]);
    }
  }
  for (double& sum : sums) sum /= weight;
  return sums;
}

// README: more elements than the steps of a pixel are drawn, with an error that the width of the lobe decides.
TEST(YanGaussians, OfMoreElementsThanStepsAreEstimated) {
  const Image map = random_normals(512, 512, 0.5F, 3);
  const Pixel pixel{{0.4, 0.6}, {0.5, 0.06}, {-0.04, 0.44}};
  std::vector<glm::dvec3> some;
  for (std::size_t i = 0; i < directions().size(); i += 4) some.push_back(directions()[i]);
  using enum NormalDistribution;
  const std::array<std::pair<Lobe, double>, 4> cases{
      {{{ggx, 0.3}, 0.015}, {{ggx, 0.1}, 0.05}, {{beckmann, 0.1}, 0.05}, {{beckmann, 0.02}, 0.05}}};
  for (const auto& [lobe, error] : cases) {
    const std::vector<double> found = densities(material_of(map, lobe), {{"jacobian", "none"}}, {pixel}, some)[0];
    const double e = relative_l2(found, texel_lobes(map, lobe, pixel, some));
    EXPECT_LT(e, error) << lobe_text(lobe);
    EXPECT_GT(e, 1e-3) << lobe_text(lobe) << ": nothing was drawn";
  }
}

// Also the whole map, and more of it.
TEST(YanGaussians, EstimateFootprintsOfManyMaps) {
  const Image map = constant_normals(1024, 1024, {0.28F, 0, 0.96F});
  const Lobe lobe{NormalDistribution::ggx, 0.3};
  const double expected = base_density(lobe.distribution, lobe.parameter, {0, 0, 1}, {0, 0, 1});
  for (const double side : {1.0, 30.0}) {
    const std::vector<Pixel> wide{{{0.5, 0.5}, {side, 0.0}, {0.0, side}}};
    EXPECT_NEAR(densities(material_of(map, lobe), {}, wide, {{0.28, 0.0, 0.96}})[0][0], expected, 1e-3 * expected);
  }
}

// Bytes a texel of a repeating map whose size is a power of two: means 16, Jacobian 16, order 4, nodes 8.
TEST(YanGaussians, TakeTheBytesThatTheReadmeStates) {
  const Material material = material_of(waves(512, 512));
  const EffectSet effects = ProbedMethod::default_effects();
  const auto bytes = [&](const Words& words) {
    const Options options(yan_gaussians_method().info.options, words, "test");
    return static_cast<double>(byte_count(yan_gaussians_method().precompute(material, options, effects, no_progress))) /
           (512.0 * 512.0);
  };
  EXPECT_NEAR(bytes({}), 44.0, 0.01);
  EXPECT_NEAR(bytes({{"jacobian", "none"}}), 28.0, 0.01);
}

}  // namespace
}  // namespace footprint::testing
