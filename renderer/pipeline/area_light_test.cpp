// Area lights against sums over their points in double precision, Lambert's formula and white furnaces.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>
#include <vector>

#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/lights.hpp"
#include "renderer/pipeline/shader_source.hpp"
#include "renderer/scene/camera.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shader_probe.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using std::numbers::pi;

constexpr int image_size = 16;  // pixels of each side of the images

AreaLight light_at(AreaShape shape, const glm::vec3& position, const glm::vec3& target, const glm::vec2& half_size) {
  AreaLight light{.shape = shape, .position = position, .direction = glm::normalize(target - position)};
  const glm::vec3 helper = std::abs(light.direction.y) < 0.9F ? glm::vec3(0, 1, 0) : glm::vec3(1, 0, 0);
  light.across = glm::normalize(glm::cross(helper, light.direction));
  light.up = glm::cross(light.direction, light.across);
  light.half_size = half_size;
  light.intensity = glm::vec3(3.0F);
  return light;
}

// A level square of one GGX or Lambert material, seen from `camera`.
struct LitSquare {
  float roughness = 0.5F;
  bool diffuse = false;
  AreaLight light;
  glm::dvec3 camera{0.0, 0.0, 3.0};
  GeometryTerm geometry = GeometryTerm::smith;
};

Scene square_of(const LitSquare& c) {
  const SquareMaterial material{
      .brdf = {NormalDistribution::ggx, c.geometry, FresnelTerm::schlick, c.diffuse},
      .roughness = c.roughness,
      .base_color = glm::vec3(c.diffuse ? 0.8F : 0.5F),
      .specular = glm::vec3(c.diffuse ? 0.0F : 0.2F),
  };
  Scene scene = square_scene({}, material);
  if (c.diffuse) scene.materials.front().brdf.fresnel = FresnelTerm::none;
  scene.lights = {c.light};
  scene.shadows.cast = false;
  const glm::dvec3 up = std::abs(c.camera.x) + std::abs(c.camera.y) > 0.0 ? glm::dvec3(0, 0, 1) : glm::dvec3(0, 1, 0);
  scene.camera.world = look_at(c.camera, {0.0, 0.0, 0.0}, up);
  scene.camera.yfov = 0.2F;
  return scene;
}

// The point of the square in the middle of a pixel.
glm::dvec3 point_under(const Scene& scene, int x, int y) {
  const double tangent = std::tan(0.5 * scene.camera.yfov);
  const glm::dvec3 ray =
      glm::dmat3(glm::dmat4(scene.camera.world)) *
      glm::dvec3((2.0 * (x + 0.5) / image_size - 1.0) * tangent, (1.0 - 2.0 * (y + 0.5) / image_size) * tangent, -1.0);
  const glm::dvec3 from(scene.camera.world[3]);
  return from - ray * (from.z / ray.z);
}

// f cos of GGX, Smith and Schlick, or of Lambert (docs/explanation/base-brdf.md), about the z axis.
double reflectance(const LitSquare& c, const glm::dvec3& wi, const glm::dvec3& wo) {
  if (wi.z <= 0.0) return 0.0;
  if (c.diffuse) return 0.8 / pi * wi.z;
  const double alpha = c.roughness * c.roughness, a2 = alpha * alpha;
  const glm::dvec3 h = glm::normalize(wi + wo);
  const double d = a2 / (pi * std::pow(a2 * h.z * h.z + h.x * h.x + h.y * h.y, 2.0));
  const auto lambda = [&](double cosine) {
    return 0.5 * (std::sqrt(1.0 + a2 * (1.0 / (cosine * cosine) - 1.0)) - 1.0);
  };
  const double g = c.geometry == GeometryTerm::smith ? 0.25 / ((1.0 + lambda(wi.z) + lambda(wo.z)) * wo.z) : 1.0;
  return (0.2 + 0.8 * std::pow(1.0 - glm::dot(wo, h), 5.0)) * d * g;
}

