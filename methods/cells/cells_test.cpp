// The lobes of the parts through the method's own shader: LEAN with one part, their C++ twin, sums over texels, and the
// numerically hard maps.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <vector>

#include "methods/cells/partition.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/image/metrics.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/stretched_twin.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& cells_method();
const Method& lean_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using enum NormalDistribution;
using Words = std::map<std::string, std::string>;
using std::numbers::pi;
const std::array<std::pair<NormalDistribution, float>, 4> lobes{
    {{blinn_phong, 64.0F}, {vmf, 30.0F}, {beckmann, 0.2F}, {ggx, 0.1F}}};

ProbedMethod parted_method(const Material& material, const Words& options = {}) {
  return {.method = &cells_method(), .material = &material, .options = options};
}

std::vector<double> exact_densities(const Material& material, const std::vector<glm::dvec3>& directions) {
  std::vector<double> exact;
  exact.reserve(directions.size());
  for (const glm::dvec3& h : directions) exact.push_back(mean_facet_density(material, h));
  return exact;
}

// Grooves along y of walls of two slopes, each wall with a waviness of its own.
Image two_walls(int size) {
  Image image = random_normals(size, size, 0.1F, 11);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      float* const n = image.at(x, y).data();
      const float lean = (x / 4) % 2 == 0 ? 0.5F : -0.4F;
      const glm::vec3 turned = glm::normalize(glm::vec3(n[0] + lean, 2.0F * n[1], n[2]));
      std::copy_n(&turned.x, 3, n);
    }
  }
  return image;
}

std::vector<PartTwin> twins_of(const Material& material, std::size_t parts) {
  const Image normals = normal_map_of(material);
  const auto points = cells::plane_points(normals, cells::Coordinates::stereographic, 3.0);
  const double variance = lobe_variance({material.brdf.distribution, *material.lobe_parameter});
  const std::vector<float> shares = cells::partition(
      points, normals.width, normals.height, {.parts = static_cast<int>(parts), .variance = variance}, no_progress);
  std::vector<PartTwin> twins;
  for (std::size_t k = 0; k < parts; ++k) {
    PartTwin twin;
    for (std::size_t i = 0; i < points.size(); ++i) {
      twin.share += shares[i * parts + k];
      twin.mean += static_cast<double>(shares[i * parts + k]) * points[i].at;
    }
    twin.mean /= twin.share;
    for (std::size_t i = 0; i < points.size(); ++i) {
      const glm::dvec2 d = points[i].at - twin.mean;
      twin.spread += static_cast<double>(shares[i * parts + k]) / twin.share * glm::outerProduct(d, d);
    }
    twin.share /= static_cast<double>(points.size());
    twins.push_back(twin);
  }
  return twins;
}

// One part over slopes is LEAN mapping: its density to rounding, and its picture.
TEST(Cells, OnePartOverSlopesIsLean) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(12, 24);
  const Words one{{"k", "1"}, {"covariance", "full"}, {"coordinates", "slopes"}, {"density", "exact"}};
  for (const auto& [distribution, lobe] : lobes) {
    for (const float tilt : sweep(std::array{0.95F, 0.1F, 0.6F}, 1)) {
      const Material material = lobe_material(random_normals(16, 16, tilt, 3), distribution, lobe);
      const std::vector<double> lean = probe_ndf({.method = &lean_method(), .material = &material}, directions);
      const std::vector<double> own = probe_ndf(parted_method(material, one), directions);
      const double peak = std::ranges::max(lean);
      for (std::size_t i = 0; i < lean.size(); ++i) EXPECT_NEAR(own[i], lean[i], 1e-5 * peak) << tilt << " " << i;
    }
  }
  const BaseBrdf brdf{blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  TestRenderer renderer(square_scene(random_normals(64, 64, 0.5F, 4), {.brdf = brdf}));
  for (const char* const filter : {"trilinear", "box:2"}) {
    const FootprintFilter parsed = parse_footprint_filter(filter, "");
    const Image lean = renderer.frame(lean_method(), {}, parsed);
    const Image own =
        renderer.frame(cells_method(), "cells:k=1:covariance=full:coordinates=slopes:density=exact", parsed);
    EXPECT_LT(compare_images(own, lean, 1.0F).value().relative_rmse, 1e-4) << filter;
  }
}

