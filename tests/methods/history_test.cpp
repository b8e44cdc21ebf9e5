// Histories of frames: the weights that alpha says, the surface followed, and nothing that a frame never showed.
#include "renderer/pipeline/history.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/matrix_transform.hpp>
#include <limits>
#include <memory>
#include <vector>

#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

constexpr glm::ivec2 history_size{32, 32};

Scene bumpy_square() { return square_scene(random_normals(128, 128, 0.5F, 7), {.brdf = {}, .roughness = 0.5F}); }

// A square of coloured patches under Lambert's term and parallel light: a shifted camera sees a shifted image.
Scene patches() {
  Scene scene = square_scene({}, {.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                                  .specular = glm::vec3(0.0F)});
  auto texels = std::make_shared<Image>(64, 64, 4, 1.0F);
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) texels->at(x, y)[0] = (x / 4 * 7 + y / 4 * 5) % 3 == 0 ? 1.0F : 0.1F;
  }
  scene.materials[0].base_color_map = TextureMap{"patches", texels, {}};
  scene.lights = {DirectionalLight{.direction = {0.3F, 0.2F, -1.0F}, .illuminance = glm::vec3(3.0F)}};
  scene.camera.orthographic = true;
  scene.camera.ymag = 0.5F;
  return scene;
}

const FrameRenderer& direct_frames(TestRenderer& renderer, const char* filter) {
  return renderer.frames(find_method("direct"), {}, filter_of(filter));
}

std::size_t pixels_apart(const Image& a, const Image& b, double most) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < a.texels.size(); i += 4)
    count += std::abs(static_cast<double>(a.texels[i]) - b.texels[i]) > most ? 1 : 0;
  return count;
}

TEST(Jitter, FillsThePixelByItsSeed) {
  glm::dvec2 sum(0.0);
  for (std::uint32_t i = 0; i < 64; ++i) {
    const glm::dvec2 offset = jitter_of(3, i);
    EXPECT_TRUE(offset.x >= -0.5 && offset.x < 0.5 && offset.y >= -0.5 && offset.y < 0.5);
    sum += offset;
  }
  EXPECT_LT(glm::length(sum / 64.0), 0.01);
  EXPECT_NE(jitter_of(3, 0), jitter_of(4, 0));
}

// Each frame has the share alpha (1 - alpha)^age, and the first one the rest.
TEST(History, OfAStillCameraWeighsFramesByAlpha) {
  constexpr double alpha = 0.2;
  TestRenderer renderer(bumpy_square(), history_size);
  const FrameRenderer& frames = direct_frames(renderer, "stochastic:1");
  History history(history_size, {.frames = 1, .alpha = alpha, .jitter = false});
  std::vector<double> expected;
  View view{.size = history_size, .camera = bumpy_square().camera, .seed = 1};
  for (; view.frame < 20; ++view.frame) {
    const Image frame = frames.render(view);
    if (expected.empty()) expected.assign(frame.texels.begin(), frame.texels.end());
    for (std::size_t i = 0; i < expected.size(); ++i)
      expected[i] = (1.0 - alpha) * expected[i] + alpha * static_cast<double>(frame.texels[i]);
    history.add(frames, view);
  }
  const Image shown = history.image();
  for (std::size_t i = 0; i < expected.size(); ++i) ASSERT_NEAR(shown.texels[i], expected[i], 1e-5);
  EXPECT_GT(pixels_apart(shown, frames.render(view), 0.05), 100U) << "single frames are noisy";
}

TEST(History, WithoutMotionIsTheFrame) {
  TestRenderer renderer(bumpy_square(), history_size);
  const FrameRenderer& frames = direct_frames(renderer, "trilinear");
  const View view{.size = history_size, .camera = bumpy_square().camera};
  for (const HistoryClamp clamp : {HistoryClamp::off, HistoryClamp::box, HistoryClamp::variance}) {
    History history(history_size, {.frames = 1, .clamp = clamp, .jitter = false});
    history.add(frames, view);
    EXPECT_EQ(history.image(), frames.render(view)) << "one frame";
    history.add(frames, view);
    if (clamp != HistoryClamp::variance) {
      EXPECT_LT(largest_difference(history.image(), frames.render(view)), 1e-5);
    }
    history.restart();
    history.add(frames, view);
    EXPECT_EQ(history.image(), frames.render(view)) << "after a restart";
  }
}

