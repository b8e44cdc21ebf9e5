// The map in camera space: rotation, culling, coverage and charts, and frames of what moves.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/matrix_transform.hpp>

#include "renderer/pipeline/frame.hpp"
#include "renderer/scene/geometry.hpp"
#include "tests/methods/built_map.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

const Words camera_space{{"space", "camera"}};

Scene turned_square(double degrees, bool two_sided = false) {
  Scene scene = blinn_phong_square(random_normals(16, 8, 0.7F, 31), 100);
  turn_meshes(scene, turn(degrees, {0, 1, 0}));
  scene.materials[0].double_sided = two_sided;
  return scene;
}

glm::vec3 direction(const Image& map, int x, int y) {
  const auto texel = map.at(x, y);
  return {texel[0], texel[1], texel[2]};
}

TEST(CameraSpace, TurnsTheLobesOfATurnedSurface) {
  const Image flat = BuiltMap(turned_square(0)).level("xu_vmf_whole", 0);
  for (const double degrees : {0.0, 40.0, -75.0}) {
    const Image turned = BuiltMap(turned_square(degrees), camera_space).level("xu_vmf_whole", 0);
    const glm::mat3 by = turn(degrees, {0, 1, 0});
    for (int y = 0; y < flat.height; ++y) {
      for (int x = 0; x < flat.width; ++x) {
        EXPECT_LT(glm::length(direction(turned, x, y) - by * direction(flat, x, y)), 1e-5F) << degrees;
        EXPECT_EQ(turned.at(x, y)[3], 1.0F);
      }
    }
  }
}

TEST(CameraSpace, LeavesOutWhatFacesAwayAndTurnsTwoSidedSurfacesRound) {
  const BuiltMap away(turned_square(180), camera_space);
  for (const float value : away.level("xu_vmf_whole", 0).texels) EXPECT_EQ(value, 0.0F);
  const std::vector<MapLobe> lobes = away.lobes();  // nothing is covered: flat, not NaN
  ASSERT_EQ(lobes.size(), 1U);
  EXPECT_NEAR(lobes[0].kappa, 101.0, 0.01);
  const Image flat = BuiltMap(turned_square(0)).level("xu_vmf_whole", 0);
  const Image behind = BuiltMap(turned_square(180, true), camera_space).level("xu_vmf_whole", 0);
  for (int x = 0; x < flat.width; ++x) {
    // The turn makes the axes (-x, y, -z), and the back reverses all three of them.
    const glm::vec3 r = direction(flat, x, 3);
    EXPECT_LT(glm::length(direction(behind, x, 3) - glm::vec3(r.x, -r.y, r.z)), 1e-5F);
  }
}

// The camera is at (0, 0, 3): of a square that is turned by 60 degrees, normals beyond 30 degrees face away on one
// side.
TEST(CameraSpace, LeavesOutNormalsThatFaceAwayIfAsked) {
  const double degrees = 60.0;
  const Scene scene = turned_square(degrees);
  const Image all = BuiltMap(scene, camera_space).level("xu_vmf_whole", 0);
  const Image culled = BuiltMap(scene, {{"space", "camera"}, {"culling", "normals"}}).level("xu_vmf_whole", 0);
  int left_out = 0;
  for (int y = 0; y < all.height; ++y) {
    for (int x = 0; x < all.width; ++x) {
      const glm::vec2 on_plane{(static_cast<float>(x) + 0.5F) / static_cast<float>(all.width) - 0.5F,
                               0.5F - (static_cast<float>(y) + 0.5F) / static_cast<float>(all.height)};
      const glm::vec3 place = glm::mat3(turn(degrees, {0, 1, 0})) * glm::vec3(2.0F * on_plane, 0.0F);
      const glm::vec3 to_viewer = glm::vec3(scene.camera.world[3]) - place;
      const float facing = glm::dot(glm::normalize(direction(all, x, y)), glm::normalize(to_viewer));
      if (std::abs(facing) < 1e-3F) continue;
      EXPECT_EQ(culled.at(x, y)[3], facing > 0.0F ? 1.0F : 0.0F) << x << ", " << y;
      if (facing < 0.0F) {
        ++left_out;
      } else {
        EXPECT_EQ(direction(culled, x, y), direction(all, x, y));
      }
    }
  }
  EXPECT_GT(left_out, 3);
  EXPECT_LT(left_out, all.width * all.height / 2);
}

