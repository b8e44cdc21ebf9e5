// Scenes far from the origin are the scene at the origin, however a file places them.
#include "renderer/scene/origin.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::GltfBuilder;

WideBounds cube(const glm::dvec3& centre, double half) {
  WideBounds bounds;
  bounds.add(centre - half);
  bounds.add(centre + half);
  return bounds;
}

TEST(Origin, IsZeroForWhatIsNear) {
  EXPECT_EQ(origin_for(WideBounds{}), glm::dvec3(0.0));
  EXPECT_EQ(origin_for(cube({0, 0, 0}, 1)), glm::dvec3(0.0));
  EXPECT_EQ(origin_for(cube({27, 0, 0}, 1)), glm::dvec3(0.0));  // 16 radii are 27.7
  EXPECT_EQ(origin_for(cube({28, 0, 0}, 1)), glm::dvec3(28, 0, 0));
  EXPECT_EQ(origin_for(cube({28, 0, 0}, 1), {20, 0, 0}), glm::dvec3(20, 0, 0));
  EXPECT_EQ(origin_for(cube({28e-6, 0, 0}, 1e-6)), glm::dvec3(28e-6, 0, 0));  // at any scale
  EXPECT_EQ(origin_for(cube({3, 0, 0}, 0)), glm::dvec3(3, 0, 0));
}

TEST(Origin, WarnsWhere64BitsRound) {
  EXPECT_EQ(rounding_warning(cube({6e6, 0, 0}, 1)), "");
  EXPECT_EQ(rounding_warning(cube({4e9, 0, 0}, 1)), "");
  EXPECT_NE(rounding_warning(cube({2e10, 0, 0}, 1)), "");
  EXPECT_EQ(rounding_warning(WideBounds{}), "");
}

const std::array<glm::dvec3, 5> corners{
    {{0.1, 0.2, 0.3}, {1.3, -0.2, 0.1}, {0.9, 1.1, -0.4}, {-0.7, 0.8, 0.9}, {0.4, -0.9, -0.8}}};
const glm::dvec3 lamp{1.75, 2.5, 3.125}, eye{0.25, 0.5, 4.75};

std::vector<float> floats(std::initializer_list<glm::dvec3> points) {
  std::vector<float> values;
  for (const glm::dvec3& point : points) {
    for (int axis = 0; axis < 3; ++axis) values.push_back(static_cast<float>(point[axis]));
  }
  return values;
}

json three(const glm::dvec3& v) { return {v.x, v.y, v.z}; }

// Three triangles, a light and a camera, all below node 0, which may be given a transform.
GltfBuilder small_scene() {
  GltfBuilder file;
  const int positions = file.add_floats(floats({corners[0], corners[1], corners[2], corners[3], corners[4]}), "VEC3");
  const int indices = file.add_indices({0, 1, 2, 0, 2, 3, 0, 3, 4});
  file.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}, {"indices", indices}}}}}};
  file.json["cameras"] = {{{"type", "perspective"}, {"perspective", {{"yfov", 0.7}, {"znear", 0.05}}}}};
  file.json["extensions"]["KHR_lights_punctual"]["lights"] = {{{"type", "spot"}, {"spot", json::object()}}};
  json light{{"translation", three(lamp)}};
  light["extensions"]["KHR_lights_punctual"]["light"] = 0;
  file.json["nodes"] = {{{"children", {1, 2, 3}}}, {{"mesh", 0}}, {{"camera", 0}, {"translation", three(eye)}}, light};
  file.json["scenes"] = {{{"nodes", {0}}}};
  return file;
}

using Write = std::string (*)(const glm::dvec3& shift);

std::string by_node(const glm::dvec3& shift) {
  GltfBuilder file = small_scene();
  file.json["nodes"][0]["translation"] = three(shift);
  return file.write().string();
}

// Two translations of which the second takes most of the first away again.
std::string by_nested_nodes(const glm::dvec3& shift) {
  GltfBuilder file = small_scene();
  file.json["nodes"][0]["translation"] = three(-2.0 * shift);
  file.json["nodes"].push_back({{"children", {0}}, {"translation", three(3.0 * shift)}});
  file.json["scenes"] = {{{"nodes", {4}}}};
  return file.write().string();
}

std::string by_matrix(const glm::dvec3& shift) {
  GltfBuilder file = small_scene();
  file.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, shift.x, shift.y, shift.z, 1};
  return file.write().string();
}

// The mesh by a joint, which its own node does not move.
std::string by_joint(const glm::dvec3& shift) {
  GltfBuilder file = small_scene();
  json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
  attributes["JOINTS_0"] = file.add_accessor(std::vector<std::uint8_t>(20, 0), 5121, 5, "VEC4");
  std::vector<float> weights;
  for (int i = 0; i < 5; ++i) weights.insert(weights.end(), {0.5F, 0.5F, 0, 0});
  attributes["WEIGHTS_0"] = file.add_floats(weights, "VEC4");
  file.json["nodes"][0]["translation"] = three(shift);
  file.json["nodes"][1]["skin"] = 0;
  file.json["nodes"].push_back(json::object());
  file.json["nodes"][0]["children"].push_back(4);
  file.json["skins"] = {{{"joints", {4}}}};
  return file.write().string();
}

