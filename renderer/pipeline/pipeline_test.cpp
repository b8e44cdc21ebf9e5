// The raster pipeline on small scenes: seeds, tiles, backends, invalid normals, lights.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>

#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "renderer/visibility/occluders.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/shadow_scenes.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

Scene bumpy_square() { return square_scene(random_normals(64, 64, 0.5F, 1), {}); }

TEST(Reference, SameSeedSameBytes) {
  TestRenderer renderer(bumpy_square());
  const Supersampled first = renderer.reference(16, 3);
  const Supersampled again = renderer.reference(16, 3);
  EXPECT_EQ(first.mean, again.mean);
  EXPECT_EQ(first.standard_error, again.standard_error);
  EXPECT_NE(first.mean, renderer.reference(16, 4).mean);
}

TEST(Reference, DoesNotDependOnTheTiles) {
  TestRenderer renderer(bumpy_square(), {50, 34});
  const Image whole = renderer.reference(64, 3).mean;
  const Image tiled = renderer.reference(64, 3, Sampling::after_shading, 16).mean;
  const auto figures = compare_images(tiled, whole, 1.0F);
  ASSERT_TRUE(figures.has_value());
  EXPECT_LT(figures->relative_rmse, 1e-3);  // a sample on the edge of two texels may take the other one
}

TEST(Reference, StandardErrorFallsFasterThanTheRootOfTheSamples) {
  TestRenderer renderer(bumpy_square());
  const double coarse = relative_standard_error(renderer.reference(16)).value();
  const double fine = relative_standard_error(renderer.reference(256)).value();
  EXPECT_GT(coarse / fine, 8.0);  // independent samples: 4
  EXPECT_FALSE(relative_standard_error(renderer.reference(1)).has_value());
}

// One texel per sample and all four have one expectation, also where maps of other sizes take their texels at random.
TEST(Reference, DrawnAndFilteredTexelsAgree) {
  Scene scene = bumpy_square();
  Image roughness(5, 3, 4, 0.3F);
  for (std::size_t i = 1; i < roughness.texels.size(); i += 8) roughness.texels[i] = 0.9F;
  scene.materials.front().metallic_roughness_map = {
      .name = "rough", .image = std::make_shared<const Image>(roughness), .coordinates = {}};
  TestRenderer renderer(scene, {16, 16});
  const auto mean = [&](TexelUse texels) {
    return renderer.reference(4096, 5, Sampling::after_shading, 0, EnvironmentUse::sampled, texels);
  };
  const Supersampled drawn = mean(TexelUse::drawn), filtered = mean(TexelUse::filtered);
  double off = 0, error = 0;
  for (std::size_t i = 0; i < drawn.mean.texel_count(); ++i) {
    off += std::pow(drawn.mean.texels[4 * i] - filtered.mean.texels[4 * i], 2);
    error += std::pow(drawn.standard_error.texels[3 * i], 2) + std::pow(filtered.standard_error.texels[3 * i], 2);
  }
  EXPECT_GT(off, 0.0);
  EXPECT_LT(off, 2.0 * error);
  EXPECT_NEAR(covered_mean(drawn.mean) / covered_mean(filtered.mean), 1.0, 1e-3);
}

TEST(Reference, HalvesAverageToTheWhole) {
  TestRenderer renderer(bumpy_square());
  const Supersampled picture = renderer.reference(64);
  ASSERT_TRUE(picture.halves.has_value());
  Image mean = picture.halves->first;
  for (std::size_t i = 0; i < mean.texels.size(); ++i)
    mean.texels[i] = 0.5F * (mean.texels[i] + picture.halves->second.texels[i]);
  EXPECT_LT(largest_difference(mean, picture.mean), 1e-4);
  EXPECT_FALSE(renderer.reference(1).halves.has_value());
}

TEST(Reference, InvalidNormalsEnterNoMean) {
  Image normals = constant_normals(4, 4, {0, 0, 1});
  normals.at(1, 2)[3] = 0.0F;
  const Scene flat = square_scene(constant_normals(4, 4, {0, 0, 1}), {});
  TestRenderer with_hole(square_scene(normals, {}), {8, 8}), without(flat, {8, 8});
  const Supersampled holed = with_hole.reference(64);
  const Image whole = without.reference(64).mean;
  int fewer = 0;  // pixels of which some samples have no radiance: their error is another
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) EXPECT_NEAR(holed.mean.at(x, y)[0], whole.at(x, y)[0], 0.02F) << x << ", " << y;
  }
  for (std::size_t i = 0; i < holed.standard_error.texel_count(); ++i)
    fewer += holed.mean.texels[4 * i] != whole.texels[4 * i] ? 1 : 0;
  EXPECT_GT(fewer, 3);
}