// Two planes under one flat map: the second is turned, and looks up the same texels.
Scene two_planes(double degrees = 60) {
  Scene scene = blinn_phong_square(constant_normals(24, 24, {0, 0, 1}), 100);
  Scene tilted;
  tilted.meshes.push_back(make_plane({1, 1}, {1, 1}));
  turn_meshes(tilted, turn(degrees, {0, 1, 0}));
  scene.meshes.push_back(tilted.meshes.front());
  return scene;
}

TEST(CameraSpace, MixesNoChartsUpToTheThirdLevel) {
  const BuiltMap map(two_planes(), {{"space", "camera"}, {"j", "1"}});
  ASSERT_EQ(map.baked().notes.size(), 1U);
  const glm::vec3 tilted = turn(60, {0, 1, 0}) * glm::vec3(0, 0, 1);
  for (std::size_t level = 0; level < 4; ++level) {
    const Image whole = map.level("xu_vmf_whole", level);
    int facing = 0, slanted = 0;
    for (int y = 0; y < whole.height; ++y) {
      for (int x = 0; x < whole.width; ++x) {
        const float covered = whole.at(x, y)[3];
        if (covered == 0.0F) continue;
        const glm::vec3 n = direction(whole, x, y) / covered / static_cast<float>(1.0 - shortfall_twin(101.0));
        if (glm::length(n - tilted) < 1e-5F) {
          ++slanted;
        } else {
          EXPECT_LT(glm::length(n - glm::vec3(0, 0, 1)), 1e-5F) << level << ": " << x << ", " << y;
          ++facing;
        }
      }
    }
    EXPECT_GT(facing, 0) << level;
    EXPECT_GT(slanted, 0) << level;
  }
}

// One of two planes faces away: at every level, of the whole and of its parts, what is covered has the other one's
// mean.
TEST(CameraSpace, MeansLeaveOutWhatIsCulled) {
  const BuiltMap map(two_planes(150), camera_space);
  const auto expect_facing = [&](std::string_view name, std::size_t levels) {
    int covered = 0;
    for (std::size_t level = 0; level < levels; ++level) {
      const Image values = map.level(name, level);
      for (int y = 0; y < values.height; ++y) {
        for (int x = 0; x < values.width; ++x) {
          const float share = values.at(x, y)[3];
          if (share == 0.0F) continue;
          ++covered;
          const glm::dvec3 mean = glm::dvec3(direction(values, x, y)) / static_cast<double>(share);
          EXPECT_LT(glm::length(mean - glm::dvec3(0, 0, 1.0 - shortfall_twin(101.0))), 1e-5) << name << level;
        }
      }
    }
    EXPECT_GT(covered, 0) << name;
  };
  expect_facing("xu_vmf_whole", map.baked().textures[0].levels.size());
  expect_facing("xu_vmf_parts", map.baked().textures[1].levels.size());
}

// A plane to the side is turned by more or less than a right angle: which side a viewer sees depends on where it is,
// or, of parallel rays, on where these come from.
TEST(CameraSpace, CullsByWhereTheViewerIs) {
  for (const bool orthographic : {false, true}) {
    for (const double degrees : {80.0, 100.0}) {
      Scene scene = turned_square(degrees);
      for (Vertex& vertex : scene.meshes[0].vertices) vertex.position.x += degrees < 90.0 ? 6.0F : -6.0F;
      scene.camera.orthographic = orthographic;
      const bool seen = orthographic ? degrees < 90.0 : degrees > 90.0;
      const Image whole = BuiltMap(scene, camera_space).level("xu_vmf_whole", 0);
      for (int x = 0; x < whole.width; ++x) EXPECT_EQ(whole.at(x, 3)[3], seen ? 1.0F : 0.0F) << degrees;
    }
  }
}

// Each texel looks its maps up where they are: one has other coordinates than the other.
TEST(CameraSpace, LooksUpEachMapWhereItIs) {
  Image roughness(8, 8, 1);
  for (std::size_t i = 0; i < roughness.texels.size(); ++i) roughness.texels[i] = 0.3F + 0.01F * static_cast<float>(i);
  Scene scene = rough_square(constant_normals(8, 8, {0, 0, 1}), roughness);
  scene.materials[0].metallic_roughness_map->coordinates.transform[2] = {3.0F / 8.0F, 0.0F};
  const Image whole = BuiltMap(scene, camera_space).level("xu_vmf_whole", 0);
  for (int y = 0; y < 8; ++y) {
    for (int x = 0; x < 8; ++x) {
      const double alpha = std::pow(roughness.at((x + 3) % 8, y)[0], 2.0);
      EXPECT_NEAR(whole.at(x, y)[2], 1.0 - shortfall_twin(2.0 / (alpha * alpha) - 1.0), 1e-5);
    }
  }
}

