// The GLSL of environment light against sums over directions, and against its C++ twins.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <numbers>

#include "renderer/environment/radiance_stack.hpp"
#include "renderer/pipeline/gpu_environment.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/slope_twin.hpp"

namespace footprint::testing {
namespace {

using std::numbers::pi;
using Inputs = std::vector<std::array<glm::vec4, 3>>;

ShaderFlags flags_of(NormalDistribution distribution, GeometryTerm geometry) {
  ShaderVariant variant;
  variant.brdf = {distribution, geometry, FresnelTerm::schlick, true};
  for (const Effect effect : {Effect::environment_light, Effect::fresnel, Effect::diffuse, Effect::masking_shadowing})
    variant.effects.set(static_cast<std::size_t>(effect));
  return shader_flags(variant, Options({}, {}, "test"));
}

// What surface_fragment.glsl takes in, behind a module that has one lobe about `normal` with the parameter `lobe`.
std::string light_functions_of(NormalDistribution distribution, GeometryTerm geometry = GeometryTerm::none) {
  const ShaderFlags flags = flags_of(distribution, geometry);
  constexpr std::string_view module =
      "layout(binding = 0) uniform sampler2DArray environment_stack;\n"
      "layout(binding = 1) uniform sampler2D environment_irradiance;\n"
      "layout(binding = 2) uniform sampler2DArray environment_lobes;\n"
      "struct Effective { Facets facets; };\n"
      "#include \"facet_normal_lobes.glsl\"\n"
      "vec3 meanNormal(Effective e) { return e.facets.normal; }\n"
      "#include \"environment_stack.glsl\"\n"
      "#include \"lobe_sampling.glsl\"\n";
  return shared_functions(flags, {"test.glsl", module});
}

glm::dvec3 about(const glm::dvec3& axis, double cosine, double azimuth) {
  const glm::dvec3 helper = std::abs(axis.x) < 0.5 ? glm::dvec3(1, 0, 0) : glm::dvec3(0, 1, 0);
  const glm::dvec3 s = glm::normalize(glm::cross(helper, axis));
  const double sine = std::sqrt(std::max(1.0 - cosine * cosine, 0.0));
  return cosine * axis + sine * (std::cos(azimuth) * s + std::sin(azimuth) * glm::cross(axis, s));
}

// The mean over a vMF lobe of f(direction), by rings of equal share.
double vmf_average(const glm::dvec3& axis, double kappa, const std::function<double(const glm::dvec3&)>& f) {
  constexpr int rings = 200;
  constexpr int sectors = 200;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double u = (i + 0.5) / rings;
    const double cosine = 1.0 + std::log(u + (1.0 - u) * std::exp(-2.0 * kappa)) / kappa;
    for (int j = 0; j < sectors; ++j) sum += f(about(axis, cosine, 2.0 * pi * (j + 0.5) / sectors));
  }
  return sum / (rings * sectors);
}

// A bright band in the upper half, darker below, and a lamp.
Environment banded_environment() {
  Image map(64, 32, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      map.at(x, y)[0] = y < 16 ? 1.0F : 0.3F;
      map.at(x, y)[1] = 0.5F + 0.4F * std::sin(0.3F * static_cast<float>(x));
      map.at(x, y)[2] = x == 40 && y == 10 ? 30.0F : 0.2F;
    }
  }
  return {.name = "band", .radiance = std::make_shared<const Image>(std::move(map)), .rotation = 0.4F};
}

// The maps of an environment where `light_functions_of` reads them.
GpuEnvironment bound(Environment environment) {
  shared_context().make_current();
  GpuEnvironment gpu(std::move(environment));
  gpu.prepare(EnvironmentUse::prefiltered);
  TextureUnits units({}, {});
  for (const std::string_view name : environment_textures(EnvironmentUse::prefiltered)) units.add(name, "sampler2D");
  gpu.bind(units, EnvironmentUse::prefiltered);
  return gpu;
}

const std::vector<glm::dvec3> axes{
    {0.1, 0.9, 0.2}, {-0.7, 0.1, 0.4}, {0.5, -0.6, -0.5}, {0.02, -0.9, 0.01}, {0.4, 0.3, -1}};

