// Footprints whose texels are drawn at random: the mean over many draws is the filter after shading, for every method.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <map>
#include <memory>
#include <string>

#include "methods/registry.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

class StochasticFilters : public ::testing::TestWithParam<const Method*> {};

// Pixels of 8 x 8 texels: draws of the finest level leave nothing to prefilter, so every method converges to the
// reference that filters after shading. 256 draws have a sixteenth of the error of one.
TEST_P(StochasticFilters, ConvergeToTheReference) {
  if (!GetParam()->info.resolves_texels) GTEST_SKIP() << "has one BRDF for the whole map";
  const int side = map_side(*GetParam(), 128, 64);
  const auto scene = [side] {
    return square_scene(random_normals(side, side, 0.5F, 7), {.brdf = {}, .roughness = 0.5F});
  };
  TestRenderer& renderer =
      shared_renderer("8 x 8 texels per pixel, drawn " + std::to_string(side), scene, {side / 8, side / 8});
  static std::map<int, Image> references;
  if (!references.contains(side)) references[side] = renderer.reference(4096).mean;
  const Image& reference = references[side];
  const double one = error_of(renderer.mean_frame(*GetParam(), {}, filter_of("stochastic:1"), 1), reference);
  const double many = error_of(renderer.mean_frame(*GetParam(), {}, filter_of("stochastic:16"), 16), reference);
  EXPECT_GT(one, 0.1);
  EXPECT_LT(many, one / 12.0);
}

TEST_P(StochasticFilters, HaveNothingToDoWhereNothingVaries) {
  const auto scene = [] {
    Image normals = constant_normals(32, 32, {0.28F, 0, 0.96F});
    normals.at(0, 0)[0] += 2e-5F;  // keeps a flat map from being left out, and is not a visible bump
    return square_scene(normals, {});
  };
  TestRenderer& renderer = shared_renderer("nothing varies, drawn", scene);
  const Image direct = renderer.frame(find_method("direct"));
  const std::array filters{"stochastic", "stochastic:2:1", "stochastic_gaussian:3", "stochastic_trilinear:2:0"};
  for (const char* const text : sweep(filters, 2, 2 * method_number(*GetParam())))
    EXPECT_LT(error_of(renderer.frame(*GetParam(), {}, filter_of(text)), direct), 1e-3) << text;
}

INSTANTIATE_TEST_SUITE_P(Registry, StochasticFilters, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& tested) { return tested.param->info.name; });

// A square of two colours under Lambert's term, which is linear in them: the mean over the draws is the filtered
// colour. The colours are the same upside down.
Scene colours(const std::array<float, 2>& of_two, Wrap wrap = Wrap::repeat) {
  Scene scene = square_scene({}, {.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                                  .specular = glm::vec3(0.0F)});
  auto texels = std::make_shared<Image>(64, 64, 4, 1.0F);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const int patch =
          x / 3 + 22 * (std::min(y, 63 - y) / 3);  // as wide as pixels' footprints, so that kernels differ
      texels->at(x, y)[0] = of_two[patch * 7919 % 13 < 5 ? 0 : 1];
    }
  }
  scene.materials[0].base_color_map = TextureMap{"colours", texels, {.wrap = {wrap, wrap}}};
  return scene;
}

constexpr std::array<float, 2> red_and_dark{1.0F, 0.1F}, white{1.0F, 1.0F};

// Footprints that are sheared, and of a map that repeats, ends or is mirrored within the image.
Scene receding_colours(Wrap wrap) {
  Scene scene = colours(red_and_dark, wrap);
  scene.camera = receding_grooves().camera;
  scene.camera.world = glm::rotate(glm::mat4(1.0F), 0.4F, glm::vec3(0.0F, 0.0F, 1.0F)) * scene.camera.world;
  scene.materials[0].base_color_map->coordinates.transform = {1.6F, 0.0F, 0.0F, 1.6F, -0.3F, -0.3F};
  return scene;
}

double rms_difference(const Image& a, const Image& b) {
  double sum = 0, count = 0;
  for (std::size_t i = 0; i < a.texels.size(); i += 4) {
    if (b.texels[i + 3] < 1.0F) continue;
    sum += std::pow(static_cast<double>(a.texels[i]) - b.texels[i], 2);
    count += 1;
  }
  return std::sqrt(sum / count);
}

constexpr std::uint32_t frames = 64;  // of 16 draws

// What as many independent draws as those frames have would leave of the deviation of one; the sequences leave less.
double most_of_all_draws(TestRenderer& renderer, const Image& mean) {
  return rms_difference(renderer.mean_frame(find_method("direct"), {}, filter_of("stochastic:1"), 1), mean) / 32.0;
}

