// Animations, morph targets and skins, against values worked out by hand.
#include "renderer/scene/gltf/pose.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "renderer/scene/model.hpp"
#include "tests/support/expect_near.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/says.hpp"

namespace footprint {
namespace {

using nlohmann::json;
using test::expect_near;
using test::GltfBuilder;
using test::make_quad;
using test::says;
using test::usage_error;

// The quad with an animation of one channel of node 0.
GltfBuilder animated(const std::string& path, const std::vector<float>& times, const std::vector<float>& values,
                     const std::string& type, const std::string& interpolation) {
  GltfBuilder file = make_quad();
  const int input = file.add_floats(times, "SCALAR"), output = file.add_floats(values, type);
  file.json["animations"] = {
      {{"name", "move"},
       {"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", path}}}}}},
       {"samplers", {{{"input", input}, {"output", output}, {"interpolation", interpolation}}}}}};
  return file;
}

Model at(const GltfBuilder& file, double time) { return load_gltf(file.write(), {.time = time}); }

glm::vec3 centre_of(const Model& model) {
  const auto& vertices = model.meshes.at(0).vertices;
  glm::vec3 sum(0.0F);
  for (const Vertex& vertex : vertices) sum += vertex.position;
  return sum / static_cast<float>(vertices.size());
}

TEST(GltfAnimation, TranslationsAreInterpolatedAndHeldBeyondTheKeys) {
  const GltfBuilder file = animated("translation", {1, 3, 4}, {0, 0, 0, 4, 2, 0, 4, 2, 8}, "VEC3", "LINEAR");
  expect_near(centre_of(at(file, 0.0)), {0, 0, 0});
  expect_near(centre_of(at(file, 1.5)), {1, 0.5F, 0});
  expect_near(centre_of(at(file, 3.25)), {4, 2, 2});
  expect_near(centre_of(at(file, 9.0)), {4, 2, 8});
  const GltfBuilder steps = animated("translation", {1, 3}, {0, 0, 0, 4, 2, 0}, "VEC3", "STEP");
  expect_near(centre_of(at(steps, 2.999)), {0, 0, 0});
  expect_near(centre_of(at(steps, 3.0)), {4, 2, 0});
}

TEST(GltfAnimation, HasTheTimeOfItsLastKeyAndAHashOfAllKeys) {
  const auto motion = [](const std::vector<float>& times, const std::vector<float>& values) {
    return at(animated("translation", times, values, "VEC3", "LINEAR"), 0.0).motion;
  };
  const auto own = motion({1, 3}, {0, 0, 0, 4, 2, 0});
  ASSERT_TRUE(own);
  EXPECT_EQ(own->last_key, 3.0);
  EXPECT_EQ(own->content, motion({1, 3}, {0, 0, 0, 4, 2, 0})->content);
  EXPECT_NE(own->content, motion({1, 3}, {0, 0, 0, 4, 2, 1})->content);
  EXPECT_NE(own->content, motion({1, 2}, {0, 0, 0, 4, 2, 0})->content);
  EXPECT_FALSE(load_gltf(make_quad().write()).motion);
}

TEST(GltfAnimation, IsAtRestUnlessATimeOrAnAnimationIsGiven) {
  GltfBuilder file = animated("translation", {0, 1}, {5, 0, 0, 6, 0, 0}, "VEC3", "LINEAR");
  file.json["nodes"][0]["translation"] = {9, 0, 0};
  const Model rest = load_gltf(file.write());
  expect_near(centre_of(rest), {9, 0, 0});
  EXPECT_TRUE(rest.warnings.empty());
  expect_near(centre_of(load_gltf(file.write(), {.animation = "move"})), {5, 0, 0});
  expect_near(centre_of(load_gltf(file.write(), {.animation = "0", .time = 0.5})), {5.5F, 0, 0});
  EXPECT_TRUE(says(usage_error([&] { return load_gltf(file.write(), {.animation = "mave"}); }), "move"));
  EXPECT_TRUE(says(usage_error([&] { return load_gltf(make_quad().write(), {.time = 1.0}); }), "animation"));
}