// The camera moves by three pixels and by a part of one. What comes into view has the newest frame alone.
TEST(History, FollowsTheSurface) {
  const Scene scene = patches();
  TestRenderer renderer(scene, history_size);
  const FrameRenderer& frames = direct_frames(renderer, "anisotropic:8");
  for (const double pixels : {3.0, 3.5}) {
    History history(history_size, {.frames = 1, .alpha = 0.01, .jitter = false});
    const View before{.size = history_size, .camera = scene.camera};
    View after = before;
    after.camera.world = glm::translate(glm::mat4(1.0F), {pixels / history_size.x, 0.0F, 0.0F}) * after.camera.world;
    history.add(frames, before);
    history.add(frames, after);
    const Image newest = frames.render(after);
    EXPECT_GT(pixels_apart(frames.render(before), newest, 0.05), 200U);
    if (pixels == 3.0) {
      EXPECT_LT(largest_difference(history.image(), newest), 1e-3);
    } else {
      // Bilinear texels blur the borders of patches alone.
      EXPECT_LT(pixels_apart(history.image(), newest, 0.3), 40U);
    }
  }
}

// The camera turns about the square in perspective, over many frames.
TEST(History, FollowsTheSurfaceInPerspective) {
  Scene scene = patches();
  scene.camera = square_scene({}, {}).camera;
  scene.camera.world = glm::rotate(glm::mat4(1.0F), 0.5F, glm::vec3(1.0F, 0.0F, 0.0F)) * scene.camera.world;
  scene.materials[0].base_color_map->coordinates.transform = {0.25F, 0.0F, 0.0F, 0.25F, 0.0F, 0.0F};  // wide patches
  TestRenderer renderer(scene, history_size);
  const FrameRenderer& frames = direct_frames(renderer, "anisotropic:8");
  History history(history_size, {.frames = 1, .alpha = 0.1, .jitter = false});
  View view{.size = history_size, .camera = scene.camera};
  const Image first = frames.render(view);
  for (int i = 0; i < 10; ++i) {
    view.camera.world =
        glm::rotate(glm::mat4(1.0F), 0.05F * static_cast<float>(i), glm::vec3(0.0F, 0.0F, 1.0F)) * scene.camera.world;
    history.add(frames, view);
  }
  const Image newest = frames.render(view);
  EXPECT_GT(pixels_apart(first, newest, 0.15), 150U);
  EXPECT_LT(pixels_apart(history.image(), newest, 0.15), 50U);
}

// A smooth pattern, whose history is the pattern itself wherever the camera goes: what is left is a fraction of a
// percent.
TEST(History, NeitherBlursNorTrails) {
  Scene scene = patches();
  auto waves = std::make_shared<Image>(256, 256, 4, 1.0F);
  for (int y = 0; y < 256; ++y) {
    for (int x = 0; x < 256; ++x)
      waves->at(x, y)[0] = 0.5F + 0.25F * (std::sin(0.19634954F * static_cast<float>(x)) +
                                           std::sin(0.19634954F * static_cast<float>(y)));
  }
  scene.materials[0].base_color_map = TextureMap{"waves", waves, {}};
  scene.camera = square_scene({}, {}).camera;
  TestRenderer renderer(scene, {64, 64});
  const FrameRenderer& frames = renderer.frames(find_method("direct"), {}, filter_of("trilinear"));
  for (const bool zooms : {true, false}) {
    History history({64, 64}, {.frames = 1, .alpha = 0.1, .jitter = false});
    View view{.size = {64, 64}, .camera = scene.camera};
    const Image first = frames.render(view);
    for (int i = 0; i < 12; ++i) {
      const auto step = static_cast<float>(i);
      view.camera.world =
          zooms ? glm::translate(glm::mat4(1.0F), {0.0F, 0.0F, 0.03F * step}) * scene.camera.world
                : glm::rotate(glm::mat4(1.0F), 0.013F * step, glm::vec3(0.3F, 0.2F, 1.0F)) * scene.camera.world;
      history.add(frames, view);
    }
    const Image newest = frames.render(view), shown = history.image();
    double largest = 0.0, moved = 0.0;
    for (int y = 8; y < 56; ++y) {
      for (int x = 8; x < 56; ++x) {
        largest = std::max(largest, std::abs(static_cast<double>(shown.at(x, y)[0]) - newest.at(x, y)[0]));
        moved = std::max(moved, std::abs(static_cast<double>(first.at(x, y)[0]) - newest.at(x, y)[0]));
      }
    }
    EXPECT_LT(largest, 0.05 * moved) << "zoom " << zooms << ": " << largest << " of " << moved;
    EXPECT_GT(moved, 0.1);
  }
}

