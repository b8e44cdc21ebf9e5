// The four flat test surfaces have the normals that their names promise, which figures on paper rest on.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <string>

#include "tests/support/surface_maps.hpp"

namespace footprint {
namespace {

using testing::make_map;

/// The share of texels for which `condition` is true.
double share(const Image& map, const std::function<bool(const glm::dvec3&)>& condition) {
  std::size_t count = 0;
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const auto texel = map.at(x, y);
      count += condition(glm::dvec3{texel[0], texel[1], texel[2]}) ? 1U : 0U;
    }
  }
  return static_cast<double>(count) / static_cast<double>(map.texel_count());
}

bool is_flat(const glm::dvec3& normal) { return normal == glm::dvec3{0.0, 0.0, 1.0}; }

// Texels on both sides of the map's border differ no more than those of some other two rows or columns that meet.
TEST(FlatSurfaces, Tile) {
  for (const std::string name : {"bumps", "scales", "scratched_metal", "car_paint"}) {
    const Image map = make_map(name, 512);
    const auto difference = [&](int x0, int y0, int x1, int y1) {
      double squares = 0.0;
      for (std::size_t c = 0; c < 3; ++c) squares += std::pow(map.at(x0, y0)[c] - map.at(x1, y1)[c], 2);
      return squares;
    };
    std::array<double, 2> border{}, inside{};
    for (int k = 0; k < map.width; ++k) {
      const int before = (k + map.width - 1) % map.width;
      std::array<double, 2> sum{};  // columns, rows
      for (int i = 0; i < map.width; ++i) {
        sum[0] += difference(before, i, k, i);
        sum[1] += difference(i, before, i, k);
      }
      for (std::size_t axis = 0; axis < 2; ++axis) {
        double& counted = k == 0 ? border[axis] : inside[axis];
        counted = std::max(counted, sum[axis]);
      }
    }
    for (std::size_t axis = 0; axis < 2; ++axis) EXPECT_LE(border[axis], 1.05 * inside[axis]) << name;
  }
}

// A scratch over the border goes on at the other side: as many texels are cut along the border as elsewhere.
TEST(Scratches, GoOnOverTheBorder) {
  const Image map = make_map("scratches", 512, {{"count", "400"}});
  const auto cut = [&](int row) {
    int count = 0;
    for (int x = 0; x < map.width; ++x) count += map.at(x, row)[2] < 1.0F ? 1 : 0;
    return count;
  };
  int differing = 0;  // texels cut in the first row whose neighbours beyond the border are not
  for (int x = 1; x + 1 < map.width; ++x) {
    if (map.at(x, 0)[2] == 1.0F) continue;
    bool goes_on = false;
    for (int near = x - 2; near <= x + 2; ++near) {
      goes_on = goes_on || map.at((near + map.width) % map.width, map.height - 1)[2] < 1.0F;
    }
    differing += goes_on ? 0 : 1;
  }
  EXPECT_GT(cut(0), 20);
  EXPECT_LT(differing, cut(0) / 4);
}

TEST(VGrooves, HaveTwoNormalsAndNoOther) {
  const double sine = std::sin(glm::radians(30.0)), cosine = std::cos(glm::radians(30.0));
  const auto is = [&](double x) {
    return [=](const glm::dvec3& normal) { return glm::length(normal - glm::dvec3{x, 0.0, cosine}) < 1e-7; };
  };
  for (const int resolution : {256, 383, 512, 1024}) {
    const Image map = make_map("v_grooves", resolution, {{"tilt_degrees", "30"}});
    EXPECT_NEAR(share(map, is(sine)), 0.5, 16.0 / resolution);
    EXPECT_EQ(share(map, is(sine)) + share(map, is(-sine)), 1.0);
  }
}

// Archimedes: the area of a hemisphere over a piece of its shadow is inverse to its z, so the shadow sees every (x, y)
// of the disc evenly: the share within radius r of the disc is r^2, in every direction alike.
TEST(Scales, AreHemispheres) {
  const Image map = make_map("scales", 1024);
  const double ground = share(map, is_flat), scales = 1.0 - ground;
  EXPECT_GT(ground, 0.15);
  EXPECT_LT(ground, 0.45);
  for (const double radius : {0.25, 0.5, 0.75, 0.9, 0.99}) {
    const double within = share(map, [&](const glm::dvec3& n) { return !is_flat(n) && std::hypot(n.x, n.y) < radius; });
    EXPECT_NEAR(within / scales, radius * radius, 0.005) << radius;
  }
  const std::array<glm::dvec2, 4> directions{{{1, 0}, {0, 1}, {-1, 0}, {0, -1}}};
  for (const glm::dvec2& direction : directions) {
    const double quarter = share(map, [&](const glm::dvec3& n) {
      return !is_flat(n) && glm::dot(glm::dvec2(n), direction) > std::sqrt(0.5) * std::hypot(n.x, n.y);
    });
    EXPECT_NEAR(quarter / scales, 0.25, 0.003);
  }
}

TEST(Scales, CoverWhatTheirRadiiSay) {
  const Image map = make_map("scales", 2048, {{"count", "4"}, {"fill", "1"}, {"variation", "0"}});
  // Four columns, four rows: discs of diameter 1/4 in rows 1/4 apart, moved by 1/8, touch their neighbours in the row.
  EXPECT_NEAR(1.0 - share(map, is_flat), 16 * glm::radians(180.0) / 64.0, 1e-3);
}

