// Every method and the reference draw a scene with a height map as the scene with the normal map made from it by hand.
#include <gtest/gtest.h>

#include <cmath>

#include "methods/registry.hpp"
#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/rendering.hpp"

namespace footprint::testing {
namespace {

constexpr double height_scale = 0.08;

Image some_heights(int side) {
  Image heights(side, side, 1);
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x)
      heights.at(x, y)[0] = static_cast<float>((7 * x * x + 5 * y * y + 3 * x * y) % 32) / 32;
  }
  return heights;
}

// The slopes of central differences, up the rows and around the border.
Image normals_by_hand(const Image& heights) {
  const int side = heights.width;
  Image normals(side, side, 3);
  const auto height = [&](int x, int y) { return static_cast<double>(heights.at(x & (side - 1), y & (side - 1))[0]); };
  for (int y = 0; y < side; ++y) {
    for (int x = 0; x < side; ++x) {
      const double right = (height(x + 1, y) - height(x - 1, y)) / 2.0 * height_scale * side;
      const double up = (height(x, y - 1) - height(x, y + 1)) / 2.0 * height_scale * side;
      const double length = std::sqrt(right * right + up * up + 1.0);
      normals.at(x, y)[0] = static_cast<float>(-right / length);
      normals.at(x, y)[1] = static_cast<float>(-up / length);
      normals.at(x, y)[2] = static_cast<float>(1.0 / length);
    }
  }
  return normals;
}

// Two scenes that differ in the file of the plane's normals.
struct Twins {
  Scene heights, normals;
};

Twins load_twins(const std::string& before, const std::string& height_key, const std::string& normal_key,
                 int side = 32) {
  const Image heights = some_heights(side);
  const auto folder = test::write_file("heights/made.txt", "").parent_path();
  write_exr(folder / "heights.exr", heights);
  write_exr(folder / "normals.exr", normals_by_hand(heights));
  const auto load = [&](const std::string& key) {
    return load_scene(test::write_file("heights/scene.toml", before + key).string(), {});
  };
  return {load(height_key + "{ file = \"heights.exr\", scale = 0.08 }\n"), load(normal_key)};
}

Twins planes(int side) {
  return load_twins("[plane]\nsize = [2, 2]\n", "height_map = ", "normal_map = \"normals.exr\"\n", side);
}

double difference(const Image& one, const Image& other) {
  return compare_images(one, other, 1.0F).value().relative_rmse;
}

class HeightMaps : public ::testing::TestWithParam<const Method*> {};

TEST_P(HeightMaps, AreDrawnAsTheirNormals) {
  const Twins twins = planes(map_side(*GetParam(), 32));
  TestRenderer heights(twins.heights), normals(twins.normals);
  const Method& method = *GetParam();
  const std::string text = method.info.name == "leadr" ? "leadr:weighting=displacement" : std::string();
  for (const double distance : {1.0, 8.0}) {
    EXPECT_LT(difference(heights.frame(method, text, {}, 0, distance), normals.frame(method, text, {}, 0, distance)),
              1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, HeightMaps, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

TEST(HeightMapsOfTheReference, AreDrawnAsTheirNormals) {
  const Twins twins = planes(32);
  EXPECT_LT(difference(TestRenderer(twins.heights).reference(4).mean, TestRenderer(twins.normals).reference(4).mean),
            1e-6);
}

// Over the material of a glTF file, and under a coat: the same texels as from the normal map.
TEST(HeightMapsOfModels, AreThoseOfTheirNormals) {
  const std::string model = test::make_quad().write().string();
  const std::string start = "[model]\nfile = \"" + model + "\"\n";
  const auto expect_equal = [](const TextureMap& one, const TextureMap& other) {
    const Image a = one.image.decoded(), b = other.image.decoded();
    ASSERT_EQ(a.texels.size(), b.texels.size());
    for (std::size_t i = 0; i < a.texels.size(); ++i) ASSERT_NEAR(a.texels[i], b.texels[i], 1e-6) << i;
    EXPECT_EQ(one.coordinates, other.coordinates);
  };
  const Twins laid =
      load_twins(start + "[tiling]\nuv = [2, 3]\n[maps]\n", "height = ", "normal = { file = \"normals.exr\" }\n");
  expect_equal(laid.heights.materials[0].normal_map.value(), laid.normals.materials[0].normal_map.value());
  EXPECT_EQ(laid.heights.materials[0].normal_map->coordinates.transform * glm::vec3(1, 1, 1), glm::vec2(2, 3));
  const Twins coated = load_twins(start + "[clear_coat]\n", "height_map = ", "normal_map = \"normals.exr\"\n");
  expect_equal(coated.heights.materials[0].coat->normal_map.value(),
               coated.normals.materials[0].coat->normal_map.value());
}

TEST(HeightMapsOfModels, ThatAreNotFiniteNameFileAndTexel) {
  Image heights = some_heights(32);
  heights.at(5, 6)[0] = std::nanf("");
  const auto folder = test::write_file("heights/made.txt", "").parent_path();
  EXPECT_THROW(write_exr(folder / "bad.exr", heights), Error);  // once it is written
  const auto scene = test::write_file("heights/bad.toml", "[plane]\nheight_map = { file = \"bad.exr\", scale = 1 }\n");
  const std::string error = test::usage_error([&] { return load_scene(scene.string(), {}); });
  EXPECT_NE(error.find("bad.exr"), std::string::npos) << error;
  EXPECT_NE(error.find("texel (5, 6)"), std::string::npos) << error;
}

}  // namespace
}  // namespace footprint::testing