TEST(History, ForgetsWhatWasCovered) {
  Scene scene = box_over_floor();
  scene.lights = {PointLight{{0.0F, 0.0F, 1.5F}, glm::vec3(3.0F), {}}};  // the box is the brighter one
  TestRenderer renderer(scene, {48, 48});
  const FrameRenderer& frames = renderer.frames(find_method("direct"), {}, filter_of("trilinear"));
  History history({48, 48}, {.frames = 1, .alpha = 0.05, .jitter = false});
  const View before{.size = {48, 48}, .camera = scene.camera};
  View after = before;
  after.camera.world = glm::translate(glm::mat4(1.0F), {0.3F, 0.0F, 0.0F}) * after.camera.world;
  history.add(frames, before);
  history.add(frames, after);
  const Image newest = frames.render(after), old = frames.render(before);
  Image blended = newest;
  for (std::size_t i = 0; i < blended.texels.size(); ++i)
    blended.texels[i] = 0.95F * old.texels[i] + 0.05F * newest.texels[i];
  const std::size_t wrong = pixels_apart(history.image(), newest, 0.1 * covered_mean(newest));
  EXPECT_LT(5 * wrong, pixels_apart(blended, newest, 0.1 * covered_mean(newest))) << wrong;
}

// Whatever the history was, it is then within what the 3 x 3 pixels around show.
TEST(History, IsClampedToTheNeighbourhood) {
  TestRenderer renderer(bumpy_square(), history_size);
  const FrameRenderer& frames = direct_frames(renderer, "stochastic:1");
  const auto outside = [&](HistoryClamp clamp) {
    History history(history_size, {.frames = 1, .clamp = clamp, .jitter = false});
    View view{.size = history_size, .camera = bumpy_square().camera, .seed = 1};
    for (; view.frame < 8; ++view.frame) history.add(frames, view);
    --view.frame;
    const Image shown = history.image(), newest = frames.render(view);
    std::size_t count = 0;
    for (int y = 0; y < history_size.y; ++y) {
      for (int x = 0; x < history_size.x; ++x) {
        float low = std::numeric_limits<float>::max(), high = 0.0F;
        for (int i = 0; i < 9; ++i) {
          const float value = newest.at(std::clamp(x + i % 3 - 1, 0, history_size.x - 1),
                                        std::clamp(y + i / 3 - 1, 0, history_size.y - 1))[1];
          low = std::min(low, value);
          high = std::max(high, value);
        }
        const float own = shown.at(x, y)[1];
        count += own < low - 1e-5F || own > high + 1e-5F ? 1 : 0;
      }
    }
    return count;
  };
  EXPECT_EQ(outside(HistoryClamp::box), 0U);
  EXPECT_EQ(outside(HistoryClamp::variance), 0U);
  EXPECT_GT(outside(HistoryClamp::off), 0U);
}

TEST(History, TakesNoNaN) {
  Scene scene = bumpy_square();
  TestRenderer renderer(scene, history_size);
  for (const HistoryClamp clamp : {HistoryClamp::off, HistoryClamp::box, HistoryClamp::variance}) {
    History history(history_size, {.frames = 1, .clamp = clamp, .jitter = false});
    const View view{.size = history_size, .camera = scene.camera};
    history.add(direct_frames(renderer, "trilinear"), view);
    const Image first = history.image();
    Scene broken = scene;
    std::get<PointLight>(broken.lights[0]).intensity = glm::vec3(std::numeric_limits<float>::quiet_NaN());
    renderer.update(broken);
    history.add(direct_frames(renderer, "trilinear"), view);
    EXPECT_EQ(history.image(), first);
    renderer.update(scene);
  }
}

TEST(History, NeedsWholeFrames) {
  TestRenderer renderer(bumpy_square(), history_size);
  History history(history_size, {.frames = 1});
  const FrameRenderer& tiled = renderer.frames(find_method("direct"), {}, filter_of("trilinear"), 16);
  EXPECT_THROW(history.add(tiled, {.size = history_size, .camera = bumpy_square().camera}), Error);
}

}  // namespace
}  // namespace footprint::testing