TEST(Cells, GlslMeetsItsTwin) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(10, 16);
  for (const auto& [distribution, lobe] : lobes) {
    for (const float tilt : {0.1F, 0.6F}) {
      const Material material = lobe_material(random_normals(16, 16, tilt, 3), distribution, lobe);
      const std::vector<PartTwin> twins = twins_of(material, 3);
      std::vector<double> expected;
      for (const glm::dvec3& h : directions) {
        double sum = 0.0;
        for (const PartTwin& twin : twins) sum += twin.density(distribution, lobe, h);
        expected.push_back(sum);
      }
      const double peak = std::ranges::max(expected);
      // Over the whole map the axes are those of the covariance: nothing is left out.
      for (const char* const covariance : {"axes", "full"}) {
        const std::vector<double> density =
            probe_ndf(parted_method(material, {{"k", "3"}, {"covariance", covariance}}), directions);
        for (std::size_t i = 0; i < directions.size(); ++i)
          EXPECT_NEAR(density[i], expected[i], 2e-4 * peak) << lobe << " " << tilt << " " << i << " " << covariance;
      }
    }
  }
}

// Over solid angle, against the sum over texels, at any level (maps of one texel, of a few, of odd sizes) and
// what is averaged over it, since every filter's moments are those of some set of texels.
TEST(Cells, KeepsTheEnergyOfTheSumOverTexels) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(160, 160);
  const auto energy = [&](const std::vector<double>& density) {
    double sum = 0;
    for (const double d : density) sum += d;
    return sum;
  };
  const std::vector<Words> ways{
      {}, {{"k", "2"}, {"storage", "fp16"}}, {{"covariance", "full"}}, {{"coordinates", "slopes"}}};
  std::size_t number = 0;
  for (const auto& [distribution, lobe] : lobes) {
    for (const Image& normals : {random_normals(5, 3, 0.4F, 6), two_walls(8)}) {
      const Material material = lobe_material(normals, distribution, lobe);
      const double exact = energy(exact_densities(material, directions));
      for (const Words& words : sweep(ways, 1, number++)) {
        EXPECT_NEAR(energy(probe_ndf(parted_method(material, words), directions)) / exact, 1.0, 0.01)
            << lobe << " " << normals.width << " " << words.size() << (words.contains("k") ? " k" : "");
      }
    }
  }
}