TEST(Scratches, AreThinLinesOnFlatGround) {
  for (const int resolution : {256, 512, 1024}) {
    const Image map = make_map("scratches", resolution);
    EXPECT_GT(share(map, is_flat), 0.8);
    EXPECT_LT(share(map, is_flat), 0.95);
    const auto steeper = [&](double degrees) {
      return share(map, [=](const glm::dvec3& n) { return n.z < std::cos(glm::radians(degrees)); });
    };
    EXPECT_EQ(steeper(45.01), 0.0);
    EXPECT_GT(steeper(20.0), 0.005);
  }
  EXPECT_EQ(share(make_map("scratches", 64, {{"count", "0"}}), is_flat), 1.0);
}

// Few texels are ground alone, and none is as steep as the deepest scratch and the grain on its flank together.
TEST(ScratchedMetal, IsScratchesOverGrain) {
  const Image grain = make_map("scratched_metal", 512, {{"count", "0"}});
  const Image both = make_map("scratched_metal", 512);
  const auto steeper = [](const Image& map, double degrees) {
    return share(map, [=](const glm::dvec3& n) { return n.z < std::cos(glm::radians(degrees)); });
  };
  EXPECT_GT(steeper(grain, 1.0), 0.8);
  EXPECT_EQ(steeper(grain, 15.0), 0.0);
  EXPECT_GT(steeper(both, 15.0), 0.05);
  EXPECT_LT(steeper(both, 15.0), 0.4);
  EXPECT_EQ(steeper(both, 35.0 + 15.0), 0.0);
}

// Slopes of flakes are Gaussian of variance tilt^2 / 2: lengths squared over tilt^2 are exponential of mean 1.
TEST(CarPaint, HasFlakesOfABeckmannDistribution) {
  const double tilt = 0.3;
  const Image map = make_map("car_paint", 512, {{"flake_tilt", "0.3"}, {"coverage", "1"}, {"flakes", "256"}});
  for (const double squared : {0.1, 0.5, 1.0, 2.0, 4.0}) {
    const double steeper =
        share(map, [&](const glm::dvec3& n) { return (n.x * n.x + n.y * n.y) / (n.z * n.z) > squared * tilt * tilt; });
    // 65536 flakes: four standard errors, twice over for flakes of different sizes.
    EXPECT_NEAR(steeper, std::exp(-squared), 0.015) << squared;
  }
}

TEST(CarPaint, IsFlatPaintWithoutFlakesAndHasTheRequestedShare) {
  EXPECT_EQ(share(make_map("car_paint", 64, {{"coverage", "0"}, {"peel", "0"}}), is_flat), 1.0);
  for (const double coverage : {0.25, 0.5, 0.75}) {
    const Image map = make_map("car_paint", 512, {{"coverage", std::to_string(coverage)}, {"peel", "0"}});
    EXPECT_NEAR(share(map, is_flat), 1.0 - coverage, 0.015) << coverage;
  }
}

// Every flake is flat and a few texels wide: where the map has four texels per cell most neighbours have one normal.
TEST(CarPaint, HasFlatFlakesSeveralTexelsWide) {
  const Image map = make_map("car_paint", 512, {{"coverage", "1"}, {"flakes", "128"}});
  int alike = 0;
  for (int y = 0; y < 512; ++y) {
    for (int x = 0; x < 512; ++x) alike += std::ranges::equal(map.at(x, y), map.at((x + 1) % 512, y)) ? 1 : 0;
  }
  const double share_alike = alike / (512.0 * 512.0);
  EXPECT_GT(share_alike, 0.6);  // squares of four texels would have three quarters
  EXPECT_LT(share_alike, 0.85);
}

// The map of lobes has the flakes where the normals have them.
TEST(CarPaint, HasTheLobeOfAFlakeWhereThereIsOne) {
  const Surface& surface = find_surface(all_surfaces(), "car_paint");
  SurfaceSettings settings = surface_settings(surface, {{"peel", "0"}, {"flake_alpha", "0.05"}});
  settings.resolution = 128;
  const Image normals = surface_normals(surface, settings),
              alphas = surface_map(surface, settings, &Surface::lobe_parameter);
  for (int y = 0; y < 128; ++y) {
    for (int x = 0; x < 128; ++x) {
      ASSERT_EQ(alphas.at(x, y)[0], normals.at(x, y)[2] == 1.0F ? 0.2F : 0.05F) << x << ", " << y;
    }
  }
}

// A height field of round bumps has no flat ground and leans to no side.
TEST(Bumps, LeaveNoGroundFlat) {
  const Image map = make_map("bumps", 512);
  EXPECT_LT(share(map, [](const glm::dvec3& n) { return n.z > std::cos(glm::radians(1.0)); }), 0.005);
  EXPECT_GT(share(map, [](const glm::dvec3& n) { return n.z < std::cos(glm::radians(20.0)); }), 0.3);
  for (int axis = 0; axis < 2; ++axis) {
    EXPECT_NEAR(share(map, [=](const glm::dvec3& n) { return n[axis] > 0.0; }), 0.5, 0.03);
  }
}

// Neighbouring texels' normals must belong to one height field: the slopes around any square of texels sum to zero.
TEST(Bumps, AreAHeightField) {
  const Image map = make_map("bumps", 1024, {{"count", "8"}});
  const auto slope = [&](int x, int y, std::size_t axis) {
    return -static_cast<double>(map.at(x, y)[axis]) / map.at(x, y)[2];
  };
  double worst = 0.0;
  for (int y = 0; y + 2 < map.height; ++y) {
    for (int x = 0; x + 2 < map.width; ++x) {
      // d slope_x / dy - d slope_y / dx by central differences; rows run downwards.
      const double curl = (slope(x + 1, y, 0) - slope(x + 1, y + 2, 0)) - (slope(x + 2, y + 1, 1) - slope(x, y + 1, 1));
      worst = std::max(worst, std::abs(curl));
    }
  }
  EXPECT_LT(worst, 2e-3);
}

}  // namespace
}  // namespace footprint
