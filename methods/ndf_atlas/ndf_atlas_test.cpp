// Densities, energy and reflectance through the method's own shader, against a table read by hand and sums over texels;
// what it does where tables cannot be.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <vector>

#include "methods/ndf_atlas/atlas.hpp"
#include "renderer/bake/baked_method.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/pipeline/gpu_scene.hpp"
#include "scenes/surfaces/registry.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& ndf_atlas_method();
const Method& tan_gmm_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using enum NormalDistribution;
using Words = std::map<std::string, std::string>;
constexpr std::array<std::pair<NormalDistribution, float>, 4> lobes{
    {{blinn_phong, 64.0F}, {vmf, 30.0F}, {beckmann, 0.2F}, {ggx, 0.25F}}};

ProbedMethod tabulated(const Material& material, const Words& options = {}) {
  return {.method = &ndf_atlas_method(), .material = &material, .options = options};
}

Prefiltered baked(const Material& material, const Words& words, EffectSet effects = ProbedMethod::default_effects()) {
  return ndf_atlas_method().precompute(material, Options(ndf_atlas_method().info.options, words, "ndf_atlas"), effects,
                                       no_progress);
}

bool has_tables(const Prefiltered& prefiltered) { return prefiltered.scalars.at("ndf_atlas_level") < 100.0F; }

double energy_of(const std::vector<double>& density) {
  double sum = 0.0;
  for (const double d : density) sum += d;
  return sum;
}

// The mean over all valid texels of any term of theirs.
std::vector<double> means_over_texels(const Image& normals, std::size_t count,
                                      const std::function<double(const glm::dvec3& n, std::size_t i)>& term) {
  std::vector<double> means;
  for (std::size_t i = 0; i < count; ++i) {
    double sum = 0.0;
    double weight = 0.0;
    for (int y = 0; y < normals.height; ++y) {
      for (int x = 0; x < normals.width; ++x) {
        if (normals.at(x, y)[3] <= 0.0F) continue;
        sum += term(normal_at(normals, x, y), i);
        weight += 1.0;
      }
    }
    means.push_back(sum / weight);
  }
  return means;
}

std::vector<double> exact_densities(const Material& material, const std::vector<glm::dvec3>& directions) {
  const Image normals = material.normal_map->image.decoded();
  return means_over_texels(normals, directions.size(), [&](const glm::dvec3& n, std::size_t i) {
    return base_density(material.brdf.distribution, *material.lobe_parameter, n, directions[i]);
  });
}

Image square_of(const Image& map, int x, int y, int edge) {
  Image out(edge, edge, 4);
  for (int row = 0; row < edge; ++row)
    for (int column = 0; column < edge; ++column)
      std::ranges::copy(map.at(x + column, y + row), out.at(column, row).begin());
  return out;
}

// The table of the coarsest level, looked up by hand.
class TableTwin {
 public:
  explicit TableTwin(const Material& material)
      : facets_(*ndf_atlas::collect_facets(material, false)), lattice_(ndf_atlas::lattice_over(facets_, 0.73)) {
    ndf_atlas::LevelTables level = ndf_atlas::build_tables(facets_, lattice_, 1, no_progress);
    while (level.coverage.size() > 1) level = ndf_atlas::coarser(level);
    table_ = level.density;
    ndf_atlas::correct_for_bilinear(table_, lattice_);
    ndf_atlas::close_border(table_, lattice_);
  }

  [[nodiscard]] double density(const glm::dvec3& h) const {
    const double azimuth = std::atan2(h.y, h.x);
    const double radius = 2.0 * std::sin(0.5 * std::acos(h.z));
    double sum = 0.0;
    for (int j = 0; j < lattice_.nodes.y; ++j) {
      for (int i = 0; i < lattice_.nodes.x; ++i) {
        const glm::dvec2 d =
            (radius * glm::dvec2(std::cos(azimuth), std::sin(azimuth)) - lattice_.point(i, j)) / lattice_.step;
        const double tent = std::max(1.0 - std::abs(d.x), 0.0) * std::max(1.0 - std::abs(d.y), 0.0);
        sum += tent * static_cast<double>(table_[static_cast<std::size_t>(j * lattice_.nodes.x + i)]);
      }
    }
    return sum;
  }