TEST(EnvironmentLight, OctahedralMapIsItsTwin) {
  Inputs inputs;
  for (const glm::dvec3& axis : axes) inputs.push_back({glm::vec4(glm::vec3(axis), 0), {}, {}});
  const auto uvs =
      evaluate_glsl(light_functions_of(NormalDistribution::vmf), "return vec4(octahedral(a.xyz), 0.0, 0.0);", inputs);
  for (std::size_t i = 0; i < axes.size(); ++i) {
    EXPECT_NEAR(uvs[i].x, octahedral_uv(axes[i]).x, 1e-6);
    EXPECT_NEAR(uvs[i].y, octahedral_uv(axes[i]).y, 1e-6);
  }
}

// Between maps and behind the last. Of the largest mean over such a lobe: 3% where the environment is smooth, 10% at a
// lamp (6% between maps, the rest between texels).
TEST(EnvironmentLight, StackHasMeansOverLobes) {
  const Environment environment = banded_environment();
  const std::string functions = light_functions_of(NormalDistribution::vmf);
  const GpuEnvironment gpu = bound(environment);
  for (const double kappa : {0.05, 0.5, 1.7, 6.0, 13.0, 40.0, 70.0}) {
    Inputs inputs;
    for (const glm::dvec3& axis : axes)
      inputs.push_back({glm::vec4(glm::vec3(glm::normalize(axis)), static_cast<float>(kappa)), {}, {}});
    const auto means = evaluate_glsl(functions, "return vec4(stackRadiance(a.xyz, a.w), 1.0);", inputs);
    for (int c = 0; c < 3; ++c) {
      std::vector<double> exact;
      exact.reserve(axes.size());
      for (const glm::dvec3& axis : axes) {
        exact.push_back(vmf_average(glm::normalize(axis), kappa,
                                    [&](const glm::dvec3& d) { return environment_radiance(environment, d)[c]; }));
      }
      const double largest = *std::ranges::max_element(exact);
      for (std::size_t i = 0; i < axes.size(); ++i)
        EXPECT_NEAR(means[i][c], exact[i], (c == 2 ? 0.1 : 0.03) * largest)
            << "kappa " << kappa << ", axis " << i << ", channel " << c;
    }
  }
}

TEST(EnvironmentLight, ShareAboveTheHorizonIsRightToTwoPercent) {
  Inputs inputs;
  std::vector<double> exact;
  for (const double kappa : {0.1, 1.0, 3.0, 10.0, 100.0, 2000.0}) {
    for (const double t : {-1.0, -0.5, -0.1, 0.0, 0.05, 0.3, 0.8, 1.0}) {
      inputs.push_back({glm::vec4(t, kappa, 0, 0), {}, {}});
      exact.push_back(vmf_average({std::sqrt(1.0 - t * t), 0.0, t}, kappa,
                                  [](const glm::dvec3& d) { return d.z > 0.0 ? 1.0 : 0.0; }));
    }
  }
  const auto shares =
      evaluate_glsl(light_functions_of(NormalDistribution::vmf), "return vec4(shareAbove(a.x, a.y));", inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i)
    EXPECT_NEAR(shares[i].x, exact[i], 0.022) << "t " << inputs[i][0].x << ", kappa " << inputs[i][0].y;
}

TEST(EnvironmentLight, VisibleLobesAreTheFacetsThatFaceTheViewer) {
  Inputs inputs;
  std::vector<double> area;
  std::vector<glm::dvec3> mean;
  for (const double kappa : {30.0, 400.0}) {
    for (const double degrees : {0.0, 40.0, 70.0, 85.0, 90.0, 93.0}) {
      const glm::dvec3 wo(std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180));
      inputs.push_back({glm::vec4(glm::vec3(wo), static_cast<float>(kappa)), {}, {}});
      const auto facing = [&](const glm::dvec3& h) { return std::max(glm::dot(h, wo), 0.0); };
      area.push_back(vmf_average({0, 0, 1}, kappa, facing));
      mean.push_back(glm::normalize(
          glm::dvec3(vmf_average({0, 0, 1}, kappa, [&](const glm::dvec3& h) { return h.x * facing(h); }), 0.0,
                     vmf_average({0, 0, 1}, kappa, [&](const glm::dvec3& h) { return h.z * facing(h); }))));
    }
  }
  const auto visible =
      evaluate_glsl(light_functions_of(NormalDistribution::vmf),
                    "VisibleLobe v = visibleLobe(NormalLobe(vec3(0, 0, 1), a.w, 1.0, 1.0, false, vec3(0, 0, 1)), "
                    "a.xyz);\nreturn vec4(v.axis, v.area);",
                    inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    EXPECT_NEAR(visible[i].w, area[i], 0.035 * area[i] + 2e-3) << i;
    EXPECT_LT(glm::length(glm::dvec3(glm::vec3(visible[i])) - mean[i]), 0.02) << i;
  }
}