TEST(CameraSpace, FallsBackToTheTangentFrameAndSaysSo) {
  Scene scene = two_planes();
  for (Vertex& vertex : scene.meshes[1].vertices) vertex.uv0.x = std::nanf("");
  const BuiltMap map(scene, camera_space);
  ASSERT_EQ(map.baked().notes.size(), 1U);
  EXPECT_EQ(map.baked().scalars.at("xu_vmf_in_camera_space"), 0.0F);
  EXPECT_EQ(map.level("xu_vmf_whole", 0).width, 24);
  const std::vector<MapLobe> lobes = map.lobes();
  ASSERT_EQ(lobes.size(), 1U);
  EXPECT_NEAR(lobes[0].kappa, 101.0, 0.01);
}

// A plane has one frame for all of its texels: turned to the camera's axes as a whole, one lobe a footprint is the same
// lobe. Mirrored as well, from behind, and from an atlas. (Texels past the map's edge are others: the picture's
// middle.)
TEST(CameraSpace, ShowsAPlaneAsTheTangentFrameDoes) {
  for (const bool mirrored : {false, true}) {
    for (const double degrees : {35.0, 145.0}) {
      Scene scene = blinn_phong_square(random_normals(64, 64, 0.6F, 32), 100);
      if (mirrored) {
        for (Vertex& vertex : scene.meshes[0].vertices) {
          vertex.uv0.x = 1.0F - vertex.uv0.x;
          vertex.tangent = {-1.0F, 0.0F, 0.0F, -1.0F};
        }
      }
      for (Vertex& vertex : scene.meshes[0].vertices) vertex.uv0.x += 0.25F;
      turn_meshes(scene, turn(degrees, {0.6F, 0.8F, 0.0F}));
      scene.materials[0].double_sided = true;
      scene.camera.yfov *= 0.25F;
      TestRenderer renderer(scene, {32, 32});
      for (const double distance : {1.0, 2.0}) {
        const Image tangent = renderer.frame(xu_vmf_method(), "xu_vmf:j=1", {}, 0, distance);
        const Image camera = renderer.frame(xu_vmf_method(), "xu_vmf:j=1:space=camera", {}, 0, distance);
        ASSERT_GT(covered_mean(tangent), 1e-3);
        EXPECT_LT(largest_difference(camera, tangent), 1e-4) << mirrored << ", " << degrees << ", " << distance;
      }
    }
  }
}

// One renderer that goes on, frame after frame.
class GoingOn {
 public:
  GoingOn(const Scene& scene, const MethodSpec& spec)
      : effects_(effects_on(derive_effects(scene))),
        gpu_scene_(shared_context().info(), scene, effects_),
        baked_(bake(xu_vmf_method(), spec, scene, effects_, no_progress)),
        gpu_(gpu_scene_, baked_),
        frames_(shared_context().info(), gpu_scene_, gpu_, {32, 32}, {}) {}

  [[nodiscard]] Image frame(const Scene& scene) {
    gpu_scene_.update(scene);
    return frames_.render({.size = {32, 32}, .camera = scene.camera});
  }

 private:
  EffectSet effects_;
  GpuScene gpu_scene_;
  BakedMethod baked_;
  GpuMethod gpu_;
  FrameRenderer frames_;
};

TEST(XuFrames, OfWhatMovesAreThoseOfAColdStart) {
  std::vector<Scene> frames{turned_square(0),  turned_square(20), turned_square(20),
                            turned_square(20), turned_square(20), turned_square(0)};
  std::get<PointLight>(frames[2].lights[0]).position = {-0.6F, 0.2F, 1.2F};  // a light
  frames[3].materials[0].lobe_parameter = 30.0F;                             // the BRDF
  frames[4] = frames[3];                                                     // the camera alone
  frames[4].camera.world = glm::translate(glm::mat4(turn(8, {1, 0, 0})), {0.3F, 0.0F, 3.0F});
  for (const std::string text :
       {"xu_vmf", "xu_vmf:rebuild=changed", "xu_vmf:space=camera", "xu_vmf:space=camera:rebuild=changed"}) {
    const MethodSpec spec = parse_methods(text).front();
    GoingOn going_on(frames.front(), spec);
    Image before;
    for (std::size_t i = 0; i < frames.size(); ++i) {
      const Image frame = going_on.frame(frames[i]);
      EXPECT_EQ(frame, GoingOn(frames[i], spec).frame(frames[i])) << text << ", frame " << i;
      EXPECT_NE(frame, before) << text << ", frame " << i;
      before = frame;
    }
  }
}

}  // namespace
}  // namespace footprint::testing
