// Every method and the reference draw texels with normals that spread as texels of the effective lobe, made by hand.
#include <gtest/gtest.h>

#include <algorithm>

#include "renderer/image/image_io.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/gltf_builder.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr double base_exponent = 200.0;

// A bumpy plane of exponent 200 with a further map.
Scene bumpy_plane(const std::string& brdf, const std::string& map, int side) {
  const auto folder = test::write_file("spread/made.txt", "").parent_path();
  const Image normals = random_normals(side, side, 0.3F, 7);
  Image stored(side, side, 3), kappas(side, side, 1), exponents(side, side, 1);
  for (std::size_t i = 0; i < normals.texel_count(); ++i) {
    std::copy_n(&normals.texels[4 * i], 3, &stored.texels[3 * i]);
    kappas.texels[i] = i % 3 == 0 ? 16.0F : 500.0F;
    exponents.texels[i] =
        static_cast<float>(kappas.texels[i] * base_exponent / (kappas.texels[i] + base_exponent));  // equation 13
  }
  write_exr(folder / "normals.exr", stored);
  write_exr(folder / "kappa.exr", kappas);
  write_exr(folder / "exponent.exr", exponents);
  const std::string scene =
      "[plane]\nsize = [2, 2]\nnormal_map = \"normals.exr\"\n[brdf]\ndistribution = \"blinn_phong\"\ndiffuse = "
      "false\nspecular = [0.9, 0.9, 0.9]\n" +
      brdf + "[maps]\n" + map + "\n";
  return load_scene(test::write_file("spread/scene.toml", scene).string(), {});
}

Scene spread_normals_plane(int side) {
  return bumpy_plane("exponent = 200\n", "normal_kappa = { file = \"kappa.exr\" }", side);
}
Scene effective_lobes_plane(int side) { return bumpy_plane("", "exponent = { file = \"exponent.exr\" }", side); }

double image_difference(const Image& one, const Image& other) {
  return compare_images(one, other, 1.0F).value().relative_rmse;
}

class TexelSpreadImages : public ::testing::TestWithParam<const Method*> {};

TEST_P(TexelSpreadImages, AreThoseOfTheEffectiveLobes) {
  const int side = map_side(*GetParam(), 16);
  TestRenderer spread(spread_normals_plane(side), {32, 32}), by_hand(effective_lobes_plane(side), {32, 32});
  for (const double distance : {1.0, 8.0}) {
    EXPECT_LT(image_difference(spread.frame(*GetParam(), {}, {}, 0, distance),
                               by_hand.frame(*GetParam(), {}, {}, 0, distance)),
              1e-5);
  }
}

INSTANTIATE_TEST_SUITE_P(Registry, TexelSpreadImages, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

TEST(TexelSpreadReference, IsThatOfTheEffectiveLobes) {
  const Image spread = TestRenderer(spread_normals_plane(16), {32, 32}).reference(16).mean;
  EXPECT_LT(image_difference(spread, TestRenderer(effective_lobes_plane(16), {32, 32}).reference(16).mean), 1e-6);
  const Scene narrow = bumpy_plane("exponent = 200\n", "", 16);
  EXPECT_GT(image_difference(spread, TestRenderer(narrow, {32, 32}).reference(16).mean), 0.05);
}

}  // namespace
}  // namespace footprint::testing
