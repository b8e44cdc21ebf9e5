// Pictures of a ball do not depend on where it is and how large it is.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using nlohmann::json;
using test::GltfBuilder;

// A ball with bumps, mesh 0 of node 0.
GltfBuilder ball(float radius) {
  constexpr int columns = 24, rows = 12;
  GltfBuilder file;
  std::vector<float> positions, normals, uvs;
  std::vector<std::uint16_t> indices;
  for (int y = 0; y <= rows; ++y) {
    for (int x = 0; x <= columns; ++x) {
      const double phi = 2.0 * std::numbers::pi * x / columns, theta = std::numbers::pi * y / rows;
      const glm::vec3 n{glm::dvec3{std::sin(theta) * std::sin(phi), std::cos(theta), std::sin(theta) * std::cos(phi)}};
      for (int axis = 0; axis < 3; ++axis) {
        positions.push_back(radius * n[axis]);
        normals.push_back(n[axis]);
      }
      uvs.insert(uvs.end(), {4.0F * static_cast<float>(x) / columns, 2.0F * static_cast<float>(y) / rows});
      if (x == columns || y == rows) continue;
      const int a = y * (columns + 1) + x, below = a + columns + 1;
      for (const int index : {a, below, below + 1, a, below + 1, a + 1})
        indices.push_back(static_cast<std::uint16_t>(index));
    }
  }
  Image stored = random_normals(16, 16, 0.5F, 3);
  for (float& value : stored.texels) value = 0.5F * (value + 1.0F);
  const json attributes{{"POSITION", file.add_floats(positions, "VEC3")},
                        {"NORMAL", file.add_floats(normals, "VEC3")},
                        {"TEXCOORD_0", file.add_floats(uvs, "VEC2")}};
  const json primitive{{"attributes", attributes}, {"indices", file.add_indices(indices)}, {"material", 0}};
  file.json["meshes"] = {{{"primitives", {primitive}}}};
  file.json["materials"] = {{{"normalTexture", {{"index", file.add_texture(stored)}}},
                             {"pbrMetallicRoughness", {{"metallicFactor", 0.3}, {"roughnessFactor", 0.4}}}}};
  file.json["nodes"] = {{{"mesh", 0}}};
  file.json["scenes"] = {{{"nodes", {0}}}};
  return file;
}

Image picture(const Scene& scene) { return TestRenderer(scene, {48, 48}).frame(base_surface()); }

double off_by(const Image& a, const Image& b) { return compare_images(a, b, 1.0F).value().relative_rmse; }

// The ball with a camera and a light that casts shadows, all below a node at `place`.
Scene ball_at(const glm::dvec3& place) {
  GltfBuilder file = ball(1.0F);
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.6}, {"znear", 0.05}}}}};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "point"}, {"intensity", 60}}};
  json light{{"translation", {2, 2.5, 3}}};
  light["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.json["nodes"].push_back({{"camera", 0}, {"translation", {0, 0, 4}}});
  file.json["nodes"].push_back(light);
  file.json["nodes"].push_back({{"children", {0, 1, 2}}, {"translation", {place.x, place.y, place.z}}});
  file.json["scenes"] = {{{"nodes", {3}}}};
  Scene scene = load_scene(file.write().string(), {});
  scene.shadows.cast = true;
  return scene;
}

TEST(Pictures, AreTheSameFarFromTheOrigin) {
  const Image here = picture(ball_at({0, 0, 0}));
  for (const glm::dvec3& place : {glm::dvec3(1e3, 20, -700), glm::dvec3(500000.3, 4649776.2, 11),
                                  glm::dvec3(3133805.225747891, 5447439.535584584, -992857.7233499398)}) {
    Scene scene = ball_at(place);
    EXPECT_LT(off_by(picture(scene), here), 1e-3) << place.x;
    // Must fail: positions that are rounded where the user has them.
    for (Vertex& vertex : scene.meshes[0].vertices)
      vertex.position = glm::vec3(glm::dvec3(glm::vec3(glm::dvec3(vertex.position) + 100.0 * place)) - 100.0 * place);
    EXPECT_GT(off_by(picture(scene), here), 1e-2) << place.x;
  }
}

TEST(Pictures, AreTheSameAtEveryScale) {
  const auto scene = [](float radius) {
    Scene supplied = load_scene(ball(radius).write().string(), {});
    supplied.environment.reset();
    return supplied;
  };
  const Image whole = picture(scene(1.0F));
  for (const float radius : {1e-6F, 1e-3F, 1e4F, 1e9F})
    EXPECT_LT(off_by(picture(scene(radius)), whole), 1e-3) << radius;
  Scene dim = scene(1e-6F);  // must fail: the point light as far away as for a model of a millimetre
  std::get<PointLight>(dim.lights[2]).position *= 1e3F;
  EXPECT_GT(off_by(picture(dim), whole), 1e-2);
}

}  // namespace
}  // namespace footprint::testing
