// The method as a whole: flat patches give the base BRDF back, patches the sum over their visible facets.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>

#include "methods/iwasaki_sg/material_table.hpp"
#include "renderer/bake/baked_method.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/microgeometry/direction_grid.hpp"
#include "renderer/pipeline/base_surface.hpp"
#include "tests/methods/iwasaki_materials.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& direct_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using namespace iwasaki_sg;

constexpr BaseBrdf blinn_phong{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};

EffectSet effects_of(const Material& material) { return ProbedMethod::default_effects() | patch_effects(material); }

double density(double exponent, const glm::dvec3& n, const glm::dvec3& h) {
  return base_density(NormalDistribution::blinn_phong, exponent, n, h);
}

/// Eq. 1 of the facets that the method samples, at two directions of its grid: specular, diffuse over albedo / pi.
struct FacetSum {
  glm::dvec3 specular{0.0}, diffuse{0.0};
};

FacetSum facet_sum(const Patch& patch, const Bvndf& bvndf, double exponent, std::size_t i, std::size_t o) {
  const glm::dvec3 h = glm::normalize(bvndf.directions[i] + bvndf.directions[o]);
  FacetSum out;
  for (std::size_t bin = 0; bin < bvndf.bins.size(); ++bin) {
    const glm::dvec3& n = bvndf.bins[bin].normal;
    const glm::dvec3 color(patch.palette[bvndf.bins[bin].paint]);
    const double weight = bvndf.gamma(bin, i, o) * glm::dot(n, bvndf.directions[o]) / bvndf.visible_area[o];
    out.specular += weight * density(exponent, n, h);
    out.diffuse += weight * glm::dot(n, bvndf.directions[i]) * color;
  }
  return out;
}

struct Compared {
  double specular = 0.0, diffuse = 0.0;  // root mean square differences over the exact sum's
};

// The method's own shader against the sum, over pairs of the grid's directions.
Compared against_sum(const Patch& patch, float exponent, const std::map<std::string, std::string>& options) {
  constexpr std::size_t facets = 16384;
  const Material material = patch_material(patch, blinn_phong, exponent);
  const Bvndf bvndf =
      make_bvndf(patch, bin_facets(patch, sample_facets(patch, facets, 1)), direction_grid(12), no_progress);
  std::vector<std::array<glm::vec4, 3>> inputs;
  std::vector<FacetSum> exact;
  for (std::size_t i = 0; i < bvndf.directions.size(); i += 7) {
    for (std::size_t o = 0; o < bvndf.directions.size(); o += 5) {
      inputs.push_back(
          {glm::vec4(glm::vec3(bvndf.directions[i]), 0), glm::vec4(glm::vec3(bvndf.directions[o]), 0), {}});
      exact.push_back(facet_sum(patch, bvndf, exponent, i, o));
    }
  }
  std::map<std::string, std::string> given = options;
  given["facets"] = std::to_string(facets);
  const ProbedMethod probed{&iwasaki_sg_method(), &material, given, effects_of(material)};
  const auto specular =
      probe_method(probed, "return vec4(shade(e, Surface(vec3(0), vec3(1)), a.xyz, b.xyz).specular, 0);", inputs);
  const auto diffuse =
      probe_method(probed, "return vec4(shade(e, Surface(vec3(pi), vec3(0)), a.xyz, b.xyz).diffuse, 0);", inputs);
  const glm::dvec3 mean(material.microgeometry->mean_color);
  Compared out;
  double all_specular = 0.0, all_diffuse = 0.0;
  for (std::size_t k = 0; k < exact.size(); ++k) {
    out.specular += std::pow(specular[k].x - exact[k].specular.x, 2.0);
    all_specular += std::pow(exact[k].specular.x, 2.0);
    const glm::dvec3 away = glm::dvec3(diffuse[k]) * mean - exact[k].diffuse;
    out.diffuse += glm::dot(away, away);
    all_diffuse += glm::dot(exact[k].diffuse, exact[k].diffuse);
  }
  return {std::sqrt(out.specular / all_specular), std::sqrt(out.diffuse / all_diffuse)};
}