// Half way of a quarter turn about z, and scales.
TEST(GltfAnimation, RotationsFollowTheShorterArc) {
  const float s = std::sqrt(0.5F);
  for (const float sign : {1.0F, -1.0F}) {  // a quaternion and its negative are one rotation
    const GltfBuilder file = animated("rotation", {0, 1}, {0, 0, 0, 1, 0, 0, sign * s, sign * s}, "VEC4", "LINEAR");
    const Model model = at(file, 0.5);
    for (const Vertex& vertex : model.meshes.at(0).vertices) {
      const bool is_on_an_axis = std::min(std::abs(vertex.position.x), std::abs(vertex.position.y)) < 1e-6F;
      EXPECT_TRUE(is_on_an_axis) << "corners at 45 degrees are turned by 45 degrees";
      expect_near(vertex.normal, {0, 0, 1});
    }
  }
  const Model scaled = at(animated("scale", {0, 1}, {1, 1, 1, 3, 1, 1}, "VEC3", "LINEAR"), 0.5);
  EXPECT_NEAR(std::abs(scaled.meshes.at(0).vertices[0].position.x), 2.0F, 1e-6F);
}

// glTF 2.0, appendix C.5 with keys at 0 and 2 s: at 0.5 s, t = 1/4.
TEST(GltfAnimation, SplinesHaveTangentsInUnitsPerSecond) {
  const GltfBuilder file = animated("translation", {0, 2},
                                    {9, 9, 9, 1, 0, 0, 0, 4, 0,  // before, value, after
                                     0, 0, 8, 3, 0, 0, 9, 9, 9},
                                    "VEC3", "CUBICSPLINE");
  const double t = 0.25, value0 = 2 * t * t * t - 3 * t * t + 1, leave = 2 * (t * t * t - 2 * t * t + t),
               value1 = 3 * t * t - 2 * t * t * t, arrive = 2 * (t * t * t - t * t);
  expect_near(centre_of(at(file, 0.5)),
              {static_cast<float>(value0 + 3 * value1), static_cast<float>(4 * leave), static_cast<float>(8 * arrive)});
  expect_near(centre_of(at(file, 2.0)), {3, 0, 0});
}

// Targets of the quad that lift it and push it, with normals that lean.
GltfBuilder morphed() {
  GltfBuilder file = make_quad();
  const auto four = [](const std::vector<float>& one) {
    std::vector<float> all;
    for (int i = 0; i < 4; ++i) all.insert(all.end(), one.begin(), one.end());
    return all;
  };
  const int up = file.add_floats(four({0, 0, 2}), "VEC3"), aside = file.add_floats(four({4, 0, 0}), "VEC3");
  const int lean = file.add_floats(four({1, 0, 0}), "VEC3");
  file.json["meshes"][0]["primitives"][0]["targets"] = {{{"POSITION", up}}, {{"POSITION", aside}, {"NORMAL", lean}}};
  return file;
}

TEST(GltfMorph, WeightsAreTheAnimationsThenTheNodesThenTheMeshes) {
  GltfBuilder file = morphed();
  expect_near(centre_of(load_gltf(file.write())), {0, 0, 0});
  file.json["meshes"][0]["weights"] = {0.5, 0.25};
  expect_near(centre_of(load_gltf(file.write())), {1, 0, 1});
  file.json["nodes"][0]["weights"] = {0, 1};
  const Model model = load_gltf(file.write());
  expect_near(centre_of(model), {4, 0, 0});
  expect_near(model.meshes.at(0).vertices[0].normal, {std::sqrt(0.5F), 0, std::sqrt(0.5F)});
  const int times = file.add_floats({0, 1}, "SCALAR"), weights = file.add_floats({0, 0, 1, 1}, "SCALAR");
  file.json["animations"] = {{{"channels", {{{"sampler", 0}, {"target", {{"node", 0}, {"path", "weights"}}}}}},
                              {"samplers", {{{"input", times}, {"output", weights}}}}}};
  expect_near(centre_of(at(file, 0.5)), {2, 0, 1});
}

