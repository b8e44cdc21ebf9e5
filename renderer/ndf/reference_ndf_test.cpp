// The exact NDF against closed forms and a plain sum, the texels under footprints, and the grids of directions.
#include "renderer/ndf/reference_ndf.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <memory>
#include <numbers>

#include "renderer/core/error.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using enum NormalDistribution;
using std::numbers::pi;

Material material_of(const Image& normals, const Lobe& lobe, Wrap wrap = Wrap::repeat) {
  Material material;
  material.name = "test";
  material.brdf = {lobe.distribution, GeometryTerm::none, FresnelTerm::none, false};
  material.lobe_parameter = static_cast<float>(lobe.parameter);
  material.normal_map = TextureMap{"normals", std::make_shared<const Image>(normals), {}};
  material.normal_map->coordinates.wrap = {wrap, wrap};
  return material;
}

// One row of texels, each a normal of its own.
Image row_of(const std::vector<glm::vec3>& normals) {
  Image image(static_cast<int>(normals.size()), 1, 4, 1.0F);
  for (std::size_t i = 0; i < normals.size(); ++i) std::copy_n(&normals[i].x, 3, &image.texels[4 * i]);
  return image;
}

const glm::vec3 up(0, 0, 1), east(0.6F, 0, 0.8F), west(-0.6F, 0, 0.8F), north(0, 0.6F, 0.8F);

double share_of(const FootprintTexels& texels, const glm::vec3& normal) {
  for (const WeightedFacet& facet : texels.facets) {
    if (glm::distance(facet.normal, glm::dvec3(normal)) < 1e-6) return facet.share;
  }
  return 0.0;
}

const std::vector<glm::vec3>& some_directions() {
  static const std::vector<glm::vec3> directions = hemisphere_grid(24).directions;
  return directions;
}

TEST(HemisphereGrid, SumsToTheHemisphereAndItsProjection) {
  for (const int resolution : {16, 64, 251}) {
    const HemisphereGrid grid = hemisphere_grid(resolution);
    double area = 0.0, projected = 0.0;
    for (std::size_t i = 0; i < grid.directions.size(); ++i) {
      EXPECT_NEAR(glm::length(grid.directions[i]), 1.0F, 1e-6F);
      EXPECT_GT(grid.directions[i].z, 0.0F);
      area += grid.solid_angles[i];
      projected += grid.solid_angles[i] * grid.directions[i].z;
    }
    EXPECT_NEAR(area, 2.0 * pi, 1e-9);
    EXPECT_NEAR(projected, pi, 1e-6);
  }
}

// The resolution for a lobe integrates it, and its square, wherever it leans.
TEST(HemisphereGrid, IntegratesTheLobesThatItIsMadeFor) {
  for (const Lobe& lobe :
       {Lobe{blinn_phong, 64}, {blinn_phong, 512}, {vmf, 2000}, {beckmann, 0.1}, {ggx, 0.05}, {blinn_phong, 1e4}}) {
    const HemisphereGrid grid = hemisphere_grid(resolution_for(lobe));
    for (const double tilt : {0.0, 0.41, 0.9, 1.5}) {
      const ReferenceNdf ndf(lobe.distribution, {{{std::sin(tilt), 0.0, std::cos(tilt)}, lobe.parameter, 1.0}});
      const NdfTotals totals = ndf_totals(grid, ndf.densities(grid.directions, no_progress));
      EXPECT_NEAR(totals.energy / ndf.expected_energy(), 1.0, 1e-3) << lobe_text(lobe) << " " << tilt;
    }
  }
}

TEST(DiscDirections, LieOnThePixelsOfThePicture) {
  const std::vector<glm::vec3> disc = disc_directions(8);
  EXPECT_EQ(disc[0], glm::vec3(0.0F));  // a corner is outside
  EXPECT_GT(disc[3].y, 0.8F);           // row 0 is on top, and y points up
  EXPECT_GT(disc[8 * 3 + 7].x, 0.8F);
  EXPECT_NEAR(glm::length(disc[8 * 4 + 2]), 1.0F, 1e-6F);
}