 private:
  ndf_atlas::Facets facets_;
  ndf_atlas::Lattice lattice_;
  std::vector<float> table_;
};

TEST(NdfAtlas, GlslMeetsItsTwin) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(24, 40);
  for (const auto& [distribution, lobe] : lobes) {
    const Material material = lobe_material(random_normals(16, 16, 0.6F, 3), distribution, lobe);
    const TableTwin twin(material);
    std::vector<double> expected;
    for (const glm::dvec3& h : directions) expected.push_back(twin.density(h));
    const double peak = std::ranges::max(expected);
    for (const auto& [tables, tolerance] : {std::pair("fp32", 2e-4), {"fp16", 1e-3}, {"unorm8", 1e-2}}) {
      const std::vector<double> density = probe_ndf(tabulated(material, {{"tables", tables}}), directions);
      for (std::size_t i = 0; i < directions.size(); ++i)
        EXPECT_NEAR(density[i], expected[i], tolerance * peak) << lobe << " " << tables << " " << i;
    }
  }
}

// Squares of 4, 16 and 64 texels, each a whole map: fine, middle and coarse levels. The bound is a fifth above the
// measured value of the README.
TEST(NdfAtlas, IsCloseToTheSumOverTexels) {
  struct Bound {
    const char* surface;
    std::array<double, 3> error;
  };
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  const std::array bounds{Bound{"carved_disk", {0.027, 0.024, 0.018}}, Bound{"scales", {0.029, 0.036, 0.032}},
                          Bound{"bumps", {0.024, 0.012, 0.008}}};
  for (const Bound& bound : sweep(bounds, 1)) {
    const Surface& surface = find_surface(all_surfaces(), bound.surface);
    SurfaceSettings settings = surface_settings(surface, {});
    settings.resolution = 256;
    const Image map = surface_normals(surface, settings);
    for (std::size_t k = 0; k < 3; ++k) {
      const Image square = square_of(map, 96, 160, std::array{4, 16, 64}[k]);
      const Material material = lobe_material(square, blinn_phong, 64.0F);
      EXPECT_LT(relative_l2(probe_ndf(tabulated(material), directions), exact_densities(material, directions)),
                bound.error[k])
          << bound.surface << " " << square.width;
    }
  }
}

// The density of the whole pipeline, for footprints of one material under one filter.
class PipelineNdf {
 public:
  PipelineNdf(const Material& material, const FootprintFilter& filter, const std::string& text = "ndf_atlas")
      : scene_(scene_of_facets(material)),
        effects_(effects_on(derive_effects(scene_))),
        gpu_(shared_context().info(), scene_, effects_),
        baked_(bake(ndf_atlas_method(), parse_methods(text).front(), scene_, effects_, no_progress)),
        ndf_(shared_context().info(), gpu_, baked_, scene_.materials.front(), filter) {}

  [[nodiscard]] std::vector<double> at(const FootprintRect& rect, const std::vector<glm::dvec3>& directions) const {
    const std::vector<float> found = ndf_.densities(rect, std::vector<glm::vec3>(directions.begin(), directions.end()));
    shared_context().check("evaluating an NDF");
    return {found.begin(), found.end()};
  }

 private:
  Scene scene_;
  EffectSet effects_;
  GpuScene gpu_;
  BakedMethod baked_;
  MethodNdf ndf_;
};

// Texel i of a map of `size` as a sampler wraps it.
int wrapped_texel(int i, int size, Wrap wrap) {
  if (wrap == Wrap::clamp_to_edge) return std::clamp(i, 0, size - 1);
  if (wrap == Wrap::repeat) return ((i % size) + size) % size;
  const int in_two = ((i % (2 * size)) + 2 * size) % (2 * size);
  return in_two < size ? in_two : 2 * size - 1 - in_two;
}

