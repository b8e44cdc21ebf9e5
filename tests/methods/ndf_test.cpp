// The effective NDF of every method, by its own shader, against the exact one: equal over a constant map, finite at the
// limits, and in the known order of methods over grooves.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <tuple>

#include "methods/registry.hpp"
#include "renderer/ndf/footprint_texels.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "scenes/surfaces/registry.hpp"
#include "tests/methods/method_number.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint::testing {
namespace {

using enum NormalDistribution;

constexpr FootprintRect whole_map{};
constexpr int energy_rings = 64;  // 0.8 widths of a lobe of exponent 512 apart, which integrates it to rounding

Material material_of(Image normals, const Lobe& lobe) {
  Material material;
  material.name = "test";
  material.brdf = {lobe.distribution, GeometryTerm::none, FresnelTerm::none, false};
  material.lobe_parameter = static_cast<float>(lobe.parameter);
  material.normal_map = TextureMap{"normals", std::make_shared<const Image>(std::move(normals)), {}};
  return material;
}

// The exact NDF of a footprint on a grid of the lobe's resolution, at most `most_rings`, and any method's NDF against
// it.
class Inspection {
 public:
  explicit Inspection(Material material, const FootprintRect& rect = whole_map, int most_rings = largest_resolution)
      : rect_(rect), scene_(scene_of_facets(material)), gpu_(shared_context().info(), scene_, effects()) {
    const ReferenceNdf exact(material.brdf.distribution, texels_under(material, rect).facets);
    grid_ = hemisphere_grid(std::min(resolution_for(exact.narrowest()), most_rings));
    exact_ = exact.densities(grid_.directions, no_progress);
  }

  [[nodiscard]] std::vector<float> densities(const std::string& text, const FootprintFilter& filter = {}) {
    return densities_at(text, grid_.directions, filter);
  }

  [[nodiscard]] std::vector<float> densities_at(const std::string& text, std::span<const glm::vec3> directions,
                                                const FootprintFilter& filter = {}) {
    const MethodSpec spec = parse_methods(text).front();
    const BakedMethod baked = bake(find_method(spec.name), spec, scene_, effects(), no_progress);
    const MethodNdf ndf(shared_context().info(), gpu_, baked, scene_.materials.front(), filter);
    std::vector<float> out = ndf.densities(rect_, directions);
    shared_context().check("evaluating an NDF");
    return out;
  }

  [[nodiscard]] NdfFigures figures(const std::string& text, const FootprintFilter& filter = {}) {
    return compare_ndfs(grid_, densities(text, filter), exact_);
  }

 private:
  [[nodiscard]] EffectSet effects() const { return effects_on(derive_effects(scene_)); }

  FootprintRect rect_;
  Scene scene_;
  GpuScene gpu_;
  HemisphereGrid grid_;
  std::vector<double> exact_;
};

// The inspection of `key`, made on the first call: methods share the exact NDF.
Inspection& shared_inspection(const std::string& key, const std::function<Inspection()>& make) {
  (void)shared_context();  // outlives the inspections
  static std::map<std::string, std::unique_ptr<Inspection>> inspections;
  std::unique_ptr<Inspection>& found = inspections[key];
  if (!found) found = std::make_unique<Inspection>(make());
  return *found;
}

class EveryMethodsNdf : public ::testing::TestWithParam<const Method*> {
 protected:
  static const std::string& name() { return GetParam()->info.name; }
  /// `count` of `lobes` for the method by default, others for the next method.
  static std::vector<Lobe> some(const std::vector<Lobe>& lobes, std::size_t count) {
    return sweep(lobes, count, count * method_number(*GetParam()));
  }
};

TEST_P(EveryMethodsNdf, IsTheLobeOverAConstantMap) {
  const std::vector<Lobe> lobes{{blinn_phong, 64}, {beckmann, 0.2}, {ggx, 0.2}, {blinn_phong, 512}, {vmf, 200}};
  for (const Lobe& lobe : some(lobes, 2)) {
    for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0.28F, 0, 0.96F)}) {
      const NdfFigures figures = shared_inspection(lobe_text(lobe) + (normal.x > 0.0F ? " tilted" : " flat"), [&] {
                                   return Inspection(material_of(constant_normals(16, 16, normal), lobe));
                                 }).figures(name());
      EXPECT_LT(figures.l2, 1e-3) << lobe_text(lobe) << ", x = " << normal.x;
      EXPECT_NEAR(figures.energy, 1.0, 0.01) << lobe_text(lobe) << ", x = " << normal.x;
    }
  }
}

