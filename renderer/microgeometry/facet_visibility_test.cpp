// Visibility over the tiled patch against rays that Embree traces through explicit copies of it.
#include "renderer/microgeometry/facet_visibility.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/microgeometry/patch.hpp"
#include "tests/support/ray_traced_tiling.hpp"

namespace footprint {
namespace {

using testing::RayTracedTiling;

struct Agreement {
  std::size_t different = 0, all = 0, visible = 0;
};

Agreement against_rays(const Patch& patch, std::size_t count, int side, int copies) {
  const FacetSamples samples = sample_facets(patch, count, 7);
  const std::vector<glm::dvec3> directions = direction_grid(side);
  const FacetVisibility visibility = facet_visibility(patch, samples, directions, no_progress);
  const RayTracedTiling tiling(patch, copies);
  Agreement out;
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const double facing = glm::dot(facet_plane(patch, samples.triangles[i]).normal, directions[d]);
      if (std::abs(facing) < 1e-2) continue;  // rounding decides whether such a ray hits its own triangle
      const bool expected = facing > 0.0 && tiling.sees(samples.positions[i], directions[d]);
      out.different += expected != visibility.visible(d, i);
      out.visible += expected;
      ++out.all;
    }
  }
  return out;
}

class EveryPatchKind : public ::testing::TestWithParam<std::string> {};

// What is left are rays that graze an edge: they differ between two ways of rounding.
TEST_P(EveryPatchKind, IsSeenAsRaysThroughCopiesSeeIt) {
  const Patch patch = make_patch(find_patch_kind(GetParam()), {});
  check_patch(patch, "test");
  const Agreement found = against_rays(patch, 2000, 12, 6);
  EXPECT_LT(static_cast<double>(found.different), 2e-4 * static_cast<double>(found.all)) << found.different;
  EXPECT_GT(found.visible, found.all / 5);
}

INSTANTIATE_TEST_SUITE_P(Kinds, EveryPatchKind,
                         ::testing::Values("flat", "grooves", "pyramids", "spheres", "weave", "noise"),
                         [](const auto& test) { return test.param; });

// Tall pillars at grazing angles: rays cross several periods.
TEST(FacetVisibility, FollowsRaysThroughManyPeriods) {
  const Patch patch = make_patch(find_patch_kind("pyramids"), {{"slope_degrees", "70"}, {"floor", "0.6"}});
  const Agreement found = against_rays(patch, 1000, 12, 9);
  EXPECT_LT(static_cast<double>(found.different), 2e-4 * static_cast<double>(found.all)) << found.different;
}

// A floor under squares half as wide as the period: a point is hidden if a square, moved along the ray, covers it. As
// high up and seen from as low as can be, rays reach several hundred periods far.
TEST(FacetVisibility, FollowsRaysThroughHundredsOfPeriods) {
  constexpr float floor = 15.0F, roof = 16.0F;
  Patch patch;
  patch.name = "squares";
  patch.vertices = {{0, 0, floor},        {1, 0, floor},        {1, 1, floor},        {0, 1, floor},
                    {0.25F, 0.25F, roof}, {0.75F, 0.25F, roof}, {0.75F, 0.75F, roof}, {0.25F, 0.75F, roof}};
  patch.triangles = {{0, 1, 2}, {0, 2, 3}, {4, 5, 6}, {4, 6, 7}};
  check_patch(patch, "test");
  const FacetSamples samples = sample_facets(patch, 4000, 7);
  const glm::dvec2 shear(24.2, 3.3);
  const FacetVisibility visibility =
      facet_visibility(patch, samples, std::vector{glm::normalize(glm::dvec3(shear, 1.0))}, no_progress);
  std::size_t different = 0, hidden = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const glm::vec3& p = samples.positions[i];
    const glm::dvec2 above = glm::fract(glm::dvec2(p) + shear);
    const bool covered = p.z < 15.5F && std::max(std::abs(above.x - 0.5), std::abs(above.y - 0.5)) < 0.25;
    hidden += covered;
    different += visibility.visible(0, i) == covered;
  }
  EXPECT_NEAR(static_cast<double>(hidden), 800.0, 100.0);  // a quarter of the floor, which has 4 of 5 samples
  EXPECT_LT(different, 10U);
}