// What a trilinear lookup of densities is: of each of two levels four texels, each a square block of the map.
class TrilinearSum {
 public:
  TrilinearSum(const Material& material, Wrap wrap)
      : material_(material), normals_(material.normal_map->image.decoded()), wrap_(wrap) {}

  [[nodiscard]] double density(const glm::dvec2& uv, double level, const glm::dvec3& h) const {
    const int lower = static_cast<int>(std::floor(level));
    return (1.0 - level + lower) * at_level(uv, lower, h) + (level - lower) * at_level(uv, lower + 1, h);
  }

 private:
  [[nodiscard]] double at_level(const glm::dvec2& uv, int level, const glm::dvec3& h) const {
    const int size = normals_.width >> level;
    const glm::ivec2 corner(glm::floor(uv * static_cast<double>(size) - 0.5));
    double sum = 0.0;
    for (int y = corner.y; y < corner.y + 2; ++y) {
      for (int x = corner.x; x < corner.x + 2; ++x) {
        const double tent =
            std::max(1.0 - std::abs(uv.x * size - 0.5 - x), 0.0) * std::max(1.0 - std::abs(uv.y * size - 0.5 - y), 0.0);
        if (tent > 0.0) sum += tent * of_block(wrapped_texel(x, size, wrap_), wrapped_texel(y, size, wrap_), level, h);
      }
    }
    return sum;
  }
  [[nodiscard]] double of_block(int x, int y, int level, const glm::dvec3& h) const {
    const int edge = 1 << level;
    double sum = 0.0;
    for (int row = 0; row < edge; ++row)
      for (int column = 0; column < edge; ++column)
        sum += base_density(material_.brdf.distribution, *material_.lobe_parameter,
                            normal_at(normals_, x * edge + column, y * edge + row), h);
    return sum / (edge * edge);
  }

  const Material& material_;
  Image normals_;
  Wrap wrap_;
};

// Within, about a border and beyond it, between levels; every wrap.
TEST(NdfAtlas, BlendsTheTexelsThatATrilinearLookupDoes) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(40, 60);
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    Material material = lobe_material(random_normals(64, 64, 0.6F, 5), blinn_phong, 64.0F);
    material.normal_map->coordinates.wrap = {wrap, wrap};
    const TrilinearSum sum(material, wrap);
    const PipelineNdf ndf(material, {FootprintFilterKind::trilinear, 1});
    for (const glm::dvec2& centre : {glm::dvec2(0.33, 0.58), glm::dvec2(0.99, 0.02), glm::dvec2(-1.37, 1.21)}) {
      if (wrap == Wrap::clamp_to_edge && centre.x < 0.0) continue;  // all of it is the corner texel
      for (const double level : {2.0, 2.7, 4.3}) {
        const double edge = std::exp2(level) / 64.0;
        const FootprintRect rect{centre - 0.5 * edge, centre + 0.5 * edge};
        std::vector<double> exact;
        for (const glm::dvec3& h : directions) exact.push_back(sum.density(centre, level, h));
        EXPECT_LT(relative_l2(ndf.at(rect, directions), exact), 0.04)
            << static_cast<int>(wrap) << " " << centre.x << " " << level;
      }
    }
  }
}

// A footprint four times as long as wide is that of four probes; with more of them than are reused from light to light.
TEST(NdfAtlas, SumsTheProbesOfALongFootprint) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(40, 60);
  const Material material = lobe_material(random_normals(64, 64, 0.6F, 5), blinn_phong, 64.0F);
  const TrilinearSum sum(material, Wrap::repeat);
  const glm::dvec2 size = glm::dvec2(24.0, 6.0) / 64.0;
  const glm::dvec2 centre(0.4, 0.3);
  std::vector<double> exact;
  for (const glm::dvec3& h : directions) {
    double mean = 0.0;
    for (int i = 1; i <= 4; ++i)
      mean += 0.25 * sum.density(centre + glm::dvec2(size.x * (i / 5.0 - 0.5), 0.0), std::log2(6.0), h);
    exact.push_back(mean);
  }
  const FootprintRect rect{centre - 0.5 * size, centre + 0.5 * size};
  EXPECT_LT(relative_l2(PipelineNdf(material, {FootprintFilterKind::anisotropic, 8}).at(rect, directions), exact),
            0.04);
  EXPECT_GT(relative_l2(PipelineNdf(material, {FootprintFilterKind::anisotropic, 2}).at(rect, directions), exact), 0.1)
      << "the gate: two probes are another footprint";
}