// Lobes so narrow that 1 - cos and lengths near 1 are rounding errors, over one tilted normal: at the peak, at half the
// peak, and in the tail, where GGX depends on the square of its width.
TEST_P(EveryMethodsNdf, KeepsNarrowLobesOnATilt) {
  const glm::vec3 normal = glm::normalize(glm::vec3(0.17364818F, 0.0F, 0.98480775F));
  const glm::vec3 along = glm::normalize(glm::cross(glm::vec3(0, 1, 0), normal));
  const std::vector<Lobe> lobes{{blinn_phong, 9.5e4}, {vmf, 1e6}, {ggx, 1e-3}, {blinn_phong, 1e6}, {beckmann, 1e-3}};
  for (const Lobe& lobe : some(lobes, 2)) {
    std::vector<glm::vec3> directions;
    for (const double away : {0.0, 1.2, 8.0})
      directions.push_back(glm::normalize(normal + along * static_cast<float>(away * lobe_width(lobe))));
    const std::vector<float> found =
        Inspection(material_of(constant_normals(16, 16, normal), lobe), whole_map, 32).densities_at(name(), directions);
    for (std::size_t i = 0; i < found.size(); ++i) {
      const glm::dvec3 d = glm::normalize(glm::dvec3(directions[i])) - glm::normalize(glm::dvec3(normal));
      const double exact = lobe_density(lobe, 0.5 * glm::dot(d, d));
      EXPECT_NEAR(found[i], exact, 0.01 * exact + 1e-9 * lobe_peak(lobe)) << lobe_text(lobe) << ", direction " << i;
    }
  }
}

// Lobes 45 degrees to either side of each facet's normal.
Material with_two_lobes(Image normals) {
  Material material = material_of(std::move(normals), {vmf, 128});
  material.lobe_parameter.reset();
  material.lobes = {{.axis = {0.70710678F, 0.0F, 0.70710678F}, .parameter = 128.0F, .weight = 0.75F},
                    {.axis = {-0.70710678F, 0.0F, 0.70710678F}, .parameter = 64.0F, .weight = 0.25F}};
  return material;
}

TEST_P(EveryMethodsNdf, HasTheLobesOverAConstantMap) {
  if (!has(GetParam()->info.honours, Effect::multi_lobe)) GTEST_SKIP();
  for (const glm::vec3& normal : {glm::vec3(0, 0, 1), glm::vec3(0, 0.28F, 0.96F)}) {
    const NdfFigures figures = Inspection(with_two_lobes(constant_normals(16, 16, normal))).figures(name());
    EXPECT_LT(figures.l2, 1e-3) << normal.y;
    EXPECT_NEAR(figures.energy, 1.0, 0.01) << normal.y;
  }
}

TEST_P(EveryMethodsNdf, KeepsTheEnergyOfSeveralLobesOverBumps) {
  if (!has(GetParam()->info.honours, Effect::multi_lobe)) GTEST_SKIP();
  const Surface& bumps = find_surface(all_surfaces(), "bumps");
  SurfaceSettings settings = surface_settings(bumps, {});
  settings.resolution = GetParam()->info.slow_frame ? 32 : 64;
  EXPECT_NEAR(
      Inspection(with_two_lobes(surface_normals(bumps, settings)), whole_map, energy_rings).figures(name()).energy, 1.0,
      0.01);
}

// Methods that represent narrow microfacet lobes, whose energy is one, by wide lobes. Toksvig's is left out: it has the
// base BRDF's own norm at its width, as in engines (methods/toksvig/README.md).
constexpr std::array widening_methods{"lean", "leadr", "tan_gmm", "xu_vmf:j=1", "xu_vmf:j=4", "xu_vmf:j=8", "xu_vmf"};

TEST(WideningMethodsNdf, KeepTheEnergyOfMicrofacetLobes) {
  for (const Lobe& lobe : {Lobe{ggx, 0.05}, {beckmann, 0.05}}) {
    Inspection inspection(material_of(random_normals(16, 16, 0.5F, 12), lobe));
    for (const char* const method : widening_methods)
      EXPECT_NEAR(inspection.figures(method).energy, 1.0, 0.01) << method << ", " << lobe_text(lobe);
  }
}

TEST(WideningMethodsNdf, KeepTheEnergyOfSeveralMicrofacetLobes) {
  Material material = with_two_lobes(random_normals(16, 16, 0.25F, 12));
  material.brdf.distribution = ggx;
  material.lobes = {{.axis = {0.28F, 0.0F, 0.96F}, .parameter = 0.03F, .weight = 0.75F},
                    {.axis = {-0.28F, 0.0F, 0.96F}, .parameter = 0.06F, .weight = 0.25F}};
  Inspection inspection(material);
  for (const char* const method : widening_methods) {
    if (!has(find_method(parse_methods(method).front().name).info.honours, Effect::multi_lobe)) continue;
    EXPECT_NEAR(inspection.figures(method).energy, 1.0, 0.01) << method;
  }
}