// The quad with a skin of two joints, nodes 1 and 2; vertices 0 and 1 have half of each, the others weights of `other`.
GltfBuilder skinned(const std::vector<float>& other) {
  GltfBuilder file = make_quad();
  file.json["nodes"][0]["skin"] = 0;
  file.json["nodes"][0]["translation"] = {100, 0, 0};  // has no effect on a skinned mesh
  file.json["nodes"].push_back({{"translation", {2, 0, 0}}});
  file.json["nodes"].push_back({{"translation", {0, 6, 0}}});
  file.json["scenes"] = {{{"nodes", {0, 1, 2}}}};
  std::vector<float> weights{0.5F, 0.5F, 0, 0, 0.5F, 0.5F, 0, 0};
  for (int i = 0; i < 2; ++i) weights.insert(weights.end(), other.begin(), other.end());
  std::vector<float> inverse(32, 0.0F);  // of joint 0 a shift by -1 along x
  for (const std::size_t i : {0U, 5U, 10U, 15U}) inverse[i] = inverse[16 + i] = 1.0F;
  inverse[12] = -1.0F;
  json& attributes = file.json["meshes"][0]["primitives"][0]["attributes"];
  const std::vector<std::uint8_t> joints{0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1, 0, 0};
  attributes["JOINTS_0"] = file.add_accessor(joints, 5121, 4, "VEC4");
  attributes["WEIGHTS_0"] = file.add_floats(weights, "VEC4");
  file.json["skins"] = {{{"joints", {1, 2}}, {"inverseBindMatrices", file.add_floats(inverse, "MAT4")}}};
  return file;
}

// Vertex i of make_quad, wherever it is among the model's.
const Vertex& corner(const Model& model, int i) {
  const glm::vec2 uv(i == 1 || i == 2 ? 1.0F : 0.0F, i >= 2 ? 1.0F : 0.0F);
  return *std::ranges::find(model.meshes.at(0).vertices, uv, &Vertex::uv0);
}

glm::vec3 shift_of(const Model& model, int i) {
  return corner(model, i).position - corner(load_gltf(make_quad().write()), i).position;
}

TEST(GltfSkin, VerticesFollowTheirJoints) {
  const Model model = load_gltf(skinned({0, 1, 0, 0}).write());
  for (int i = 0; i < 4; ++i) {
    expect_near(shift_of(model, i), i < 2 ? glm::vec3(0.5F, 3, 0) : glm::vec3(0, 6, 0));
    expect_near(corner(model, i).normal, {0, 0, 1});
  }
  EXPECT_TRUE(model.warnings.empty());
}

TEST(GltfSkin, WeightsAreDividedByTheirSumAndTheFirstJointTakesOver) {
  const Model large = load_gltf(skinned({0, 4, 0, 0}).write()), none = load_gltf(skinned({0, 0, 0, 0}).write());
  expect_near(shift_of(large, 3), {0, 6, 0});
  expect_near(shift_of(none, 3), {1, 0, 0});
  EXPECT_TRUE(says(large.warnings.at(0), "2 vertices whose joints' weights do not sum to 1"));
  EXPECT_TRUE(says(load_gltf(skinned({0, NAN, 0, 0}).write()).warnings.at(0), "do not sum to 1"));
}

TEST(GltfPose, BrokenFilesAreRefusedAtTheirPlace) {
  const auto refused = [](const GltfBuilder& file) { return usage_error([&] { return at(file, 0.5); }); };
  EXPECT_TRUE(says(refused(animated("translation", {1, 1}, {0, 0, 0, 1, 1, 1}, "VEC3", "LINEAR")), "key 1"));
  EXPECT_TRUE(says(refused(animated("translation", {0, 1}, {0, 0, 0}, "VEC3", "LINEAR")), "3 numbers for 2 keys"));
  EXPECT_TRUE(says(refused(animated("rotation", {0, 1}, {0, 0, 0, 0, 0, 0, 0, 1}, "VEC4", "LINEAR")), "no length"));
  EXPECT_TRUE(says(refused(animated("scale", {0, 1}, {NAN, 0, 0, 1, 1, 1}, "VEC3", "LINEAR")), "not finite"));
  GltfBuilder other = animated("translation", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3", "LINEAR");
  other.json["animations"][0]["channels"][0]["sampler"] = 7;
  EXPECT_TRUE(says(refused(other), "sampler 7"));
  GltfBuilder fixed = animated("translation", {0, 1}, {0, 0, 0, 1, 1, 1}, "VEC3", "LINEAR");
  fixed.json["nodes"][0]["matrix"] = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1};
  EXPECT_TRUE(says(refused(fixed), "has a matrix"));
  GltfBuilder few = skinned({1, 0, 0, 0});
  few.json["skins"][0]["joints"] = {1};
  EXPECT_TRUE(says(usage_error([&] { return load_gltf(few.write()); }), "names joint 1 of 1"));
  GltfBuilder cycle = skinned({1, 0, 0, 0});
  cycle.json["nodes"][1]["children"] = {2};
  cycle.json["nodes"][2]["children"] = {1};
  EXPECT_FALSE(usage_error([&] { return load_gltf(cycle.write()); }).empty());
}

}  // namespace
}  // namespace footprint