// Five flat normals: five lobes describe them completely.
TEST(IwasakiSg, IsTheSumOverVisibleFacetsForFlatOnes) {
  const Patch patch = patch_of("pyramids", {{"slope_degrees", "40"}});
  const Compared base = against_sum(patch, 50.0F, {});
  EXPECT_LT(base.specular, 2e-3);
  EXPECT_LT(base.diffuse, 2e-3);
  const Compared sg = against_sum(patch, 50.0F, {{"lobe", "sg"}, {"convolution", "exact"}});
  EXPECT_LT(sg.specular, 0.03);  // Blinn-Phong's lobe as one spherical Gaussian
  EXPECT_NEAR(against_sum(patch, 50.0F, {{"lobe", "sg"}}).specular, sg.specular, 0.005);
}

TEST(IwasakiSg, MakesOnlyTheLobesOfTheBrdfAgainWhenItChanges) {
  const Options options =
      options_of(iwasaki_sg_method(), parse_methods("iwasaki_sg:lobe=sg:facets=1024:directions=4").front());
  Material material = patch_material(patch_of("weave", {}), blinn_phong, 50.0F);
  const Prefiltered before = baked_material(material, options, effects_of(material), no_progress);
  material.lobe_parameter = 10.0F;
  const Prefiltered again = with_other_brdf(before, material, options, effects_of(material));
  const Prefiltered wanted = baked_material(material, options, effects_of(material), no_progress);
  ASSERT_EQ(again.textures.size(), wanted.textures.size());
  bool changed = false;
  for (std::size_t i = 0; i < wanted.textures.size(); ++i) {
    EXPECT_EQ(again.textures[i].name, wanted.textures[i].name);
    EXPECT_EQ(texel_content(again.textures[i]), texel_content(wanted.textures[i])) << wanted.textures[i].name;
    changed = changed || texel_content(before.textures[i]) != texel_content(wanted.textures[i]);
  }
  EXPECT_TRUE(changed);
  EXPECT_EQ(again.notes, wanted.notes);
}

// Curved threads of two colours.
TEST(IwasakiSg, IsCloseToTheSumOverVisibleFacetsOfAWeave) {
  const Patch patch = patch_of("weave", {{"warp_blue", "0.1"}, {"weft_red", "0.2"}});
  double before = 1.0;
  for (const char* j : {"4", "8", "16"}) {
    const Compared found = against_sum(patch, 30.0F, {{"j", j}});
    EXPECT_LT(found.specular, before);
    EXPECT_LT(found.diffuse, 2e-3);
    before = found.specular;
  }
  EXPECT_LT(before, 0.12);
}

// A flat patch hides nothing: the base BRDF comes back, at any angle.
TEST(IwasakiSg, FlatPatchGivesItsBaseBrdfBack) {
  constexpr std::array<BaseBrdf, 4> brdfs{
      {{NormalDistribution::ggx, GeometryTerm::smith, FresnelTerm::schlick, true},
       {NormalDistribution::beckmann, GeometryTerm::smith, FresnelTerm::schlick, true},
       blinn_phong,
       {NormalDistribution::vmf, GeometryTerm::tan, FresnelTerm::schlick, true}}};
  for (const BaseBrdf& brdf : brdfs) {
    Scene scene = square_scene({}, {.brdf = brdf});
    scene.materials[0].microgeometry = microgeometry_of(patch_of("flat"));
    TestRenderer renderer(scene);
    const Image direct = renderer.frame(direct_method());
    const Image picture = renderer.frame(iwasaki_sg_method(), "iwasaki_sg:facets=1024");
    EXPECT_LT(compare_images(picture, direct, 1.0F).value().relative_rmse, 1e-3) << static_cast<int>(brdf.distribution);
  }
}