TEST(FootprintTexels, CoverWholeTexelsAndParts) {
  const Material material = material_of(row_of({up, east, west, north}), {blinn_phong, 64});
  const FootprintTexels whole = texels_under(material, {{0, 0}, {1, 1}});
  EXPECT_DOUBLE_EQ(whole.texels, 4.0);
  for (const glm::vec3& n : {up, east, west, north}) EXPECT_NEAR(share_of(whole, n), 0.25, 1e-12);
  const FootprintTexels part = texels_under(material, {{0.125, 0.2}, {0.375, 0.7}});
  EXPECT_DOUBLE_EQ(part.texels, 0.5);
  EXPECT_NEAR(share_of(part, up), 0.5, 1e-12);
  EXPECT_NEAR(share_of(part, east), 0.5, 1e-12);
}

TEST(FootprintTexels, UniteEqualFacets) {
  const FootprintTexels texels = texels_under(material_of(row_of({up, east, up, up}), {vmf, 9}), {{0, 0}, {1, 1}});
  ASSERT_EQ(texels.facets.size(), 2U);
  EXPECT_NEAR(share_of(texels, up), 0.75, 1e-12);
}

// Beyond the map's edge: repeated, mirrored, or the last texel going on.
TEST(FootprintTexels, WrapAsTheCoordinatesSay) {
  const Image row = row_of({up, east, west, north});
  const FootprintRect right{{1.0, 0.0}, {1.25, 1.0}}, left{{-0.25, 0.0}, {0.0, 1.0}}, far{{-3.75, 0.0}, {-3.5, 1.0}};
  const auto only = [&](Wrap wrap, const FootprintRect& rect, const glm::vec3& normal) {
    return share_of(texels_under(material_of(row, {blinn_phong, 64}, wrap), rect), normal);
  };
  EXPECT_NEAR(only(Wrap::repeat, right, up), 1.0, 1e-9);
  EXPECT_NEAR(only(Wrap::repeat, left, north), 1.0, 1e-9);
  EXPECT_NEAR(only(Wrap::repeat, far, east), 1.0, 1e-9);
  EXPECT_NEAR(only(Wrap::mirrored_repeat, right, north), 1.0, 1e-9);
  EXPECT_NEAR(only(Wrap::mirrored_repeat, left, up), 1.0, 1e-9);
  EXPECT_NEAR(only(Wrap::mirrored_repeat, far, east), 1.0, 1e-9);  // period -4: not mirrored
  EXPECT_NEAR(only(Wrap::clamp_to_edge, right, north), 1.0, 1e-9);
  EXPECT_NEAR(only(Wrap::clamp_to_edge, left, up), 1.0, 1e-9);
}

// Hard case 25: a texel without a normal is not there.
TEST(FootprintTexels, LeaveOutTexelsWithoutANormal) {
  Image row = row_of({up, east, {0, 0, 0}, west});
  row.texels[4 * 2 + 3] = 0.0F;
  const FootprintTexels texels = texels_under(material_of(row, {blinn_phong, 64}), {{0, 0}, {1, 1}});
  EXPECT_NEAR(texels.valid_share, 0.75, 1e-12);
  for (const glm::vec3& n : {up, east, west}) EXPECT_NEAR(share_of(texels, n), 1.0 / 3.0, 1e-12);
  EXPECT_THROW((void)texels_under(material_of(row, {blinn_phong, 64}), {{0.5, 0}, {0.75, 1}}), Error);
}

// A roughness map of another size and scale covers the normals: both decide what a facet is.
TEST(FootprintTexels, CarryTheRoughnessOverThem) {
  Material material = material_of(row_of({up, east, west, north}), {ggx, 0.5});
  material.lobe_parameter.reset();
  Image roughness(3, 1, 2, 0.0F);
  for (std::size_t i = 0; i < 3; ++i) roughness.texels[2 * i] = 0.3F + 0.3F * static_cast<float>(i);
  material.metallic_roughness_map = TextureMap{"roughness", std::make_shared<const Image>(roughness), {}};
  const FootprintTexels texels = texels_under(material, {{0, 0}, {1, 1}});
  EXPECT_EQ(texels.facets.size(), 6U);  // borders at 1/4, 1/3, 1/2, 2/3, 3/4
  double smooth = 0.0;
  for (const WeightedFacet& facet : texels.facets) smooth += facet.parameter < 0.1 ? facet.share : 0.0;
  EXPECT_NEAR(smooth, 1.0 / 3.0, 1e-12);
  material.metallic_roughness_map->coordinates.transform[0][0] = 2.0F;  // twice as dense along u
  EXPECT_EQ(texels_under(material, {{0, 0}, {1, 1}}).facets.size(), 8U);
  const MappedFootprint mapped = roughness_footprint(material, {{0, 0}, {0.5, 0.5}});
  EXPECT_NEAR(mapped.centre.x, 0.5, 1e-6);
  EXPECT_NEAR(mapped.along_u.x, 1.0, 1e-6);
  EXPECT_NEAR(mapped.along_v.y, 0.5, 1e-6);
  material.metallic_roughness_map->coordinates.transform = glm::mat3x2(0, 1, -1, 0, 0, 0);  // a quarter turn
  EXPECT_THROW((void)texels_under(material, {{0, 0}, {1, 1}}), Error);
}