TEST(EnvironmentLight, FresnelMeanIsThatOfTheHemisphere) {
  Inputs inputs;
  std::vector<double> exact;
  for (const double c : {0.0, 0.3, 0.6, 1.0}) {
    const glm::dvec3 wo(std::sqrt(1.0 - c * c), 0, c);
    double sum = 0;
    for (int i = 0; i < 400; ++i) {
      for (int j = 0; j < 400; ++j) {
        const glm::dvec3 wi = about({0, 0, 1}, std::sqrt((i + 0.5) / 400), 2.0 * pi * (j + 0.5) / 400);
        sum += std::pow(1.0 - glm::dot(wo, glm::normalize(wi + wo)), 5.0);
      }
    }
    inputs.push_back({glm::vec4(c, 0, 0, 0), {}, {}});
    exact.push_back(1.0 - sum / (400 * 400));
  }
  const auto means = evaluate_glsl(light_functions_of(NormalDistribution::vmf),
                                   "return vec4(meanTransmitted(vec3(0.0), a.x), 1.0);", inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) EXPECT_NEAR(means[i].x, exact[i], 5e-4);
}

// A lobe's parameter, and where its normals are drawn from.
struct DrawnCase {
  NormalDistribution distribution;
  float lobe;
};

// The mean cosine of the drawn normals is that of their density, and the density integrates to one.
TEST(EnvironmentLight, NormalsAreDrawnAsTheirDensitySays) {
  for (const DrawnCase& c : {DrawnCase{NormalDistribution::blinn_phong, 12.0F},
                             {NormalDistribution::vmf, 6.0F},
                             {NormalDistribution::beckmann, 0.4F},
                             {NormalDistribution::ggx, 0.3F}}) {
    const std::string functions = light_functions_of(c.distribution);
    const glm::vec4 normal(glm::vec3(glm::normalize(glm::dvec3(0.3, -0.4, 0.8))), c.lobe);
    Inputs drawn, listed;
    constexpr int steps = 64;
    for (int i = 0; i < steps * steps; ++i) {
      const glm::vec2 cell = (glm::vec2(glm::ivec2(i % steps, i / steps)) + 0.5F) / static_cast<float>(steps);
      drawn.push_back({normal, glm::vec4(cell, 0, 0), {}});
      const glm::dvec3 d = about({0, 0, 1}, 2.0 * cell.x - 1.0, 2.0 * pi * cell.y);
      listed.push_back({normal, glm::vec4(glm::vec3(d), 0), {}});
    }
    double mean = 0, expected = 0, energy = 0;
    for (const glm::vec4& r : evaluate_glsl(
             functions, "vec3 h = drawnNormal(a.w, a.xyz, b.xy);\nreturn vec4(dot(h, a.xyz), length(h), 0.0, 0.0);",
             drawn)) {
      mean += r.x / (steps * steps);
      EXPECT_NEAR(r.y, 1.0, 1e-5);
    }
    for (const glm::vec4& r : evaluate_glsl(
             functions, "float d = drawnDensity(a.w, a.xyz, b.xyz);\nreturn vec4(d, d * dot(a.xyz, b.xyz), 0, 0);",
             listed)) {
      energy += r.x * 4.0 * pi / (steps * steps);
      expected += r.y * 4.0 * pi / (steps * steps);
    }
    EXPECT_NEAR(energy, 1.0, 0.01) << static_cast<int>(c.distribution);
    EXPECT_NEAR(mean, expected / energy, 0.004) << static_cast<int>(c.distribution);
  }
}

// Specular radiance of facets about a leaning normal, by a sum over directions.
double brute_force(const DrawnCase& c, const Environment& environment, const glm::dvec3& n, const glm::dvec3& wo,
                   int channel) {
  double sum = 0;
  constexpr int rings = 150;
  constexpr int sectors = 300;
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < sectors; ++j) {
      const glm::dvec3 wi = about({0, 0, 1}, (i + 0.5) / rings, 2.0 * pi * (j + 0.5) / sectors);
      sum += base_density(c.distribution, c.lobe, n, glm::normalize(wi + wo)) *
             environment_radiance(environment, wi)[channel];
    }
  }
  return sum * 2.0 * pi / (rings * sectors);
}