// Over solid angle, against the sum over texels: every lobe, sizes that are no power of two, texels without a normal.
TEST(NdfAtlas, KeepsTheEnergyOfTheSumOverTexels) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(160, 160);
  Image holes = random_normals(13, 7, 0.7F, 6);
  for (int x = 2; x < 9; ++x) holes.at(x, 3)[3] = 0.0F;
  for (const auto& [distribution, lobe] : sweep(lobes, 2)) {
    for (const Image& normals : {random_normals(16, 16, 0.4F, 6), holes}) {
      const Material material = lobe_material(normals, distribution, lobe);
      const double exact = energy_of(exact_densities(material, directions));
      for (const char* const tables : {"unorm8", "fp16"}) {
        EXPECT_NEAR(energy_of(probe_ndf(tabulated(material, {{"tables", tables}}), directions)) / exact, 1.0, 0.01)
            << lobe << " " << normals.width << " " << tables;
      }
    }
  }
}

// At every level, and half-way between two, a footprint's density has the base lobe's energy.
TEST(NdfAtlas, EveryLevelKeepsTheEnergy) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(120, 120);
  const Material material = lobe_material(random_normals(64, 64, 0.5F, 9), blinn_phong, 64.0F);
  const double exact = energy_of(exact_densities(material, directions));
  const PipelineNdf ndf(material, {});
  for (double level = 0.0; level <= 6.0; level += 0.5) {
    const glm::dvec2 half_edge(0.5 * std::exp2(level) / 64.0);
    const std::vector<double> density = ndf.at({0.37 - half_edge, 0.37 + half_edge}, directions);
    EXPECT_NEAR(energy_of(density) / exact, 1.0, 0.01) << level;
  }
}

// The mean of a picture of evenly spread light is the same under any filter and at any distance.
TEST(NdfAtlas, EveryFilterKeepsTheEnergy) {
  const BaseBrdf brdf{blinn_phong, GeometryTerm::none, FresnelTerm::none, true};
  Image normals(64, 64, 4, 1.0F);  // grooves: between two texels of a wall is one lobe
  for (int y = 0; y < 64; ++y) {
    for (int x = 0; x < 64; ++x) {
      const glm::vec3 n = glm::normalize(
          glm::vec3((x / 4) % 2 == 0 ? 0.5F : -0.4F, 0.1F * std::sin(0.7F * static_cast<float>(y)), 1.0F));
      std::copy_n(&n.x, 3, normals.at(x, y).begin());
    }
  }
  Scene scene = square_scene(normals, {.brdf = brdf, .base_color = glm::vec3(0.0F), .specular = glm::vec3(0.5F)});
  scene.materials[0].lobe_parameter = 8.0F;
  TestRenderer renderer(scene, {32, 32});
  const double reference = covered_mean(renderer.reference(256).mean);
  const std::array texts{"ndf_atlas:level=1", "ndf_atlas:level=2:tables=fp16"};
  std::size_t number = 0;
  for (const char* const filter :
       {"trilinear", "anisotropic:8", "box:3", "area:3", "ewa:8", "shaded:2", "hardware:4"}) {
    for (const char* const text : sweep(texts, 1, number++))
      EXPECT_NEAR(
          covered_mean(renderer.frame(ndf_atlas_method(), text, parse_footprint_filter(filter, ""))) / reference, 1.0,
          0.01)
          << filter << " " << text;
  }
}