// Without a patch the normal map as a whole is the geometry: its NDF against the texels' own.
TEST(IwasakiSg, NormalMapWithoutAPatchIsOneDistribution) {
  const Image normals = random_normals(32, 32, 0.4F, 3);
  Material material = square_scene(normals, {.brdf = blinn_phong}).materials[0];
  material.lobe_parameter = 30.0F;
  const ProbedMethod probed{&iwasaki_sg_method(), &material};
  const std::vector<glm::dvec3> directions = hemisphere_grid(16, 16);
  const std::vector<double> found = probe_ndf(probed, directions);
  double away = 0.0, square = 0.0, energy = 0.0, all = 0.0;
  for (std::size_t k = 0; k < directions.size(); ++k) {
    double sum = 0.0;
    for (std::size_t i = 0; i < normals.texels.size(); i += 4) {
      const glm::dvec3 n(normals.texels[i], normals.texels[i + 1], normals.texels[i + 2]);
      sum += density(30.0, n, directions[k]);
    }
    sum /= static_cast<double>(normals.texel_count());
    away += std::pow(found[k] - sum, 2.0);
    square += sum * sum;
    energy += found[k];
    all += sum;
  }
  EXPECT_LT(std::sqrt(away / square), 0.05);
  EXPECT_NEAR(energy / all, 1.0, 0.01);
}

TEST(IwasakiSg, StaysFiniteForHardPatches) {
  for (const auto& [kind, given] : std::initializer_list<std::pair<const char*, std::map<std::string, std::string>>>{
           {"pyramids", {{"slope_degrees", "80"}, {"floor", "0"}}},
           {"pyramids", {{"slope_degrees", "-80"}}},
           {"spheres", {{"radius", "0.5"}, {"height", "1"}}},
           {"weave", {{"warp_width", "0.02"}, {"weft_width", "0.02"}}}}) {
    for (const char* options : {"iwasaki_sg:facets=500", "iwasaki_sg:facets=500:energy=published:cosines=published",
                                "iwasaki_sg:facets=500:lobe=sg:convolution=exact:storage=fp16"}) {
      Scene scene = square_scene({}, {});
      scene.materials[0].microgeometry = microgeometry_of(patch_of(kind, given));
      for (const float v : TestRenderer(scene).frame(iwasaki_sg_method(), options).texels) {
        ASSERT_TRUE(std::isfinite(v) && v >= 0.0F) << kind << " " << options;
      }
    }
  }
}

// Facets with Ward's BRDF on a flat patch: what the reference sums from the table is what the lobes fitted to it give.
TEST(IwasakiSg, TabulatedBrdfOfAFlatPatchIsThatOfTheReference) {
  Scene scene = square_scene({}, {});
  Microgeometry flat{patch_of("flat")};
  flat.brdf = std::make_shared<const TabulatedBrdf>(ward_brdf({0.3F, 0.2F, 0.1F}, {0.3F, 0.3F, 0.3F}, 0.25));
  scene.materials[0].microgeometry = std::make_shared<const Microgeometry>(flat);
  TestRenderer renderer(scene);
  const Image reference = renderer.reference(16).mean;
  const Image picture = renderer.frame(iwasaki_sg_method(), "iwasaki_sg:facets=1024");
  // Functions of the half and the difference angle cannot represent Ward's root of cosines.
  EXPECT_LT(compare_images(picture, reference, 1.0F).value().relative_rmse, 0.03);
}

// The reference's facets, drawn at random, against the method's sum of lobes, which is exact for flat facets.
TEST(IwasakiSg, MeetsTheReferenceOfAPatch) {
  Scene scene = square_scene({}, {.brdf = blinn_phong, .roughness = 0.7F});
  scene.materials[0].microgeometry = microgeometry_of(patch_of("pyramids", {{"slope_degrees", "25"}}));
  TestRenderer renderer(scene, {32, 32});
  const Image reference = renderer.reference(64).mean;
  const Image picture = renderer.frame(iwasaki_sg_method(), "iwasaki_sg:facets=4096");
  EXPECT_LT(compare_images(picture, reference, 1.0F).value().relative_rmse, 0.05);
}

// The paper's 2.3 MB for eight lobes in colour.
TEST(IwasakiSg, TakesWhatThePaperTakes) {
  const Material material = patch_material(patch_of("weave", {{"warp_blue", "0"}}), blinn_phong, 100.0F);
  const Options options(iwasaki_sg_method().info.options, {{"facets", "2000"}, {"j", "8"}}, "test");
  const Prefiltered baked = iwasaki_sg_method().precompute(material, options, effects_of(material), no_progress);
  EXPECT_LT(byte_count(baked), 2'300'000U);
  EXPECT_GT(byte_count(baked), 2'200'000U);
}

