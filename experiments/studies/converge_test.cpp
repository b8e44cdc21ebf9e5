// Which tiles of a reference go on, and what they come to.
#include "experiments/studies/reference_noise.hpp"

#include <gtest/gtest.h>

#include "renderer/pipeline/base_surface.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr std::uint64_t fixed_seed = 3;
constexpr glm::ivec2 size{256, 128};  // two tiles: the left one rough, the right one flat

// Random normals on the left half of the square, one normal on the right.
Scene half_flat() {
  Image normals = random_normals(256, 256, 0.6F, 5);
  const Image flat = constant_normals(1, 1, {0, 0, 1});
  for (int y = 0; y < 256; ++y) {
    for (int x = 128; x < 256; ++x) std::ranges::copy(flat.at(0, 0), normals.at(x, y).begin());
  }
  SquareMaterial material;
  material.roughness = 0.3F;
  return square_scene(normals, material);
}

class Converge : public ::testing::Test {
 protected:
  Converge()
      : context_(shared_context()),
        scene_(half_flat()),
        gpu_(context_.info(), scene_, effects_on(derive_effects(scene_))),
        baked_(bake(base_surface(), {.text = "reference", .name = "reference", .options = {}}, scene_,
                    effects_on(derive_effects(scene_)), no_progress)),
        method_(gpu_, baked_),
        sampler_(context_.info(), gpu_, method_, Sampling::after_shading, false) {}

  [[nodiscard]] Supersampled picture(int spp) const { return sampler_.render(view_, spp, fixed_seed, no_progress); }

  const gl::Context& context_;
  Scene scene_;
  GpuScene gpu_;
  BakedMethod baked_;
  GpuMethod method_;
  Supersampler sampler_;
  View view_{.size = size, .camera = scene_.camera};
};

bool same_columns(const Image& a, const Image& b, int from, int to) {
  for (int y = 0; y < a.height; ++y) {
    for (int x = from; x < to; ++x) {
      if (!std::ranges::equal(a.at(x, y), b.at(x, y))) return false;
    }
  }
  return true;
}

TEST_F(Converge, TakesNoisyTilesFurtherAndLeavesTheOthers) {
  const Supersampled first = picture(64), finer = picture(256);
  Supersampled refined = first;
  const double floor = noise_floor(first, 1.0F).value();
  const double samples = converge(sampler_, refined, view_, fixed_seed,
                                  {.noise = floor, .spp_max = 256, .max_extra_work = 100.0}, no_progress);
  EXPECT_EQ(samples, (64 + 256) / 2.0);
  EXPECT_TRUE(same_columns(refined.mean, first.mean, 128, 256));
  EXPECT_FALSE(same_columns(refined.mean, first.mean, 0, 128));
  EXPECT_LT(noise_floor(refined, 1.0F).value(), floor);
  EXPECT_LT(largest_difference(refined.mean, finer.mean), largest_difference(first.mean, finer.mean));
}

TEST_F(Converge, StopsAtItsNoiseAndAtItsWork) {
  Supersampled refined = picture(64);
  const Supersampled first = refined;
  EXPECT_EQ(converge(sampler_, refined, view_, fixed_seed, {.noise = 1.0}, no_progress), 64.0);
  EXPECT_EQ(refined.mean, first.mean);
  EXPECT_EQ(converge(sampler_, refined, view_, fixed_seed, {.noise = 1e-9, .max_extra_work = 1.0}, no_progress), 64.0);
  EXPECT_EQ(refined.mean, first.mean);  // one tile of 256 samples is twice the first picture's work
}

TEST_F(Converge, IsDeterministic) {
  Supersampled one = picture(64), other = picture(64);
  const Convergence wanted{.noise = 1e-4, .spp_max = 256, .max_extra_work = 20.0};
  EXPECT_EQ(converge(sampler_, one, view_, fixed_seed, wanted, no_progress),
            converge(sampler_, other, view_, fixed_seed, wanted, no_progress));
  EXPECT_EQ(one.mean, other.mean);
}

}  // namespace
}  // namespace footprint::testing