// Supersampled, a method shades texels: then there are no tables, and each texel has the base lobe.
TEST(NdfAtlas, SupersampledIsTheReference) {
  TestRenderer renderer(square_scene(random_normals(64, 64, 0.5F, 5), {}));
  const Image finest = renderer.supersampled(ndf_atlas_method(), 16).mean;
  EXPECT_LT(compare_images(finest, renderer.reference(16).mean, 1.0F).value().relative_rmse, 1e-4);
}

// Rough texels and smooth ones: a table has each facet's own lobe.
TEST(NdfAtlas, TabulatesEachFacetsOwnRoughness) {
  const Image normals = random_normals(32, 32, 0.5F, 4);
  Material material = lobe_material(normals, ggx, 0.0F);
  material.lobe_parameter.reset();
  Image roughness(16, 16, 2, 1.0F);
  for (int y = 0; y < 16; ++y)
    for (int x = 0; x < 16; ++x) roughness.at(x, y)[0] = normals.at(2 * x, 2 * y)[0] > 0.0F ? 0.65F : 0.5F;
  material.metallic_roughness_map =
      TextureMap{"roughness", std::make_shared<const Image>(roughness), material.normal_map->coordinates};
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  std::vector<double> exact;
  for (const glm::dvec3& h : directions) {
    double sum = 0.0;
    for (int y = 0; y < 32; ++y)
      for (int x = 0; x < 32; ++x)
        sum += base_density(ggx, std::pow(roughness.at(x / 2, y / 2)[0], 2.0), normal_at(normals, x, y), h);
    exact.push_back(sum / 1024.0);
  }
  ProbedMethod probed = tabulated(material);
  probed.effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  EXPECT_LT(relative_l2(probe_ndf(probed, directions), exact), 0.03);
  EXPECT_GT(relative_l2(probe_ndf(tabulated(material, {{"level", "10"}, {"nodes", "8"}}), directions), exact), 0.1)
      << "the gate: lobes of the mean width";
}

// F D G' of the mean of facets, each about its own normal.
TEST(NdfAtlas, GeometryIsAboutTheNormalsThatReflect) {
  const Image normals = random_normals(32, 32, 0.6F, 12);
  const Material material = lobe_material(normals, ggx, 0.2F, GeometryTerm::smith);
  std::vector<std::array<glm::vec4, 3>> inputs;
  const std::vector<glm::dvec3> grid = hemisphere_grid(6, 9);
  for (const glm::dvec3& wi : grid)
    for (const glm::dvec3& wo : grid)
      if (wi.z > 0.3 && wo.z > 0.3) inputs.push_back({glm::vec4(glm::vec3(wi), 0), glm::vec4(glm::vec3(wo), 0), {}});
  const auto smith = [](const glm::dvec3& n, const glm::dvec3& wi, const glm::dvec3& wo) {
    const double nl = glm::dot(n, wi);
    const double nv = std::max(glm::dot(n, wo), 1e-4);
    if (nl <= 0.0) return 0.0;
    constexpr double a2 = 0.2 * 0.2;
    return 0.5 * nl / (nl * std::sqrt(a2 + (1.0 - a2) * nv * nv) + nv * std::sqrt(a2 + (1.0 - a2) * nl * nl));
  };
  const std::vector<double> exact = means_over_texels(normals, inputs.size(), [&](const glm::dvec3& n, std::size_t i) {
    const glm::dvec3 wi(inputs[i][0]);
    const glm::dvec3 wo(inputs[i][1]);
    return base_density(ggx, 0.2, n, glm::normalize(wi + wo)) * smith(n, wi, wo);
  });
  const auto reflected = [&](const std::string& axis) {
    std::vector<double> out;
    const std::string body =
        "Surface s = Surface(vec3(0.0), vec3(1.0)); " + axis + " return vec4(shade(e, s, a.xyz, b.xyz).specular, 0.0);";
    for (const glm::vec4& v : probe_method(tabulated(material), body, inputs)) out.push_back(v.x);
    return out;
  };
  const double error = relative_l2(reflected(""), exact);
  EXPECT_LT(error, 0.092);
  EXPECT_GT(relative_l2(reflected("e.narrowing = 0.0;"), exact), 1.5 * error) << "the gate: about the mean normal";
}

