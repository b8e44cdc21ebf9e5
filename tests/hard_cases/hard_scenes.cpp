// A plane of a partly metallic material, and a point light next to the camera.
#include "tests/hard_cases/hard_scenes.hpp"

#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <utility>

#include "renderer/scene/geometry.hpp"

namespace footprint::hard_cases {

Scene square(Image normals, float roughness) {
  Scene scene;
  scene.name = scene.source = "hard case";
  Material material;
  material.name = "square";
  material.base_color = glm::vec4(0.6F, 0.5F, 0.4F, 1.0F);
  material.metallic = 0.5F;
  material.roughness = roughness;
  material.normal_map = TextureMap{"normals", std::make_shared<const Image>(std::move(normals)), {}};
  scene.materials.push_back(std::move(material));
  scene.meshes.push_back(make_plane({2.0F, 2.0F}, {1.0F, 1.0F}));
  scene.lights.emplace_back(PointLight{.position = {0.4F, 0.3F, 1.5F}, .intensity = glm::vec3(4.0F), .range = {}});
  scene.camera.world = glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, 3.0F});
  scene.bounds = {{-1.0F, -1.0F, 0.0F}, {1.0F, 1.0F, 0.0F}};
  scene.exposure = 1.0F;
  return scene;
}

}  // namespace footprint::hard_cases
