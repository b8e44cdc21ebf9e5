// Patches under an environment: against sums over facets and directions, and against the reference.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <tuple>

#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/iwasaki_sg/study/effective_brdf.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/scene/environment.hpp"
#include "tests/methods/iwasaki_materials.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"

namespace footprint::testing {
namespace {

using namespace iwasaki_sg;
using std::numbers::pi;

// Bright above the surface and, in another colour, on one side.
Environment uneven_environment() {
  Image map(32, 16, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 d = environment_direction({.name = "", .radiance = nullptr}, (x + 0.5) / 32.0, (y + 0.5) / 16.0);
      map.at(x, y)[0] = static_cast<float>(0.2 + std::exp(4.0 * (d.z - 1.0)));
      map.at(x, y)[1] = 0.3F;
      map.at(x, y)[2] = static_cast<float>(0.1 + 2.0 * std::exp(4.0 * (0.8 * d.x + 0.6 * d.z - 1.0)));
    }
  }
  return {.name = "uneven", .radiance = std::make_shared<const Image>(std::move(map))};
}

// A patch with a tabulated BRDF, seen from a direction by parallel rays, all its light from around.
Scene patch_scene(const Patch& patch, const TabulatedBrdf& brdf, const glm::dvec3& wo, Environment environment) {
  Scene scene = square_scene({}, {});
  scene.materials[0] = patch_material(patch, {}, 0.3F);
  Microgeometry geometry = *scene.materials[0].microgeometry;
  geometry.brdf = std::make_shared<const TabulatedBrdf>(brdf);
  scene.materials[0].microgeometry = std::make_shared<const Microgeometry>(std::move(geometry));
  scene.lights.clear();
  scene.environment = std::move(environment);
  scene.camera.world = look_at(3.0 * wo, glm::dvec3(0.0), {0.0, 1.0, 0.0});
  scene.camera.orthographic = true;
  scene.camera.ymag = 0.2F;
  return scene;
}

// Radiance by the sum over facets and `side` x `side` directions (Eq. 1), which shares no code with the shaders: under
// the uneven environment, and under one of 1 from all sides.
struct FacetRadiance {
  glm::dvec3 uneven{0.0}, white{0.0};
};

FacetRadiance sum_of_facets(const Material& material, const glm::dvec3& wo, int side = 32) {
  const Environment environment = uneven_environment();
  const TableSettings settings = table_settings(material, Options(option_table(), {}, "test"), patch_effects(material));
  const Patch& patch = material.microgeometry->patch;
  std::vector<glm::dvec3> directions = direction_grid(side);
  const std::size_t cells = directions.size();
  directions.push_back(wo);
  const FacetSum sum(material, settings, bin_facets(patch, sample_facets(patch, 8192, 9)), std::move(directions),
                     no_progress);
  FacetRadiance radiance;
  const double cell = 2.0 * pi / static_cast<double>(cells);
  for (std::size_t i = 0; i < cells; ++i) {
    const glm::dvec3 reflected = cell * sum(i, cells);
    radiance.uneven += reflected * glm::dvec3(environment_radiance(environment, sum.directions()[i]));
    radiance.white += reflected;
  }
  return radiance;
}

glm::dvec3 mean_of(const Image& picture) {
  glm::dvec3 sum(0.0);
  for (std::size_t i = 0; i < picture.texels.size(); i += 4) {
    for (int c = 0; c < 3; ++c) sum[c] += picture.texels[i + static_cast<std::size_t>(c)];
  }
  return sum / static_cast<double>(picture.texel_count());
}

glm::dvec3 drawn(const Scene& scene) {
  return mean_of(TestRenderer(scene, {4, 4}).frame(iwasaki_sg_method(), "iwasaki_sg:facets=8192"));
}

void expect_near(const glm::dvec3& found, const glm::dvec3& expected, double bound) {
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(found[c] / expected[c], 1.0, bound) << "channel " << c;
}

const glm::dvec3 above(0.0, 0.0, 1.0), oblique = glm::normalize(glm::dvec3(0.7, 0.2, 0.8));

// Facets that reflect diffusely and, by their table, in colours of their own.
TEST(IwasakiUnderAnEnvironment, DiffuseTermIsThatOfTheFacets) {
  const TabulatedBrdf matte = ward_brdf({0.5F, 0.4F, 0.2F}, glm::vec3(0.0F), 0.3);
  for (const char* kind : {"flat", "grooves"}) {
    for (const glm::dvec3& wo : {above, oblique}) {
      const Scene white = patch_scene(patch_of(kind), matte, wo, constant_environment(glm::vec3(1.0F)));
      const FacetRadiance expected = sum_of_facets(white.materials[0], wo);
      expect_near(drawn(white), expected.white, 0.005);
      expect_near(drawn(patch_scene(patch_of(kind), matte, wo, uneven_environment())), expected.uneven, 0.05);
    }
  }
}

// The lobes of a tabulated BRDF, in colour. On grooves each meets three planes; a weave's normals are too many for
// seven lobes.
TEST(IwasakiUnderAnEnvironment, TabulatedBrdfIsNearTheSumOverFacets) {
  const TabulatedBrdf rough = ward_brdf({0.3F, 0.2F, 0.1F}, {0.1F, 0.3F, 0.4F}, 0.3);
  const TabulatedBrdf glossy = ward_brdf({0.05F, 0.05F, 0.1F}, {0.5F, 0.4F, 0.2F}, 0.1);
  // Narrow ones lose most where their mean height is taken wrongly.
  const TabulatedBrdf sharp = ward_brdf(glm::vec3(0.0F), {0.5F, 0.4F, 0.2F}, 0.05);
  const std::vector<std::tuple<const char*, const TabulatedBrdf*, double>> rows{
      {"flat", &sharp, 0.07}, {"grooves", &rough, 0.14}, {"weave", &glossy, 0.11},  {"grooves", &sharp, 0.07},
      {"flat", &rough, 0.05}, {"flat", &glossy, 0.04},   {"grooves", &glossy, 0.07}};
  for (const auto& [kind, brdf, bound] : sweep(rows, 3)) {
    const int side = brdf == &sharp ? 96 : 32;  // cells of half of the lobe's width
    for (const glm::dvec3& wo : {above, oblique}) {
      SCOPED_TRACE(fmt::format("{} {} {}", kind, brdf == &rough ? "rough" : brdf == &sharp ? "sharp" : "glossy", wo.z));
      const Scene uneven = patch_scene(patch_of(kind), *brdf, wo, uneven_environment());
      const FacetRadiance expected = sum_of_facets(uneven.materials[0], wo, side);
      expect_near(drawn(uneven), expected.uneven, bound);
      const Scene white = patch_scene(patch_of(kind), *brdf, wo, constant_environment(glm::vec3(1.0F)));
      expect_near(drawn(white), expected.white, bound);
    }
  }
}

// The reference's facets and directions, drawn at random.
TEST(IwasakiUnderAnEnvironment, ReferenceIsTheSumOverFacets) {
  const TabulatedBrdf rough = ward_brdf({0.3F, 0.2F, 0.1F}, {0.1F, 0.3F, 0.4F}, 0.3);
  for (const char* kind : {"grooves", "weave"}) {
    const Scene uneven = patch_scene(patch_of(kind), rough, oblique, uneven_environment());
    expect_near(mean_of(TestRenderer(uneven, {8, 8}).reference(256).mean),
                sum_of_facets(uneven.materials[0], oblique).uneven, 0.02);
  }
}

// Threads of two colours over a base BRDF: the specular term's colour is that of the visible threads, not their mean.
TEST(IwasakiUnderAnEnvironment, AmplitudesKeepTheirColours) {
  const Patch weave = patch_of("weave", {{"warp_width", "0.9"}, {"weft_width", "0.3"}, {"warp_blue", "0"}});
  constexpr BaseBrdf metal{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  Scene scene = square_scene({}, {});
  scene.materials[0] = patch_material(weave, metal, 40.0F);
  scene.materials[0].metallic = 1.0F;
  scene.materials[0].base_color *= glm::vec4(scene.materials[0].microgeometry->mean_color, 1.0F);
  scene.lights.clear();
  scene.environment = constant_environment(glm::vec3(1.0F));
  const glm::dvec3 found = drawn(scene);
  expect_near(found, mean_of(TestRenderer(scene, {8, 8}).reference(256).mean), 0.1);
  EXPECT_LT(found.b, 0.5 * found.r);
}

// A matte patch without a table, under an environment that its diffuse term has as Gaussians.
Scene matte_scene(const char* kind, const glm::dvec3& wo, Environment environment) {
  constexpr BaseBrdf matte{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  Scene scene =
      patch_scene(patch_of(kind), ward_brdf(glm::vec3(0.0F), glm::vec3(0.0F), 0.3), wo, std::move(environment));
  scene.materials[0] = patch_material(patch_of(kind), matte, 40.0F);
  scene.materials[0].dielectric_specular = glm::vec3(0.0F);
  return scene;
}

glm::dvec3 drawn_with_gaussians(const Scene& scene) {
  return mean_of(
      TestRenderer(scene, {4, 4}).frame(iwasaki_sg_method(), "iwasaki_sg:facets=8192:environment=gaussians"));
}

TEST(IwasakiUnderAnEnvironment, AGaussianOfLightIsALightFromItsAxis) {
  const glm::dvec3 from = glm::normalize(glm::dvec3(0.5, 0.3, 1.0));
  constexpr double sharpness = 100.0;
  Image map(256, 128, 3);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 d =
          environment_direction({.name = "", .radiance = nullptr}, (x + 0.5) / 256.0, (y + 0.5) / 128.0);
      for (float& channel : map.at(x, y))
        channel = static_cast<float>(10.0 * std::exp(sharpness * (glm::dot(d, from) - 1.0)));
    }
  }
  const Environment light{.name = "one", .radiance = std::make_shared<const Image>(std::move(map))};
  for (const char* kind : {"flat", "grooves"}) {
    const Scene scene = matte_scene(kind, oblique, light);
    Scene directional = scene;
    directional.environment.reset();
    directional.lights = {DirectionalLight{.direction = -glm::vec3(from),
                                           .illuminance = glm::vec3(static_cast<float>(10.0 * 2.0 * pi / sharpness))}};
    expect_near(drawn_with_gaussians(scene), drawn(directional), 0.02);
  }
}

// A wide Gaussian counts with the cosine of its axis, so light from all sides is 12% too dark.
TEST(IwasakiUnderAnEnvironment, NineGaussiansAreNearTheReference) {
  for (const auto& [kind, wo] : {std::pair("flat", above), std::pair("grooves", oblique)}) {
    const Scene scene = matte_scene(kind, wo, uneven_environment());
    const glm::dvec3 truth = mean_of(TestRenderer(scene, {8, 8}).reference(256).mean);
    expect_near(drawn_with_gaussians(scene), truth, 0.13);
    expect_near(drawn(scene), truth, 0.05);
  }
}

// What other parts of a scene call for compiles their terms in: here the diffuse term of a table.
TEST(IwasakiUnderAnEnvironment, ATableElsewhereInTheSceneChangesNothing) {
  constexpr BaseBrdf shine{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, false};
  Scene scene = square_scene({}, {});
  scene.materials[0] = patch_material(patch_of("grooves"), shine, 40.0F);
  scene.lights.clear();
  scene.environment = uneven_environment();
  EffectSet effects = effects_on(derive_effects(scene));
  const glm::dvec3 alone = drawn(scene);
  effects.set(static_cast<std::size_t>(Effect::tabulated_brdf));
  expect_near(mean_of(TestRenderer(scene, {4, 4}, effects).frame(iwasaki_sg_method(), "iwasaki_sg:facets=8192")), alone,
              1e-6);
}

}  // namespace
}  // namespace footprint::testing
