// [[brdf.lobe]] and [maps]: what a scene.toml says of lobes and of maps of the base BRDF, and what comes of it.
#include <gtest/gtest.h>

#include <cmath>

#include "renderer/image/image_io.hpp"
#include "renderer/scene/assembly/load_scene.hpp"
#include "renderer/scene/geometry.hpp"
#include "tests/support/gltf_builder.hpp"

namespace footprint {
namespace {

Mesh unit_square(const SurfaceSettings& /*settings*/) { return make_plane({1.0F, 1.0F}, {1.0F, 1.0F}); }
Image flat(const SurfaceSettings& settings) { return {settings.resolution, settings.resolution, 4, 1.0F}; }
Image kappas(const SurfaceSettings& /*settings*/) { return {3, 2, 1, 500.0F}; }
Image speculars(const SurfaceSettings& /*settings*/) { return {5, 7, 3, 0.25F}; }
glm::vec2 four_times(const SurfaceSettings& /*settings*/) { return {4.0F, 2.0F}; }
std::vector<FacetLobe> leaning(const SurfaceSettings& /*settings*/) { return {{{0.6F, 0.0F, 0.8F}, 90.0F, 1.0F}}; }

Surface surface_named(const std::string& name) {
  return {.name = name, .summary = {}, .parameters = {}, .default_resolution = 4, .normals = flat, .mesh = unit_square};
}

const std::vector<Surface>& glossy_surfaces() {
  static const std::vector<Surface> surfaces = [] {
    Surface glossy = surface_named("glossy");
    glossy.lobe_parameter = kappas;
    glossy.specular = speculars;
    glossy.distribution = NormalDistribution::vmf;
    glossy.map_tiling = four_times;
    Surface leaner = surface_named("leaner");
    leaner.lobes = leaning;
    leaner.distribution = NormalDistribution::vmf;
    return std::vector{glossy, leaner};
  }();
  return surfaces;
}

Scene load_lobes(const std::string& settings) {
  return load_scene(test::write_file("made/scene.toml", settings).string(),
                    {.folder = {}, .surfaces = glossy_surfaces()});
}

Material material(const std::string& settings) { return load_lobes(settings).materials.at(0); }

void expect_brdf_error(const std::string& text, const std::vector<std::string>& wanted) {
  const std::string error = test::usage_error([&] { return load_lobes(text); });
  for (const std::string& words : wanted) {
    EXPECT_NE(error.find(words), std::string::npos) << "wanted: " << words << "\ngot: " << error;
  }
}

const std::string vmf_plane = "[plane]\n[brdf]\ndistribution = \"vmf\"\n";

TEST(FacetLobeSettings, AxesAreNormalisedAndWeightsSumToOneWhereNoneIsGiven) {
  const Material made = material(vmf_plane +
                                 "[[brdf.lobe]]\naxis = [3, 0, 4]\nkappa = 128\n"
                                 "[[brdf.lobe]]\naxis = [0, -3, 4]\nkappa = 64\n");
  EXPECT_EQ(made.lobes,
            (std::vector<FacetLobe>{{{0.6F, 0.0F, 0.8F}, 128.0F, 0.5F}, {{0.0F, -0.6F, 0.8F}, 64.0F, 0.5F}}));
  EXPECT_EQ(material(vmf_plane + "[[brdf.lobe]]\naxis = [0, 0, 2]\nkappa = 1\nweight = 0.25\n").lobes.at(0).weight,
            0.25F);
}

const std::string metal_plane = "[plane]\n[brdf]\ndistribution = \"ggx\"\n";

TEST(AnisotropySettings, AreAStrengthOrTwoAlphas) {
  const Material strong = material(metal_plane + "alpha = 0.2\nanisotropy = 0.5\nanisotropy_rotation_degrees = 90\n");
  ASSERT_TRUE(strong.anisotropy);
  EXPECT_EQ(strong.anisotropy->strength, 0.5F);
  EXPECT_FLOAT_EQ(strong.anisotropy->rotation, 1.5707964F);
  EXPECT_NEAR(alphas_of(strong).along, 0.2 + 0.8 * 0.25, 1e-6);
  EXPECT_NEAR(alphas_of(strong).across, 0.2, 1e-6);
  EXPECT_NEAR(lobe_of(strong).parameter, std::sqrt(0.5 * (0.16 + 0.04)), 1e-6) << "the round mean";
  const Material wide = material(metal_plane + "alpha_x = 0.4\nalpha_y = 0.1\n");
  EXPECT_NEAR(alphas_of(wide).along, 0.4, 1e-6);
  EXPECT_NEAR(alphas_of(wide).across, 0.1, 1e-7);
  EXPECT_EQ(wide.anisotropy->rotation, 0.0F);
  const Material high = material(metal_plane + "alpha_x = 0.1\nalpha_y = 0.4\nanisotropy_rotation_degrees = 30\n");
  EXPECT_NEAR(alphas_of(high).along, 0.4, 1e-6);
  EXPECT_NEAR(high.anisotropy->rotation, (90.0 + 30.0) * 3.14159265 / 180.0, 1e-6);
  EXPECT_FALSE(material(metal_plane + "alpha_x = 0.3\nalpha_y = 0.3\n").anisotropy);
  EXPECT_FALSE(material(metal_plane + "alpha = 0.3\nanisotropy = 0\n").anisotropy);
  EXPECT_EQ(alphas_of(material(metal_plane + "alpha_x = 1\nalpha_y = 1\n")), (Alphas{1.0, 1.0}));
}

TEST(AnisotropySettings, MistakesNameTheirLine) {
  expect_brdf_error(vmf_plane + "kappa = 9\nanisotropy = 0.5\n",
                    {"scene.toml:5", "needs the distribution ggx, beckmann or ward"});
  expect_brdf_error("[plane]\n[brdf]\ndistribution = \"blinn_phong\"\nalpha_x = 0.5\nalpha_y = 0.1\n",
                    {"scene.toml:4", "needs the distribution ggx, beckmann or ward"});
  expect_brdf_error(metal_plane + "anisotropy = 1.5\n", {"scene.toml:4", "not within"});
  expect_brdf_error(metal_plane + "alpha_x = 0.5\n", {"`alpha_y`", "missing"});
  expect_brdf_error(metal_plane + "alpha_x = 0.5\nalpha_y = 0.1\nanisotropy = 1\n", {"scene.toml:6", "excludes"});
  expect_brdf_error(metal_plane + "alpha_x = 0.5\nalpha_y = 0.1\nalpha = 0.1\n", {"scene.toml:6", "excludes"});
  expect_brdf_error(metal_plane + "anisotropy_rotation_degrees = 3\n", {"`anisotropy`", "missing"});
  expect_brdf_error(metal_plane + "anisotropy = 0.5\n[[brdf.lobe]]\naxis = [0, 0, 1]\nalpha = 0.3\n",
                    {"scene.toml:4", "excludes [[brdf.lobe]]"});
  expect_brdf_error(metal_plane + "anisotropy = 0.5\n[microgeometry]\nkind = \"grooves\"\n",
                    {"excludes anisotropy in [brdf]"});
  expect_brdf_error("[plane]\n[brdf]\ndistribution = \"ward\"\ngeometry = \"smith\"\n",
                    {"scene.toml:4", "excludes Ward's distribution"});
}

TEST(AnisotropySettings, WardIsBeckmannWithItsOwnGeometryTerm) {
  const Material ward = material("[plane]\n[brdf]\ndistribution = \"ward\"\nalpha_x = 0.3\nalpha_y = 0.1\n");
  EXPECT_EQ(ward.brdf.distribution, NormalDistribution::beckmann);
  EXPECT_EQ(ward.brdf.geometry, GeometryTerm::ward);
  EXPECT_TRUE(ward.anisotropy);
}

TEST(FacetLobeSettings, MistakesNameTheirLine) {
  const std::string lobe = vmf_plane + "[[brdf.lobe]]\n";
  expect_brdf_error(lobe + "kappa = 3\n", {"scene.toml:4", "`axis` in [[brdf.lobe]] is missing"});
  expect_brdf_error(lobe + "axis = [0, 0, 1]\n", {"scene.toml:4", "`kappa`", "missing"});
  expect_brdf_error(lobe + "axis = [0, 0, 0]\nkappa = 3\n", {"scene.toml:5", "no length"});
  expect_brdf_error(lobe + "axis = [0.7, 0, -0.7]\nkappa = 3\n", {"scene.toml:5", "horizon"});
  expect_brdf_error(lobe + "axis = [0.7, 0.7, 0]\nkappa = 3\n", {"scene.toml:5", "horizon"});
  expect_brdf_error(lobe + "axis = [0, 0, 1]\nkappa = 3\nweight = 0\n", {"scene.toml:7", "`weight`", "not within"});
  expect_brdf_error(lobe + "axis = [0, 0, 1]\nkappa = -3\n", {"scene.toml:6", "not within"});
  expect_brdf_error(lobe + "axis = [0, 0, 1]\nalpha = 0.3\n", {"scene.toml:6", "does not belong"});
  expect_brdf_error(lobe + "axis = [0, 0, 1]\nkapa = 3\n", {"scene.toml:6", "`kappa`"});
  const std::string whole = "[[brdf.lobe]]\naxis = [0, 0, 1]\nkappa = 3\n";
  expect_brdf_error(vmf_plane + whole + "weight = 0.5\n" + whole, {"scene.toml:8", "`weight`", "for some lobes only"});
  expect_brdf_error(vmf_plane + "kappa = 5\n" + whole, {"excludes"});
  std::string many = vmf_plane;
  for (std::size_t i = 0; i <= most_facet_lobes; ++i) many += whole;
  expect_brdf_error(many, {"`lobe`", "9 times", "8 lobes"});
}

std::string exr(const std::string& name, const Image& image) {
  const auto file = test::write_file("made/" + name, "");
  write_exr(file, image);
  return name;
}

TEST(MapSettings, MapsHaveTheirOwnSizeAndTiling) {
  Image lobes(3, 2, 1, 77.0F);
  lobes.at(2, 1)[0] = 1e5F;
  const Material made = material(vmf_plane + "specular = [0.5, 1, 1]\n[tiling]\nuv = [2, 2]\n[maps.kappa]\nfile = \"" +
                                 exr("kappa.exr", lobes) + "\"\nuv = [3, 5]\n[maps.specular]\nfile = \"" +
                                 exr("ks.exr", Image(1, 1, 3, 0.5F)) + "\"\n[maps.diffuse]\nfile = \"" +
                                 exr("kd.exr", Image(1, 4, 3, 0.25F)) + "\"\nuv = [7, 1]\n");
  ASSERT_TRUE(made.lobe_parameter_map && made.specular_map && made.base_color_map);
  EXPECT_EQ(made.lobe_parameter_map->image.decoded(), lobes);  // no digit is lost
  EXPECT_EQ(made.lobe_parameter_map->coordinates.transform[1], glm::vec2(0, 5));
  EXPECT_EQ(made.specular_map->coordinates.transform[0], glm::vec2(2, 0));
  EXPECT_EQ(made.base_color_map->coordinates.transform[0], glm::vec2(7, 0));
  EXPECT_EQ(made.base_color_map->image.height(), 4);
  EXPECT_EQ(made.dielectric_specular, glm::vec3(0.5F, 1.0F, 1.0F));
  EXPECT_EQ(made.metallic, 0.0F);
}

// The bounds in 32 bits: 0.001 is below the double of that name.
TEST(MapSettings, MapsMayHoldTheBoundsOfTheirLobe) {
  Image alphas(2, 1, 1, 0.001F);
  alphas.at(1, 0)[0] = 1.0F;
  const std::string plane = "[plane]\n[brdf]\ndistribution = \"ggx\"\n[maps.alpha]\nfile = \"";
  const Material made = material(plane + exr("alpha.exr", alphas) + "\"\n");
  ASSERT_TRUE(made.lobe_parameter_map);
  EXPECT_EQ(made.lobe_parameter_map->image.decoded(), alphas);
  alphas.at(0, 0)[0] = std::nextafter(0.001F, 0.0F);
  expect_brdf_error(plane + exr("low.exr", alphas) + "\"\n", {"low.exr", "texel (0, 0)"});
}

TEST(MapSettings, RoughnessTakesThePlaceOfEveryOtherWidth) {
  const Material made = material("[surface]\nname = \"glossy\"\n[maps]\nroughness = { file = \"" +
                                 exr("r.exr", Image(2, 2, 1, 0.4F)) + "\" }\n");
  EXPECT_FALSE(made.lobe_parameter_map);
  ASSERT_NE(width_map(made), nullptr);
  EXPECT_EQ(width_map(made)->image.decoded().at(1, 1)[0], 0.4F);
  EXPECT_EQ(width_map(made)->image.decoded().at(1, 1)[1], made.metallic);
}

TEST(MapSettings, MistakesAreNamed) {
  const std::string bad = exr("bad.exr", Image(2, 1, 1, 0.0F));
  const std::string one = exr("one.exr", Image(2, 1, 1, 1.0F));
  const auto kappa_map = [](const std::string& file) { return "[maps.kappa]\nfile = \"" + file + "\"\n"; };
  expect_brdf_error(vmf_plane + "[maps.kapa]\nfile = \"x\"\n", {"scene.toml:4", "`kappa`"});
  expect_brdf_error(vmf_plane + "[maps.kappa]\nuv = [1, 1]\n", {"scene.toml:4", "`file` in [maps.kappa] is missing"});
  expect_brdf_error(vmf_plane + kappa_map(one) + "uv = [0, 1]\n", {"scene.toml:6", "not within"});
  expect_brdf_error(vmf_plane + kappa_map("none.exr"), {"none.exr", "no such file"});
  expect_brdf_error(vmf_plane + kappa_map(bad), {"bad.exr", "texel (0, 0)", "contains 0"});
  expect_brdf_error("[plane]\n" + kappa_map(one), {"scene.toml:2", "does not belong"});
  expect_brdf_error(vmf_plane + "kappa = 3\n" + kappa_map(one), {"scene.toml:5", "excludes"});
  expect_brdf_error(vmf_plane + kappa_map(one) + "[maps.roughness]\nfile = \"one.exr\"\n", {"excludes"});
  expect_brdf_error(vmf_plane + kappa_map(one) + "[[brdf.lobe]]\naxis = [0, 0, 1]\nkappa = 3\n",
                    {"excludes [[brdf.lobe]]"});
  write_png(test::write_file("made/bytes.png", ""), Image(2, 2, 1, 0.5F));
  expect_brdf_error(vmf_plane + kappa_map("bytes.png"), {"bytes.png", "not an EXR"});
}

TEST(SurfaceMaps, ASurfaceBringsLobesAndMaps) {
  const Material glossy = material("[surface]\nname = \"glossy\"\n[tiling]\nuv = [2, 2]\n");
  EXPECT_EQ(glossy.brdf.distribution, NormalDistribution::vmf);
  ASSERT_TRUE(glossy.lobe_parameter_map && glossy.specular_map);
  EXPECT_EQ(glossy.lobe_parameter_map->coordinates.transform[0], glm::vec2(8, 0));
  EXPECT_EQ(glossy.specular_map->image.width(), 5);
  EXPECT_EQ(glossy.dielectric_specular, glm::vec3(1.0F));
  EXPECT_EQ(material("[surface]\nname = \"leaner\"\n").lobes.size(), 1U);
}

TEST(SurfaceMaps, TheSceneFileOverridesThem) {
  const Material own = material("[surface]\nname = \"glossy\"\n[brdf]\nalpha = 0.3\nspecular = [1, 0, 0]\n");
  EXPECT_EQ(own.brdf.distribution, NormalDistribution::ggx);
  EXPECT_EQ(own.lobe_parameter, 0.3F);
  EXPECT_FALSE(own.lobe_parameter_map || own.specular_map);
  EXPECT_TRUE(material("[surface]\nname = \"leaner\"\n[brdf]\nalpha = 0.3\n").lobes.empty());
  expect_brdf_error("[surface]\nname = \"leaner\"\n[brdf]\ndistribution = \"ggx\"\n",
                    {"leaner", "of another distribution"});
}

}  // namespace
}  // namespace footprint
