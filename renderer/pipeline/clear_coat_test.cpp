// The clear coat against KHR_materials_clearcoat's formulas in double precision, which share no code with the shaders.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "renderer/pipeline/base_surface.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing::clear_coat {
namespace {

using glm::dvec3;
using std::numbers::pi;

TextureMap map_of(Image image) { return {"map", std::make_shared<const Image>(std::move(image)), {}}; }

ClearCoat coat_of(float weight, float roughness) {
  ClearCoat coat;
  coat.weight = weight;
  coat.roughness = roughness;
  return coat;
}

// f * cos of the layer alone: D G / (4 n.v) about its normal.
double layer(const dvec3& n, const dvec3& l, const dvec3& v, double alpha) {
  const dvec3 h = glm::normalize(l + v);
  const double nl = glm::dot(n, l), nv = glm::dot(n, v), nh = glm::dot(n, h);
  if (nl <= 0.0 || nh <= 0.0) return 0.0;
  const double a2 = alpha * alpha, t = nh * nh * (a2 - 1.0) + 1.0;
  const double g = 0.5 / (nl * std::sqrt(nv * nv * (1.0 - a2) + a2) + nv * std::sqrt(nl * nl * (1.0 - a2) + a2));
  return a2 / (pi * t * t) * g * nl;
}

// The extension's weight of the layer: Schlick's term of 0.04 about the coat's normal.
double layer_share(const dvec3& n, const dvec3& v, double weight) {
  return weight * (0.04 + 0.96 * std::pow(1.0 - std::abs(glm::dot(n, v)), 5.0));
}

// A square of Lambert's term alone under a coat: no specular term of its own.
Scene coated_square(const ClearCoat& coat) {
  Scene scene = square_scene({}, {.brdf = {.fresnel = FresnelTerm::none},
                                  .roughness = 1.0F,
                                  .base_color = glm::vec3(0.6F),
                                  .specular = glm::vec3(0.0F)});
  scene.materials[0].coat = coat;
  return scene;
}

// What leaves a point of it towards the camera, the coat's normal n.
double coated_radiance(const dvec3& n, double x, double y, double weight, double alpha) {
  const dvec3 point(x, y, 0.0), to_light = dvec3(0.4F, 0.3F, 1.5F) - point;
  const dvec3 l = glm::normalize(to_light), v = glm::normalize(dvec3(0.0, 0.0, 3.0) - point);
  const double share = layer_share(n, v, weight);
  const double base = 0.6F / pi * l.z;
  return ((1.0 - share) * base + share * layer(n, l, v, alpha)) * 4.0 / glm::dot(to_light, to_light);
}

constexpr int edge = 32;

// The centre of a pixel on the square.
glm::dvec2 centre(int px, int py) { return {(px + 0.5) / edge * 2.0 - 1.0, 1.0 - (py + 0.5) / edge * 2.0}; }

double largest_error(const Image& picture, const dvec3& n, double weight, double alpha) {
  double largest = 0;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      const glm::dvec2 at = centre(x, y);
      const double expected = coated_radiance(n, at.x, at.y, weight, alpha);
      largest = std::max(largest, std::abs(picture.at(x, y)[0] / expected - 1.0));
    }
  }
  return largest;
}

TEST(ClearCoat, IsTheExtensionsFormula) {
  for (const double roughness : {1.0, 0.5, 0.2}) {
    const Scene scene = coated_square(coat_of(0.8F, static_cast<float>(roughness)));
    const Image picture = TestRenderer(scene, {edge, edge}).frame(base_surface());
    EXPECT_LT(largest_error(picture, {0, 0, 1}, 0.8F, roughness * roughness), 2e-5) << roughness;
    EXPECT_GT(largest_error(picture, {0, 0, 1}, 0.7F, roughness * roughness), 1e-3) << "another weight differs";
  }
}

TEST(ClearCoat, HasANormalMapOfItsOwn) {
  const glm::vec3 tilted = glm::normalize(glm::vec3(0.2F, -0.1F, 1.0F));
  ClearCoat coat = coat_of(1.0F, 0.5F);
  coat.normal_map = map_of(constant_normals(2, 2, tilted));
  const Image picture = TestRenderer(coated_square(coat), {edge, edge}).frame(base_surface());
  EXPECT_LT(largest_error(picture, glm::normalize(dvec3(tilted)), 1.0, 0.25), 1e-4);
  EXPECT_GT(largest_error(picture, {0, 0, 1}, 1.0, 0.25), 0.01);
}