// A bad texel of a map does not hide the surface: its pixels still count.
TEST(Reference, InvalidNormalsAreCovered) {
  Image normals = constant_normals(32, 32, {0, 0, 1});
  normals.at(11, 5)[3] = 0.0F;
  Scene scene = square_scene(normals, {});
  for (Vertex& vertex : scene.meshes.front().vertices) vertex.uv0 *= 16.0F;  // every pixel has a bad texel or more
  TestRenderer renderer(scene, {16, 16});
  const Supersampled picture = renderer.reference(64);
  EXPECT_EQ(object_pixel_count(picture.mean), 256U);
  EXPECT_EQ(object_pixel_count(picture.halves->first), 256U);
  EXPECT_EQ(object_pixel_count(picture.halves->second), 256U);
}

TEST(Reference, NothingButInvalidNormalsShowsNothing) {
  Image normals = constant_normals(4, 4, {0, 0, 1});
  for (std::size_t i = 3; i < normals.texels.size(); i += 4) normals.texels[i] = 0.0F;
  TestRenderer renderer(square_scene(normals, {}), {8, 8});
  EXPECT_EQ(object_pixel_count(renderer.reference(16).mean), 0U);
}

TEST(Frame, DoesNotDependOnTheTiles) {
  TestRenderer renderer(bumpy_square(), {50, 34});
  EXPECT_LT(largest_difference(renderer.frame(base_surface()), renderer.frame(base_surface(), {}, {}, 16)), 1e-3);
}

// White Lambert under vertex colours that run linearly from left to right: each pixel is the white one's times the
// colour at its centre, for the methods and for the reference's mean over the pixel alike.
TEST(VertexColor, MultipliesTheBaseColourLinearly) {
  const SquareMaterial matte{.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                             .base_color = {1.0F, 1.0F, 1.0F},
                             .specular = glm::vec3(0.0F)};
  Scene scene = square_scene({}, matte);
  scene.lights = {DirectionalLight{.direction = {0, 0, -1}, .illuminance = glm::vec3(1.0F)}};
  const Image white = TestRenderer(scene, {16, 16}).frame(base_surface());
  for (Vertex& vertex : scene.meshes[0].vertices) {
    vertex.color = vertex.position.x < 0 ? glm::vec4(0.2F, 0.0F, 1.0F, 1.0F) : glm::vec4(0.8F, 1.0F, 0.5F, 1.0F);
  }
  TestRenderer colored(scene, {16, 16});
  const Image frame = colored.frame(base_surface()), mean = colored.reference(16).mean;
  for (int x = 0; x < 16; ++x) {
    const double share = (x + 0.5) / 16.0;
    const std::array<double, 3> color{0.2 + 0.6 * share, share, 1.0 - 0.5 * share};
    for (std::size_t c = 0; c < 3; ++c) {
      EXPECT_NEAR(frame.at(x, 7)[c], color.at(c) * white.at(x, 7)[c], 2e-4) << x;
      EXPECT_NEAR(mean.at(x, 7)[c], color.at(c) * white.at(x, 7)[c], 2e-3) << x;
    }
  }
}

// A checkerboard of 0.2 and 0.6 far away, times its factor and its vertices' colour: no light, normal or coat matters,
// and the reference has the mean.
TEST(Unlit, SurfacesRadiateTheirColour) {
  Image board(2, 2, 4, 1.0F);
  for (const auto& [x, y] : {std::pair{0, 0}, {1, 1}}) std::ranges::fill(board.at(x, y).first(3), 0.2F);
  for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}}) std::ranges::fill(board.at(x, y).first(3), 0.6F);
  Scene scene = square_scene(random_normals(8, 8, 0.5F, 1), {.brdf = {}, .base_color = {1.0F, 0.5F, 0.25F}});
  Material& material = scene.materials[0];
  material.base_color_map = TextureMap{"board", std::make_shared<const Image>(board), {}};
  material.base_color_map->coordinates.transform = glm::mat3x2{64.0F, 0.0F, 0.0F, 64.0F, 0.0F, 0.0F};
  material.coat = ClearCoat{};
  material.unlit = true;
  for (Vertex& vertex : scene.meshes[0].vertices) vertex.color = glm::vec4(0.5F, 1.0F, 1.0F, 1.0F);
  const auto expect_colours = [](const Image& picture, double tolerance) {
    for (std::size_t i = 0; i < picture.texels.size(); i += 4) {
      for (const auto& [channel, wanted] : {std::pair{0, 0.2}, {1, 0.2}, {2, 0.1}})
        ASSERT_NEAR(picture.texels[i + static_cast<std::size_t>(channel)], wanted, tolerance);
    }
  };
  TestRenderer renderer(scene, {8, 8});
  expect_colours(renderer.frame(base_surface()), 1e-5);
  expect_colours(renderer.reference(256).mean, 0.03);
  scene.lights.clear();
  expect_colours(TestRenderer(scene, {8, 8}).frame(base_surface()), 1e-5);
}

