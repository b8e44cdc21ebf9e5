// The surfaces after Xu et al. 2017 and the scenes they are in: meshes that close and unfold, maps that say what they
// should.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <set>

#include "renderer/scene/assembly/load_scene.hpp"
#include "scenes/surfaces/height.hpp"
#include "scenes/surfaces/jacquard.hpp"
#include "tests/support/source_folder.hpp"
#include "tests/support/surface_maps.hpp"
#include "tests/support/texture_coverage.hpp"

namespace footprint {
namespace {

using testing::make_map;

Mesh mesh_of(const std::string& name) {
  const Surface& surface = find_surface(all_surfaces(), name);
  return surface.mesh(surface_settings(surface, {}));
}

double share_covered(const std::vector<int>& counts) {
  return 1.0 - static_cast<double>(std::ranges::count(counts, 0)) / static_cast<double>(counts.size());
}

void expect_unfolded(const Mesh& mesh, double least_share) {
  for (const Vertex& vertex : mesh.vertices) {
    ASSERT_TRUE(glm::all(glm::greaterThanEqual(vertex.uv0, glm::vec2{0.0F})));
    ASSERT_TRUE(glm::all(glm::lessThanEqual(vertex.uv0, glm::vec2{1.0F})));
  }
  const auto counts = testing::texture_coverage(mesh, 509);
  EXPECT_LE(std::ranges::max(counts), 1);
  EXPECT_GT(share_covered(counts), least_share);
}

/// Positions to a micrometre, so that two sheets that meet have the same ones.
using Corner = std::array<long, 3>;

Corner corner_of(const Vertex& vertex) {
  return {std::lround(1e6 * vertex.position.x), std::lround(1e6 * vertex.position.y),
          std::lround(1e6 * vertex.position.z)};
}

/// Edges that do not have one triangle on either side.
std::size_t open_edges(const Mesh& mesh) {
  std::map<std::pair<Corner, Corner>, int> sides;
  for (std::size_t i = 0; i < mesh.indices.size(); ++i) {
    const Corner a = corner_of(mesh.vertices[mesh.indices[i]]);
    const Corner b = corner_of(mesh.vertices[mesh.indices[i / 3 * 3 + (i + 1) % 3]]);
    if (a == b) continue;
    a < b ? ++sides[{a, b}] : --sides[{b, a}];
  }
  return static_cast<std::size_t>(std::ranges::count_if(sides, [](const auto& side) { return side.second != 0; }));
}

TEST(Pillow, IsClosedAndUnfoldsWithoutOverlap) {
  const Mesh mesh = mesh_of("pillow");
  EXPECT_EQ(open_edges(mesh), 0U);
  expect_unfolded(mesh, 0.99);
}

TEST(Pillow, HasTwoThreadsOfDifferentGloss) {
  const Surface& surface = find_surface(all_surfaces(), "pillow");
  const Image lobes = surface_map(surface, surface_settings(surface, {}), &Surface::lobe_parameter);
  const auto glossy = std::ranges::count_if(lobes.texels, [](float exponent) { return exponent > 55.0F; });
  const double share = static_cast<double>(glossy) / static_cast<double>(lobes.texels.size());
  EXPECT_GT(share, 0.2);
  EXPECT_LT(share, 0.6);
}

TEST(Tablecloth, IsOnItsTableAndUnfoldsWithoutOverlap) {
  const Mesh mesh = mesh_of("tablecloth");
  expect_unfolded(mesh, 0.99);
  double lowest = 1.0, highest = 0.0;
  for (const Vertex& vertex : mesh.vertices) {
    lowest = std::min(lowest, static_cast<double>(vertex.position.y));
    highest = std::max(highest, static_cast<double>(vertex.position.y));
  }
  EXPECT_NEAR(highest, 0.74, 1e-6);
  EXPECT_GT(lowest, 0.05);  // above the floor
  EXPECT_LT(lowest, 0.4);
}

TEST(Checker, HasTwoBrdfsInEqualSharesAndNoRelief) {
  Surface surface = find_surface(all_surfaces(), "checker");
  SurfaceSettings settings = surface_settings(surface, {{"squares", "4"}});
  settings.resolution = 64;
  const Image lobes = surface_map(surface, settings, &Surface::lobe_parameter);
  std::map<float, int> counts;
  for (const float exponent : lobes.texels) ++counts[exponent];
  EXPECT_EQ(counts, (std::map<float, int>{{8.0F, 2048}, {800.0F, 2048}}));
  EXPECT_NE(lobes.at(0, 0)[0], lobes.at(16, 0)[0]);
  EXPECT_EQ(lobes.at(0, 0)[0], lobes.at(16, 16)[0]);
  const Image normals = surface_normals(surface, settings);
  for (int i = 0; i < 64; ++i) EXPECT_EQ(normals.at(i, i)[2], 1.0F);
}

TEST(Studs, HasMetalWhereItIsRaised) {
  Surface surface = find_surface(all_surfaces(), "studs");
  SurfaceSettings settings = surface_settings(surface, {{"count", "6"}});
  settings.resolution = 128;
  const Image normals = surface_normals(surface, settings),
              lobes = surface_map(surface, settings, &Surface::lobe_parameter);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      ASSERT_TRUE(normals.at(x, y)[2] == 1.0F || lobes.at(x, y)[0] > 23.9F);
    }
  }
}