// The radiance of a point of the square under a sphere, summed over n x n parts of equal area of the sphere.
double summed_over_sphere(const LitSquare& c, const glm::dvec3& point, int n) {
  const glm::dvec3 wo = glm::normalize(c.camera - point);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const double z = 2.0 * (i + 0.5) / n - 1.0, azimuth = 2.0 * pi * (j + 0.5) / n, ring = std::sqrt(1.0 - z * z);
      const glm::dvec3 normal(ring * std::cos(azimuth), ring * std::sin(azimuth), z);
      const glm::dvec3 d = glm::dvec3(c.light.position) + static_cast<double>(c.light.half_size.x) * normal - point;
      const double distance = glm::length(d), cosine = -glm::dot(normal, d) / distance;
      if (cosine > 0.0) sum += reflectance(c, d / distance, wo) * cosine / (distance * distance);
    }
  }
  return 3.0 * 4.0 * sum / (n * n);  // a sphere has four times the area of its outline
}

// The radiance of a point of the square, summed over n x n parts of the light.
double summed(const LitSquare& c, const glm::dvec3& point, int n) {
  if (c.light.shape == AreaShape::sphere) return summed_over_sphere(c, point, n);
  const glm::dvec3 wo = glm::normalize(c.camera - point), facing(c.light.direction);
  double sum = 0.0;
  for (int i = 0; i < n; ++i) {
    for (int j = 0; j < n; ++j) {
      const glm::dvec2 u((i + 0.5) / n, (j + 0.5) / n);
      glm::dvec2 at = 2.0 * u - 1.0;
      if (c.light.shape == AreaShape::disk)
        at = std::sqrt(u.x) * glm::dvec2(std::cos(2.0 * pi * u.y), std::sin(2.0 * pi * u.y));
      const glm::dvec3 d = glm::dvec3(c.light.position) + at.x * c.light.half_size.x * glm::dvec3(c.light.across) +
                           at.y * c.light.half_size.y * glm::dvec3(c.light.up) - point;
      const double distance = glm::length(d), cosine = -glm::dot(facing, d) / distance;
      if (cosine > 0.0) sum += reflectance(c, d / distance, wo) * cosine / (distance * distance);
    }
  }
  return 3.0 * sum / (n * n);
}

// The largest difference of an image from the sums, over the largest value.
double off_by(const LitSquare& c, const Image& picture, int n = 200) {
  const Scene scene = square_of(c);
  double most = 0.0, off = 0.0;
  for (int y = 1; y < image_size; y += 3) {
    for (int x = 1; x < image_size; x += 3) {
      if (picture.at(x, y)[3] < 1.0F) continue;
      const double exact = summed(c, point_under(scene, x, y), n);
      most = std::max(most, exact);
      off = std::max(off, std::abs(picture.at(x, y)[0] - exact));
    }
  }
  EXPECT_GT(most, 0.0) << "nothing is lit";
  return off / most;
}

Image frame_of(const LitSquare& c) {
  return TestRenderer(square_of(c), {image_size, image_size}).frame(base_surface());
}

LitSquare by_points(LitSquare c, int points) {
  c.light.integral = AreaIntegral::points;
  c.light.points = points;
  return c;
}

std::vector<LitSquare> lit_squares() {
  const AreaLight above = light_at(AreaShape::rectangle, {0.2F, 0.3F, 1.5F}, {0, 0, 0}, {0.5F, 0.3F});
  const AreaLight low = light_at(AreaShape::disk, {-1.6F, 0.2F, 0.6F}, {0, 0, 0.2F}, {0.4F, 0.4F});
  const AreaLight sunken = light_at(AreaShape::rectangle, {-1.2F, 0.1F, 0.1F}, {0, 0, 0.1F}, {0.6F, 0.5F});
  const AreaLight ball = light_at(AreaShape::sphere, {-0.8F, 0.5F, 1.0F}, {0, 0, 2.0F}, {0.4F, 0.4F});
  std::vector<LitSquare> all;
  for (const AreaLight& light : {above, low, sunken, ball}) {
    for (const float roughness : {0.4F, 0.6F, 1.0F})
      all.push_back({.roughness = roughness, .light = light, .camera = {1.5, 0.0, 1.5}});
    all.push_back({.diffuse = true, .light = light});
  }
  return all;
}

