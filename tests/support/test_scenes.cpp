// Normal maps, random ones by fixed seeds, and a square under one light with the camera above it.
#include "tests/support/test_scenes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <random>

#include "renderer/scene/camera.hpp"
#include "renderer/scene/geometry.hpp"

namespace footprint::testing {

Image random_normals(int width, int height, float most_tilt, std::uint32_t seed) {
  std::mt19937 random(seed);
  const auto uniform = [&] { return static_cast<float>(random()) / 4294967296.0F * 2.0F - 1.0F; };
  Image image(width, height, 4);
  for (std::size_t i = 0; i < image.texels.size(); i += 4) {
    const float x = uniform() * most_tilt * 0.7071F;
    const float y = uniform() * most_tilt * 0.7071F;
    image.texels[i] = x;
    image.texels[i + 1] = y;
    image.texels[i + 2] = std::sqrt(1.0F - x * x - y * y);
    image.texels[i + 3] = 1.0F;
  }
  return image;
}

Image constant_normals(int width, int height, const glm::vec3& normal) {
  Image image(width, height, 4, 1.0F);
  for (std::size_t i = 0; i < image.texels.size(); i += 4) {
    for (int c = 0; c < 3; ++c) image.texels[i + static_cast<std::size_t>(c)] = normal[c];
  }
  return image;
}

Image four_texel_normals() {
  Image image(2, 2, 4, 1.0F);
  const std::array<glm::vec3, 4> normals{{{0, 0, 1}, {0.6F, 0, 0.8F}, {0, -0.6F, 0.8F}, {-0.28F, 0, 0.96F}}};
  for (std::size_t i = 0; i < 4; ++i) std::copy_n(&normals[i].x, 3, &image.texels[4 * i]);
  return image;
}

Image gaussian_slope_normals(int size, float spread) {
  std::mt19937 random(9);
  std::normal_distribution<float> normal;
  Image image(size, size, 4, 1.0F);
  for (std::size_t i = 0; i < image.texels.size(); i += 4) {
    const float a = spread * normal(random);
    const float b = spread * normal(random);
    const glm::vec3 n = glm::normalize(glm::vec3(0.1F - a, -0.15F - 0.5F * a - 0.2F * b, 1.0F));
    std::copy_n(&n.x, 3, &image.texels[i]);
  }
  return image;
}

Scene square_scene(const Image& normals, const SquareMaterial& settings) {
  constexpr float side = 2.0F;
  constexpr float camera_height = 3.0F;
  Scene scene;
  scene.name = scene.source = "square";
  Material material;
  material.name = "square";
  material.brdf = settings.brdf;
  material.roughness = settings.roughness;
  material.metallic = settings.metallic;
  material.base_color = glm::vec4(settings.base_color, 1.0F);
  material.dielectric_specular = settings.specular;
  if (!normals.empty()) material.normal_map = TextureMap{"normals", std::make_shared<const Image>(normals), {}};
  scene.materials.push_back(std::move(material));
  scene.meshes.push_back(make_plane({side, side}, {1.0F, 1.0F}));
  scene.lights.emplace_back(PointLight{.position = {0.4F, 0.3F, 1.5F}, .intensity = glm::vec3(4.0F), .range = {}});
  scene.camera.world = glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, camera_height});
  scene.camera.yfov = 2.0F * std::atan(0.5F * side / camera_height);
  scene.bounds = {{-1.0F, -1.0F, 0.0F}, {1.0F, 1.0F, 0.0F}};
  scene.exposure = 1.0F;
  return scene;
}

Material lobe_material(const Image& normals, NormalDistribution distribution, float lobe, GeometryTerm geometry) {
  const BaseBrdf brdf{distribution, geometry, FresnelTerm::none, true};
  Material material = square_scene(normals, {.brdf = brdf}).materials[0];
  material.lobe_parameter = lobe;
  return material;
}

glm::dvec3 normal_at(const Image& normals, int x, int y) {
  const auto n = normals.at(x, y);
  return glm::normalize(glm::dvec3(n[0], n[1], n[2]));
}

Scene receding_grooves() {
  std::mt19937 random(4);
  std::uniform_real_distribution<float> slope(-0.4F, 0.4F);
  Image normals(64, 64, 4, 1.0F);
  for (int x = 0; x < normals.width; ++x) {
    const glm::vec3 n = glm::normalize(glm::vec3(slope(random), 0.0F, 1.0F));
    for (int y = 0; y < normals.height; ++y) std::copy_n(&n.x, 3, normals.at(x, y).begin());
  }
  Scene scene = square_scene(normals, {});
  scene.camera.world = look_at({0.0, -2.5, 0.5}, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  return scene;
}

}  // namespace footprint::testing