TEST(EngineTurned, HasFlanksThatRiseAndFallAlike) {
  const Image map = make_map("engine_turned", 512);
  double sum_x = 0.0, sum_y = 0.0, steepest = 0.0;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) {
      const auto normal = map.at(x, y);
      sum_x += normal[0];
      sum_y += normal[1];
      steepest = std::max(steepest, std::hypot(normal[0], normal[1]) / static_cast<double>(normal[2]));
    }
  }
  EXPECT_LT(std::abs(sum_x) / (512 * 512), 0.01);
  EXPECT_LT(std::abs(sum_y) / (512 * 512), 0.01);
  EXPECT_NEAR(steepest, std::tan(16.0 * 3.14159265 / 180.0), 0.01);
}

TEST(CastMetal, HasStainsOfTheSizeThatThePaperGives) {
  const Surface& surface = find_surface(all_surfaces(), "cast_metal");
  const SurfaceSettings settings = surface_settings(surface, {});
  EXPECT_EQ(settings.resolution, 2048);
  const Image stains = surface_map(surface, settings, &Surface::specular);
  EXPECT_EQ(stains.width, 671);
  EXPECT_EQ(stains.height, 457);
  EXPECT_EQ(surface.map_tiling(settings), glm::vec2(4.0F, 6.0F));
}

TEST(Jacquard, HasOneThreadOnTopAndTiles) {
  const Jacquard cloth({40, 40}, {2, 2}, 7);
  int binding = 0, ground = 0;
  for (int row = 0; row < 40; ++row) {
    for (int column = 0; column < 40; ++column) {
      const glm::dvec2 uv{(column + 0.5) / 40.0, (row + 0.5) / 40.0};
      const Thread thread = cloth.at(uv), again = cloth.at(uv + glm::dvec2{1.0, -2.0});
      EXPECT_EQ(thread.weft, again.weft);
      EXPECT_EQ(thread.uneven, again.uneven);
      EXPECT_NEAR(thread.across, 0.0, 1e-9);
      ground += thread.figure ? 0 : 1;
      binding += !thread.figure && thread.weft ? 1 : 0;
    }
  }
  EXPECT_NEAR(static_cast<double>(binding) / ground, 0.2, 0.05);  // satin of five
}

TEST(OctaveNoise, HasTheSlopeOfItsRelief) {
  std::mt19937_64 random(3);
  const OctaveNoise noise(std::array{Octave{4, 0.2}, Octave{17, 0.3}}, random);
  const auto height = [&](double x, double y) { return noise.relief(HeightPoint{{x, y}}).value(); };
  for (int i = 0; i < 50; ++i) {
    const double x = 0.019 * i, y = 0.37 + 0.011 * i, step = 1e-6;
    const glm::dvec2 slope = slope_of(noise.relief(HeightPoint{{x, y}}));
    EXPECT_NEAR(slope.x, (height(x + step, y) - height(x - step, y)) / (2 * step), 1e-6);
    EXPECT_NEAR(slope.y, (height(x, y + step) - height(x, y - step)) / (2 * step), 1e-6);
  }
}

TEST(HallCloth, TakesTurnsInEveryArch) {
  const Surface& surface = find_surface(all_surfaces(), "hall_cloth");
  std::multiset<std::pair<int, int>> arches;
  for (const char* dye : {"red", "green", "blue"}) {
    const Mesh mesh = surface.mesh(surface_settings(surface, {{"dye", dye}}));
    std::set<std::pair<int, int>> own;
    for (const Vertex& vertex : mesh.vertices) {
      own.emplace(vertex.position.x < 0.0F ? -1 : 1, static_cast<int>(std::floor(-vertex.position.z / 3.0F)));
    }
    arches.insert(own.begin(), own.end());
  }
  EXPECT_EQ(arches.size(), 12U);
  EXPECT_EQ((std::set<std::pair<int, int>>(arches.begin(), arches.end()).size()), 12U);
}

Scene load(const std::string& name) {
  return load_scene(name, {.folder = testing::source_folder() / "scenes", .surfaces = all_surfaces()});
}

TEST(XuScenes, HallHasFiveMaterialsOfOneBaseBrdf) {
  const Scene scene = load("sponza_hall");
  ASSERT_EQ(scene.materials.size(), 5U);
  EXPECT_EQ(scene.materials[1].name, "floor/hall_floor");
  for (const Material& material : scene.materials) EXPECT_EQ(material.brdf, scene.materials.front().brdf);
  EXPECT_TRUE(scene.defaults.empty());
  EXPECT_TRUE(scene.warnings.empty());
}

TEST(XuScenes, TableclothHasThePapersTwoLobes) {
  const Scene scene = load("tablecloth");
  ASSERT_EQ(scene.materials.at(0).lobes.size(), 2U);
  for (const FacetLobe& lobe : scene.materials[0].lobes) {
    EXPECT_EQ(lobe.parameter, 128.0F);
    EXPECT_NEAR(std::abs(lobe.axis.x), std::sqrt(0.5F), 1e-6F);
    EXPECT_NEAR(lobe.axis.z, std::sqrt(0.5F), 1e-6F);
  }
}

TEST(XuScenes, ModelsUnfoldWithoutOverlapWhereTheirPackagesAre) {
  for (const auto& [name, file] :
       {std::pair{"bunny", "/usr/share/glmark2/models/bunny.obj"},
        std::pair{"engine", "/usr/share/assimp/models/glTF2/2CylinderEngine-glTF-Binary/2CylinderEngine.glb"}}) {
    if (!std::filesystem::exists(file)) continue;
    const Scene scene = load(name);
    ASSERT_EQ(scene.meshes.size(), 1U) << name;
    expect_unfolded(scene.meshes[0], 0.25);
    EXPECT_TRUE(scene.materials.at(0).lobe_parameter_map);
  }
}

}  // namespace
}  // namespace footprint