// Points are the definition; 256 of them come near to the integral.
TEST(AreaLights, PointsConvergeToTheIntegral) {
  for (const LitSquare& c : lit_squares())
    EXPECT_LT(off_by(c, frame_of(by_points(c, 256))), 0.03) << c.roughness << c.diffuse;
}

TEST(AreaLights, OnePointIsTheCentre) {
  for (const AreaShape shape : {AreaShape::rectangle, AreaShape::disk}) {
    LitSquare c{.light = light_at(shape, {0.3F, 0.2F, 1.2F}, {0, 0, 0}, glm::vec2(0.1F))};
    c.light.half_size = glm::vec2(0.0F);
    EXPECT_LT(off_by(c, frame_of(by_points(c, 1)), 1), 1e-4);
  }
}

// The error of the fit, and of a disk of 24 corners.
TEST(AreaLights, LobesAreTheIntegralButForTheFit) {
  for (const LitSquare& c : lit_squares())
    EXPECT_LT(off_by(c, frame_of(c)), c.diffuse ? 0.003 : 0.12) << c.roughness << c.diffuse;
}

// A small light near the horizon has a small share of a rough lobe, and the fit's error is a share of the whole lobe.
TEST(AreaLights, LobesAtGrazingViewsAreOffByTheFit) {
  for (const auto& [roughness, most] : {std::pair(0.3F, 0.25), std::pair(0.5F, 0.25), std::pair(0.8F, 0.5)}) {
    const LitSquare c{.roughness = roughness,
                      .light = light_at(AreaShape::rectangle, {-1.5F, 0.0F, 0.5F}, {0, 0, 0}, {0.3F, 0.3F}),
                      .camera = {2.9, 0.0, 0.5}};
    EXPECT_LT(off_by(c, frame_of(c)), most) << roughness;
  }
}

TEST(AreaLights, ReferenceConvergesToTheIntegral) {
  for (const LitSquare& c : lit_squares()) {
    TestRenderer renderer(square_of(c), {image_size, image_size});
    EXPECT_LT(off_by(c, renderer.reference(1024).mean), 0.02) << c.roughness << c.diffuse;
  }
}

// Narrow lobes: directions drawn from the lobe find the light that few of its points do.
TEST(AreaLights, ReferenceResolvesMirrors) {
  LitSquare c{.roughness = 0.05F,
              .light = light_at(AreaShape::rectangle, {-1.0F, 0.0F, 1.0F}, {0, 0, 0}, {0.2F, 0.2F}),
              .camera = {2.0, 0.0, 2.0}};
  const Scene scene = square_of(c);
  TestRenderer renderer(scene, {image_size, image_size});
  const Image reference = renderer.reference(256).mean, lobes = renderer.frame(base_surface());
  // In the middle the mirror image of the light fills the lobe: F times radiance.
  const double radiance = 3.0 / (4.0 * 0.2 * 0.2), mirrored = 0.2 + 0.8 * std::pow(1.0 - std::sqrt(0.5), 5.0);
  EXPECT_NEAR(reference.at(8, 8)[0], mirrored * radiance, 0.02 * radiance);
  EXPECT_NEAR(lobes.at(8, 8)[0], mirrored * radiance, 0.01 * radiance);
  EXPECT_LT(reference.at(8, 0)[0], 0.01 * radiance) << "outside of the mirror image";
  EXPECT_LT(lobes.at(8, 0)[0], 0.01 * radiance);
}

// Irradiance of a polygon (Lambert 1760): half the sum over its edges of their angle times their normal's cosine.
double lambert(const std::vector<glm::dvec3>& corners) {
  double sum = 0.0;
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const glm::dvec3 a = glm::normalize(corners[i]), b = glm::normalize(corners[(i + 1) % corners.size()]);
    sum += std::acos(std::clamp(glm::dot(a, b), -1.0, 1.0)) * glm::normalize(glm::cross(a, b)).z;
  }
  return 0.5 * std::abs(sum);
}