// A triangle may be wider than the period: its copies overlap it.
TEST(FacetVisibility, LooksThroughTheCopiesOfAWideTriangle) {
  Patch patch;
  patch.name = "wide";
  patch.vertices = {{-0.9F, -0.2F, 0.0F}, {1.9F, -0.1F, 0.9F}, {0.1F, 1.8F, 0.4F}};
  patch.triangles = {{0, 1, 2}};
  const Agreement found = against_rays(patch, 2000, 12, 9);
  EXPECT_LT(static_cast<double>(found.different), 2e-4 * static_cast<double>(found.all)) << found.different;
  EXPECT_LT(found.visible, found.all);
}

TEST(FacetVisibility, OfAPlaneIsWhole) {
  const Patch patch = make_patch(find_patch_kind("flat"), {});
  const FacetSamples samples = sample_facets(patch, 333, 1);
  const std::vector<glm::dvec3> directions = direction_grid(12);
  const FacetVisibility visibility = facet_visibility(patch, samples, directions, no_progress);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    for (std::size_t i = 0; i < samples.size(); ++i) ASSERT_TRUE(visibility.visible(d, i));
  }
}

// What the viewer sees of a closed height field fills its frame: the visible projected area is that of the period.
TEST(FacetVisibility, VisibleAreaOfAHeightFieldIsItsProjection) {
  const Patch patch = make_patch(find_patch_kind("noise"), {{"slope", "0.8"}});
  const FacetSamples samples = sample_facets(patch, 65536, 1);
  const std::vector<glm::dvec3> directions = direction_grid(12);
  const FacetVisibility visibility = facet_visibility(patch, samples, directions, no_progress);
  for (std::size_t d = 0; d < directions.size(); ++d) {
    double area = 0.0;
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!visibility.visible(d, i)) continue;
      area += samples.facet_area * glm::dot(facet_plane(patch, samples.triangles[i]).normal, directions[d]);
    }
    EXPECT_NEAR(area / directions[d].z, 1.0, 0.02) << "direction " << d;
  }
}

TEST(FacetVisibility, StopsOnRequest) {
  const Patch patch = make_patch(find_patch_kind("flat"), {});
  const FacetSamples samples = sample_facets(patch, 10, 1);
  const Progress stop = [](std::string_view, double) { throw Error(ErrorKind::interrupted, "test", "stopped"); };
  EXPECT_THROW((void)facet_visibility(patch, samples, direction_grid(12), stop), Error);
}

TEST(FacetSamples, FallByArea) {
  const Patch patch = make_patch(find_patch_kind("pyramids"), {{"floor", "0.5"}});
  constexpr std::size_t count = 5000;
  const FacetSamples samples = sample_facets(patch, count, 3);
  std::vector<double> found(patch.triangles.size());
  double area = 0.0;
  for (const std::uint32_t t : samples.triangles) ++found[t];
  for (std::size_t t = 0; t < found.size(); ++t) {
    const double expected = facet_plane(patch, t).area / samples.facet_area;
    EXPECT_NEAR(found[t], expected, 2.0);
    area += facet_plane(patch, t).area;
  }
  EXPECT_NEAR(samples.facet_area * count, area, 1e-12);
}

TEST(Patch, RefusesWhatCannotBeTiled) {
  const Patch good = make_patch(find_patch_kind("flat"), {});
  const auto refused = [&](auto&& spoil) {
    Patch bad = good;
    spoil(bad);
    EXPECT_THROW(check_patch(bad, "test"), Error);
  };
  EXPECT_NO_THROW(check_patch(good, "test"));
  refused([](Patch& p) { p.triangles.clear(); });
  refused([](Patch& p) { p.triangles[0].y = 99; });
  refused([](Patch& p) { p.vertices[0].z = std::nanf(""); });
  refused([](Patch& p) { p.vertices[0].z = 1e9F; });
  refused([](Patch& p) { p.period.x = 0.0F; });
  refused([](Patch& p) { p.paints.assign(p.triangles.size(), 3); });
  refused([](Patch& p) { p.palette.clear(); });
  refused([](Patch& p) { p.vertices.assign(p.vertices.size(), glm::vec3(0.5F)); });
}

TEST(PatchKinds, NameWhatIsWrong) {
  EXPECT_THROW((void)find_patch_kind("pyramid"), Error);
  EXPECT_THROW((void)make_patch(find_patch_kind("weave"), {{"warp_width", "2"}}), Error);
  EXPECT_THROW((void)make_patch(find_patch_kind("weave"), {{"width", "1"}}), Error);
  for (const PatchKind& kind : patch_kinds()) {
    EXPECT_TRUE(kind.summary.ends_with('.'));
    EXPECT_EQ(make_patch(kind, {}), make_patch(kind, {})) << kind.name;
  }
}

}  // namespace
}  // namespace footprint