TEST(FootprintTexels, RefuseRectanglesThatAreNone) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  for (const FootprintRect& rect : {FootprintRect{{0, 0}, {0, 1}},
                                    {{0.5, 0}, {0.25, 1}},
                                    {{0, nan}, {1, 1}},
                                    {{0, 0}, {1, std::numeric_limits<double>::infinity()}},
                                    {{-1e9, 0}, {1, 1}}}) {
    EXPECT_THROW(check_footprint(rect, "--region"), Error);
  }
  EXPECT_NO_THROW(check_footprint({{-1, 0.25}, {2, 0.26}}, "--region"));
}

TEST(ReferenceNdf, OfOneNormalIsTheLobe) {
  for (const Lobe& lobe : {Lobe{blinn_phong, 64}, {beckmann, 0.3}, {ggx, 0.2}, {vmf, 100}}) {
    const FootprintTexels texels = texels_under(material_of(row_of({east}), lobe), {{0, 0}, {1, 1}});
    const auto densities = ReferenceNdf(lobe.distribution, texels.facets).densities(some_directions(), no_progress);
    for (std::size_t i = 0; i < densities.size(); ++i) {
      const double u = 1.0 - glm::dot(glm::dvec3(some_directions()[i]), glm::normalize(glm::dvec3(east)));
      EXPECT_NEAR(densities[i], lobe_peak(lobe) * lobe_shape(lobe, u), 1e-5 * lobe_peak(lobe));
    }
  }
}

// The sum as it is written, over every texel, against cells, supports and united facets.
TEST(ReferenceNdf, IsThePlainMeanOverTheTexels) {
  const Image normals = random_normals(37, 23, 0.9F, 11);
  for (const Lobe& lobe : {Lobe{blinn_phong, 512}, {ggx, 0.02}, {beckmann, 0.1}}) {
    const FootprintTexels texels = texels_under(material_of(normals, lobe), {{0, 0}, {1, 1}});
    const Lobe stored{lobe.distribution, texels.facets.front().parameter};  // a material stores 32 bits
    const auto densities = ReferenceNdf(lobe.distribution, texels.facets).densities(some_directions(), no_progress);
    for (std::size_t d = 0; d < densities.size(); ++d) {
      const glm::dvec3 h = glm::normalize(glm::dvec3(some_directions()[d]));
      double sum = 0.0;
      for (std::size_t i = 0; i < normals.texel_count(); ++i) {
        const glm::dvec3 n(normals.texels[4 * i], normals.texels[4 * i + 1], normals.texels[4 * i + 2]);
        sum += lobe_peak(stored) * lobe_shape(stored, 0.5 * glm::dot(h - glm::normalize(n), h - glm::normalize(n)));
      }
      EXPECT_NEAR(densities[d], sum / static_cast<double>(normals.texel_count()), 1e-10 * lobe_peak(stored));
    }
  }
}

// Golden: four texels under exponent 100.
TEST(ReferenceNdf, OfFourTexelsMeetsTheGoldenDensity) {
  const FootprintTexels texels = texels_under(
      material_of(row_of({up, east, {0, -0.6F, 0.8F}, {-0.28F, 0, 0.96F}}), {blinn_phong, 100}), {{0, 0}, {1, 1}});
  EXPECT_NEAR(ReferenceNdf(blinn_phong, texels.facets).densities(std::vector{up}, no_progress)[0], 4.086458431324459,
              1e-6);
}