// What a frame's filters average is linear: the mean of a picture of evenly spread light is the same at any distance.
TEST(Cells, EveryFilterKeepsTheEnergy) {
  const BaseBrdf brdf{blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  Scene scene = square_scene(two_walls(64), {.brdf = brdf, .base_color = glm::vec3(0.0F), .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 8.0F;
  TestRenderer renderer(scene, {32, 32});
  const double reference = covered_mean(renderer.reference(256).mean);
  const std::array texts{"cells", "cells:covariance=full", "cells:k=2:storage=fp16"};
  std::size_t number = 0;
  for (const char* const filter : {"trilinear", "anisotropic:8", "box:3", "area:3", "ewa:8", "shaded:2"}) {
    for (const char* const text : sweep(texts, 1, number++))
      EXPECT_NEAR(covered_mean(renderer.frame(cells_method(), text, parse_footprint_filter(filter, ""))) / reference,
                  1.0, 0.01)
          << filter << " " << text;
  }
}

TEST(Cells, HalfFloatsAreCloseToFloats) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(40, 40);
  const Material material = lobe_material(two_walls(32), blinn_phong, 64.0F);
  const std::vector<double> floats = probe_ndf(parted_method(material), directions);
  EXPECT_LT(relative_l2(probe_ndf(parted_method(material, {{"storage", "fp16"}}), directions), floats), 0.01);
}

// The mean of the unit normals out of the moments, against that of the texels. Walls that face each other are exact for
// one part already; where a part leans the second order is what counts.
TEST(Cells, MomentsTellTheMeanNormal) {
  const std::array<std::array<glm::vec4, 3>, 1> input{};
  const auto error = [&](const Image& normals, const Words& words, const char* found) {
    const Material material = lobe_material(normals, blinn_phong, 16.0F);
    ProbedMethod probed = parted_method(material, words);
    probed.effects.set(static_cast<std::size_t>(Effect::diffuse));
    const glm::vec3 mean(probe_method(probed, found, input)[0]);
    glm::dvec3 expected(0.0);
    for (int y = 0; y < normals.height; ++y) {
      for (int x = 0; x < normals.width; ++x) expected += normal_at(normals, x, y);
    }
    return glm::length(glm::dvec3(mean) - expected / static_cast<double>(normals.texel_count()));
  };
  const char* const whole = "return vec4(e.mean_normal, 0.0);";
  Image facing(2, 1, 4);
  for (const float tilt : {0.2F, 0.8F, 0.985F}) {
    const float height = std::sqrt(1.0F - tilt * tilt);
    facing.texels = {tilt, 0.0F, height, 1.0F, -tilt, 0.0F, height, 1.0F};
    EXPECT_LT(error(facing, {{"k", "1"}}, whole), 1e-6) << tilt;
  }
  for (const char* const covariance : {"axes", "full"}) {
    EXPECT_LT(error(two_walls(32), {{"covariance", covariance}}, whole), 1e-4);
    EXPECT_LT(error(two_walls(32), {{"k", "1"}, {"covariance", covariance}}, whole), 4e-3);
    EXPECT_LT(error(random_normals(32, 32, 0.9F, 5), {{"covariance", covariance}}, whole), 4e-3);
  }
  EXPECT_GT(error(two_walls(32), {{"k", "1"}}, "return vec4(e.part[0].axis, 0.0);"), 0.05)
      << "the gate: the part's axis";
}

// Two walls in two parts, where one lobe covers the ridge between them.
TEST(Cells, TellsTheWallsOfGroovesApart) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  const Material material = lobe_material(two_walls(32), blinn_phong, 64.0F);
  const std::vector<double> exact = exact_densities(material, directions);
  EXPECT_LT(relative_l2(probe_ndf(parted_method(material, {{"k", "2"}}), directions), exact), 0.1);
  EXPECT_GT(relative_l2(probe_ndf(parted_method(material, {{"k", "1"}}), directions), exact), 0.4) << "the gate";
}

// Hard case 13: equal normals under exponent 1e5. In 32 bits it is the base lobe, whose peak is (s + 1) / 2 pi.
TEST(Cells, FlatTiltedMapsAreTheBaseLobe) {
  for (const float slope : {0.0F, 0.5F, 3.0F}) {
    const glm::vec3 n = glm::normalize(glm::vec3(-slope, 0.0F, 1.0F));
    const Material material = lobe_material(constant_normals(8, 8, n), blinn_phong, 1e5F);
    const std::array<std::array<glm::vec4, 3>, 1> input{{{glm::vec4(n, 0), {}, {}}}};
    for (const char* const storage : {"fp32", "fp16"}) {
      for (const char* const coordinates : {"stereographic", "slopes"}) {
        const float peak = probe_method(parted_method(material, {{"storage", storage}, {"coordinates", coordinates}}),
                                        "return vec4(ndf(e, a.xyz));", input)[0]
                               .x;
        EXPECT_TRUE(std::isfinite(peak) && peak > 0.0F);
        if (std::string(storage) == "fp16") continue;
        EXPECT_NEAR(peak * 2.0 * pi / 1e5, 1.0, 0.05) << slope << coordinates;
      }
    }
  }
}

// Hard cases 11, 15 and 28: more parts than normals, normals at the horizon, below it, and no valid normal at all.
TEST(Cells, EmptyPartsAndNormalsAtTheHorizonStayFinite) {
  Image horizon = random_normals(4, 4, 0.9F, 6);
  const glm::vec3 sideways(1, 0, 0);
  const glm::vec3 below = glm::normalize(glm::vec3(0.3F, 0.2F, -0.9F));
  std::copy_n(&sideways.x, 3, horizon.at(2, 1).begin());
  std::copy_n(&below.x, 3, horizon.at(0, 3).begin());
  Image invalid = random_normals(4, 4, 0.5F, 7);
  for (std::size_t i = 3; i < invalid.texels.size(); i += 4) invalid.texels[i] = 0.0F;
  std::size_t number = 0;
  for (const Image& map : {horizon, constant_normals(4, 4, sideways), random_normals(2, 1, 0.5F, 8), invalid}) {
    for (const float lobe : sweep(std::array{1.0F, 1e5F}, 1, number++)) {
      const Material material = lobe_material(map, blinn_phong, lobe);
      for (const char* const coordinates : {"stereographic", "slopes"}) {
        for (const double d :
             probe_ndf(parted_method(material, {{"k", "8"}, {"coordinates", coordinates}}), hemisphere_grid(20, 20)))
          EXPECT_TRUE(std::isfinite(d) && d >= 0.0) << lobe << " " << coordinates;
      }
    }
  }
}

// One of 16384 texels at the horizon: stereographic coordinates have no pole there, so that nothing has to be bounded.
TEST(Cells, OneSteepTexelDoesNotOutweighThousands) {
  const auto peak = [](bool spoilt, const Words& words) {
    Image normals = random_normals(128, 128, 0.1F, 4);
    const glm::vec3 steep(0.9999F, 0.0F, 0.0141F);
    if (spoilt) std::copy_n(&steep.x, 3, normals.at(40, 50).begin());
    const Material material = lobe_material(normals, blinn_phong, 64.0F);
    return std::ranges::max(probe_ndf(parted_method(material, words), hemisphere_grid(40, 40)));
  };
  const double whole = peak(false, {{"k", "1"}});
  EXPECT_NEAR(peak(true, {{"k", "1"}}) / whole, 1.0, 0.03);
  EXPECT_LT(peak(true, {{"k", "1"}, {"coordinates", "slopes"}, {"steepest", "50"}}) / whole, 0.7)
      << "the gate: unbounded slopes do";
}

// The base lobe by two instructions, within 2e-4 of its peak for every exponent.
TEST(Cells, TheFastDensityIsWithinItsBound) {
  for (const float lobe : {1.0F, 64.0F, 999.0F, 1001.0F, 1e4F, 1e6F}) {
    const Material material = lobe_material(constant_normals(2, 2, {0, 0, 1}), blinn_phong, lobe);
    std::vector<glm::dvec3> directions;
    for (int i = 0; i <= 200; ++i) {
      const double sine = std::min(0.03 * i / std::sqrt(static_cast<double>(lobe)), 1.0);
      directions.emplace_back(sine, 0.0, std::sqrt(1.0 - sine * sine));
    }
    const std::vector<double> fast = probe_ndf(parted_method(material, {{"density", "fast"}}), directions);
    for (std::size_t i = 0; i < directions.size(); ++i) {
      const glm::dvec3 h{glm::vec3(directions[i])};
      EXPECT_NEAR(fast[i] * 2.0 * pi / (lobe + 1.0),
                  base_density(blinn_phong, lobe, {0, 0, 1}, h) * 2.0 * pi / (lobe + 1.0), 2e-4)
          << lobe << " " << i;
    }
  }
}

// Rough walls and smooth ones: a part has the roughness of its own texels.
TEST(Cells, RoughnessGoesWithTheNormals) {
  const Image normals = two_walls(32);
  Material material = lobe_material(normals, ggx, 0.0F);
  material.lobe_parameter.reset();
  Image roughness(32, 32, 2);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      roughness.at(x, y)[0] = (x / 4) % 2 == 0 ? 0.55F : 0.3F;
      roughness.at(x, y)[1] = 1.0F;
    }
  }
  material.metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(roughness), material.normal_map->coordinates};
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  std::vector<double> exact;
  for (const glm::dvec3& h : directions) {
    double sum = 0.0;
    for (int y = 0; y < 32; ++y) {
      for (int x = 0; x < 32; ++x) {
        const double perceptual = (x / 4) % 2 == 0 ? 0.55 : 0.3;
        sum += base_density(ggx, perceptual * perceptual, normal_at(normals, x, y), h);
      }
    }
    exact.push_back(sum / static_cast<double>(normals.texel_count()));
  }
  ProbedMethod probed = parted_method(material, {{"k", "2"}});
  probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  const double joint = relative_l2(probe_ndf(probed, directions), exact);
  probed.options["roughness"] = "separate";
  const double separate = relative_l2(probe_ndf(probed, directions), exact);
  EXPECT_LT(joint, 0.2);
  EXPECT_LT(joint, 0.5 * separate);
  // On other coordinates nothing is joint: one variance, as on request.
  material.metallic_roughness_map->coordinates.set = 1;
  probed.options["roughness"] = "joint";
  EXPECT_NEAR(relative_l2(probe_ndf(probed, directions), exact), separate, 1e-3);
}

