// One picture at every size: nothing in the pipeline has a length of its own.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/pipeline/interior.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/camera.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr glm::ivec2 scales_size{48, 48};

// A box and a ball over a bumpy floor, under every kind of light and an environment, all times `scale`.
Scene bodies(float scale) {
  Scene scene = box_over_floor();
  scene.meshes.push_back(sphere_mesh({0.5F, 0.5F, 0.3F}, 0.3F, 12));
  scene.materials[0].normal_map =
      TextureMap{"bumps", std::make_shared<const Image>(random_normals(16, 16, 0.3F, 2)), {}};
  for (Mesh& mesh : scene.meshes) {
    for (Vertex& vertex : mesh.vertices) vertex.position *= scale;
  }
  fit_bounds(scene);
  scene.camera = frame_bounds(scene.bounds, {});
  scene.lights = supplied_lights(scene.camera, scene.bounds);
  const glm::vec3 candela(scale * scale);
  const PointLight lamp{.position = glm::vec3(0.8F, -0.6F, 1.5F) * scale, .intensity = candela, .range = 4.0F * scale};
  scene.lights.push_back(SpotLight{.point = lamp, .direction = glm::normalize(-lamp.position)});
  scene.lights.push_back(AreaLight{.position = glm::vec3(-0.5F, 0.5F, 1.2F) * scale,
                                   .direction = {0.0F, 0.0F, -1.0F},
                                   .half_size = glm::vec2(0.2F * scale),
                                   .intensity = candela});
  scene.environment = supplied_environment();
  return scene;
}

struct Pictures {
  Image frame, reference, interior;
};

Pictures pictures_at(float scale) {
  const Scene scene = bodies(scale);
  TestRenderer renderer(scene, scales_size);
  GpuScene gpu(shared_context().info(), scene, effects_on(derive_effects(scene)));
  const View view{.size = scales_size, .camera = scene.camera};
  const Interior interior =
      InteriorFinder(gpu, scene).render(view, {.origin = {0, 0}, .size = scales_size}, 4, 1, no_progress);
  return {renderer.frame(base_surface()), renderer.reference(4).mean, interior.mask};
}

double mean_distance(const Image& a, const Image& b) {
  double sum = 0.0;
  for (std::size_t i = 0; i < a.texels.size(); ++i) sum += std::abs(double{a.texels[i]} - b.texels[i]);
  return sum / static_cast<double>(a.texels.size());
}

TEST(Scales, HaveThePictureOfOneMetre) {
  const Pictures metre = pictures_at(1.0F);
  EXPECT_GT(covered_mean(metre.frame), 0.05);
  EXPECT_GT(pixel_count(metre.interior), 300U);
  for (const float scale : {1e-12F, 1e-9F, 1e-7F, 1e-4F, 1e3F, 1e6F, 1e9F}) {
    SCOPED_TRACE(scale);
    const Pictures scaled = pictures_at(scale);
    EXPECT_LT(mean_distance(scaled.frame, metre.frame), 1e-4);
    EXPECT_LT(mean_distance(scaled.reference, metre.reference), 1e-3);
    EXPECT_LT(mean_distance(scaled.interior, metre.interior), 5e-3);
  }
}

}  // namespace
}  // namespace footprint::testing