// Narrow lobes, directions far from every lobe, texels without a normal, normals on the horizon, sizes that are not
// powers of two, and footprints within a texel. A coarse grid finds values that are not finite.
TEST_P(EveryMethodsNdf, IsFiniteAndNotNegativeAtTheLimits) {
  Image hard = random_normals(13, 7, 0.999F, 8);
  std::ranges::copy(std::vector{1.0F, 0.0F, 1e-6F, 1.0F}, hard.at(3, 2).begin());
  std::ranges::copy(std::vector{0.0F, 0.0F, 1.0F, 0.0F}, hard.at(4, 2).begin());
  for (const Lobe& lobe : some({{blinn_phong, 1e-3}, {ggx, 0.05}, {blinn_phong, 1e4}}, 2)) {
    for (const FootprintRect& rect : {whole_map, FootprintRect{{0.3, 0.3}, {0.31, 0.32}}, {{-1.5, 0.2}, {2.5, 0.3}}}) {
      for (const float d : Inspection(material_of(hard, lobe), rect, 48).densities(name())) {
        ASSERT_TRUE(std::isfinite(d) && d >= 0.0F) << lobe_text(lobe);
      }
    }
  }
}

TEST_P(EveryMethodsNdf, TakesAnisotropicProbes) {
  Inspection inspection(material_of(random_normals(32, 32, 0.5F, 6), {blinn_phong, 64}), {{0, 0.4}, {1, 0.6}});
  EXPECT_TRUE(std::isfinite(inspection.figures(name(), default_footprint_filter).l2));
}

// Footprints in the middle, within whole texels of a level, about a corner and an edge of the map, in a copy of it, and
// beyond it.
constexpr std::array<FootprintRect, 6> parts_of_map{{{{0.40, 0.55}, {0.49, 0.60}},
                                                     {{0.25, 0.5}, {0.375, 0.625}},
                                                     {{-0.05, -0.06}, {0.06, 0.04}},
                                                     {{0.96, 0.3}, {1.04, 0.36}},
                                                     {{2.10, -0.8}, {2.20, -0.7}},
                                                     {{-1.3, 0.97}, {-1.25, 1.05}}}};

// The greatest difference of a method's density between the whole map's bake and that of the part which `rect` needs,
// of the greatest density.
double difference_by_part(const Material& material, const std::string& method, const FootprintRect& rect,
                          const FootprintPart& part, const FootprintFilter& filter) {
  constexpr int rings = 24;
  Inspection whole(material, rect, rings), cropped(part.material, part.rect, rings);
  const std::vector<float> expected = whole.densities(method, filter), found = cropped.densities(method, filter);
  double most = 0.0;
  for (std::size_t i = 0; i < expected.size(); ++i)
    most = std::max(most, std::abs(static_cast<double>(found[i]) - expected[i]));
  return most / *std::ranges::max_element(expected);
}

// Methods of which a part of a map may be baked for itself have the same density from it, for any content at the map's
// border. The density of the part next to it differs: the comparison sees which texels are taken.
TEST_P(EveryMethodsNdf, IsTheSameFromThePartThatIsLookedAt) {
  if (!GetParam()->info.bakes_by_texel) GTEST_SKIP();
  using enum FootprintFilterKind;
  constexpr std::array<FootprintFilter, 4> filters{{{trilinear, 1}, {anisotropic, 8}, {box, 2}, {ewa, 4}}};
  Material material = material_of(random_normals(32, 32, 0.5F, 6), {blinn_phong, 64});
  std::size_t number = 0;
  for (const Wrap wrap : {Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}) {
    material.normal_map->coordinates.wrap = {wrap, wrap};
    for (const FootprintRect& rect : parts_of_map) {
      const FootprintFilter& filter = filters.at(number++ % filters.size());
      SCOPED_TRACE(footprint_filter_text(filter) + ", footprint " + std::to_string(rect.lower.x) + ", wrap " +
                   std::to_string(static_cast<int>(wrap)));
      std::optional<FootprintPart> part = part_under(material, rect, filter);
      if (!part && wrap == Wrap::mirrored_repeat && rect.lower.x > 1.5) continue;  // the third copy: baked whole
      ASSERT_TRUE(part);
      EXPECT_LE(part->material.normal_map->image.texel_count(), std::size_t{32} * 32 / 2);
      EXPECT_LT(difference_by_part(material, name(), rect, *part, filter), 1e-5);
      const glm::dvec2 step = part->rect.size();
      part->rect = {part->rect.lower + step, part->rect.upper + step};
      if (number == 1) {
        EXPECT_GT(difference_by_part(material, name(), rect, *part, filter), 1e-3);
      }
    }
  }
}