TEST(AreaLights, DiffuseRectangleIsLambertsFormula) {
  const LitSquare c{.diffuse = true,
                    .light = light_at(AreaShape::rectangle, {0.5F, -0.4F, 1.0F}, {0, 0, 0}, {0.4F, 0.3F})};
  const Scene scene = square_of(c);
  const Image picture = TestRenderer(scene, {image_size, image_size}).frame(base_surface());
  for (const int x : {0, 7, 15}) {
    std::vector<glm::dvec3> corners;
    for (const glm::vec2& side : {glm::vec2(1, 1), glm::vec2(-1, 1), glm::vec2(-1, -1), glm::vec2(1, -1)}) {
      corners.push_back(glm::dvec3(c.light.position + side.x * 0.4F * c.light.across + side.y * 0.3F * c.light.up) -
                        point_under(scene, x, 5));
    }
    const double exact = 0.8 / pi * lambert(corners) * 3.0 / (4.0 * 0.4 * 0.3);
    EXPECT_NEAR(picture.at(x, 5)[0], exact, 1e-4 * exact);
  }
}

// Irradiance of a sphere above the horizon, exact: radiance times pi sin^2 of its half angle times the cosine.
TEST(AreaLights, DiffuseSphereIsTheFormula) {
  for (const glm::vec3& at :
       {glm::vec3(0.3F, -0.2F, 1.2F), glm::vec3(3.0F, 0.0F, 4.0F), glm::vec3(0.0F, 0.0F, 100.0F)}) {
    const LitSquare c{.diffuse = true, .light = light_at(AreaShape::sphere, at, {0, 0, 200}, glm::vec2(0.5F))};
    const Scene scene = square_of(c);
    TestRenderer renderer(scene, {image_size, image_size});
    const Image lobes = renderer.frame(base_surface()), reference = renderer.reference(256).mean;
    const glm::dvec3 d = glm::dvec3(at) - point_under(scene, 7, 5);
    const double exact = 0.8 / pi * 3.0 * d.z / std::pow(glm::length(d), 3.0);
    EXPECT_NEAR(lobes.at(7, 5)[0], exact, 1e-3 * exact) << at.z;
    EXPECT_NEAR(reference.at(7, 5)[0], exact, 1e-2 * exact) << at.z;
  }
}

// A sphere that goes through the horizon is off by the fit alone: as a disk of the same cone.
TEST(AreaLights, SpheresAreTheDisksThatTheyCover) {
  for (const float roughness : {0.4F, 1.0F}) {
    LitSquare c{.roughness = roughness,
                .light = light_at(AreaShape::sphere, {-1.3F, 0.0F, 0.1F}, {0, 0, 2}, glm::vec2(0.4F)),
                .camera = {1.5, 0.0, 1.5}};
    const Scene scene = square_of(c);
    TestRenderer renderer(scene, {image_size, image_size});
    const Image lobes = renderer.frame(base_surface()), reference = renderer.reference(1024).mean;
    EXPECT_LT(off_by(c, reference), 0.02) << roughness;
    const glm::dvec3 point = point_under(scene, 8, 8), d = glm::dvec3(c.light.position) - point;
    const double cosine2 = 1.0 - 0.4 * 0.4 / glm::dot(d, d);
    const auto radius = static_cast<float>(0.4 * std::sqrt(cosine2));
    c.light = light_at(AreaShape::disk, glm::vec3(point + cosine2 * d), glm::vec3(point), glm::vec2(radius));
    c.light.intensity *= static_cast<float>(cosine2);
    const float expected = frame_of(c).at(8, 8)[0];
    EXPECT_NEAR(lobes.at(8, 8)[0], expected, 2e-3 * expected) << roughness;
  }
}