// Smooth and rough texels of one normal: their parts are their lobes.
TEST(Cells, SmoothAndRoughTexelsHavePartsOfTheirOwn) {
  Image normals(32, 32, 4, 1.0F), roughness(32, 32, 2, 1.0F);
  for (std::size_t i = 0; i < normals.texel_count(); ++i) {
    normals.texels[4 * i] = normals.texels[4 * i + 1] = 0.0F;
    roughness.texels[2 * i] = i % 3 == 0 ? 0.2F : 0.7F;
  }
  Material material = lobe_material(normals, ggx, 0.0F);
  material.lobe_parameter.reset();
  material.metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(roughness), material.normal_map->coordinates};
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  const double smooth_share = std::ceil(1024 / 3.0) / 1024;
  std::vector<double> exact;
  for (const glm::dvec3& h : directions)
    exact.push_back(smooth_share * base_density(ggx, 0.2 * 0.2, {0, 0, 1}, h) +
                    (1.0 - smooth_share) * base_density(ggx, 0.7 * 0.7, {0, 0, 1}, h));
  ProbedMethod probed = parted_method(material, {{"k", "2"}});
  probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  EXPECT_LT(relative_l2(probe_ndf(probed, directions), exact), 1e-3);
  probed.options["roughness"] = "separate";
  EXPECT_GT(relative_l2(probe_ndf(probed, directions), exact), 0.3);
}

