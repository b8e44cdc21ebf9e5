// The table of hard scenes: a square under one light, with one thing about it that is hard.
#include <glm/gtc/matrix_transform.hpp>
#include <memory>
#include <utility>

#include "renderer/scene/camera.hpp"
#include "renderer/scene/plane.hpp"
#include "stability/hard_case.hpp"
#include "stability/hard_maps.hpp"

namespace footprint::stability {
namespace {

using enum NormalDistribution;

// A square of side 2 seen from above, of what glTF materials are.
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

Scene bumpy() { return square(noise(16, 16, 0.5, 9), 0.4F); }

Scene seen_from(const glm::dvec3& eye) {
  Scene scene = bumpy();
  scene.camera.world = look_at(eye, {0.0, 0.0, 0.0}, {0.0, 0.0, 1.0});
  return scene;
}

Scene lit_from(const glm::vec3& light, float candela) {
  Scene scene = bumpy();
  scene.lights = {PointLight{.position = light, .intensity = glm::vec3(candela), .range = {}}};
  return scene;
}

// Everything about the scene that is a length, times `factor`.
Scene scaled(float factor) {
  Scene scene = bumpy();
  for (Vertex& vertex : scene.meshes.front().vertices) vertex.position *= factor;
  scene.camera.world[3] *= glm::vec4(glm::vec3(factor), 1.0F);
  scene.camera.znear *= factor;
  scene.bounds = {scene.bounds.lower * factor, scene.bounds.upper * factor};
  auto& light = std::get<PointLight>(scene.lights.front());
  light.position *= factor;
  light.intensity *= factor * factor;
  return scene;
}

// Triangles that are points and lines in space or on the map, and a mirrored map.
Scene degenerate() {
  Scene scene = bumpy();
  Mesh& mesh = scene.meshes.front();
  mesh.indices.insert(mesh.indices.end(), {0, 0, 0, 0, 1, 1});
  Mesh flat = mesh, mirrored = mesh;
  for (Vertex& vertex : flat.vertices) vertex.uv0 = vertex.uv1 = {0.3F, 0.3F};
  for (Vertex& vertex : mirrored.vertices) {
    vertex.uv0.x = vertex.uv1.x = -vertex.uv0.x;
    vertex.tangent.w = -1.0F;
    vertex.position.z = 0.5F;
    vertex.position.x *= 0.3F;
  }
  scene.meshes.push_back(flat);
  scene.meshes.push_back(mirrored);
  return scene;
}

Scene surrounded(float sun) {
  Scene scene = bumpy();
  Image map(32, 16, 3, 0.0F);
  for (int x = 0; x < 32; ++x) map.at(x, 3)[1] = 0.5F;
  for (float& channel : map.at(5, 4)) channel = sun;
  scene.environment = Environment{.name = "hard", .radiance = std::make_shared<const Image>(std::move(map))};
  return scene;
}

Scene varying_roughness() {
  Scene scene = bumpy();
  Image map(16, 16, 2, 0.0F);
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 16; ++x) map.at(x, y)[0] = (x + y) % 2 == 0 ? 0.0F : 1.0F;
  }
  scene.materials.front().metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(std::move(map)), {}};
  return scene;
}

}  // namespace

std::span<const PictureCase> picture_cases() {
  static const std::vector<PictureCase> cases{
      {"roughness_0", "mirrors over noise", [] { return square(noise(16, 16, 0.5, 9), 0.0F); }},
      {"roughness_1", "roughness 1 over noise up to the horizon", [] { return square(noise(16, 16, 0.999, 9), 1.0F); }},
      {"roughness_0_and_1", "roughness 0 and 1 in turn", varying_roughness},
      {"constant_tilt", "one normal everywhere: nothing to filter", [] { return square(tilted(17.0), 0.5F); }, true},
      {"grazing_view", "seen from a degree above the surface",
       [] {
         return seen_from({0.0, -3.0, 0.05});
       }},
      {"eye_on_the_surface", "seen from the surface's own plane",
       [] {
         return seen_from({0.0, -3.0, 0.0});
       }},
      {"light_at_the_eye", "wi = wo",
       [] {
         return lit_from({0.0F, 0.0F, 3.0F}, 4.0F);
       }},
      {"light_on_the_surface", "light from the surface's own plane",
       [] {
         return lit_from({1.5F, 0.0F, 0.0F}, 4.0F);
       }},
      {"light_behind", "light from behind",
       [] {
         return lit_from({0.4F, 0.3F, -1.5F}, 4.0F);
       }},
      {"faint_light", "1e-30 candela",
       [] {
         return lit_from({0.4F, 0.3F, 1.5F}, 1e-30F);
       }},
      {"bright_light", "1e12 candela",
       [] {
         return lit_from({0.4F, 0.3F, 1.5F}, 1e12F);
       }},
      {"tiny_scene", "lengths times 1e-6", [] { return scaled(1e-6F); }},
      {"huge_scene", "lengths times 1e6", [] { return scaled(1e6F); }},
      {"degenerate_triangles", "points, lines, one uv everywhere, a mirrored map", degenerate},
      {"environment_with_a_sun", "one texel of 1e6 in an environment of zeros", [] { return surrounded(1e6F); }},
      {"black_environment", "an environment of zeros but for one ring", [] { return surrounded(0.0F); }}};
  return cases;
}

}  // namespace footprint::stability