TEST(StochasticFilter, DrawsAverageToTheFilterThatTheyAreDrawnFrom) {
  for (const Wrap wrap : {Wrap::repeat, Wrap::clamp_to_edge, Wrap::mirrored_repeat}) {
    TestRenderer renderer(receding_colours(wrap), {20, 20});
    const auto filtered = [&](const char* text) { return renderer.frame(find_method("direct"), {}, filter_of(text)); };
    const double most = most_of_all_draws(renderer, filtered("shaded:8"));
    const auto expect_mean = [&](const char* drawn, const char* filter) {
      const Image mean = renderer.mean_frame(find_method("direct"), {}, filter_of(drawn), frames);
      EXPECT_LT(rms_difference(mean, filtered(filter)), most) << drawn << " " << filter;
    };
    expect_mean("stochastic:16:0", "trilinear");
    expect_mean("stochastic:16:1", "shaded:2");
    expect_mean("stochastic:16:3", "shaded:8");
    expect_mean("stochastic_gaussian:16:0", "trilinear");
    expect_mean("stochastic_trilinear:16:0", "trilinear");
    expect_mean("stochastic_trilinear:16:1", "trilinear");
    expect_mean("stochastic_trilinear:16", "trilinear");
    for (const char* const other : {"trilinear", "shaded:2"})
      EXPECT_GT(rms_difference(filtered(other), filtered("shaded:8")), 2.0 * most) << "another kernel";
  }
}

// Against Heckbert's Gaussian summed in double precision over the square, which is seen from straight above.
TEST(StochasticFilter, GaussianDrawsAverageToTheGaussian) {
  constexpr int size = 10;
  TestRenderer renderer(colours(red_and_dark), {size, size});
  const Image map = colours(red_and_dark).materials[0].base_color_map->image.decoded();
  const auto red_at = [&](double x, double y) {  // bilinear, x and y in texels
    const double left = std::floor(x - 0.5), top = std::floor(y - 0.5);
    double sum = 0;
    for (int i = 0; i < 4; ++i) {
      const double column = left + (i & 1), row = top + (i >> 1);
      const double weight = (1.0 - std::abs(x - 0.5 - column)) * (1.0 - std::abs(y - 0.5 - row));
      sum += weight * map.at((static_cast<int>(column) + 128) % 64, (static_cast<int>(row) + 128) % 64)[0];
    }
    return sum;
  };
  const Image whole = TestRenderer(colours(white), {size, size}).frame(find_method("direct"));
  Image expected = whole;
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      double sum = 0, weights = 0;
      for (double v = -0.99; v < 1.0; v += 0.02) {
        for (double u = -0.99; u < 1.0; u += 0.02) {
          if (u * u + v * v > 1.0) continue;
          const double weight = std::exp(-2.0 * (u * u + v * v));
          sum += weight * red_at(64.0 * (x + 0.5 + u) / size, 64.0 * (y + 0.5 + v) / size);
          weights += weight;
        }
      }
      expected.at(x, y)[0] *= static_cast<float>(sum / weights);
    }
  }
  const double most = most_of_all_draws(renderer, expected);
  const Image drawn = renderer.mean_frame(find_method("direct"), {}, filter_of("stochastic_gaussian:16"), frames);
  EXPECT_LT(rms_difference(drawn, expected), most);
  const Image box = renderer.mean_frame(find_method("direct"), {}, filter_of("stochastic:16"), frames);
  EXPECT_GT(rms_difference(box, expected), 2.0 * most) << "the box is another kernel";
}

TEST(StochasticFilter, FramesFollowTheSeedAndTheirNumberAlone) {
  TestRenderer renderer(receding_colours(Wrap::repeat), {20, 20});
  const auto drawn = [&](std::uint32_t count, std::uint64_t seed, int tile = 0) {
    return renderer.mean_frame(find_method("direct"), {}, filter_of("stochastic:2"), count, seed, tile);
  };
  const Image first = drawn(1, 5);
  EXPECT_EQ(drawn(1, 5), first);
  const double other_seed = rms_difference(drawn(1, 6), first);
  EXPECT_GT(other_seed, 0.02);
  EXPECT_GT(rms_difference(drawn(2, 5), first), 0.02);
  // Coordinates are rounded otherwise in a tile, so that a few draws may fall on the texel beside.
  EXPECT_LT(rms_difference(drawn(1, 5, 8), first), 0.2 * other_seed) << "in tiles";
}

TEST(StochasticFilter, CountsALookupAndALobePerDraw) {
  TestRenderer renderer(square_scene(random_normals(64, 64, 0.5F, 7), {.brdf = {}, .roughness = 0.5F}), {16, 16});
  for (const char* const text : {"stochastic:4", "stochastic_gaussian:4:1", "stochastic_trilinear:4:2"}) {
    const PixelWork work = renderer.work(find_method("naive_mip"), "naive_mip", filter_of(text));
    EXPECT_NEAR(work.lookups, 4, 1e-6) << text;
    EXPECT_NEAR(work.lobes, 4, 1e-6) << text;
  }
}

}  // namespace
}  // namespace footprint::testing