// A chessboard of two patches, far below a pixel and larger than one: coverage blends, and no material takes more.
TEST(IwasakiSg, SeveralMaterialsBlendByCoverage) {
  const BaseBrdf brdf{NormalDistribution::blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  Scene scene = square_scene({}, {.brdf = brdf, .roughness = 0.7F});
  scene.materials.push_back(scene.materials[0]);
  scene.meshes.push_back(scene.meshes[0]);
  scene.meshes[1].material = 1;
  for (std::size_t k = 0; k < 2; ++k) {
    Image share(2, 2, 1);
    share.texels[k] = share.texels[3 - k] = 1.0F;
    TextureMap map{"indices", std::make_shared<const Image>(std::move(share)), {}};
    map.coordinates.transform = {3.0F, 0.0F, 0.0F, 3.0F, 0.0F, 0.0F};
    scene.materials[k].share = SurfaceShare{std::move(map), k == 0};
    scene.materials[k].microgeometry =
        microgeometry_of(k == 0 ? patch_of("pyramids", {{"slope_degrees", "25"}})
                                : patch_of("weave", {{"warp_blue", "0"}, {"warp_green", "0.2"}}));
    scene.materials[k].base_color *= glm::vec4(scene.materials[k].microgeometry->mean_color, 1.0F);
    const Options options(option_table(), {{"facets", "2000"}, {"j", "8"}}, "test");
    EXPECT_LT(byte_count(iwasaki_sg_method().precompute(scene.materials[k], options, effects_on(derive_effects(scene)),
                                                        no_progress)),
              2'300'000U);
  }
  TestRenderer renderer(scene, {24, 24});
  const Image reference = renderer.supersampled(base_surface(), 256).mean;
  EXPECT_LT(compare_images(renderer.frame(iwasaki_sg_method(), "iwasaki_sg:facets=4096"), reference, 1.0F)
                .value()
                .relative_rmse,
            0.06);
  const Image far = renderer.frame(iwasaki_sg_method(), "iwasaki_sg:facets=4096", {}, 0, 6.0);
  for (std::size_t i = 3; i < far.texels.size(); i += 4) {
    ASSERT_TRUE(far.texels[i] == 1.0F || far.texels[i] == 0.0F);
  }
}

TEST(IwasakiSg, DoesNotDependOnThreads) {
  const Patch patch = patch_of("noise");
  TableSettings settings;
  settings.facets = 3000;
  settings.paints.resize(1);
  std::vector<std::string> stages;
  double before = -1.0;
  const auto note = [&](std::string_view stage, double fraction) {
    if (stages.empty() || stages.back() != stage) stages.emplace_back(stage);
    EXPECT_GE(fraction, before);
    before = fraction;
  };
  const MaterialTable a = patch_table(patch, settings, note);
  const MaterialTable b = patch_table(patch, settings, no_progress);
  EXPECT_EQ(a.amplitudes.masses, b.amplitudes.masses);
  EXPECT_EQ(stages, (std::vector<std::string>{"samples", "visibility", "BVNDF", "NDF", "BVNDF", "amplitudes"}));
}

TEST(Microgeometry, MapsShowThePatchFromAbove) {
  const PatchMaps maps = patch_maps(patch_of("pyramids", {{"floor", "0"}, {"slope_degrees", "45"}}), 8);
  // Row 0 is the top: the side towards +y, whose normal leans to +y.
  EXPECT_NEAR(maps.normals.at(4, 0)[1], std::numbers::sqrt2 / 2.0, 1e-6);
  EXPECT_NEAR(maps.normals.at(0, 4)[0], -std::numbers::sqrt2 / 2.0, 1e-6);
  const PatchMaps weave = patch_maps(
      patch_of("weave", {{"warp_width", "0.5"}, {"weft_width", "0.5"}, {"weft_red", "0"}, {"warp_green", "0"}}), 64);
  EXPECT_NEAR(weave.mean_color.r, 0.5, 0.02);
  EXPECT_NEAR(weave.mean_color.g, 0.5, 0.02);
  std::size_t holes = 0;
  for (std::size_t i = 3; i < weave.normals.texels.size(); i += 4) holes += weave.normals.texels[i] == 0.0F;
  EXPECT_NEAR(static_cast<double>(holes) / 4096.0, 0.25, 0.05);
}

}  // namespace
}  // namespace footprint::testing
