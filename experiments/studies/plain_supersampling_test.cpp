// One sample is a frame at pixel centres; many are the picture that a finer one averages to.
#include "experiments/studies/frame_times.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <set>
#include <span>

#include "methods/registry.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

// The mean of frames of a method at the offsets.
Image mean_of(const Scene& scene, const char* method, int edge, std::span<const glm::dvec2> offsets) {
  (void)shared_context();
  const EffectSet effects = effects_on(derive_effects(scene));
  GpuScene gpu_scene(shared_context().info(), scene, effects);
  const BakedMethod baked = bake(find_method(method), parse_methods(method).front(), scene, effects, no_progress);
  const GpuMethod gpu(gpu_scene, baked);
  const FrameRenderer frames(shared_context().info(), gpu_scene, gpu, {edge, edge}, {});
  FrameMean mean({edge, edge});
  for (const glm::dvec2& offset : offsets)
    mean.add(frames.render({.size = {edge, edge}, .camera = scene.camera}, offset));
  return mean.mean();
}

// Frames of `direct` over a square with random normals.
Image mean_at(int texels, int edge, std::span<const glm::dvec2> offsets) {
  return mean_of(square_scene(random_normals(texels, texels, 0.5F, 1), {}), "direct", edge, offsets);
}

TEST(FrameOffsets, LieInThePixelAboutItsCentre) {
  for (const int spp : {2, 8, 64}) {
    glm::dvec2 mean(0.0);
    const std::vector<glm::dvec2> offsets = frame_offsets(spp, 3);
    ASSERT_EQ(offsets.size(), static_cast<std::size_t>(spp));
    for (const glm::dvec2& offset : offsets) {
      EXPECT_LE(std::max(std::abs(offset.x), std::abs(offset.y)), 0.5);
      mean += offset / static_cast<double>(spp);
    }
    EXPECT_LT(glm::length(mean), 1.0 / spp);
    std::set<int> columns, rows;  // as many as samples, one in each
    for (const glm::dvec2& offset : offsets) {
      columns.insert(static_cast<int>(std::floor((offset.x + 0.5) * spp)));
      rows.insert(static_cast<int>(std::floor((offset.y + 0.5) * spp)));
    }
    EXPECT_EQ(columns.size(), offsets.size());
    EXPECT_EQ(rows.size(), offsets.size());
  }
}

TEST(FrameOffsets, OfMoreBeginWithThoseOfFewer) {
  const std::vector<glm::dvec2> many = frame_offsets(64, 3), few = frame_offsets(4, 3), other = frame_offsets(4, 4);
  EXPECT_TRUE(std::ranges::equal(few, std::span(many).first(4)));
  EXPECT_NE(few, other);
}

TEST(FrameOffsets, FillEverySquareOfAGridAlike) {
  for (const std::uint64_t seed : {1U, 2U, 3U}) {
    std::set<int> cells;
    for (const glm::dvec2& offset : frame_offsets(16, seed))
      cells.insert(static_cast<int>((offset.x + 0.5) * 4) * 4 + static_cast<int>((offset.y + 0.5) * 4));
    EXPECT_EQ(cells.size(), 16U);
  }
}

TEST(MeanOfFrames, OfOneIsTheFrame) {
  TestRenderer renderer(square_scene(random_normals(64, 64, 0.5F, 1), {}), {24, 24});
  EXPECT_EQ(mean_at(64, 24, std::vector{glm::dvec2(0.0)}), renderer.frame(find_method("direct")));
}

// Texels as large as pixels: a frame moved by a pixel shows what stood one pixel further on.
TEST(MeanOfFrames, MovesSamplesByPixels) {
  const Image frame = mean_at(16, 16, std::vector{glm::dvec2(0.0)});
  const Image moved = mean_at(16, 16, std::vector{glm::dvec2(1.0, 0.0)});
  for (int y = 0; y < 16; ++y) {
    for (int x = 0; x < 15; ++x) EXPECT_NEAR(moved.at(x, y)[0], frame.at(x + 1, y)[0], 1e-3F) << x << ", " << y;
    EXPECT_EQ(moved.at(15, y)[3], 0.0F) << "beside the square";
  }
}

// Ripples of a pixel's width, of so many texels that interpolating their normals changes little.
Image ripples(int pixels) {
  constexpr int texels_per_ripple = 32;
  Image normals(pixels * texels_per_ripple, 1, 4);
  for (int x = 0; x < normals.width; ++x) {
    const double slope = 0.3 * std::sin(2.0 * std::numbers::pi * (x + 0.5) / texels_per_ripple);
    const glm::vec3 normal(glm::normalize(glm::dvec3(-slope, 0.0, 1.0)));
    std::ranges::copy(std::array{normal.x, normal.y, normal.z, 1.0F}, normals.at(x, 0).begin());
  }
  return normals;
}

// `direct` reads the coat's finest level, so its frames converge. A method that filters coats keeps the error of that
// filter.
TEST(MeanOfFrames, ConvergesUnderAClearCoat) {
  Scene scene =
      square_scene({}, {.brdf = {}, .roughness = 0.5F, .base_color = glm::vec3(0.2F), .specular = glm::vec3(0.04F)});
  ClearCoat& coat = scene.materials.front().coat.emplace();
  coat.weight = 1.0F;
  coat.roughness = 0.3F;
  constexpr int edge = 16;
  coat.normal_map = {"coat", std::make_shared<const Image>(ripples(edge)), {}};
  const std::vector<glm::dvec2> offsets = frame_offsets(256, 1);
  TestRenderer renderer(scene, {edge, edge});
  const Image reference = renderer.reference(1024, 1).mean;
  const auto error = [&](const char* method, std::size_t frames) {
    return normalized_color(mean_of(scene, method, edge, std::span(offsets).first(frames)), reference, 1.0F).value();
  };
  const double least = error("direct", 256);
  EXPECT_LT(least, 0.3 * error("direct", 16));
  EXPECT_LT(least, 0.1 * error("toksvig", 256)) << "whose coat is filtered";
}

TEST(MeanOfFrames, IsTheMeanOverWhatIsCovered) {
  const std::vector offsets{glm::dvec2(0.0), glm::dvec2(1.0, 0.0)};
  const Image both = mean_at(16, 16, offsets), first = mean_at(16, 16, std::span(offsets).first(1)),
              second = mean_at(16, 16, std::span(offsets).last(1));
  EXPECT_NEAR(both.at(3, 5)[1], 0.5F * (first.at(3, 5)[1] + second.at(3, 5)[1]), 1e-6F);
  EXPECT_NEAR(both.at(15, 5)[1], first.at(15, 5)[1], 1e-6F);
  EXPECT_EQ(both.at(15, 5)[3], 0.5F);
}

}  // namespace
}  // namespace footprint::testing
