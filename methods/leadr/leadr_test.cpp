// LEADR through its own shader: Smith's term against the integral that defines it, the whole against its C++ twin and
// against sums over texels, bump and displaced, and the numerically hard maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& leadr_method();
}

namespace footprint::testing {
namespace {

using enum NormalDistribution;
using Words = std::map<std::string, std::string>;
using Inputs = std::vector<std::array<glm::vec4, 3>>;
using std::numbers::pi;

ProbedMethod leadr(const Material& material, const Words& options = {}) {
  return {.method = &leadr_method(), .material = &material, .options = options};
}

glm::dvec3 texel_normal(const Image& map, std::size_t i) {
  return glm::normalize(glm::dvec3(map.texels[4 * i], map.texels[4 * i + 1], map.texels[4 * i + 2]));
}

glm::dvec3 direction(double theta, double phi) {
  return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

std::vector<glm::dvec3> directions_to(double largest_theta) {
  std::vector<glm::dvec3> out;
  for (const double share : {0.0, 0.3, 0.6, 0.8, 1.0}) {
    for (int k = 0; k < 6; ++k) out.push_back(direction(share * largest_theta, 0.2 + k * pi / 3));
  }
  return out;
}

// 1 + Lambda is the area of all facets that face w over that of the mean surface: the integral of max(w.n, 0) / n_z
// over a Gaussian of slopes, by sums over a grid of +-7 deviations.
double masking_by_integration(const glm::dvec2& mean, const glm::dmat2& covariance, const glm::dvec3& w) {
  const double along = std::sqrt(covariance[0][0]);
  const double lean = covariance[0][1] / along;
  const double across = std::sqrt(covariance[1][1] - lean * lean);
  constexpr int steps = 400;
  double sum = 0;
  double weights = 0;
  for (int i = 0; i < steps; ++i) {
    for (int j = 0; j < steps; ++j) {
      const double x = ((i + 0.5) / steps - 0.5) * 14.0;
      const double y = ((j + 0.5) / steps - 0.5) * 14.0;
      const glm::dvec2 slope = mean + glm::dvec2(along * x, lean * x + across * y);
      const double weight = std::exp(-0.5 * (x * x + y * y));
      sum += weight * std::max(w.z - glm::dot(slope, glm::dvec2(w)), 0.0);
      weights += weight;
    }
  }
  const double mean_area = w.z - glm::dot(mean, glm::dvec2(w));
  return mean_area / (sum / weights);  // G1
}

TEST(Leadr, SmithTermMeetsItsIntegral) {
  for (const float spread : {0.1F, 0.4F, 1.0F}) {
    const Material material = lobe_material(gaussian_slope_normals(16, spread), beckmann, 0.2F, GeometryTerm::smith);
    const SlopeTwin twin = slope_twin_of(material);
    Inputs inputs;
    std::vector<double> expected;
    for (const glm::dvec3& w : directions_to(1.35)) {
      if (glm::dot(w, twin.axis()) < 0.05) continue;
      inputs.push_back({glm::vec4(glm::vec3(w), 0), {}, {}});
      expected.push_back(masking_by_integration(twin.mean, twin.spread + glm::dmat2(twin.variance()), w));
    }
    // The method keeps all slopes, as the twin has them.
    const auto out = probe_method(leadr(material, {{"roughness", "shading"}, {"steepest", "50"}}),
                                  "return vec4(lobeLambda(e.lobe, a.xyz));", inputs);
    for (std::size_t i = 0; i < out.size(); ++i)
      EXPECT_NEAR(1.0 / (1.0 + out[i].x), expected[i], 4e-3)
          << spread << " " << i;  // the rational function's own error
  }
}

// The formulas once more in doubles: slopes towards a direction by their mean, variance and cotangent.
struct Twin {
  SlopeTwin lobe;
  bool stretched = true;
  bool displaced = false;
  GeometryTerm geometry = GeometryTerm::smith;

  [[nodiscard]] double lambda_of(double inverse_a2) const {
    if (stretched && lobe.distribution == ggx) return 0.5 * (std::sqrt(1.0 + inverse_a2) - 1.0);
    const double a = 1.0 / std::max(std::sqrt(inverse_a2), 1e-6);
    return a < 1.6 ? (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a) : 0.0;
  }

  [[nodiscard]] double lambda(const glm::dvec3& w, bool with_base) const {
    const glm::dvec3 n = lobe.axis();
    const double sine = std::max(std::sqrt(1.0 - w.z * w.z), 1e-9);
    const glm::dvec2 azimuth = glm::dvec2(w) / sine;
    const double reach = w.z / sine - glm::dot(lobe.mean, azimuth);
    double variance = glm::dot(azimuth, lobe.spread * azimuth);
    const double c = glm::dot(n, w);
    const double tan2_about_mean = (1.0 - c * c) / (c * c);
    if (with_base) variance += lobe.variance() * (stretched ? tan2_about_mean * reach * reach : 1.0);
    return lambda_of(2.0 * variance / (reach * reach));
  }

  [[nodiscard]] glm::dvec3 texel(const glm::dvec3& h) const {
    const glm::dvec3 n = lobe.axis();
    glm::dmat2 base(lobe.variance());
    if (stretched) {  // W = v J J^T, J J^T = (1 + B^2) (1 + B B^T)
      base = lobe.variance() / (n.z * n.z) * (glm::dmat2(1.0) + glm::outerProduct(lobe.mean, lobe.mean));
    }
    const glm::dvec2 offset = -glm::dvec2(h) / h.z - lobe.mean;
    return glm::normalize(glm::dvec3(-lobe.mean - lobe.spread * (glm::inverse(lobe.spread + base) * offset), 1.0));
  }

  [[nodiscard]] double specular(const glm::dvec3& wi, const glm::dvec3& wo) const {
    const glm::dvec3 h = glm::normalize(wi + wo);
    const glm::dvec3 n = lobe.axis();
    const glm::dvec3 m = texel(h);
    const double density = stretched ? lobe.stretched(h) : lobe.gaussian(h);
    if (geometry == GeometryTerm::smith) {
      const double g2 = 1.0 / (1.0 + lambda(wi, true) + lambda(wo, true));
      return density * (displaced ? n.z / m.z : 1.0) * g2 / (4.0 * glm::dot(n, wo));
    }
    if (!displaced) return density;
    return density * (std::max(glm::dot(m, wo), 0.0) / m.z) / (glm::dot(n, wo) / n.z * (1.0 + lambda(wo, false)));
  }
};

TEST(Leadr, GlslMeetsItsTwin) {
  const std::vector<glm::dvec3> directions = directions_to(1.1);
  Inputs inputs;
  for (const glm::dvec3& wi : directions) {
    for (const glm::dvec3& wo : directions)
      inputs.push_back({glm::vec4(glm::vec3(wi), 0), glm::vec4(glm::vec3(wo), 0), {}});
  }
  for (const auto& [distribution, lobe] :
       {std::pair{beckmann, 0.3F}, std::pair{ggx, 0.25F}, std::pair{blinn_phong, 40.0F}}) {
    for (const GeometryTerm geometry : {GeometryTerm::smith, GeometryTerm::none}) {
      const Material material = lobe_material(gaussian_slope_normals(16, 0.3F), distribution, lobe, geometry);
      for (const bool stretched : {true, false}) {
        for (const bool displaced : {true, false}) {
          const Twin twin{slope_twin_of(material), stretched, displaced, geometry};
          const Words words{{"roughness", stretched ? "stretched" : "shading"},
                            {"weighting", displaced ? "displacement" : "bump"}};
          const auto out =
              probe_method(leadr(material, words),
                           "return vec4(shade(e, Surface(vec3(0.0), vec3(1.0)), a.xyz, b.xyz).specular, 0);", inputs);
          double largest = 0;
          for (const glm::vec4& v : out) largest = std::max(largest, static_cast<double>(v.x));
          for (std::size_t i = 0; i < out.size(); ++i) {
            const glm::dvec3 wi(inputs[i][0]);
            const glm::dvec3 wo(inputs[i][1]);
            ASSERT_NEAR(out[i].x, twin.specular(wi, wo), 1e-5 * largest)
                << lobe << " " << stretched << " " << displaced << " " << i;
          }
        }
      }
    }
  }
}

double energy(const std::vector<double>& density) {
  double sum = 0;
  for (const double d : density) sum += d;
  return sum * 2.0 * pi / static_cast<double>(density.size());
}

// Against the sum over texels: equal weights, and weights 1 / n_z relative to the mean surface's.
TEST(Leadr, KeepsTheEnergyOfTheSumOverTexels) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(150, 200);
  for (const auto& [distribution, lobe] :
       {std::pair{blinn_phong, 64.0F}, std::pair{beckmann, 0.2F}, std::pair{ggx, 0.1F}}) {
    const Image normals = gaussian_slope_normals(6, 0.3F);
    const Material material = lobe_material(normals, distribution, lobe, GeometryTerm::smith);
    const double mean_z = slope_twin_of(material).axis().z;
    std::vector<double> bump;
    std::vector<double> displaced;
    for (const glm::dvec3& h : directions) {
      bump.push_back(0);
      displaced.push_back(0);
      for (std::size_t i = 0; i < normals.texel_count(); ++i) {
        const glm::dvec3 n = texel_normal(normals, i);
        const double d = base_density(distribution, lobe, n, h) / static_cast<double>(normals.texel_count());
        bump.back() += d;
        displaced.back() += d * mean_z / n.z;
      }
    }
    EXPECT_NEAR(energy(probe_ndf(leadr(material), directions)) / energy(bump), 1.0, 0.01) << lobe;
    if (distribution == ggx) continue;  // its tails, stretched, reach slopes that no texel has: README, limits
    EXPECT_NEAR(energy(probe_ndf(leadr(material, {{"weighting", "displacement"}}), directions)) / energy(displaced),
                1.0, 0.01)
        << lobe;
  }
}

// Many texels of Gaussian slopes, each with its own lobe, weighed by the area that the viewer sees of it: what that
// changes against equal weights.
TEST(Leadr, DisplacementWeighsTexelsByTheirVisibleArea) {
  const Image normals = gaussian_slope_normals(128, 0.3F);
  const float exponent = 100.0F;
  const Material material = lobe_material(normals, blinn_phong, exponent, GeometryTerm::none);
  Inputs inputs;
  std::vector<double> expected;
  for (const glm::dvec3& wo : {direction(0.0, 0.0), direction(0.7, 1.0), direction(1.1, 4.0)}) {
    for (const glm::dvec3& wi : {direction(0.2, 3.0), direction(0.8, 1.0), direction(0.5, 0.5)}) {
      const glm::dvec3 h = glm::normalize(wi + wo);
      double weighed = 0;
      double plain = 0;
      double visible = 0;
      for (std::size_t i = 0; i < normals.texel_count(); ++i) {
        const glm::dvec3 n = texel_normal(normals, i);
        const double weight = std::max(glm::dot(n, wo), 0.0) / n.z;
        const double density = base_density(blinn_phong, exponent, n, h);
        weighed += weight * density;
        plain += density;
        visible += weight;
      }
      inputs.push_back({glm::vec4(glm::vec3(wi), 0), glm::vec4(glm::vec3(wo), 0), {}});
      expected.push_back(weighed / visible / (plain / static_cast<double>(normals.texel_count())));
    }
  }
  const std::string body = "return vec4(shade(e, Surface(vec3(0.0), vec3(1.0)), a.xyz, b.xyz).specular, 0);";
  const auto bump = probe_method(leadr(material), body, inputs);
  const auto displaced = probe_method(leadr(material, {{"weighting", "displacement"}}), body, inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    EXPECT_NEAR(displaced[i].x / bump[i].x / expected[i], 1.0, 0.03) << i << ": " << expected[i];
}

// A displaced surface reflects no more than it gets, for any slopes, with F = 1.
TEST(Leadr, MaskedSurfacesReflectNoMoreThanTheyGet) {
  const std::vector<glm::dvec3> lights = hemisphere_grid(100, 100);
  for (const float spread : {0.05F, 0.3F, 0.8F}) {
    const Material material = lobe_material(gaussian_slope_normals(16, spread), beckmann, 0.3F, GeometryTerm::smith);
    for (const double theta : {0.0, 0.7, 1.2, 1.5}) {
      Inputs inputs;
      for (const glm::dvec3& wi : lights)
        inputs.push_back({glm::vec4(glm::vec3(wi), 0), glm::vec4(glm::vec3(direction(theta, 2.0)), 0), {}});
      double sum = 0;
      for (const glm::vec4& v :
           probe_method(leadr(material, {{"weighting", "displacement"}}),
                        "return vec4(shade(e, Surface(vec3(0.0), vec3(1.0)), a.xyz, b.xyz).specular, 0);", inputs))
        sum += v.x;
      const double reflected = sum * 2.0 * pi / static_cast<double>(lights.size());
      EXPECT_LT(reflected, 1.01) << spread << " " << theta;
      EXPECT_GT(reflected, 0.3) << spread << " " << theta;
    }
  }
}

// Facets that face away from the light reflect none of it: the mean of max(n.l, 0), not the maximum of a mean.
TEST(Leadr, DiffuseMeetsTheSumOverTexels) {
  const Image normals = gaussian_slope_normals(64, 0.4F);
  const Material material = lobe_material(normals, beckmann, 0.3F, GeometryTerm::none);
  Inputs inputs;
  std::vector<double> bump;
  std::vector<double> displaced;
  const glm::dvec3 wo = direction(0.6, 2.0);
  for (const glm::dvec3& wi : directions_to(1.4)) {
    inputs.push_back({glm::vec4(glm::vec3(wi), 0), glm::vec4(glm::vec3(wo), 0), {}});
    double lit = 0;
    double seen_and_lit = 0;
    double seen = 0;
    for (std::size_t i = 0; i < normals.texel_count(); ++i) {
      const glm::dvec3 n = texel_normal(normals, i);
      const double visible = std::max(glm::dot(n, wo), 0.0) / n.z;
      lit += std::max(glm::dot(n, wi), 0.0);
      seen_and_lit += visible * std::max(glm::dot(n, wi), 0.0);
      seen += visible;
    }
    bump.push_back(lit / static_cast<double>(normals.texel_count()) / pi);
    displaced.push_back(seen_and_lit / seen / pi);
  }
  const std::string body = "return vec4(shade(e, Surface(vec3(1.0), vec3(0.0)), a.xyz, b.xyz).diffuse, 0);";
  const auto out = probe_method(leadr(material), body, inputs);
  const auto out_displaced = probe_method(leadr(material, {{"weighting", "displacement"}}), body, inputs);
  for (std::size_t i = 0; i < out.size(); ++i) {
    EXPECT_NEAR(out[i].x, bump[i], 0.015 / pi) << i;
    EXPECT_NEAR(out_displaced[i].x, displaced[i], 0.015 / pi) << i;
  }
}

// Grooves that run away from the viewer: probes along the long side of a pixel's footprint leave the short side sharp.
TEST(Leadr, ProbesSharpenAnObliqueView) {
  TestRenderer renderer(receding_grooves());
  const Image reference = renderer.reference(256).mean;
  const auto error = [&](const char* filter) {
    return compare_images(renderer.frame(leadr_method(), {}, parse_footprint_filter(filter, "")), reference, 1.0F)
        .value()
        .relative_rmse;
  };
  EXPECT_LT(error("anisotropic:8"), 0.6 * error("trilinear"));
}

// Hard cases 13, 17, 18 and 28: flat tilted mirrors, grazing and opposite directions, normals at the horizon.
TEST(Leadr, StaysFiniteAtTheLimits) {
  Image horizon = random_normals(4, 4, 0.9F, 6);
  const glm::vec3 sideways(1, 0, 0);
  std::copy_n(&sideways.x, 3, horizon.at(2, 1).begin());
  std::vector<glm::dvec3> directions = directions_to(1.5707);
  directions.push_back(-directions[20]);
  Inputs inputs;
  for (const glm::dvec3& wi : directions) {
    for (const glm::dvec3& wo : directions)
      inputs.push_back({glm::vec4(glm::vec3(wi), 0), glm::vec4(glm::vec3(wo), 0), {}});
  }
  for (const Image& map :
       {horizon, constant_normals(4, 4, sideways), constant_normals(4, 4, glm::normalize(glm::vec3(3, 0, 1)))}) {
    for (const auto& [distribution, lobe] :
         {std::pair{ggx, 1e-3F}, std::pair{blinn_phong, 1e5F}, std::pair{beckmann, 1.0F}}) {
      for (const GeometryTerm geometry : {GeometryTerm::smith, GeometryTerm::tan}) {
        const Material material = lobe_material(map, distribution, lobe, geometry);
        for (const Words& words : {Words{}, Words{{"weighting", "displacement"}, {"storage", "fp16"}},
                                   Words{{"roughness", "moments"}, {"weighting", "displacement"}}}) {
          const auto out = probe_method(
              leadr(material, words),
              "return vec4(shade(e, Surface(vec3(0.0), vec3(1.0)), a.xyz, b.xyz).specular.x, ndf(e, a.xyz), "
              "shade(e, Surface(vec3(1.0), vec3(0.0)), a.xyz, b.xyz).diffuse.x, 0);",
              inputs);
          for (const glm::vec4& v : out) {
            for (int c = 0; c < 3; ++c) ASSERT_TRUE(std::isfinite(v[c]) && v[c] >= 0.0F) << lobe << " channel " << c;
          }
        }
      }
    }
  }
}

// Two sides of a groove are no Gaussian of slopes; what that costs is said, with the figures of the README.
TEST(Leadr, SaysWhereItsDiffuseTermIsOff) {
  const auto note_of = [](double degrees, bool diffuse) {
    const double angle = degrees * pi / 180.0;
    Image map(8, 8, 4, 1.0F);
    for (std::size_t i = 0; i < map.texel_count(); ++i) {
      map.texels[4 * i] = static_cast<float>(i % 2 == 0 ? std::sin(angle) : -std::sin(angle));
      map.texels[4 * i + 1] = 0.0F;
      map.texels[4 * i + 2] = static_cast<float>(std::cos(angle));
    }
    EffectSet effects;
    effects.set(static_cast<std::size_t>(Effect::normal_variation));
    effects.set(static_cast<std::size_t>(Effect::diffuse), diffuse);
    const Options options(leadr_method().info.options, {}, "test");
    std::string notes;
    for (const std::string& note :
         leadr_method()
             .precompute(lobe_material(map, ggx, 0.3F, GeometryTerm::smith), options, effects, no_progress)
             .notes)
      notes += note;
    return notes;
  };
  EXPECT_NE(note_of(80.0, true).find("0.73 of a level surface instead of 0.17 (+320%)"), std::string::npos)
      << note_of(80.0, true);
  EXPECT_NE(note_of(45.0, true).find("0.83 of a level surface instead of 0.71 (+18%)"), std::string::npos)
      << note_of(45.0, true);
  EXPECT_EQ(note_of(20.0, true), "");
  EXPECT_EQ(note_of(45.0, false), "") << "without a diffuse term";
}

}  // namespace
}  // namespace footprint::testing