// The mean of a - b over all pixels, per colour.
std::array<double, 3> mean_difference(const Image& a, const Image& b) {
  std::array<double, 3> sums{};
  for (std::size_t i = 0; i < a.texel_count(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      sums.at(c) +=
          static_cast<double>(a.texels[4 * i + c] - b.texels[4 * i + c]) / static_cast<double>(a.texel_count());
  return sums;
}

// A checkerboard of 0.2 and 0.6 far away, times the factor, over what bumps reflect: the methods and the reference add
// its mean. A coat darkens it by what it reflects of the view, 0.04 + 0.96 (1 - cos)^5.
TEST(Emission, IsAddedToWhatSurfacesReflect) {
  Image board(2, 2, 3, 0.2F);
  for (const auto& [x, y] : {std::pair{1, 0}, {0, 1}}) std::ranges::fill(board.at(x, y), 0.6F);
  Scene dark = square_scene(random_normals(8, 8, 0.5F, 1), {}), lit = dark;
  lit.materials[0].emission = {2.0F, 1.0F, 0.5F};
  lit.materials[0].emission_map = TextureMap{"board", std::make_shared<const Image>(board), {}};
  lit.materials[0].emission_map->coordinates.transform = glm::mat3x2{50.3F, 0.0F, 0.0F, 47.9F, 0.0F, 0.0F};
  const auto expect_added = [&](double scale) {
    TestRenderer with(lit, {8, 8}), without(dark, {8, 8});
    const auto frames = mean_difference(with.frame(base_surface()), without.frame(base_surface()));
    const auto means = mean_difference(with.reference(256).mean, without.reference(256).mean);
    for (std::size_t c = 0; c < 3; ++c) {
      const double wanted = scale * 0.4 * lit.materials[0].emission[static_cast<int>(c)];
      EXPECT_NEAR(frames.at(c), wanted, 1e-3 * wanted);
      EXPECT_NEAR(means.at(c), wanted, 0.02 * wanted);
    }
  };
  expect_added(1.0);
  dark.lights.clear();
  lit.lights.clear();
  expect_added(1.0);
  dark.materials[0].coat = lit.materials[0].coat = ClearCoat{.weight = 0.5F};
  expect_added(1.0 - 0.5 * 0.04);  // nearly along the normal, where (1 - cos)^5 is below 1e-3
}

// A share of 0.3 is left of the environment's light, and all of the lamp's, for the methods and the reference alike.
TEST(Occlusion, DimsTheEnvironmentAlone) {
  Scene lamp = square_scene(random_normals(8, 8, 0.5F, 1), {}), both = lamp, occluded;
  both.environment = constant_environment({0.5F, 0.75F, 1.0F});
  occluded = both;
  occluded.materials[0].occlusion_map = TextureMap{"seen", std::make_shared<const Image>(1, 1, 1, 0.3F), {}};
  TestRenderer of_lamp(lamp, {8, 8}), of_both(both, {8, 8}), of_occluded(occluded, {8, 8});
  const auto expect_share = [](const Image& lamp_alone, const Image& all, const Image& dimmed, double tolerance) {
    const auto whole = mean_difference(all, lamp_alone), left = mean_difference(dimmed, lamp_alone);
    for (std::size_t c = 0; c < 3; ++c) EXPECT_NEAR(left.at(c), 0.3 * whole.at(c), tolerance * whole.at(c));
  };
  expect_share(of_lamp.frame(base_surface()), of_both.frame(base_surface()), of_occluded.frame(base_surface()), 1e-4);
  expect_share(of_lamp.reference(64).mean, of_both.reference(64).mean, of_occluded.reference(64).mean, 0.02);
}

// Alpha from 0 to 1 across the square, cut at a half: in the picture, in its shadow and before the rays alike.
TEST(VertexColor, AlphaCutsOut) {
  Scene scene = white_floor();
  scene.materials.push_back(scene.materials[0]);
  scene.materials[1].alpha_cutoff = 0.5F;
  Mesh sheet = scene.meshes[0];
  sheet.material = 1;
  for (Vertex& vertex : sheet.vertices) {
    vertex.color.a = vertex.position.x > 0 ? 1.0F : 0.0F;
    vertex.position.z = 0.5F;
  }
  scene.meshes.push_back(sheet);
  fit_bounds(scene);
  const float slope = std::numbers::sqrt2_v<float> / 2.0F;
  scene.lights = {DirectionalLight{.direction = {-slope, 0, -slope}, .illuminance = glm::vec3(1.0F)}};
  const Occluders occluders(scene);
  EXPECT_FALSE(occluders.blocked({-0.1F, 0.3F, 0.1F}, {0, 0, 1}));
  EXPECT_TRUE(occluders.blocked({0.1F, 0.3F, 0.1F}, {0, 0, 1}));
  scene.materials[1].base_color = {0, 0, 0, 1};  // the sheet is black where it is there
  const Image picture = TestRenderer(scene, {32, 32}).frame(base_surface());
  EXPECT_NEAR(picture.at(4, 16)[0], slope / std::numbers::pi, 0.02);  // the floor at -0.7, lit through the hole
  EXPECT_EQ(picture.at(12, 16)[0], 0.0F);                             // at -0.2, in the shadow of what is there
  EXPECT_LT(picture.at(24, 16)[0], 0.02F);                            // the sheet
}

// Lambert facets that lean by asin 0.8 under a light from below the plane, by hand; for the reference too.
TEST(Horizon, OpenLetsLightFromBelowToFacetsThatFaceIt) {
  const SquareMaterial matte{.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                             .base_color = glm::vec3(0.5F),
                             .specular = glm::vec3(0.0F)};
  Scene scene = square_scene(constant_normals(4, 4, {0.8F, 0, 0.6F}), matte);
  const glm::vec3 to_light = glm::normalize(glm::vec3(0.9F, 0.1F, -0.2F));
  scene.lights = {DirectionalLight{.direction = -to_light, .illuminance = glm::vec3(2.0F)}};
  TestRenderer cut(scene, {8, 8});
  EXPECT_EQ(covered_mean(cut.frame(base_surface())), 0.0);
  EXPECT_EQ(covered_mean(cut.reference(4).mean), 0.0);
  scene.horizon = Horizon::open;
  TestRenderer open(scene, {8, 8});
  const double expected = 0.5 / std::numbers::pi * 2.0 * glm::dot(glm::vec3(0.8F, 0, 0.6F), to_light);
  EXPECT_NEAR(covered_mean(open.frame(base_surface())), expected, 1e-4);
  EXPECT_NEAR(covered_mean(open.reference(4).mean), expected, 1e-4);
}

// A near plane of next to nothing leaves the picture as it is, and the order of surfaces behind one another.
TEST(Frame, NearPlaneMayLieAnywhereBeforeTheScene) {
  Scene scene = box_over_floor();
  scene.lights = {DirectionalLight{.direction = {0.3F, 0.2F, -0.93F}, .illuminance = glm::vec3(3.0F)}};
  const Image picture = TestRenderer(scene, {48, 48}).frame(base_surface());
  EXPECT_GT(covered_mean(picture), 0.1);
  for (const float znear : {1e-7F, 1e-12F, 1e-18F}) {
    for (const std::optional<float> zfar : {std::optional<float>(), std::optional(10.0F), std::optional(1e15F)}) {
      scene.camera.znear = znear;
      scene.camera.zfar = zfar;
      EXPECT_LT(largest_difference(TestRenderer(scene, {48, 48}).frame(base_surface()), picture), 1e-6) << znear;
    }
  }
}

TEST(Frame, PlanesCutWhatIsBeyondThem) {
  Scene scene = white_floor();  // 3 m before the camera
  for (const bool orthographic : {false, true}) {
    scene.camera.orthographic = orthographic;
    const auto covered = [&](float znear, std::optional<float> zfar) {
      scene.camera.znear = znear;
      scene.camera.zfar = zfar;
      return object_pixel_count(TestRenderer(scene, {8, 8}).frame(base_surface())) == 64U;
    };
    EXPECT_TRUE(covered(2.99F, 3.01F));
    EXPECT_FALSE(covered(0.1F, 2.99F));
    EXPECT_FALSE(covered(3.01F, 9.0F));
  }
}

// One facet under one light, by hand: Lambert alone at the foot of the perpendicular.
TEST(Frame, LambertMeetsTheHandComputedValue) {
  const SquareMaterial matte{.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                             .roughness = 1.0F,
                             .base_color = glm::vec3(0.5F),
                             .specular = glm::vec3(0.0F),
                             .metallic = 0.0F};
  Scene scene = square_scene({}, matte);
  scene.lights = {
      DirectionalLight{.direction = glm::normalize(glm::vec3(0.0F, -0.6F, -0.8F)), .illuminance = {2, 1, 0}}};
  TestRenderer renderer(scene, {9, 9});
  const Image picture = renderer.frame(base_surface());
  const double expected = 0.5 / std::numbers::pi * 0.8;
  EXPECT_NEAR(picture.at(4, 4)[0], 2.0 * expected, 1e-5);
  EXPECT_NEAR(picture.at(4, 4)[1], expected, 1e-5);
  EXPECT_EQ(picture.at(4, 4)[2], 0.0F);
  EXPECT_EQ(picture.at(4, 4)[3], 1.0F);
}

TEST(Frame, SpotLightFollowsItsConeAndRange) {
  const SquareMaterial matte{.brdf = {NormalDistribution::ggx, GeometryTerm::none, FresnelTerm::none, true},
                             .roughness = 1.0F,
                             .base_color = glm::vec3(1.0F),
                             .specular = glm::vec3(0.0F),
                             .metallic = 0.0F};
  Scene scene = square_scene({}, matte);
  scene.lights = {SpotLight{.point = {.position = {0, 0, 1}, .intensity = glm::vec3(3.0F), .range = 2.0F},
                            .direction = {0, 0, -1},
                            .inner_cone_angle = 0.2F,
                            .outer_cone_angle = 0.5F}};
  TestRenderer renderer(scene, {65, 65});
  const Image picture = renderer.frame(base_surface());
  // Below the light: distance 1, full cone, window 1 - (1/2)^4.
  EXPECT_NEAR(picture.at(32, 32)[0], 3.0 / std::numbers::pi * (1.0 - 1.0 / 16.0), 1e-3);
  EXPECT_EQ(picture.at(0, 32)[0], 0.0F);  // 45 degrees off: outside
}

TEST(Frame, BackFacesAreDrawnOnlyWhereDoubleSided) {
  Scene scene = bumpy_square();
  scene.camera.world = glm::mat4(1, 0, 0, 0, 0, -1, 0, 0, 0, 0, -1, 0, 0, 0, -3, 1);  // from below
  scene.lights = {PointLight{.position = {0, 0, -2}, .intensity = glm::vec3(4.0F), .range = {}}};
  EXPECT_EQ(TestRenderer(scene).frame(base_surface()).at(32, 32)[3], 0.0F);
  scene.materials[0].double_sided = true;
  const Image picture = TestRenderer(scene).frame(base_surface());
  EXPECT_EQ(picture.at(32, 32)[3], 1.0F);
  EXPECT_GT(picture.at(32, 32)[0], 0.0F);
}

TEST(Frame, OrthographicCamerasSeeParallelRays) {
  Scene scene = square_scene({}, {});
  scene.lights = {DirectionalLight{.direction = {0, 0, -1}, .illuminance = glm::vec3(1.0F)}};
  scene.camera.orthographic = true;
  scene.camera.ymag = 0.5F;
  scene.camera.zfar = 10.0F;
  const Image picture = TestRenderer(scene, {16, 16}).frame(base_surface());
  EXPECT_NEAR(picture.at(0, 0)[0], picture.at(8, 8)[0], 1e-6F);  // no view angle changes over the frame
  EXPECT_EQ(picture.at(0, 0)[3], 1.0F);
}

TEST(Backends, DrawTheSamePicture) {
  const Scene scene = bumpy_square();
  const Image expected = TestRenderer(scene).reference(16).mean;
  int compared = 0;
  for (const gl::BackendReport& report : gl::probe_backends()) {
    if (!report.info) continue;
    const gl::Context context({.backend = report.backend, .device = report.device});
    const Image picture = TestRenderer(scene, {64, 64}, {}, context).reference(16).mean;
    // Software rasterisers of one build agree to the bit; a GPU rounds otherwise and may draw a neighbouring texel.
    const auto figures = compare_images(picture, expected, 1.0F);
    EXPECT_LT(figures.value().relative_rmse, report.info->software ? 1e-6 : 2e-2) << gl::backend_name(report.backend);
    ++compared;
  }
  (void)shared_context();
  EXPECT_GE(compared, 1);
}

TEST(GpuScene, RefusesTwoBaseBrdfs) {
  Scene scene = bumpy_square();
  scene.materials.push_back(scene.materials.front());
  scene.materials.back().brdf.distribution = NormalDistribution::beckmann;
  EXPECT_THROW(TestRenderer{scene}, Error);
}

}  // namespace
}  // namespace footprint::testing