TEST(ClearCoat, HasMapsOfWeightAndRoughness) {
  ClearCoat coat = coat_of(1.0F, 1.0F);
  Image weights(2, 1, 1), widths(2, 1, 1);
  weights.texels = {0.25F, 0.75F};
  widths.texels = {0.3F, 0.6F};
  coat.weight_map = map_of(weights);
  coat.roughness_map = map_of(widths);
  const Image picture = TestRenderer(coated_square(coat), {edge, edge}).frame(base_surface());
  for (const int x : {edge / 4, 3 * edge / 4}) {  // where the bilinear filter sees one texel
    const std::size_t texel = x < edge / 2 ? 0 : 1;
    const double x_at = texel == 0 ? -0.5 : 0.5;  // a texel's centre is between pixels
    const Image& p = picture;
    const double measured = 0.5 * (p.at(x - 1, 5)[0] + p.at(x, 5)[0]);
    const double alpha = widths.texels[texel] * widths.texels[texel];
    EXPECT_NEAR(measured / coated_radiance({0, 0, 1}, x_at, centre(x, 5).y, weights.texels[texel], alpha), 1.0, 0.02);
  }
}

// A weight of 0, by factor or by map, leaves the picture as it is.
TEST(ClearCoat, OfNoWeightIsNotThere) {
  Scene bare = coated_square({});
  bare.materials[0].coat.reset();
  const Image picture = TestRenderer(bare, {edge, edge}).frame(base_surface());
  EXPECT_EQ(
      largest_difference(TestRenderer(coated_square(coat_of(0.0F, 0.0F)), {edge, edge}).frame(base_surface()), picture),
      0.0);
}

// Directions of Lambert's half of the sphere, evenly by solid angle: the midpoint rule.
double reflected_of_white(const dvec3& v, double alpha) {
  constexpr int rings = 1500, sectors = 800;
  double sum = 0;
  for (int i = 0; i < rings; ++i) {
    const double z = (i + 0.5) / rings, sine = std::sqrt(1.0 - z * z);
    for (int j = 0; j < sectors; ++j) {
      const double azimuth = 2.0 * pi * (j + 0.5) / sectors;
      sum += layer({0, 0, 1}, {sine * std::cos(azimuth), sine * std::sin(azimuth), z}, v, alpha);
    }
  }
  return 2.0 * pi * sum / (rings * sectors);
}

// Under light from all sides the coat reflects its share of the layer's energy, and the base the rest of its own: by
// the methods' lookup, and by the reference's drawn and listed directions.
TEST(ClearCoat, ReflectsAnEnvironment) {
  for (const double roughness : {0.9, 0.5}) {
    Scene scene = coated_square(coat_of(1.0F, static_cast<float>(roughness)));
    scene.lights.clear();
    scene.environment = constant_environment(glm::vec3(1.0F));
    TestRenderer renderer(scene, {edge, edge});
    const Image drawn = renderer.reference(64).mean;
    const Image listed = renderer.reference(16, 1, Sampling::after_shading, 0, EnvironmentUse::dense).mean;
    const Image looked_up = renderer.frame(base_surface(), {}, {}, 0, 1.0, EnvironmentUse::prefiltered);
    for (const int px : {2, edge / 2}) {
      const glm::dvec2 at = centre(px, edge / 2);
      const dvec3 v = glm::normalize(dvec3(0, 0, 3) - dvec3(at, 0.0));
      const double share = layer_share({0, 0, 1}, v, 1.0);
      const double expected = (1.0 - share) * 0.6F + share * reflected_of_white(v, roughness * roughness);
      EXPECT_NEAR(listed.at(px, edge / 2)[0], expected, 0.005 * expected) << roughness;
      EXPECT_NEAR(looked_up.at(px, edge / 2)[0], expected, 0.01 * expected) << roughness;
    }
    EXPECT_NEAR(covered_mean(drawn) / covered_mean(listed), 1.0, 0.003) << roughness;
  }
}