TEST(AreaLights, SpheresLightNothingWithin) {
  LitSquare c{.diffuse = true, .light = light_at(AreaShape::sphere, {0, 0, 0.5F}, {0, 0, 2}, glm::vec2(1.5F))};
  TestRenderer renderer(square_of(c), {image_size, image_size});
  EXPECT_EQ(renderer.frame(base_surface()).at(8, 8)[0], 0.0F);
  EXPECT_EQ(renderer.reference(16).mean.at(8, 8)[0], 0.0F);
  EXPECT_EQ(frame_of(by_points(c, 16)).at(8, 8)[0], 0.0F);
}

TEST(AreaLights, SpheresWithoutSizeArePoints) {
  for (const float radius : {0.0F, 1e-6F, 1e-3F}) {
    LitSquare c{.roughness = 0.6F,
                .light = light_at(AreaShape::sphere, {-0.9F, 0.3F, 1.2F}, {0, 0, 9}, glm::vec2(radius)),
                .camera = {1.0, 0.0, 1.2}};
    Scene scene = square_of(c);
    TestRenderer renderer(scene, {image_size, image_size});
    scene.lights = {PointLight{.position = c.light.position, .intensity = c.light.intensity, .range = {}}};
    const float point = TestRenderer(scene, {image_size, image_size}).frame(base_surface()).at(8, 8)[0];
    EXPECT_NEAR(renderer.frame(base_surface()).at(8, 8)[0], point, 0.06 * point) << radius;
    EXPECT_NEAR(renderer.reference(64).mean.at(8, 8)[0], point, 0.01 * point) << radius;
    EXPECT_NEAR(frame_of(by_points(c, 16)).at(8, 8)[0], point, 1e-3 * point) << radius;
  }
}

// A light as wide as the sky reflects the energy of the lobe, summed over directions.
TEST(AreaLights, WhiteFurnaceReflectsTheEnergyOfTheLobe) {
  for (const float roughness : {0.1F, 0.5F, 0.8F, 1.0F}) {
    for (const glm::dvec3& camera : {glm::dvec3(0, 0, 3), glm::dvec3(2, 0, 2), glm::dvec3(2.9, 0, 0.6)}) {
      LitSquare c{.roughness = roughness, .light = {}, .camera = camera};
      c.light = light_at(AreaShape::rectangle, {0, 0, 1}, {0, 0, 0}, {1000.0F, 1000.0F});
      c.light.intensity = glm::vec3(c.light.area());  // radiance 1
      const glm::dvec3 wo = glm::normalize(camera);
      const double a2 = std::pow(roughness, 4.0);
      double energy = 0.0;
      constexpr int rings = 300, sectors = 300;
      for (int i = 0; i < rings * sectors; ++i) {  // normals by equal parts of D (n.h)
        const double u = (i / sectors + 0.5) / rings, azimuth = 2.0 * pi * (i % sectors + 0.5) / sectors;
        const double tan2 = a2 * u / (1.0 - u), cosine = 1.0 / std::sqrt(1.0 + tan2), sine = cosine * std::sqrt(tan2);
        const glm::dvec3 h(sine * std::cos(azimuth), sine * std::sin(azimuth), cosine);
        const double oh = glm::dot(wo, h);
        const glm::dvec3 wi = 2.0 * oh * h - wo;
        const double d = a2 / (pi * std::pow(a2 * cosine * cosine + sine * sine, 2.0));
        if (oh > 0.0) energy += reflectance(c, wi, wo) * 4.0 * oh / (d * cosine * rings * sectors);
      }
      TestRenderer renderer(square_of(c), {image_size, image_size});
      EXPECT_NEAR(renderer.frame(base_surface()).at(8, 8)[0], energy, 0.015 * energy) << roughness << ", " << camera.z;
      EXPECT_NEAR(renderer.reference(1024).mean.at(8, 8)[0], energy, 0.03 * energy) << roughness << ", " << camera.z;
    }
  }
}

