// Checks of every surface: unit normals, seeds, threads, sizes, tiles, statistics, meshes.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <array>
#include <cmath>
#include <numeric>
#include <ostream>
#include <set>
#include <string>

#include "renderer/core/error.hpp"
#include "scenes/surfaces/registry.hpp"
#include "tests/support/surface_meshes.hpp"
#include "tests/support/sweep.hpp"

namespace footprint {

void PrintTo(const Surface& surface, std::ostream* out) { *out << surface.name; }

namespace {

class EverySurface : public ::testing::TestWithParam<Surface> {
 protected:
  static SurfaceSettings settings(int resolution, std::uint32_t seed = 1) {
    SurfaceSettings settings = surface_settings(GetParam(), {});
    settings.resolution = resolution;
    settings.seed = seed;
    return settings;
  }
  static Image normals(int resolution, std::uint32_t seed = 1) {
    return surface_normals(GetParam(), settings(resolution, seed));
  }
};

glm::dvec3 normal_at(const Image& map, int x, int y) {
  const auto texel = map.at(x, y);
  return {texel[0], texel[1], texel[2]};
}

void expect_unit_normals(const Image& map) {
  double longest = 0.0, shortest = 2.0, lowest = 1.0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec3 normal = normal_at(map, x, y);
      longest = std::max(longest, glm::length(normal));
      shortest = std::min(shortest, glm::length(normal));
      lowest = std::min(lowest, normal.z);
      ASSERT_EQ(map.at(x, y)[3], 1.0F);
      ASSERT_TRUE(std::isfinite(glm::dot(normal, normal)));
    }
  }
  EXPECT_LT(longest, 1.0 + 1e-6);
  EXPECT_GT(shortest, 1.0 - 1e-6);
  EXPECT_GT(lowest, 0.0);
}

TEST_P(EverySurface, HasUnitNormalsOutOfTheSurfaceAtAnySize) {
  std::vector<int> resolutions(17);
  std::iota(resolutions.begin(), resolutions.end(), 1);
  for (const int resolution : testing::sweep(resolutions, 5)) {
    const Image map = normals(resolution);
    EXPECT_EQ(map.width, resolution);
    EXPECT_EQ(map.height, resolution);
    EXPECT_EQ(map.channels, 4);
    expect_unit_normals(map);
  }
  for (const int resolution : testing::sweep(std::array{251, 256}, 1)) expect_unit_normals(normals(resolution));
}

/// All maps that a surface has.
std::vector<Image> maps(const Surface& surface, const SurfaceSettings& settings) {
  return {surface_normals(surface, settings), surface_map(surface, settings, &Surface::base_color),
          surface_map(surface, settings, &Surface::specular), surface_map(surface, settings, &Surface::lobe_parameter)};
}

/// Whether chance has no part in a surface.
bool is_regular(const Surface& surface) {
  return std::set<std::string>{"checker", "chess_board", "chess_piece", "sphere"}.contains(surface.name);
}

/// Whether a surface has a shape, colours or gloss alone.
bool has_relief(const Surface& surface) { return !is_regular(surface) && surface.name != "pillow"; }

TEST_P(EverySurface, IsAFunctionOfItsSeedAlone) {
  const auto made = maps(GetParam(), settings(129));
  EXPECT_EQ(maps(GetParam(), settings(129)), made);
  EXPECT_EQ(maps(GetParam(), settings(129, 2)) == made, is_regular(GetParam()));
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  EXPECT_EQ(maps(GetParam(), settings(129)), made);
}

TEST_P(EverySurface, HasMapsOfItsBrdfWithinTheirRanges) {
  for (const int resolution : {1, 2, 33, 128}) {
    const auto [colors, speculars, lobes] =
        std::array{surface_map(GetParam(), settings(resolution), &Surface::base_color),
                   surface_map(GetParam(), settings(resolution), &Surface::specular),
                   surface_map(GetParam(), settings(resolution), &Surface::lobe_parameter)};
    for (const Image& map : {colors, speculars}) {
      for (const float value : map.texels) ASSERT_TRUE(value >= 0.0F && value <= 1.0F) << value;
    }
    const bool widths =
        GetParam().distribution == NormalDistribution::beckmann || GetParam().distribution == NormalDistribution::ggx;
    const auto [least, most] = widths ? std::array{1e-3F, 1.0F} : std::array{1.0F, 1e6F};
    for (const float value : lobes.texels) ASSERT_TRUE(value >= least && value <= most) << value;
    EXPECT_TRUE(colors.empty() || colors.channels == 4);
    EXPECT_TRUE(speculars.empty() || speculars.channels == 3);
    EXPECT_TRUE(lobes.empty() || lobes.channels == 1);
  }
}

/// Mean and variance of the normals' x and y; slopes have none where a surface is steep.
struct Moments {
  glm::dvec2 mean{0.0}, variance{0.0};
};

Moments moments(const Image& map) {
  Moments moments;
  const double weight = 1.0 / static_cast<double>(map.texel_count());
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) moments.mean += weight * glm::dvec2(normal_at(map, x, y));
  }
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const glm::dvec2 offset = glm::dvec2(normal_at(map, x, y)) - moments.mean;
      moments.variance += weight * offset * offset;
    }
  }
  return moments;
}

TEST_P(EverySurface, HasTheSameStatisticsAtEverySize) {
  const Moments coarse = moments(normals(256)), fine = moments(normals(512)), odd = moments(normals(383));
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(fine.mean[axis], coarse.mean[axis], 0.01);
    EXPECT_NEAR(fine.variance[axis], coarse.variance[axis], 0.05 * fine.variance[axis] + 1e-12);
    EXPECT_NEAR(fine.variance[axis], odd.variance[axis], 0.05 * fine.variance[axis] + 1e-12);
  }
  EXPECT_EQ(fine.variance.x > 1e-4, has_relief(GetParam()));
}

TEST_P(EverySurface, HasAMeshWithUnitFrames) { testing::expect_unit_frames(GetParam().mesh(settings(64))); }

TEST_P(EverySurface, FacesTheSideThatItsNormalsPointTo) {
  testing::expect_faces_its_normals(GetParam().mesh(settings(64)));
}

TEST_P(EverySurface, MapRunsAlongItsTangents) { testing::expect_map_along_tangents(GetParam().mesh(settings(64))); }

TEST_P(EverySurface, RefusesSizesThatNoMapHas) {
  for (const int resolution : {0, -1, largest_surface_resolution + 1, 1'000'000}) {
    try {
      (void)normals(resolution);
      FAIL() << resolution;
    } catch (const Error& error) {
      EXPECT_EQ(error.kind(), ErrorKind::usage);
      EXPECT_THAT(error.what(), ::testing::HasSubstr("not within 1 to 16384"));
    }
  }
}

TEST_P(EverySurface, RefusesParametersThatItHasNot) {
  EXPECT_THROW((void)surface_settings(GetParam(), {{"nonsense", "1"}}), Error);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, EverySurface, ::testing::ValuesIn(all_surfaces().begin(), all_surfaces().end()),
                         [](const auto& row) { return row.param.name; });

TEST(Surfaces, AreFoundByName) {
  EXPECT_EQ(find_surface(all_surfaces(), "v_grooves").name, "v_grooves");
  try {
    (void)find_surface(all_surfaces(), "v_groves");
    FAIL();
  } catch (const Error& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("did you mean `v_grooves`"));
  }
}

}  // namespace
}  // namespace footprint