// A sky that is bright on one side, and a coat alone: the lookup is the reference's integral.
TEST(ClearCoat, IsLookedUpInAnEnvironmentAsTheReferenceIntegratesIt) {
  Image sky(32, 16, 3);
  for (int y = 0; y < sky.height; ++y) {
    for (int x = 0; x < sky.width; ++x) {
      for (std::size_t c = 0; c < 3; ++c) sky.at(x, y)[c] = y < 8 ? 1.0F + (x < 16 ? 2.0F : 0.0F) : 0.2F;
    }
  }
  for (const float roughness : {0.3F, 0.7F}) {
    ClearCoat coat = coat_of(1.0F, roughness);
    coat.normal_map = map_of(constant_normals(1, 1, glm::normalize(glm::vec3(0.3F, 0.2F, 1.0F))));
    Scene scene = coated_square(coat);
    scene.materials[0].base_color = {0, 0, 0, 1};
    scene.lights.clear();
    scene.environment = Environment{.name = "sky", .radiance = std::make_shared<const Image>(sky), .rotation = 0.0F};
    TestRenderer renderer(scene, {edge, edge});
    const double reference = covered_mean(renderer.reference(256).mean);
    EXPECT_GT(reference, 0.01);
    EXPECT_NEAR(covered_mean(renderer.frame(base_surface(), {}, {}, 0, 1.0, EnvironmentUse::prefiltered)) / reference,
                1.0, 0.03)
        << roughness;
  }
}

// Bumps of the coat that a pixel no longer shows widen its lobe: far closer to the reference than their mean normal
// only, which the bare narrow lobe represents.
TEST(ClearCoat, BumpsUnderAPixelWidenIt) {
  ClearCoat coat = coat_of(1.0F, 0.3F);
  coat.normal_map = map_of(random_normals(256, 256, 0.3F, 5));
  const Scene bumpy = coated_square(coat);
  coat.normal_map.reset();
  const Scene smooth = coated_square(coat);
  constexpr int few = 16;
  const Image reference = TestRenderer(bumpy, {few, few}).reference(1024).mean;
  const auto distance = [&](const Image& picture) {
    double sum = 0;
    for (std::size_t i = 0; i < reference.texels.size(); ++i)
      sum += std::pow(picture.texels[i] - reference.texels[i], 2);
    return std::sqrt(sum);
  };
  const double widened = distance(TestRenderer(bumpy, {few, few}).frame(base_surface()));
  const double narrow = distance(TestRenderer(smooth, {few, few}).frame(base_surface()));
  EXPECT_LT(widened, 0.2 * narrow);
}

// Seen along the surface, the normals that mirror a light from above lean towards the viewer: they reflect a twentieth,
// where the mean normal, which hardly faces him, would say a third.
TEST(ClearCoat, BumpsSeenAlongTheSurfaceReflectByTheirOwnFresnelTerm) {
  Scene scene = coated_square({});
  scene.materials[0].base_color = {0, 0, 0, 1};
  scene.camera = receding_grooves().camera;
  std::get<PointLight>(scene.lights.front()).position = {0.0F, 1.0F, 2.8F};
  EXPECT_GT(layer_share({0, 0, 1}, glm::normalize(dvec3(scene.camera.world[3])), 1.0), 6.0 * 0.04);
  const auto ratio_of = [&](float roughness) {
    scene.materials[0].coat = coat_of(1.0F, roughness);
    scene.materials[0].coat->normal_map = map_of(random_normals(256, 256, 0.7F, 5));
    TestRenderer renderer(scene, {16, 16});
    return covered_mean(renderer.frame(base_surface())) / covered_mean(renderer.reference(1024).mean);
  };
  EXPECT_NEAR(ratio_of(0.15F), 1.0, 0.25);
  // A rough coat loses the tails of normals that hardly face the viewer and reflect nearly all: base-brdf.md.
  EXPECT_NEAR(ratio_of(0.4F), 1.0 / 3.0, 0.05);
}

// Normals at the horizon that cancel, at mirrors and at lights from below: no NaN, nothing negative, and a wide coat.
TEST(ClearCoat, IsThereWhereItsNormalsCancel) {
  ClearCoat coat = coat_of(1.0F, 0.0F);
  Image opposite(2, 1, 4);
  opposite.texels = {1, 0, 0, 1, -1, 0, 0, 1};
  coat.normal_map = map_of(opposite);
  coat.normal_map->coordinates.transform = {64.0F, 0.0F, 0.0F, 64.0F, 0.0F, 0.0F};
  Scene scene = coated_square(coat);
  scene.materials[0].base_color = {0, 0, 0, 1};
  scene.horizon = Horizon::open;
  scene.lights.emplace_back(DirectionalLight{.direction = {0, 0, 1}, .illuminance = glm::vec3(1.0F)});
  scene.environment = constant_environment(glm::vec3(1.0F));
  TestRenderer renderer(scene, {8, 8});
  for (const Image& picture : {renderer.frame(base_surface()), renderer.reference(16).mean}) {
    for (const float value : picture.texels) ASSERT_TRUE(std::isfinite(value) && value >= 0.0F) << value;
  }
  EXPECT_GT(covered_mean(renderer.frame(base_surface())), 0.01);
}

}  // namespace
}  // namespace footprint::testing::clear_coat