TEST(ReferenceNdf, OfMergedFacetsStaysWithinTheBound) {
  const Lobe lobe{blinn_phong, 64};
  const FootprintTexels texels = texels_under(material_of(random_normals(128, 128, 0.9F, 3), lobe), {{0, 0}, {1, 1}});
  const double spacing = 0.25 * lobe_width(lobe);
  const std::vector<WeightedFacet> merged = merged_facets(texels.facets, spacing);
  EXPECT_LT(merged.size(), texels.facets.size() / 2);
  const auto exact = ReferenceNdf(blinn_phong, texels.facets).densities(some_directions(), no_progress);
  const auto near = ReferenceNdf(blinn_phong, merged).densities(some_directions(), no_progress);
  for (std::size_t i = 0; i < exact.size(); ++i) {
    EXPECT_NEAR(near[i], exact[i], lobe_peak(lobe) * std::pow(spacing / lobe_width(lobe), 2) / 4.0);
  }
}

// Hard case 28: normals on the horizon; half of each lobe is below it.
TEST(ReferenceNdf, OfNormalsOnTheHorizonLosesHalf) {
  const Lobe lobe{blinn_phong, 512};
  const FootprintTexels texels = texels_under(material_of(row_of({{1, 0, 0}, {0, -1, 0}}), lobe), {{0, 0}, {1, 1}});
  const ReferenceNdf ndf(blinn_phong, texels.facets);
  const HemisphereGrid grid = hemisphere_grid(resolution_for(lobe));
  EXPECT_NEAR(ndf.expected_energy(), 0.5, 1e-4);
  EXPECT_NEAR(ndf_totals(grid, ndf.densities(grid.directions, no_progress)).energy, 0.5, 1e-3);
}

TEST(NdfFigures, TellHowFarADensityIsOff) {
  const HemisphereGrid grid = hemisphere_grid(16);
  const std::vector<double> exact(grid.directions.size(), 0.5);
  std::vector<float> densities(grid.directions.size(), 1.0F);
  const NdfFigures doubled = compare_ndfs(grid, densities, exact);
  EXPECT_NEAR(doubled.l2, 1.0, 1e-12);
  EXPECT_NEAR(doubled.energy, 2.0, 1e-12);
  EXPECT_EQ(doubled.peak, 1.0);
  densities[7] = std::numeric_limits<float>::quiet_NaN();
  const NdfFigures broken = compare_ndfs(grid, densities, exact);
  EXPECT_FALSE(std::isfinite(broken.l2) || std::isfinite(broken.energy) || std::isfinite(broken.peak));
}

// A map of lobe parameters gives its own numbers, not those that a roughness map would store.
TEST(FootprintTexels, TakesLobeParametersAsTheyAre) {
  Material material;
  material.brdf.distribution = NormalDistribution::vmf;
  Image kappas(2, 1, 1);
  kappas.texels = {0.25F, 123456.0F};
  material.lobe_parameter_map = TextureMap{"kappas", std::make_shared<const Image>(kappas), {}};
  const FootprintTexels under = texels_under(material, {});
  ASSERT_EQ(under.facets.size(), 2U);
  EXPECT_EQ(under.facets[0].parameter, 0.25);
  EXPECT_EQ(under.facets[1].parameter, 123456.0);
}

// The axis of each lobe replaces the facet, with the lobe's weight.
TEST(FootprintTexels, HasAFacetForEachLobe) {
  Material material;
  material.lobes = {{.axis = {0.6F, 0.0F, 0.8F}, .parameter = 0.1F, .weight = 0.5F},
                    {.axis = {0.0F, 0.0F, 1.0F}, .parameter = 0.2F, .weight = 2.0F}};
  const FootprintTexels under = texels_under(material, {});
  ASSERT_EQ(under.facets.size(), 2U);
  EXPECT_NEAR(under.facets[0].normal.x, 0.6, 1e-6);
  EXPECT_NEAR(under.facets[0].share, 0.5, 1e-6);
  EXPECT_NEAR(under.facets[1].normal.z, 1.0, 1e-6);
  EXPECT_NEAR(under.facets[1].share, 2.0, 1e-6);
  EXPECT_NEAR(under.valid_share, 1.0, 1e-12);
}

}  // namespace
}  // namespace footprint::testing