TEST(AreaLights, SmallLightsAreTheirCentre) {
  for (const float half : {0.0F, 1e-6F, 1e-4F, 1e-3F}) {
    for (const AreaShape shape : {AreaShape::rectangle, AreaShape::disk}) {
      LitSquare c{.roughness = 0.6F,
                  .light = light_at(shape, {-0.9F, 0.3F, 1.2F}, {0, 0, 0}, glm::vec2(half)),
                  .camera = {1.0, 0.0, 1.2}};
      TestRenderer renderer(square_of(c), {image_size, image_size});
      EXPECT_LT(off_by(c, renderer.frame(base_surface()), 1), 0.06) << half;
      EXPECT_LT(off_by(c, renderer.reference(64).mean, 1), 0.01) << half;
    }
  }
}

// Lights that shine past the surface, from below, along it or on it: finite and not negative, by lobes, by points and
// in the reference.
TEST(AreaLights, HardCasesAreFinite) {
  const glm::vec3 middle(0.0F, 0.0F, 0.0F);
  std::vector<AreaLight> lights;
  for (const AreaShape shape : {AreaShape::rectangle, AreaShape::disk, AreaShape::sphere}) {
    lights.push_back(light_at(shape, {0, 0, 1}, {0, 0, 2}, glm::vec2(0.5F)));        // shines away
    lights.push_back(light_at(shape, {0, 0, -1}, middle, glm::vec2(0.5F)));          // below the surface
    lights.push_back(light_at(shape, {0.5F, 0, 1}, {0.5F, 1, 1}, glm::vec2(0.5F)));  // edge-on
    lights.push_back(light_at(shape, {1, 0, 0}, middle, glm::vec2(0.5F)));           // through the horizon
    lights.push_back(light_at(shape, middle, {0, 0, -1}, glm::vec2(0.5F)));          // on the surface
    lights.push_back(light_at(shape, {0, 0, 1e-6F}, middle, glm::vec2(0.5F)));       // just above it
    lights.push_back(light_at(shape, {0, 0, 2}, middle, {0.0F, 0.5F}));              // a line
    lights.push_back(light_at(shape, {0, 0, 2}, middle, {1e6F, 1e6F}));              // huge
    lights.push_back(light_at(shape, {1e6F, 0, 1e6F}, middle, {1e-6F, 1e-6F}));      // far and tiny
    lights.push_back(light_at(shape, {0, 0, 3}, middle, glm::vec2(0.1F)));           // at the camera
  }
  for (const AreaLight& light : lights) {
    for (const float roughness : {0.0F, 0.3F, 1.0F}) {
      const LitSquare c{.roughness = roughness, .light = light};
      TestRenderer renderer(square_of(c), {image_size, image_size});
      const auto expect_finite = [&](const Image& picture, const char* what) {
        EXPECT_TRUE(
            std::ranges::all_of(picture.texels, [](float value) { return std::isfinite(value) && value >= 0.0F; }))
            << what << ", roughness " << roughness << ", light at " << light.position.x << " " << light.position.z;
      };
      expect_finite(renderer.frame(base_surface()), "lobes");
      expect_finite(renderer.reference(16).mean, "reference");
      expect_finite(frame_of(by_points(c, 16)), "points");
    }
  }
}

TEST(AreaLights, ShineToOneSideOfTheSurfaceAlone) {
  for (const bool away : {false, true}) {
    LitSquare c{.diffuse = true, .light = {}};
    c.light = away ? light_at(AreaShape::disk, {0, 0, 1}, {0, 0, 2}, glm::vec2(0.5F))
                   : light_at(AreaShape::disk, {0, 0, -1}, {0, 0, 0}, glm::vec2(0.5F));
    TestRenderer renderer(square_of(c), {image_size, image_size});
    EXPECT_EQ(renderer.frame(base_surface()).at(8, 8)[0], 0.0F);
    EXPECT_EQ(renderer.reference(16).mean.at(8, 8)[0], 0.0F);
    EXPECT_EQ(frame_of(by_points(c, 16)).at(8, 8)[0], 0.0F);
  }
}