std::string write_settings(const std::string& model, const glm::dvec3& shift) {
  const auto words = [](const glm::dvec3& v) { return fmt::format("[{:.6f}, {:.6f}, {:.6f}]", v.x, v.y, v.z); };
  return test::write_file(
             "far/scene.toml",
             fmt::format("{}\n[camera]\nposition = {}\ntarget = {}\nznear = 0.05\nyfov_degrees = 40.107\n"
                         "[lights]\nkeep = false\n[[light]]\ntype = \"spot\"\nposition = {}\ndirection = [0, 0, -1]\n",
                         model, words(eye + shift), words(eye + shift - glm::dvec3(0, 0, 1)), words(lamp + shift)))
      .string();
}

// By the place of a part, with the camera and the light of the scene.toml.
std::string by_part(const glm::dvec3& shift) {
  const GltfBuilder file = small_scene();
  test::write_file("far/part.gltf", file.text());
  return write_settings(fmt::format("[[part]]\nname = \"p\"\nmodel = {{ file = \"part.gltf\" }}\n"
                                    "place = {{ translate = [{:.6f}, {:.6f}, {:.6f}] }}",
                                    shift.x, shift.y, shift.z),
                        shift);
}

// By the numbers of an OBJ file.
std::string by_obj(const glm::dvec3& shift) {
  std::string text;
  for (const glm::dvec3& corner : corners)
    text += fmt::format("v {:.6f} {:.6f} {:.6f}\n", corner.x + shift.x, corner.y + shift.y, corner.z + shift.z);
  test::write_file("far/model.obj", text + "f 1 2 3\nf 1 3 4\nf 1 4 5\n");
  return write_settings("[model]\nfile = \"model.obj\"", shift);
}

// The positions of triangles, camera and light, in the user's coordinates less `shift`.
std::vector<glm::dvec3> places(const Scene& scene, const glm::dvec3& shift) {
  std::vector<glm::dvec3> all;
  const auto add = [&](const glm::vec3& at) { all.push_back(glm::dvec3(at) + (scene.origin - shift)); };
  for (const std::uint32_t index : scene.meshes.at(0).indices) add(scene.meshes[0].vertices[index].position);
  add(glm::vec3(scene.camera.world[3]));
  add(std::get<SpotLight>(scene.lights.at(0)).point.position);
  add(scene.bounds.lower);
  add(scene.bounds.upper);
  return all;
}

double largest_shift(const std::vector<glm::dvec3>& a, const std::vector<glm::dvec3>& b) {
  double largest = a.size() == b.size() ? 0.0 : 1e9;
  for (std::size_t i = 0; i < std::min(a.size(), b.size()); ++i) largest = std::max(largest, glm::distance(a[i], b[i]));
  return largest;
}

class FarScene : public ::testing::TestWithParam<Write> {};

TEST_P(FarScene, IsTheSceneAtTheOrigin) {
  const auto places_at = [](const glm::dvec3& shift) { return places(load_scene(GetParam()(shift), {}), shift); };
  const std::vector<glm::dvec3> here = places_at(glm::dvec3(0.0));
  for (const glm::dvec3& shift :
       {glm::dvec3(300, 0, 0), glm::dvec3(1e4, -7, 2.5e3), glm::dvec3(500000.25, 4649776.5, 9),
        glm::dvec3(3133805.225747, 5447439.535584, -992857.723349)}) {
    EXPECT_LT(largest_shift(places_at(shift), here), 1e-6) << shift.x;
    // Must fail: what 32 bits of the user's own coordinates would leave.
    std::vector<glm::dvec3> rounded = here;
    for (glm::dvec3& at : rounded) at = glm::dvec3(glm::vec3(at + shift)) - shift;
    EXPECT_GT(largest_shift(rounded, here), 3e-6) << shift.x;
  }
}

INSTANTIATE_TEST_SUITE_P(Ways, FarScene,
                         ::testing::Values(by_node, by_nested_nodes, by_matrix, by_joint, by_part, by_obj));

TEST(Origin, OfASceneNearZeroIsZero) {
  const Scene scene = load_scene(by_node({4, 5, -6}), {});
  EXPECT_EQ(scene.origin, glm::dvec3(0.0));
  EXPECT_EQ(glm::vec3(scene.camera.world[3]), glm::vec3(eye + glm::dvec3(4, 5, -6)));
}

// Poses of an animation share the origin and the bounds that are given.
TEST(Origin, IsTheGivenOne) {
  const glm::dvec3 shift(1e6, 2e6, 3e6);
  const PlacedBounds given{{glm::vec3(-5), glm::vec3(5)}, shift + 1.0};
  SceneOverrides overrides;
  overrides.bounds = given;
  const Scene scene = load_scene(by_node(shift), {}, overrides);
  EXPECT_EQ(scene.origin, given.origin);
  EXPECT_EQ(scene.bounds.upper, given.bounds.upper);
  EXPECT_LT(glm::distance(glm::dvec3(glm::vec3(scene.camera.world[3])), eye - 1.0), 1e-6);
}

TEST(Origin, PositionsThat64BitsRoundAreNamed) {
  EXPECT_TRUE(load_scene(by_node({1e9, 0, 0}), {}).warnings.empty());
  const std::vector<std::string> warnings = load_scene(by_node({1e12, 0, 0}), {}).warnings;
  ASSERT_EQ(warnings.size(), 1U);
  EXPECT_NE(warnings[0].find("64 bits round its positions"), std::string::npos);
}

}  // namespace
}  // namespace footprint
