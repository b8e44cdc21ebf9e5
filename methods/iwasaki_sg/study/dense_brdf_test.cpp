// The sum over facets and the table of it, against cases that are known, and the figures that compare them with lobes.
#include "methods/iwasaki_sg/study/effective_brdf.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <tuple>

#include "methods/iwasaki_sg/material_table.hpp"
#include "methods/registry.hpp"
#include "renderer/core/error.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "tests/methods/iwasaki_materials.hpp"
#include "tests/support/sweep.hpp"

namespace footprint {
std::span<const Quantity> iwasaki_sg_quantities();
}

namespace footprint::iwasaki_sg {
namespace {

using testing::patch_material;
using testing::patch_of;

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};

double figure(const std::string& name, const Material& material, const std::map<std::string, std::string>& options,
              const std::map<std::string, std::string>& parameters = {}) {
  for (const Quantity& quantity : iwasaki_sg_quantities()) {
    if (quantity.name != name) continue;
    return quantity.measure(material, Options(option_table(), options, "test"),
                            Options(quantity.parameters, parameters, "test"));
  }
  ADD_FAILURE() << "no figure " << name;
  return 0.0;
}

// Pyramids of 40 degrees hide nothing from directions within 50 degrees of the axis: the sum over their planes by hand.
TEST(FacetSum, IsTheSumOverPlanes) {
  const Material material =
      patch_material(patch_of("pyramids", {{"slope_degrees", "40"}, {"floor", "0"}}), blinn_phong, 50.0F);
  const TableSettings settings = table_settings(material, Options(option_table(), {}, "test"), {});
  const Patch& patch = material.microgeometry->patch;
  const std::vector<glm::dvec3> directions{glm::normalize(glm::dvec3(0.1, 0.2, 1.0)),
                                           glm::normalize(glm::dvec3(-0.5, 0.1, 1.0))};
  const FacetSum sum(material, settings, bin_facets(patch, sample_facets(patch, 20000, 3)), directions, no_progress);
  const glm::dvec3 h = glm::normalize(directions[0] + directions[1]);
  double seen = 0.0, area = 0.0;
  for (std::size_t t = 0; t < patch.triangles.size(); ++t) {
    const FacetPlane plane = facet_plane(patch, t);
    const double projected = plane.area * glm::dot(plane.normal, directions[1]);
    area += projected;
    seen += projected * 51.0 / (2.0 * std::numbers::pi) * std::pow(std::max(glm::dot(plane.normal, h), 0.0), 50.0);
  }
  EXPECT_NEAR(sum(0, 1).x / (seen / area), 1.0, 2e-3);
  EXPECT_EQ(sum(0, 1).x, sum(0, 1).y);
}

// At its own directions the table is the sum.
TEST(DenseTable, StoresTheSumAndInterpolatesIt) {
  const Material material = patch_material(patch_of("grooves"), blinn_phong, 20.0F);
  TableSettings settings = table_settings(material, Options(option_table(), {{"facets", "2000"}}, "test"), {});
  const Patch& patch = material.microgeometry->patch;
  for (const Cosines cosines : {Cosines::base, Cosines::published}) {
    settings.cosines = cosines;
    const BrdfFunction table = dense_table(material, settings, 5, no_progress);
    const FacetSum sum(material, settings, bin_facets(patch, sample_facets(patch, settings.facets, settings.seed)),
                       direction_grid(5), no_progress);
    for (const std::size_t i : {0U, 7U, 12U, 24U}) {
      for (const std::size_t o : {3U, 12U, 20U}) {
        const glm::dvec3 expected = sum(i, o);
        EXPECT_NEAR(table(sum.directions()[i], sum.directions()[o]).y, expected.y, 1e-5 * (1.0 + expected.y));
      }
    }
  }
  EXPECT_EQ(dense_table_bytes(5, 3), 625U * 12U);
}

// With all singular values the matrix is the lobe at the grid's normals, and fewer values leave a larger error.
TEST(LowRankLobe, IsTheLobeWithAllValuesAndLessWithFewer) {
  const Lobe lobe{NormalDistribution::blinn_phong, 60.0};
  const std::vector<glm::dvec3> normals = direction_grid(8);
  const LowRankLobe all(lobe, {.side = 10, .normals = 8, .values = 64}),
      few(lobe, {.side = 10, .normals = 8, .values = 8});
  double whole = 0.0, off = 0.0;
  for (const glm::dvec3& h : direction_grid(5)) {
    const Eigen::VectorXd row = all.row(h), short_row = few.row(h);
    for (const glm::dvec3& n : normals) {
      const double expected = 61.0 / (2.0 * std::numbers::pi) * std::pow(std::max(glm::dot(n, h), 0.0), 60.0);
      EXPECT_NEAR(all.density(row, n), expected, 1e-4);
      off += std::pow(few.density(short_row, n) - expected, 2.0);
      whole += expected * expected;
    }
  }
  EXPECT_GT(off, 0.1 * whole) << "8 vectors do not have the lobes about 64 normals";
  EXPECT_LT(off, whole);
}

// Iwasaki et al. 2012, section 6: 1.7M x 6.1K, 460 MB with 70 singular values and 782 MB with 120 (of 2^20 bytes).
TEST(LowRankLobe, HasTheBytesThatArePrinted) {
  EXPECT_NEAR(static_cast<double>(LowRankLobe::byte_count({.side = 43, .normals = 78, .values = 70})) / 1048576.0,
              460.0, 3.0);
  EXPECT_NEAR(static_cast<double>(LowRankLobe::byte_count({.side = 43, .normals = 78, .values = 120})) / 1048576.0,
              782.0, 5.0);
}

// Few planes: the lobes represent them and the table of the same size does not; a larger table comes nearer.
TEST(BrdfFigures, LobesAgainstTables) {
  const Material material = patch_material(patch_of("grooves"), blinn_phong, 200.0F);
  const std::map<std::string, std::string> options{{"facets", "8192"}};
  const double lobes = figure("brdf_error", material, options);
  const double coarse = figure("table_error", material, options, {{"side", "6"}});
  const double fine = figure("table_error", material, options, {{"side", "12"}});
  EXPECT_LT(lobes, 0.1);
  EXPECT_LT(lobes, 0.5 * fine);
  EXPECT_LT(fine, 0.9 * coarse);
  EXPECT_EQ(figure("table_bytes", material, options, {{"side", "12"}}), 144.0 * 144.0 * 4.0);
  EXPECT_GT(figure("brdf_bytes", material, options), 144.0 * 144.0 * 4.0);
  EXPECT_GT(figure("brdf_ms", material, options), 0.0);
  EXPECT_GT(figure("table_ms", material, options, {{"side", "6"}}), 0.0);
}

// The patches of scenes/bi_scale_spheres with 1, 4 and 8 lobes. As many lobes as normals are enough (grooves 3,
// pyramids 5), fewer are not. Bounds are measured figures, rounded up.
TEST(BrdfFigures, LobesAgainstTheSumOverFacetsByTheirNumber) {
  const std::vector<std::tuple<Patch, std::array<double, 3>>> rows{
      {patch_of("spheres", {{"radius", "0.3"}}), {0.99, 0.14, 0.13}},
      {patch_of("pyramids", {{"floor", "0.3"}, {"slope_degrees", "15"}}), {0.82, 0.66, 0.08}},
      {patch_of("grooves", {{"land", "0.25"}, {"flank_degrees", "20"}}), {0.98, 0.04, 0.04}}};
  for (std::size_t row = 0; row < rows.size(); ++row) {
    const auto& [patch, bounds] = rows[row];
    const Material material = patch_material(patch, blinn_phong, 512.0F);
    constexpr std::array counts{"1", "4", "8"};
    for (const std::size_t i : testing::sweep(std::array<std::size_t, 3>{0, 1, 2}, 1, row)) {
      EXPECT_LT(figure("brdf_error", material, {{"facets", "4096"}, {"j", counts[i]}}), bounds[i])
          << patch.name << ", " << counts[i] << " lobes";
    }
  }
}

TEST(BrdfFigures, OfAMaterialWithoutAPatchAreAnError) {
  const Material material = testing::square_scene({}, {}).materials[0];
  EXPECT_THROW((void)figure("brdf_error", material, {}), Error);
  EXPECT_THROW((void)figure("table_error", material, {}), Error);
}

}  // namespace
}  // namespace footprint::iwasaki_sg