// Equal shares of the area, in cells of equal area.
TEST(AreaLights, PointsAreEvenOverTheArea) {
  for (const AreaShape shape : {AreaShape::rectangle, AreaShape::disk}) {
    AreaLight light{.shape = shape};
    light.half_size = glm::vec2(1.0F);
    light.points = 256;
    std::array<int, 16> counts{};
    for (const glm::vec3& point : area_points(light)) {
      const glm::dvec2 at(glm::dot(point, light.across), glm::dot(point, light.up));
      const double azimuth = (std::atan2(at.y, at.x) / (2.0 * pi)) + (at.y < 0.0 ? 1.0 : 0.0);
      const glm::dvec2 u = shape == AreaShape::rectangle ? 0.5 * at + 0.5 : glm::dvec2(glm::dot(at, at), azimuth);
      ++counts.at(static_cast<std::size_t>(std::min(3, static_cast<int>(4.0 * u.x)) +
                                           4 * std::min(3, static_cast<int>(4.0 * u.y))));
    }
    EXPECT_TRUE(std::ranges::all_of(counts, [](int count) { return count == 16; }));
  }
}

// Pearson's statistic of independent draws in 64 cells of equal area: 63 degrees of freedom, 99.9% below 103.4.
TEST(AreaLights, SamplerIsEvenOverTheArea) {
  const ShaderFlags flags = shader_flags({}, Options({}, {}, "test"));
  const std::string functions = shared_functions(flags, {"test.glsl", "#include \"area_points.glsl\"\n"});
  constexpr int draws = 16384;
  for (const bool rectangle : {true, false}) {
    std::vector<std::array<glm::vec4, 3>> inputs;
    std::uint32_t state = 12345;
    const auto uniform = [&] {
      state = state * 1664525U + 1013904223U;
      return static_cast<float>(state >> 8U) / 16777216.0F;
    };
    for (int i = 0; i < draws; ++i) {
      const float x = uniform();
      inputs.push_back({glm::vec4(x, uniform(), rectangle ? 1.0F : 0.0F, 0.0F), {}, {}});
    }
    const auto drawn = evaluate_glsl(functions, "return vec4(drawnAreaPoint(a.z > 0.5, a.xy), 0.0, 0.0);", inputs);
    std::array<double, 64> counts{};
    for (const glm::vec4& point : drawn) {
      const glm::dvec2 at(point.x, point.y);
      ASSERT_LE(rectangle ? std::max(std::abs(at.x), std::abs(at.y)) : glm::length(at), 1.0 + 1e-6);
      const double azimuth = std::atan2(at.y, at.x) / (2.0 * pi) + (at.y < 0.0 ? 1.0 : 0.0);
      const glm::dvec2 u = rectangle ? 0.5 * at + 0.5 : glm::dvec2(glm::dot(at, at), azimuth);
      const auto cell = [](double v) { return static_cast<std::size_t>(std::clamp(8.0 * v, 0.0, 7.0)); };
      ++counts.at(cell(u.x) + 8 * cell(u.y));
    }
    double statistic = 0.0;
    for (const double count : counts) statistic += std::pow(count - draws / 64.0, 2.0) / (draws / 64.0);
    EXPECT_LT(statistic, 103.4) << (rectangle ? "rectangle" : "disk");
  }
}

TEST(AreaLights, CastTheShadowOfTheirCentre) {
  LitSquare c{.diffuse = true, .light = light_at(AreaShape::rectangle, {0, 0, 2}, {0, 0, 0}, {0.2F, 0.2F})};
  Scene scene = square_of(c);
  Mesh blocker = scene.meshes.front();
  for (Vertex& vertex : blocker.vertices) vertex.position = 0.02F * vertex.position + glm::vec3(0, 0, 1);
  scene.meshes.push_back(blocker);
  scene.bounds.upper.z = 1.0F;
  scene.shadows = {.cast = true, .both_sides = true};
  scene.camera.world = look_at({0.6, 0.0, 3.0}, {0, 0, 0}, {0, 1, 0});
  TestRenderer renderer(scene, {33, 33});
  for (const Image& picture : {renderer.frame(base_surface()), renderer.reference(64).mean}) {
    EXPECT_EQ(picture.at(16, 16)[0], 0.0F);
    EXPECT_GT(picture.at(2, 16)[0], 0.1F);
  }
}

}  // namespace
}  // namespace footprint::testing