// Lobes that are too narrow for a lattice get a note and no tables; so does a roughness map on other coordinates.
TEST(NdfAtlas, SaysWhereItHasNoTables) {
  const Image normals = random_normals(32, 32, 0.6F, 3);
  const std::vector<glm::dvec3> directions = hemisphere_grid(30, 60);
  for (const auto& [distribution, lobe] :
       {std::pair(blinn_phong, 1e6F), {vmf, 1e5F}, {ggx, 1e-3F}, {beckmann, 0.01F}}) {
    const Material material = lobe_material(normals, distribution, lobe);
    const Prefiltered prefiltered = baked(material, {});
    EXPECT_FALSE(has_tables(prefiltered)) << lobe;
    ASSERT_EQ(prefiltered.notes.size(), 1U);
    EXPECT_NE(prefiltered.notes[0].find("nodes"), std::string::npos);
    for (const double d : probe_ndf(tabulated(material), directions)) EXPECT_TRUE(std::isfinite(d) && d >= 0.0);
  }
  // Normals that hardly lean let a narrower lobe in.
  EXPECT_TRUE(has_tables(baked(lobe_material(random_normals(32, 32, 0.002F, 3), blinn_phong, 1e5F), {})));
  Material rough = lobe_material(normals, ggx, 0.5F);
  rough.lobe_parameter.reset();
  Image roughness(4, 4, 2, 0.6F);
  roughness.at(1, 1)[0] = 0.8F;
  rough.metallic_roughness_map = TextureMap{"roughness", std::make_shared<const Image>(roughness), {.set = 1}};
  EffectSet effects = ProbedMethod::default_effects();
  effects.set(static_cast<std::size_t>(Effect::roughness_variation));
  EXPECT_FALSE(has_tables(baked(rough, {}, effects)));
  EXPECT_EQ(baked(rough, {}, effects).notes.size(), 1U);
  rough.metallic_roughness_map->coordinates = {};
  EXPECT_TRUE(has_tables(baked(rough, {}, effects)));
}

TEST(NdfAtlas, StartsAtALevelThatFitsMemory) {
  const Material material = lobe_material(random_normals(128, 128, 0.6F, 3), blinn_phong, 64.0F);
  const Prefiltered whole = baked(material, {{"level", "1"}});
  const Prefiltered small = baked(material, {{"level", "1"}, {"megabytes", "2"}});
  EXPECT_EQ(whole.scalars.at("ndf_atlas_level"), 1.0F);
  EXPECT_TRUE(whole.notes.empty());
  EXPECT_GT(small.scalars.at("ndf_atlas_level"), 1.0F);
  EXPECT_EQ(small.notes.size(), 1U);
  const auto atlas_bytes = [](const Prefiltered& prefiltered) {
    return byte_count(*std::ranges::find(prefiltered.textures, "ndf_atlas_densities", &PrefilteredTexture::name));
  };
  EXPECT_LE(atlas_bytes(small), 2100000U) << "the last row of blocks is not full";
  EXPECT_GT(atlas_bytes(whole), 2100000U);
}

// What it is made for: grooves and relief that turn through all directions, seen from afar.
TEST(NdfAtlas, IsCloserThanAlignedMixturesFromAfar) {
  const Surface& surface = find_surface(all_surfaces(), "carved_disk");
  SurfaceSettings settings = surface_settings(surface, {});
  settings.resolution = 64;
  const Image map = surface_normals(surface, settings);
  const Material material = lobe_material(map, blinn_phong, 64.0F);
  const std::vector<glm::dvec3> directions = hemisphere_grid(30, 60);
  const std::vector<double> exact = exact_densities(material, directions);
  const double error = relative_l2(probe_ndf(tabulated(material), directions), exact);
  EXPECT_LT(error,
            0.5 * relative_l2(probe_ndf({.method = &tan_gmm_method(), .material = &material}, directions), exact));
}

}  // namespace
}  // namespace footprint::testing
