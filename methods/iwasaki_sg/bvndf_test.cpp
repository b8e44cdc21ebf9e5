// The BVNDF against sums over rays that Embree traces, its symmetry, and its sums against plain loops.
#include "methods/iwasaki_sg/bvndf.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

#include "methods/iwasaki_sg/lobe_fit.hpp"
#include "renderer/core/error.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "tests/support/ray_traced_tiling.hpp"

namespace footprint::iwasaki_sg {
namespace {

Bvndf bvndf_of(const Patch& patch, std::size_t facets, int side) {
  return make_bvndf(patch, bin_facets(patch, sample_facets(patch, facets, 1)), direction_grid(side), no_progress);
}

// Points of an even grid on each triangle, each with its share of the area: another way of sampling than facets'.
struct Point {
  glm::vec3 position;
  std::size_t triangle;
  double area;
};

std::vector<Point> even_points(const Patch& patch, int steps) {
  std::vector<Point> points;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const glm::dvec3 a(patch.vertices[patch.triangles[t].x]);
    const glm::dvec3 ab = glm::dvec3(patch.vertices[patch.triangles[t].y]) - a;
    const glm::dvec3 ac = glm::dvec3(patch.vertices[patch.triangles[t].z]) - a;
    const double area = facet_plane(patch, t).area / (steps * steps);
    for (int v = 0; v < steps; ++v) {
      for (int u = 0; u < steps; ++u) {  // centroids of the steps^2 triangles that it is cut into
        const bool upper = u + v >= steps;
        const double x = upper ? (steps - u - 1.0 / 3.0) / steps : (u + 1.0 / 3.0) / steps;
        const double y = upper ? (steps - v - 1.0 / 3.0) / steps : (v + 1.0 / 3.0) / steps;
        points.push_back({glm::vec3(a + x * ab + y * ac), t, area});
      }
    }
  }
  return points;
}

// gamma of every discretised normal of pyramids, whose normals are five, to 0.5% of the patch's area.
TEST(Bvndf, IsTheRayTracedSum) {
  const Patch patch = make_patch(find_patch_kind("pyramids"), {{"slope_degrees", "50"}, {"floor", "0.3"}});
  const Bvndf bvndf = bvndf_of(patch, 65536, 5);
  ASSERT_EQ(bvndf.bins.size(), 5U);
  const testing::RayTracedTiling tiling(patch, 8);
  const std::vector<Point> points = even_points(patch, 24);
  const std::size_t n = bvndf.directions.size();
  std::vector<std::vector<bool>> sees(n);
  for (std::size_t d = 0; d < n; ++d) {
    for (const Point& p : points) {
      const bool faces = glm::dot(facet_plane(patch, p.triangle).normal, bvndf.directions[d]) > 0.0;
      sees[d].push_back(faces && tiling.sees(p.position, bvndf.directions[d]));
    }
  }
  double worst = 0.0;
  for (std::size_t bin = 0; bin < bvndf.bins.size(); ++bin) {
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t o = i; o < n; ++o) {
        double sum = 0.0;
        for (std::size_t k = 0; k < points.size(); ++k) {
          const glm::dvec3 normal = facet_plane(patch, points[k].triangle).normal;
          if (sees[i][k] && sees[o][k] && glm::dot(normal, bvndf.bins[bin].normal) > 0.999) sum += points[k].area;
        }
        worst = std::max(worst, std::abs(bvndf.gamma(bin, i, o) - sum));
        EXPECT_EQ(bvndf.gamma(bin, i, o), bvndf.gamma(bin, o, i));
      }
    }
  }
  EXPECT_LT(worst, 0.005 * bvndf.total_area());
}

// a_v: the visible area of a closed height field is the projected period.
TEST(Bvndf, VisibleAreaIsTheProjectionOfTheFrame) {
  const Bvndf bvndf = bvndf_of(make_patch(find_patch_kind("pyramids"), {}), 65536, 12);
  for (std::size_t d = 0; d < bvndf.directions.size(); ++d) {
    EXPECT_NEAR(bvndf.visible_area[d] / bvndf.directions[d].z, 1.0, 0.02);
  }
}