// One texel in 2048 that leans: in 16 bits its part's share of the variance of polished facets rounds to nothing.
TEST(Cells, ASmallPartOfPolishedFacetsStaysFinite) {
  Image normals = constant_normals(64, 32, {0, 0, 1});
  const glm::vec3 leans = glm::normalize(glm::vec3(0.5F, 0.0F, 1.0F));
  std::copy_n(&leans.x, 3, normals.at(5, 7).begin());
  Material material = lobe_material(normals, ggx, 0.0F);
  material.lobe_parameter.reset();
  Image roughness(64, 32, 2);
  for (std::size_t i = 1; i < roughness.texels.size(); i += 2) roughness.texels[i] = 1.0F;
  roughness.at(1, 1)[0] = 0.5F;
  material.metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(roughness), material.normal_map->coordinates};
  ProbedMethod probed = parted_method(material, {{"k", "2"}, {"storage", "fp16"}});
  probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  std::vector<glm::dvec3> directions = hemisphere_grid(20, 20);
  directions.emplace_back(leans);
  for (const double density : probe_ndf(probed, directions)) EXPECT_TRUE(std::isfinite(density) && density >= 0.0);
}

// Two polished walls, each with a roughness that varies: where the one is seen, the other's part weighs nothing at all.
TEST(Cells, PartsThatAreNotThereHaveNoRoughness) {
  Image normals(32, 32, 4), roughness(32, 32, 2);
  for (int y = 0; y < 32; ++y) {
    for (int x = 0; x < 32; ++x) {
      const glm::vec3 n = glm::normalize(glm::vec3(x < 16 ? 0.5F : -0.5F, 0.0F, 1.0F));
      std::copy_n(&n.x, 3, normals.at(x, y).data());
      normals.at(x, y)[3] = 1.0F;
      roughness.at(x, y)[0] = x % 2 == 0 ? 0.1F : 0.05F;
      roughness.at(x, y)[1] = 1.0F;
    }
  }
  const BaseBrdf brdf{ggx, GeometryTerm::none, FresnelTerm::none, true};
  Scene scene = square_scene(normals, {.brdf = brdf});
  Material& material = scene.materials[0];
  material.lobe_parameter.reset();
  material.metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(roughness), material.normal_map->coordinates};
  TestRenderer renderer(scene, {32, 32});
  const Image frame = renderer.frame(cells_method(), "cells:k=2", parse_footprint_filter("trilinear", ""));
  EXPECT_TRUE(std::ranges::all_of(frame.texels, [](float v) { return std::isfinite(v) && v >= 0.0F; }));
  EXPECT_GT(covered_mean(frame), 0.0);
}

// What an effect does not need is not stored.
TEST(Cells, StoresWhatIsCalledFor) {
  const Material material = lobe_material(random_normals(4, 4, 0.5F, 8), ggx, 0.3F);
  const auto layers = [&](const Words& words, std::initializer_list<Effect> effects) {
    EffectSet set;
    for (const Effect effect : effects) set.set(static_cast<std::size_t>(effect));
    const Options options(cells_method().info.options, words, "cells");
    int count = 0;
    for (const PrefilteredTexture& texture : cells_method().precompute(material, options, set, no_progress).textures)
      count += std::max(texture.layers, 1);
    return count;
  };
  EXPECT_EQ(layers({}, {}), 0);
  EXPECT_EQ(layers({}, {Effect::normal_variation}), 5);
  EXPECT_EQ(layers({{"covariance", "full"}}, {Effect::normal_variation}), 6);
  EXPECT_EQ(layers({{"k", "1"}}, {Effect::normal_variation}), 2);
  EXPECT_EQ(layers({{"k", "3"}}, {Effect::normal_variation, Effect::diffuse}), 4);
  EXPECT_EQ(layers({{"coordinates", "slopes"}}, {Effect::normal_variation, Effect::diffuse}), 6);
  EXPECT_EQ(layers({}, {Effect::normal_variation, Effect::roughness_variation}), 7);
}

}  // namespace
}  // namespace footprint::testing
