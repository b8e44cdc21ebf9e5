// Facets with several lobes as the shaders have them: how axes turn, against the C++ twin, and what is shaded, against
// sums written out by hand.
#include "renderer/bake/facets.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <vector>

#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "tests/support/facet_axes.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using std::numbers::pi;
constexpr BaseBrdf plain_vmf{NormalDistribution::vmf, GeometryTerm::none, FresnelTerm::none, false};

// The block and the functions over it.
std::string multi_lobe_functions(const BaseBrdf& brdf) {
  ShaderVariant variant;
  variant.brdf = brdf;
  for (const Effect effect : {Effect::multi_lobe, Effect::masking_shadowing, Effect::fresnel})
    variant.effects.set(static_cast<std::size_t>(effect));
  const ShaderFlags flags = shader_flags(variant, Options({}, {}, "test"));
  return material_block(flags) + shared_functions(flags);
}

TEST(FacetLobes, GlslTurnsAsCppAndBack) {
  std::vector<std::array<glm::vec4, 3>> inputs;
  for (const glm::dvec3& n : sphere_normals()) {
    for (const glm::dvec3& axis : facet_axes()) inputs.push_back({glm::vec4(axis, 0), glm::vec4(n, 0), {}});
  }
  const std::string functions = multi_lobe_functions(plain_vmf);
  const auto there = evaluate_glsl(functions, "return vec4(turnedWithNormal(a.xyz, b.xyz), 0.0);", inputs);
  const auto back =
      evaluate_glsl(functions, "return vec4(inFacetFrame(turnedWithNormal(a.xyz, b.xyz), b.xyz), 0.0);", inputs);
  for (std::size_t i = 0; i < inputs.size(); ++i) {
    const glm::dvec3 axis(inputs[i][0]), n(inputs[i][1]);
    EXPECT_LT(glm::length(glm::dvec3(there[i]) - turned_with_normal(axis, n)), 1e-6) << n.x << " " << n.y << " " << n.z;
    EXPECT_LT(glm::length(glm::dvec3(back[i]) - axis), 1e-6) << n.x << " " << n.y << " " << n.z;
  }
}

const std::vector<FacetLobe> two_lobes{{.axis = {0.6F, 0.0F, 0.8F}, .parameter = 60.0F, .weight = 0.75F},
                                       {.axis = {0.0F, -0.6F, 0.8F}, .parameter = 20.0F, .weight = 0.5F}};

// A square of tilted facets under one light, and its specular radiance at a pixel, in doubles: equation 6 of Xu 2017
// about axes turned by a quaternion.
TEST(FacetLobes, AFrameIsTheSumOverTheLobes) {
  const glm::dvec3 normal = glm::normalize(glm::dvec3(0.3, -0.2, 0.9));
  Scene scene =
      square_scene(constant_normals(4, 4, glm::vec3(normal)), {.brdf = plain_vmf, .specular = glm::vec3(0.5F)});
  scene.materials[0].lobes = two_lobes;
  constexpr int size = 16;
  const Image picture = TestRenderer(scene, {size, size}).frame(base_surface());
  const glm::dvec3 about = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), normal));
  const glm::dvec3 light(0.4, 0.3, 1.5), camera(0, 0, 3);
  for (const glm::ivec2 pixel : {glm::ivec2(3, 4), glm::ivec2(9, 12), glm::ivec2(13, 2)}) {
    // The square is as large as the frame, and rows start at the top.
    const glm::dvec3 point(2.0 * (pixel.x + 0.5) / size - 1.0, 1.0 - 2.0 * (pixel.y + 0.5) / size, 0.0);
    const glm::dvec3 to_light = light - point;
    const glm::dvec3 h = glm::normalize(glm::normalize(to_light) + glm::normalize(camera - point));
    double expected = 0;
    for (const FacetLobe& lobe : two_lobes) {
      const glm::dvec3 axis = glm::angleAxis(std::acos(normal.z), about) * glm::dvec3(lobe.axis);
      const double kappa = lobe.parameter;
      expected += lobe.weight * kappa / (2 * pi * (1 - std::exp(-2 * kappa))) * std::exp(kappa * (dot(axis, h) - 1));
    }
    expected *= 0.5 * 4.0 / glm::dot(to_light, to_light);
    EXPECT_NEAR(picture.at(pixel.x, pixel.y)[0], expected, 1e-4 * expected + 1e-7) << pixel.x << " " << pixel.y;
  }
}

// One lobe about the normal, said in full, is what is drawn without: with every distribution and geometry term.
TEST(FacetLobes, OneLobeAboutTheNormalIsTheBaseLobe) {
  for (const BaseBrdf& brdf : {BaseBrdf{},
                               {NormalDistribution::beckmann, GeometryTerm::tan, FresnelTerm::schlick, true},
                               {NormalDistribution::blinn_phong, GeometryTerm::smith, FresnelTerm::none, true}}) {
    Scene scene = square_scene(random_normals(32, 32, 0.6F, 7), {.brdf = brdf, .roughness = 0.4F});
    const Image plain_picture = TestRenderer(scene).frame(base_surface());
    const auto parameter = static_cast<float>(lobe_of(scene.materials[0]).parameter);
    scene.materials[0].lobes = {{.axis = {0, 0, 1}, .parameter = parameter, .weight = 1.0F}};
    EXPECT_LT(largest_difference(TestRenderer(scene).frame(base_surface()), plain_picture), 1e-4);
  }
}

// A material without lobes beside one with: the effect is on for both.
TEST(FacetLobes, AMaterialWithoutLobesKeepsItsOwn) {
  Scene scene = square_scene(random_normals(8, 8, 0.4F, 7), {.brdf = plain_vmf, .specular = glm::vec3(0.5F)});
  const Image alone = TestRenderer(scene).frame(base_surface());
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].lobes = two_lobes;
  EXPECT_LT(largest_difference(TestRenderer(scene).frame(base_surface()), alone), 1e-6);
}

}  // namespace
}  // namespace footprint::testing