// Only the texels under the footprint are baked: some about a corner of a large map, or the whole map.
TEST(FootprintParts, AreAsSmallAsTheirFootprints) {
  const Material material = material_of(constant_normals(2048, 1024, {0.0F, 0.0F, 1.0F}), {blinn_phong, 64});
  const auto texels = [&](const FootprintRect& rect) {
    const std::optional<FootprintPart> part = part_under(material, rect, default_footprint_filter);
    return part ? part->material.normal_map->image.texel_count() : material.normal_map->image.texel_count();
  };
  EXPECT_EQ(texels({{0.0, 0.0}, {0.125, 0.25}}), std::size_t{256} * 256);      // one texel of a level
  EXPECT_LE(texels({{0.1, 0.1}, {0.225, 0.35}}), std::size_t{9} * 256 * 256);  // at any position
  EXPECT_EQ(texels(whole_map), std::size_t{2048} * 1024);
  EXPECT_FALSE(part_under(material, {{0.0, 0.0}, {0.125, 0.25}}, {FootprintFilterKind::hardware, 8}));
  const Material odd = material_of(constant_normals(1001, 1001, {0.0F, 0.0F, 1.0F}), {blinn_phong, 64});
  EXPECT_FALSE(part_under(odd, {{0.0, 0.0}, {0.125, 0.125}}, default_footprint_filter));
}

// Four surfaces at a size with a fast bake, under one exponent.
class SurfaceNdfs : public ::testing::TestWithParam<std::tuple<std::string, double>> {
 protected:
  static Inspection inspection(int resolution = 128, int most_rings = largest_resolution) {
    const auto& [name, exponent] = GetParam();
    const Surface& surface = find_surface(all_surfaces(), name);
    SurfaceSettings settings = surface_settings(surface, {});
    settings.resolution = resolution;
    return Inspection(material_of(surface_normals(surface, settings), {blinn_phong, exponent}), whole_map, most_rings);
  }
};

// Every method's density has the integral of the exact one, within 1%. Slow methods have a smaller map. By default one
// exponent per surface, and half of the methods.
TEST_P(SurfaceNdfs, KeepTheExactEnergy) {
  const auto& [surface, exponent] = GetParam();
  const bool is_wide = surface == "bumps" || surface == "scales";
  if (!all_tests() && is_wide != (exponent < 100.0)) GTEST_SKIP() << "only with scripts/test --all";
  Inspection inspected = inspection(128, energy_rings), small = inspection(48, energy_rings);
  const std::size_t half = (all_methods().size() + 1) / 2;
  for (const Method* method : sweep(all_methods(), half, surface == "bumps" || surface == "v_grooves" ? 0 : half)) {
    const NdfFigures figures =
        (method->info.slow_frame || method->info.slow_precompute ? small : inspected).figures(method->info.name);
    EXPECT_NEAR(figures.energy, 1.0, 0.01) << method->info.name << ", L2 " << figures.l2;
  }
}

TEST_P(SurfaceNdfs, ComeInTheKnownOrder) {
  const std::string& surface = std::get<0>(GetParam());
  Inspection inspected = inspection();
  const double naive = inspected.figures("naive_mip").l2;
  const double toksvig = inspected.figures("toksvig").l2;
  const double lean = inspected.figures("lean").l2;
  const double tan = inspected.figures("tan_gmm").l2;
  EXPECT_LT(tan, 0.5 * naive);
  if (surface == "scratches") return;  // mostly flat: the unwidened lobe is then nearer than one wide enough for all
  EXPECT_LT(toksvig, 0.75 * naive);
  EXPECT_LT(lean, 0.75 * naive);
  if (surface != "v_grooves") return;
  EXPECT_LT(tan, 0.2 * lean);
  EXPECT_LT(lean, toksvig);
}

INSTANTIATE_TEST_SUITE_P(Surfaces, SurfaceNdfs,
                         ::testing::Combine(::testing::Values("bumps", "v_grooves", "scales", "scratches"),
                                            ::testing::Values(64.0, 512.0)),
                         [](const auto& test) {
                           return std::get<0>(test.param) + std::to_string(static_cast<int>(std::get<1>(test.param)));
                         });

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethodsNdf, ::testing::ValuesIn(all_methods().begin(), all_methods().end()),
                         [](const auto& test) { return test.param->info.name; });

}  // namespace
}  // namespace footprint::testing
