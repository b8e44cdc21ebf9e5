// The backs of double-sided surfaces, by every method.
#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

#include "methods/registry.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

Scene seen_from_below() {
  Image normals = random_normals(16, 16, 0.5F, 6);
  for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
    const glm::vec3 n =
        glm::normalize(glm::vec3{normals.texels[i] + 0.3F, normals.texels[i + 1] + 0.2F, normals.texels[i + 2]});
    std::copy_n(&n.x, 3, &normals.texels[i]);
  }
  Scene scene = square_scene(normals, {.brdf = {}, .roughness = 0.6F});
  scene.materials[0].double_sided = true;
  scene.camera.world = glm::mat4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, -3, 1);
  scene.lights = {PointLight{.position = {0.7F, 0.9F, -1.2F}, .intensity = glm::vec3(4.0F), .range = {}}};
  return scene;
}

// The surface whose front is the back of `scene`, with its normals reversed, and its tangents too.
Scene reversed(Scene scene, bool turns_tangents) {
  for (Vertex& vertex : scene.meshes[0].vertices) {
    vertex.normal = -vertex.normal;
    if (turns_tangents) vertex.tangent = -vertex.tangent;
  }
  std::vector<std::uint32_t>& indices = scene.meshes[0].indices;
  for (std::size_t i = 0; i + 2 < indices.size(); i += 3) std::swap(indices[i + 1], indices[i + 2]);
  return scene;
}

double difference_from_reversed(const Method& method, bool turns_tangents) {
  const auto picture = [&](const std::string& key, const auto& scene) {
    return shared_renderer(key, scene, {24, 24}).frame(method, {}, {}, 0, 2.0);
  };
  const Image back = picture("back", seen_from_below);
  const Image front = picture(turns_tangents ? "reversed" : "normals alone reversed",
                              [=] { return reversed(seen_from_below(), turns_tangents); });
  return compare_images(front, back, 1.0F).value().relative_rmse;
}

class BacksByMethod : public ::testing::TestWithParam<const Method*> {};

TEST_P(BacksByMethod, AreTheReversedSurface) { EXPECT_LT(difference_from_reversed(*GetParam(), true), 1e-4); }

TEST(Backs, WithoutReversedTangentsAreAnotherSurface) {  // must fail
  EXPECT_GT(difference_from_reversed(find_method("direct"), false), 0.1);
}

INSTANTIATE_TEST_SUITE_P(Registry, BacksByMethod, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

}  // namespace
}  // namespace footprint::testing