// The whole approximation but for geometry and Fresnel terms: 8% of the exact radiance, plus 1% of what a lobe could
// reflect at most.
TEST(EnvironmentLight, LobesReflectWhatTheSumOverDirectionsSays) {
  const Environment environment = banded_environment();
  const GpuEnvironment gpu = bound(environment);
  for (const DrawnCase& c : {DrawnCase{NormalDistribution::blinn_phong, 60.0F},
                             {NormalDistribution::vmf, 25.0F},
                             {NormalDistribution::beckmann, 0.25F},
                             {NormalDistribution::ggx, 0.15F}}) {
    Inputs inputs;
    std::vector<std::array<double, 2>> expected;
    for (const double tilt : {0.0, 20.0}) {
      for (const double degrees : {0.0, 30.0, 60.0, -50.0}) {
        const glm::dvec3 n(0, std::sin(tilt * pi / 180), std::cos(tilt * pi / 180));
        const glm::dvec3 wo(std::sin(degrees * pi / 180), 0, std::cos(degrees * pi / 180));
        inputs.push_back({glm::vec4(glm::vec3(n), c.lobe), glm::vec4(glm::vec3(wo), 0), {}});
        expected.push_back({brute_force(c, environment, n, wo, 0), brute_force(c, environment, n, wo, 1)});
      }
    }
    const auto radiance = evaluate_glsl(
        light_functions_of(c.distribution),
        "return vec4(environmentSpecular(Effective(evenFacets(a.xyz, a.w)), vec3(1.0), b.xyz, mat3(1.0)), 1.0);",
        inputs);
    const double bound = 0.08;
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      for (int channel = 0; channel < 2; ++channel) {
        const double exact = expected[i][static_cast<std::size_t>(channel)];
        EXPECT_NEAR(radiance[i][channel], exact, bound * exact + 0.04)
            << "distribution " << static_cast<int>(c.distribution) << ", view " << i << ", channel " << channel;
      }
    }
  }
}

// G2 / (4 n.v) of GGX as in Heitz 2014: two Lambdas, where the shader has one fraction.
double ggx_smith(double alpha, double nl, double nv) {
  if (nl <= 0.0) return 0.0;
  nv = std::max(nv, 1e-4);
  const auto lambda = [&](double c) { return 0.5 * (std::sqrt(1.0 + alpha * alpha * (1.0 / (c * c) - 1.0)) - 1.0); };
  return 0.25 / ((1.0 + lambda(nv) + lambda(nl)) * nv);
}

// What GGX facets about a normal under Smith's masking reflect, by a sum over their normals: equal parts of D (n.h).
double ggx_reflects(double alpha, const glm::dvec3& n, const glm::dvec3& wo,
                    const std::function<double(const glm::dvec3&)>& light) {
  constexpr int rings = 300;
  constexpr int sectors = 100;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double u = (i + 0.5) / rings;
    const double cosine = 1.0 / std::sqrt(1.0 + alpha * alpha * u / (1.0 - u));
    for (int j = 0; j < sectors; ++j) {
      const glm::dvec3 h = about(n, cosine, 2.0 * pi * (j + 0.5) / sectors);
      const glm::dvec3 wi = 2.0 * glm::dot(h, wo) * h - wo;
      if (glm::dot(h, wo) <= 0.0 || wi.z <= 0.0) continue;
      sum += 4.0 * glm::dot(h, wo) / cosine * ggx_smith(alpha, glm::dot(n, wi), glm::dot(n, wo)) * light(wi);
    }
  }
  return sum / (rings * sectors);
}

// A GGX facet: alpha, its lean, the view, and the azimuth between the two; degrees.
struct Facet {
  double alpha, lean, view, azimuth;

  [[nodiscard]] glm::dvec3 normal() const { return direction(lean, 0.0); }
  [[nodiscard]] glm::dvec3 wo() const { return direction(view, azimuth); }