// Threads of two colours, of which one absorbs all: sums in three channels, bins that are cut across words.
TEST(Bvndf, SumsAreThoseOfPlainLoops) {
  const Patch patch = make_patch(find_patch_kind("weave"), {{"steps_along", "4"}, {"steps_across", "3"}});
  const Bvndf bvndf = bvndf_of(patch, 3000, 3);
  const std::array<SphericalGaussian, 2> lobes{SphericalGaussian{{0, 0, 1}, 8.0},
                                               SphericalGaussian{glm::normalize(glm::dvec3(0.4, 0.1, 1)), 30.0}};
  const std::array<PaintFactors, 2> paints{PaintFactors{{1.0F, 0.5F, 0.0F}, {0.2F, 1.0F, 0.7F}},
                                           PaintFactors{{0.0F, 1.0F, 0.3F}, {1.0F, 0.0F, 0.1F}}};
  for (const Cosines cosines : {Cosines::base, Cosines::published}) {
    const BvndfSums sums = sum_bvndf(bvndf, lobes, cosines, 3, paints, no_progress);
    const std::size_t n = bvndf.directions.size();
    for (std::size_t i = 0; i < n; ++i) {
      for (std::size_t o = 0; o < n; ++o) {
        glm::dvec3 total(0.0), diffuse(0.0);
        std::array<glm::dvec3, 2> products{};
        for (std::size_t bin = 0; bin < bvndf.bins.size(); ++bin) {
          const NormalBin& b = bvndf.bins[bin];
          const double ci = std::max(glm::dot(b.normal, bvndf.directions[i]), 0.0);
          const double co = std::max(glm::dot(b.normal, bvndf.directions[o]), 0.0);
          const double weight = bvndf.gamma(bin, i, o) * co * (cosines == Cosines::published ? ci : 1.0);
          total += weight * glm::dvec3(paints[b.paint].specular);
          diffuse += bvndf.gamma(bin, i, o) * ci * co * glm::dvec3(paints[b.paint].diffuse);
          for (std::size_t j = 0; j < 2; ++j) {
            products[j] += weight * value(lobes[j], b.normal) * glm::dvec3(paints[b.paint].specular);
          }
        }
        for (int c = 0; c < 3; ++c) {
          const std::size_t at = (static_cast<std::size_t>(c) * n + i) * n + o;
          EXPECT_NEAR(sums.totals[at], total[c], 1e-5);
          EXPECT_NEAR(sums.diffuse[at], diffuse[c], 1e-5);
          for (std::size_t j = 0; j < 2; ++j) {
            const std::size_t product = ((static_cast<std::size_t>(c) * 2 + j) * n + i) * n + o;
            EXPECT_NEAR(sums.products[product], products[j][c], 2e-5);
          }
        }
      }
    }
  }
}

TEST(NormalBins, KeepFlatNormalsExactly) {
  const Patch patch = make_patch(find_patch_kind("pyramids"), {});
  const BinnedFacets binned = bin_facets(patch, sample_facets(patch, 1000, 1));
  EXPECT_EQ(binned.bins.size(), 5U);
  for (const NormalBin& bin : binned.bins) {
    for (std::size_t i = bin.begin; i < bin.end; ++i) {
      EXPECT_LT(glm::length(facet_plane(patch, binned.samples.triangles[i]).normal - bin.normal), 1e-6);
    }
  }
}

TEST(NormalBins, CellsAreWhereTheNormalPoints) {
  EXPECT_EQ(cube_cell({1, 0, 0}, 1), 0U);
  EXPECT_EQ(cube_cell({0, -1, 0}, 1), 3U);
  EXPECT_EQ(cube_cell({0, 0, 1}, 1), 4U);
  std::map<std::uint32_t, int> cells;
  for (const glm::dvec3& d : direction_grid(64)) ++cells[cube_cell(d, 4)];
  EXPECT_GT(cells.size(), 40U);  // half of 6 x 16, and those that the horizon cuts
  for (const auto& [cell, count] : cells) EXPECT_LT(cell, 96U);
}

TEST(NormalBins, OfAMapLeaveOutWhatIsInvalid) {
  Image map(2, 2, 4);
  map.texels = {0, 0, 1, 1, 0.6F, 0, 0.8F, 1, 0, 0, 1, 0, 0, 0, 0, 1};
  const std::vector<WeightedNormal> normals = bin_normal_map(map);
  ASSERT_EQ(normals.size(), 2U);
  EXPECT_NEAR(normals[0].weight, 0.5, 1e-12);
  EXPECT_TRUE(bin_normal_map(Image(1, 1, 4)).empty());
}

}  // namespace
}  // namespace footprint::iwasaki_sg
