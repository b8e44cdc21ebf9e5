// Shadows of point, spot and directional lights: where geometry puts their edges, as rays say, and nowhere else.
#include "renderer/pipeline/shadow_maps.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/scene/camera.hpp"
#include "renderer/visibility/cast_shadows.hpp"
#include "renderer/visibility/occluders.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"

namespace footprint::testing {
namespace {

EffectSet without_shadows(const Scene& scene) {
  return effects_on(derive_effects(scene)).reset(static_cast<std::size_t>(Effect::cast_shadow));
}

// What a picture shows of the way to the scene's one light: the share that is clear, -1 where nothing says.
std::vector<float> clear_shares(const Scene& scene, int edge) {
  const Image with = TestRenderer(scene, {edge, edge}).frame(base_surface());
  const Image without = TestRenderer(scene, {edge, edge}, without_shadows(scene)).frame(base_surface());
  std::vector<float> shares;
  for (std::size_t i = 0; i < with.texels.size(); i += 4) {
    shares.push_back(without.texels[i] > 1e-6F ? with.texels[i] / without.texels[i] : -1.0F);
  }
  return shares;
}

// The ray through a point of the picture; (0, 0) is its top left corner, in pixels.
struct EyeRay {
  glm::vec3 origin, direction;
};

EyeRay eye_ray(const Camera& camera, int edge, float x, float y) {
  const float half = std::tan(0.5F * camera.yfov);
  const glm::vec4 local((2.0F * x / static_cast<float>(edge) - 1.0F) * half,
                        (1.0F - 2.0F * y / static_cast<float>(edge)) * half, -1.0F, 0.0F);
  return {glm::vec3(camera.world[3]), glm::normalize(glm::vec3(camera.world * local))};
}

// Whether rays find the way clear from what is seen at a point of the picture; none where nothing is seen or the
// surface there does not face the light.
std::optional<bool> truly_clear(const Occluders& occluders, const Scene& scene, const EyeRay& eye) {
  const auto hit = occluders.nearest(eye.origin, eye.direction);
  if (!hit) return {};
  const glm::vec3 point = occluders.position(*hit);
  const glm::vec3 normal = occluders.normal(hit->mesh, hit->triangle);
  const auto ray = ray_to_light(scene.lights.front(), point);
  if (!ray || glm::dot(normal, ray->direction) < 0.02F) return {};
  return !occluders.blocked(point + occluders.offset() * normal, ray->direction, ray->distance);
}

struct Agreement {
  std::size_t compared = 0, agreeing = 0, shadowed = 0;
};

// Pixels whose neighbourhood of `reach` pixels is wholly in light or wholly in shadow.
Agreement agreement_with_rays(const Scene& scene, int edge, float reach) {
  const Occluders occluders(scene);
  const std::vector<float> shares = clear_shares(scene, edge);
  Agreement found;
  for (int y = 0; y < edge; ++y) {
    for (int x = 0; x < edge; ++x) {
      const float share =
          shares[static_cast<std::size_t>(y) * static_cast<std::size_t>(edge) + static_cast<std::size_t>(x)];
      std::optional<bool> clear;
      bool edge_near = share < 0.0F;
      for (int i = 0; i < 9 && !edge_near; ++i) {
        const glm::vec2 beside(static_cast<float>(x) + 0.5F + reach * static_cast<float>(i % 3 - 1),
                               static_cast<float>(y) + 0.5F + reach * static_cast<float>(i / 3 - 1));
        const auto there = truly_clear(occluders, scene, eye_ray(scene.camera, edge, beside.x, beside.y));
        edge_near = !there || (clear && *clear != *there);
        clear = there;
      }
      if (edge_near) continue;
      ++found.compared;
      found.shadowed += *clear ? 0 : 1;
      found.agreeing += std::abs(share - (*clear ? 1.0F : 0.0F)) < 0.01F ? 1 : 0;
    }
  }
  return found;
}

PointLight lamp(const glm::vec3& position) { return {.position = position, .intensity = glm::vec3(4.0F), .range = {}}; }

struct LightCase {
  const char* name;
  Light light;
  std::size_t maps;
};

const auto light_cases = std::to_array<LightCase>({
    {"directional",
     DirectionalLight{.direction = glm::normalize(glm::vec3(0.6F, 0.3F, -1.0F)), .illuminance = glm::vec3(3)}, 1},
    {"low_directional",
     DirectionalLight{.direction = glm::normalize(glm::vec3(1.0F, 0.2F, -0.4F)), .illuminance = glm::vec3(9)}, 1},
    {"point_outside", lamp({-0.6F, 0.5F, 3.0F}), 1},
    {"point_among", lamp({-0.6F, 0.45F, 0.9F}), 6},
    {"spot",
     SpotLight{.point = lamp({-0.4F, 0.5F, 1.0F}),
               .direction = glm::normalize(glm::vec3(0.4F, -0.5F, -1.0F)),
               .outer_cone_angle = 0.7F},
     1},
    {"wide_spot", SpotLight{.point = lamp({-0.6F, 0.45F, 0.9F}), .direction = {0, 0, -1}, .outer_cone_angle = 1.5F}, 6},
});

class ShadowOf : public ::testing::TestWithParam<LightCase> {};

Scene bodies_over_floor(const Light& light) {
  Scene scene = box_over_floor();
  scene.meshes.push_back(sphere_mesh({0.55F, -0.5F, 0.3F}, 0.25F, 64));
  fit_bounds(scene);
  scene.lights = {light};
  return scene;
}

TEST_P(ShadowOf, IsWhereRaysFindIt) {
  const Scene scene = bodies_over_floor(GetParam().light);
  const Agreement found = agreement_with_rays(scene, 160, 2.0F);
  EXPECT_GT(found.compared, 160U * 160U / 3U);
  EXPECT_GT(found.shadowed, 300U);
  EXPECT_GE(static_cast<double>(found.agreeing), 0.999 * static_cast<double>(found.compared))
      << found.agreeing << " of " << found.compared;
  EXPECT_EQ(TestRenderer(scene).gpu_scene().shadow_maps()->views().views.size(), GetParam().maps);
}

// With the effect compiled in, what casts no shadow looks as it does without: no surface shadows itself.
TEST_P(ShadowOf, LeavesAPlaneAlone) {
  Scene scene = white_floor();
  scene.lights = {GetParam().light};
  for (const float tilt : {0.0F, 0.7F, 1.3F}) {
    const glm::vec3 up(0.0F, std::sin(tilt), std::cos(tilt));
    for (Vertex& vertex : scene.meshes[0].vertices) {
      vertex.position = {vertex.position.x, glm::vec2(vertex.position.y, vertex.position.z).x * up.z,
                         vertex.position.y * -up.y};
      vertex.normal = up;
    }
    fit_bounds(scene);
    const EffectSet with = without_shadows(scene).set(static_cast<std::size_t>(Effect::cast_shadow));
    for (const int resolution : {16, 333, 2048}) {
      scene.shadows.resolution = resolution;
      EXPECT_LT(largest_difference(TestRenderer(scene, {128, 128}, with).frame(base_surface()),
                                   TestRenderer(scene, {128, 128}, without_shadows(scene)).frame(base_surface())),
                1e-5)
          << tilt << " " << resolution;
    }
  }
}

// On the facets that face the light; beyond them a mesh shadows what its smooth normals would still light.
TEST_P(ShadowOf, LeavesASphereAlone) {
  Scene scene = white_floor();
  scene.meshes = {sphere_mesh({0, 0, 0}, 0.8F, 24)};
  fit_bounds(scene);
  scene.lights = {GetParam().light};
  const Occluders occluders(scene);
  scene.shadows.cast = true;
  constexpr int edge = 160;
  const std::vector<float> shares = clear_shares(scene, edge);
  std::size_t lit = 0;
  for (std::size_t i = 0; i < shares.size(); ++i) {
    const EyeRay eye =
        eye_ray(scene.camera, edge, static_cast<float>(i % edge) + 0.5F, static_cast<float>(i / edge) + 0.5F);
    const auto clear = truly_clear(occluders, scene, eye);
    if (!clear || !*clear || shares[i] < 0.0F) continue;
    ++lit;
    EXPECT_GT(shares[i], 0.99F) << i % edge << ", " << i / edge;
  }
  EXPECT_GT(lit, 1000U);
}

INSTANTIATE_TEST_SUITE_P(Lights, ShadowOf, ::testing::ValuesIn(light_cases),
                         [](const auto& test) { return std::string(test.param.name); });

// A box at height 0.25 to 0.5 under light that falls along (1, 0, -1): on the floor its shadow runs from 0 to 0.75 in
// x.
TEST(ShadowMaps, EdgeIsWhereGeometryHasIt) {
  Scene scene = box_over_floor();
  scene.lights = {DirectionalLight{.direction = glm::normalize(glm::vec3(1, 0, -1)), .illuminance = glm::vec3(3)}};
  constexpr int edge = 512;
  const std::vector<float> shares = clear_shares(scene, edge);
  // Along y = 0, to the right of what the box hides from the camera at (0, 0, 3).
  const std::size_t row = std::size_t{edge / 2} * edge;
  float end = 0.0F;
  for (std::size_t x = 380; x < edge; ++x) end += 1.0F - shares[row + x];
  EXPECT_NEAR(380.0F + end, (0.75F + 1.0F) / 2.0F * edge, 1.5F);
}

TEST(ShadowMaps, HolesLetLightThrough) {
  Scene scene = box_over_floor();
  Mesh roof = scene.meshes[0];
  for (Vertex& vertex : roof.vertices) vertex.position = glm::vec3(vertex.position.x, vertex.position.y, 1.0F);
  roof.material = 1;
  scene.materials.push_back(scene.materials[0]);
  Image mask(2, 2, 4, 1.0F);
  mask.at(1, 1)[3] = 0.0F;
  scene.materials[1].alpha_cutoff = 0.5F;
  scene.materials[1].base_color_map = TextureMap{"mask", std::make_shared<const Image>(mask), {}};
  scene.meshes[1] = roof;
  fit_bounds(scene);
  scene.lights = {
      DirectionalLight{.direction = glm::normalize(glm::vec3(0.1F, 0.05F, -1.0F)), .illuminance = glm::vec3(3)}};
  // The camera looks through the hole.
  scene.camera.world = look_at({0.5, -0.5, 3.0}, {0.5, -0.5, 0.0}, {0.0, 1.0, 0.0});
  scene.camera.yfov = 0.2F;
  const std::vector<float> shares = clear_shares(scene, 32);
  EXPECT_GT(shares[16 * 32 + 16], 0.99F);
  scene.materials[1].alpha_cutoff.reset();
  scene.camera.world = look_at({0.5, -0.5, 0.9}, {0.5, -0.5, 0.0}, {0.0, 1.0, 0.0});
  EXPECT_LT(clear_shares(scene, 32)[16 * 32 + 16], 0.01F);
}

// A frame's pixels and the reference's samples look the same way: away from edges both are one or the other.
// A sheet that faces down hovers over the floor: drawn only from below, it blocks no light from above, for any
// kind of light and whichever way round its map is.
TEST_P(ShadowOf, LeavesTheBacksOfOneSidedTrianglesOut) {
  Scene scene = white_floor();
  scene.lights = {GetParam().light};
  Mesh sheet = scene.meshes[0];
  for (Vertex& vertex : sheet.vertices) {
    vertex.position = 0.25F * vertex.position + glm::vec3(0, 0, 0.3F);
    vertex.normal = {0, 0, -1};
  }
  for (std::size_t i = 0; i < sheet.indices.size(); i += 3) std::swap(sheet.indices[i], sheet.indices[i + 1]);
  scene.meshes.push_back(sheet);
  fit_bounds(scene);
  const auto shadowed = [&] {
    EffectSet effects = effects_on(derive_effects(scene));
    effects.set(static_cast<std::size_t>(Effect::cast_shadow));
    const Image with = TestRenderer(scene, {64, 64}, effects).frame(base_surface());
    const Image without = TestRenderer(scene, {64, 64}, without_shadows(scene)).frame(base_surface());
    int count = 0;
    for (std::size_t i = 0; i < with.texels.size(); i += 4) count += with.texels[i] < 0.5F * without.texels[i] ? 1 : 0;
    return count;
  };
  EXPECT_EQ(shadowed(), 0);
  scene.shadows.both_sides = true;
  EXPECT_GT(shadowed(), 60);
}

TEST(ShadowMaps, ReferenceHasThemToo) {
  Scene scene = box_over_floor();
  scene.lights = {DirectionalLight{.direction = glm::normalize(glm::vec3(1, 0, -1)), .illuminance = glm::vec3(3)}};
  const Image frame = TestRenderer(scene).frame(base_surface());
  const Image reference = TestRenderer(scene).reference(16).mean;
  std::size_t differing = 0;
  for (std::size_t i = 0; i < frame.texels.size(); i += 4) {
    if (std::abs(frame.texels[i] - reference.texels[i]) > 1e-3F) ++differing;
  }
  EXPECT_LT(differing, 64U * 64U / 12U);
}

TEST(ShadowMaps, TooManyAreAnErrorThatSaysWhatToDo) {
  Scene scene = box_over_floor();
  for (int i = 0; i < 500; ++i) scene.lights.emplace_back(lamp({0.0F, 0.0F, 0.6F}));
  try {
    const TestRenderer renderer(scene);
    FAIL() << "3000 maps were made";
  } catch (const Error& error) {
    EXPECT_EQ(error.kind(), ErrorKind::machine);
    EXPECT_NE(error.hint().find("[shadows]"), std::string::npos);
  }
}

TEST(ShadowMaps, BytesAreCounted) {
  Scene scene = bodies_over_floor(light_cases[0].light);
  scene.shadows.resolution = 100;
  const TestRenderer renderer(scene);
  EXPECT_EQ(renderer.gpu_scene().shadow_maps()->bytes(), 100U * 100U * 4U);
  EXPECT_EQ(renderer.gpu_scene().shared_bytes(), 100U * 100U * 4U);
}

}  // namespace
}  // namespace footprint::testing