 private:
  static glm::dvec3 direction(double degrees, double around) {
    const double angle = degrees * pi / 180.0, turn = around * pi / 180.0;
    return {std::sin(angle) * std::cos(turn), std::sin(angle) * std::sin(turn), std::cos(angle)};
  }
};

std::vector<Facet> facets() {
  std::vector<Facet> all;
  for (const double alpha : {0.05, 0.1, 0.25, 0.5, 0.75, 1.0}) {
    for (const double azimuth : {0.0, 90.0}) {
      for (const double lean : {0.0, 25.0, -25.0, 50.0}) {
        if (azimuth > 0.0 && lean <= 0.0) continue;  // the same as others
        for (const double view : {0.0, 30.0, 60.0, 85.0}) all.push_back({alpha, lean, view, azimuth});
      }
    }
  }
  return all;
}

std::vector<glm::vec4> facet_radiance(const Environment& environment) {
  const GpuEnvironment gpu = bound(environment);
  Inputs inputs;
  for (const Facet& f : facets()) {
    inputs.push_back(
        {glm::vec4(glm::vec3(f.normal()), static_cast<float>(f.alpha)), glm::vec4(glm::vec3(f.wo()), 0), {}});
  }
  return evaluate_glsl(
      light_functions_of(NormalDistribution::ggx, GeometryTerm::smith),
      "return vec4(environmentSpecular(Effective(evenFacets(a.xyz, a.w)), vec3(1.0), b.xyz, mat3(1.0)), 1.0);", inputs);
}

// Rough facets lose much of a white furnace to masking and to the horizon, and those that turn away from the viewer
// shine by their tail alone: at most 7% of what arrives is off, 2% on average.
TEST(EnvironmentLight, GgxFacetsKeepTheEnergyOfAFurnace) {
  const auto radiance = facet_radiance(constant_environment(glm::vec3(1.0F)));
  double squares = 0;
  const std::vector<Facet> all = facets();
  for (std::size_t i = 0; i < all.size(); ++i) {
    const double expected =
        ggx_reflects(all[i].alpha, all[i].normal(), all[i].wo(), [](const glm::dvec3&) { return 1.0; });
    EXPECT_NEAR(radiance[i].x, expected, 0.07) << "alpha " << all[i].alpha << ", lean " << all[i].lean << ", view "
                                               << all[i].view << ", azimuth " << all[i].azimuth;
    squares += std::pow(radiance[i].x - expected, 2.0);
  }
  EXPECT_LT(std::sqrt(squares / static_cast<double>(all.size())), 0.02);
}

// Light that is below the horizon alone may not be reflected; at most 11% of it is. (A coarse map would
// blur across the horizon by itself.)
TEST(EnvironmentLight, LightFromBelowTheHorizonStaysOut) {
  Image map(512, 256, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) std::ranges::fill(map.at(x, y), y < map.height / 2 ? 0.0F : 1.0F);
  }
  const GpuEnvironment gpu =
      bound({.name = "ground", .radiance = std::make_shared<const Image>(std::move(map)), .rotation = 0.0F});
  for (const NormalDistribution distribution :
       {NormalDistribution::ggx, NormalDistribution::beckmann, NormalDistribution::blinn_phong}) {
    Inputs inputs;
    for (const Facet& f : facets()) {
      if (distribution == NormalDistribution::blinn_phong && f.alpha > 0.9) continue;
      inputs.push_back(
          {glm::vec4(glm::vec3(f.normal()), static_cast<float>(f.alpha)), glm::vec4(glm::vec3(f.wo()), 0), {}});
    }
    const auto radiance = evaluate_glsl(light_functions_of(distribution, GeometryTerm::smith),
                                        "mat3 up = mat3(vec3(1, 0, 0), vec3(0, 0, -1), vec3(0, 1, 0));\n"
                                        "Facets f = evenFacets(a.xyz, lobeFromAlpha(a.w));\n"
                                        "return vec4(environmentSpecular(Effective(f), vec3(1.0), b.xyz, up), 1.0);",
                                        inputs);
    for (std::size_t i = 0; i < inputs.size(); ++i) {
      EXPECT_LT(radiance[i].x, 0.11) << "distribution " << static_cast<int>(distribution) << ", alpha "
                                     << inputs[i][0].w << ", normal x " << inputs[i][0].x << ", view x "
                                     << inputs[i][1].x;
    }
  }
}

}  // namespace
}  // namespace footprint::testing
