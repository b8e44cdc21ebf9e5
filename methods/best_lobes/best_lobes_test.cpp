// The method as a whole: known normals, never above methods of as many lobes, energy, and pictures against `exact`. The
// exact distribution is a plain sum over texels in doubles.
#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/bake/baked_method.hpp"
#include "renderer/core/error.hpp"
#include "renderer/image/metrics.hpp"
#include "renderer/ndf/method_ndf.hpp"
#include "renderer/ndf/reference_ndf.hpp"
#include "tests/support/method_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/slope_twin.hpp"
#include "tests/support/stretched_twin.hpp"
#include "tests/support/sweep.hpp"
#include "tests/support/test_scenes.hpp"

namespace footprint {
const Method& best_lobes_method();
const Method& cells_method();
const Method& exact_method();
const Method& tan_gmm_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using enum NormalDistribution;
using Words = std::map<std::string, std::string>;
using std::numbers::pi;

struct Base {
  NormalDistribution distribution;
  float lobe;
};
constexpr std::array<Base, 4> bases{{{blinn_phong, 64.0F}, {vmf, 30.0F}, {beckmann, 0.25F}, {ggx, 0.2F}}};

std::vector<double> exact_densities(const Material& material, const std::vector<glm::dvec3>& directions) {
  std::vector<double> exact;
  exact.reserve(directions.size());
  for (const glm::dvec3& h : directions) exact.push_back(mean_facet_density(material, h));
  return exact;
}

std::vector<double> densities(const Method& method, const Material& material, const Words& options,
                              const std::vector<glm::dvec3>& directions) {
  return probe_ndf({.method = &method, .material = &material, .options = options}, directions);
}

Prefiltered baked(const Material& material, const Words& given, const Progress& progress = no_progress) {
  EffectSet effects;
  effects.set(static_cast<std::size_t>(Effect::normal_variation));
  return best_lobes_method().precompute(material, Options(best_lobes_method().info.options, given, "best_lobes"),
                                        effects, progress);
}

// Blocks of 8 x 8 texels with four normals each, others in every block.
Image four_normals_a_block(int blocks) {
  const Image normals = random_normals(4 * blocks, blocks, 0.6F, 21);
  Image map(8 * blocks, 8 * blocks, 4);
  for (int y = 0; y < map.height; ++y) {
    for (int x = 0; x < map.width; ++x) {
      const int which = (x % 8 * 5 + y % 8 * 3) % 4;
      std::ranges::copy(normals.at(4 * (x / 8) + which, y / 8), map.at(x, y).begin());
    }
  }
  return map;
}

TEST(BestLobes, AreTheNormalsWhereThereAreNoMore) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  for (const Base& base : bases) {
    const Material material = lobe_material(four_normals_a_block(1), base.distribution, base.lobe);
    const std::vector<double> exact = exact_densities(material, directions);
    for (const char* const shape : {"round", "stretched"}) {
      EXPECT_LT(relative_l2(densities(best_lobes_method(), material, {{"shape", shape}}, directions), exact), 1e-4);
      EXPECT_GT(
          relative_l2(densities(best_lobes_method(), material, {{"shape", shape}, {"k", "2"}}, directions), exact),
          0.02)
          << "the gate: two lobes are too few";
    }
  }
  const Material blocks = lobe_material(four_normals_a_block(4), blinn_phong, 64.0F);
  EXPECT_TRUE(baked(blocks, {}).notes.empty());
}

// Grooves along y of walls of two slopes, each wall with a waviness of its own.
Image wavy_walls(int size) {
  Image image = random_normals(size, size, 0.15F, 11);
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

std::vector<Image> rough_maps() {
  return {random_normals(16, 16, 0.5F, 3), gaussian_slope_normals(16, 0.25F), wavy_walls(16)};
}

// The errors of methods at every texel above the finest level, by their shaders, against the sum over the texel's
// normals.
class TexelErrors {
 public:
  explicit TexelErrors(const Material& material)
      : scene_(scene_of_facets(material)),
        effects_(effects_of(material)),
        gpu_(shared_context().info(), scene_, effects_) {
    for (int texels = material.normal_map->image.width() / 2; texels > 0; texels /= 2) {
      for (int i = 0; i < texels * texels; ++i) {
        const glm::dvec2 lower = glm::dvec2(i % texels, i / texels) / static_cast<double>(texels);
        rects_.push_back({lower, lower + 1.0 / texels});
        const ReferenceNdf exact(material.brdf.distribution, texels_under(material, rects_.back()).facets);
        exact_.push_back(exact.densities(grid_.directions, no_progress));
      }
    }
  }

  [[nodiscard]] std::vector<double> of(const Method& method, const std::string& text) {
    const BakedMethod baked = bake(method, parse_methods(text).front(), scene_, effects_, no_progress);
    const MethodNdf ndf(shared_context().info(), gpu_, baked, scene_.materials.front(), {});
    std::vector<double> errors;
    for (std::size_t i = 0; i < rects_.size(); ++i)
      errors.push_back(compare_ndfs(grid_, ndf.densities(rects_[i], grid_.directions), exact_[i]).l2);
    return errors;
  }

 private:
  static EffectSet effects_of(const Material& material) {
    EffectSet effects;
    effects.set(static_cast<std::size_t>(Effect::normal_variation));
    if (material.metallic_roughness_map) effects.set(static_cast<std::size_t>(Effect::roughness_variation));
    return effects;
  }

  Scene scene_;
  EffectSet effects_;
  GpuScene gpu_;
  HemisphereGrid grid_ = footprint::hemisphere_grid(64);
  std::vector<FootprintRect> rects_;
  std::vector<std::vector<double>> exact_;
};

// Texel by texel, for all that it is compared with: how much above the others the bound is at most, and its mean error
// over theirs.
struct Comparison {
  double excess = 0.0, bound = 0.0, others = 0.0;

  void add(const std::vector<double>& own, const std::vector<double>& other) {
    for (std::size_t i = 0; i < own.size(); ++i) {
      excess = std::max(excess, own[i] - other[i]);
      bound += own[i];
      others += other[i];
    }
  }
};

TEST(BestLobes, ErrNoMoreAtAnyTexelThanMethodsOfAsManyLobes) {
  constexpr double rounding = 1e-4;  // of the distribution's norm: pooled normals, the lattice, 32-bit floats
  const std::vector<Image> maps = rough_maps();
  for (const std::size_t i : sweep(std::array<std::size_t, bases.size()>{0, 1, 2, 3}, 2)) {
    TexelErrors errors(lobe_material(maps[i % maps.size()], bases[i].distribution, bases[i].lobe));
    Comparison stretched, round, fewer;
    std::vector<double> before, round_before;
    for (const char* const k : {"1", "2", "3", "4"}) {
      const std::string of_k = std::string("best_lobes:k=") + k;
      const std::vector<double> own = errors.of(best_lobes_method(), of_k);
      const std::vector<double> own_round = errors.of(best_lobes_method(), of_k + ":shape=round");
      const std::vector<double> tan = errors.of(tan_gmm_method(), std::string("tan_gmm:n=") + k);
      const std::vector<double> alone = errors.of(tan_gmm_method(), std::string("tan_gmm:align=off:n=") + k);
      stretched.add(own, tan);
      stretched.add(own, alone);
      stretched.add(own, errors.of(cells_method(), std::string("cells:k=") + k));
      round.add(own_round, tan);
      round.add(own_round, alone);
      if (!before.empty()) fewer.add(own, before);
      if (!before.empty()) fewer.add(own_round, round_before);
      before = own;
      round_before = own_round;
    }
    for (const Comparison& comparison : {stretched, round, fewer}) {
      EXPECT_LE(comparison.excess, rounding) << "distribution " << static_cast<int>(bases[i].distribution);
      EXPECT_LT(comparison.bound, 0.9 * comparison.others) << "the gate: there is something to gain";
    }
  }
}

// Normals under a roughness of their own: half of the texels have one of three narrow lobes, the others one of three
// wide ones, in stripes or at random.
Material material_of_two_roughnesses(const Image& normals, NormalDistribution distribution, bool striped) {
  const BaseBrdf brdf{distribution, GeometryTerm::none, FresnelTerm::none, true};
  Material material = square_scene(normals, {.brdf = brdf}).materials.front();
  const Image noise = random_normals(normals.width, normals.height, 0.5F, 77);
  auto roughness = std::make_shared<Image>(normals.width, normals.height, 2);
  for (std::size_t i = 0; i < noise.texels.size() / 4; ++i) {
    const bool wide = striped ? i % 16 < 8 : noise.texels[4 * i] > 0.0F;
    const float step = noise.texels[4 * i + 1] > 0.1F ? 0.05F : noise.texels[4 * i + 1] > -0.1F ? 0.02F : 0.0F;
    roughness->texels[2 * i] = (wide ? 0.65F : 0.4F) + step;
  }
  material.metallic_roughness_map = TextureMap{.name = "two", .image = roughness, .coordinates = {}};
  return material;
}

TEST(BestLobes, ErrNoMoreWhereTexelsHaveARoughnessOfTheirOwn) {
  constexpr double rounding = 1e-4;
  const std::vector<Image> maps = rough_maps();
  for (const std::size_t i : sweep(std::array<std::size_t, bases.size()>{0, 1, 2, 3}, 2, 2)) {
    TexelErrors errors(material_of_two_roughnesses(maps[i % maps.size()], bases[i].distribution, i % 2 == 0));
    Comparison comparison;
    std::vector<double> before;
    for (const char* const k : {"1", "2", "4"}) {
      const std::vector<double> own = errors.of(best_lobes_method(), std::string("best_lobes:k=") + k);
      comparison.add(own, errors.of(cells_method(), std::string("cells:k=") + k));
      comparison.add(own, errors.of(tan_gmm_method(), std::string("tan_gmm:n=") + k));
      comparison.add(own, errors.of(tan_gmm_method(), std::string("tan_gmm:align=off:n=") + k));
      if (!before.empty()) comparison.add(own, before);
      before = own;
    }
    EXPECT_LE(comparison.excess, rounding) << "distribution " << static_cast<int>(bases[i].distribution);
    EXPECT_LT(comparison.bound, 0.8 * comparison.others) << "the gate: there is something to gain";
  }
}

// Above the surface, of normals that lean up to 24 degrees: within one percent of what the texels have there.
TEST(BestLobes, KeepTheEnergy) {
  const std::vector<glm::dvec3> directions = hemisphere_grid(60, 120);
  const auto energy = [&](const std::vector<double>& density) {
    double sum = 0.0;
    for (const double d : density) sum += d;
    return sum * 2.0 * pi / static_cast<double>(directions.size());
  };
  for (const Base& base : bases) {
    const Material material = lobe_material(random_normals(16, 16, 0.4F, 7), base.distribution, base.lobe);
    const double expected = energy(exact_densities(material, directions));
    for (const char* const shape : {"round", "stretched"}) {
      for (const char* const k : {"1", "4"}) {
        EXPECT_NEAR(energy(densities(best_lobes_method(), material, {{"k", k}, {"shape", shape}}, directions)),
                    expected, 0.01)
            << "distribution " << static_cast<int>(base.distribution) << ", " << shape << ", k " << k;
      }
    }
  }
}

// At any size, in every texel: the part of the area that has normals.
TEST(BestLobes, WeightsSumToTheCoveredPart) {
  Image map = random_normals(13, 7, 0.6F, 2);
  for (int x = 0; x < 13; ++x) map.at(x, 0)[3] = 0.0F;
  const Prefiltered prefiltered = baked(lobe_material(map, ggx, 0.2F), {{"k", "3"}});
  const PrefilteredTexture& first = prefiltered.textures.at(0);
  const PrefilteredTexture& rest = prefiltered.textures.at(1);
  const std::size_t last = first.levels.size() - 1;
  double sum = decode_level(first, last).at(0, 0)[3];
  for (int layer = 0; layer < 2; ++layer) sum += decode_level(rest, last - 1, layer).at(0, 0)[3];
  EXPECT_NEAR(sum, 6.0 / 7.0, 1e-6);
}

// A lobe of the shader is that of the README: stored ones, decoded, against their twins, which know the wider base lobe
// of a deviation by its parameter.
TEST(BestLobes, LobesMeetTheirTwins) {
  for (const Base& base : bases) {
    const Material material = lobe_material(wavy_walls(16), base.distribution, base.lobe);
    const Prefiltered prefiltered = baked(material, {{"k", "2"}});
    const std::size_t last = prefiltered.textures.at(0).levels.size() - 1;
    const double variance = lobe_variance({base.distribution, base.lobe});
    const std::vector<glm::dvec3> directions = hemisphere_grid(8, 12);
    std::vector<double> expected(directions.size());
    double deviations = 0.0;
    for (int i = 0; i < 2; ++i) {
      const Image lobe =
          i == 0 ? decode_level(prefiltered.textures[0], last) : decode_level(prefiltered.textures[1], last - 1, 0);
      const Image spread = decode_level(prefiltered.textures[1], last - 1, 1 + i);
      const double theta = 2.0 * std::asin(0.5 * std::hypot(lobe.texels[0], lobe.texels[1]));
      const glm::dvec2 tilt = glm::normalize(glm::dvec2(lobe.texels[0], lobe.texels[1]));
      const PartTwin twin{.share = lobe.texels[3],
                          .mean = tilt * std::tan(0.5 * theta),
                          .spread = glm::dmat2(spread.texels[0], spread.texels[1], spread.texels[1], spread.texels[2])};
      const Lobe wider = lobe_from_variance(
          base.distribution, static_cast<float>(variance + static_cast<double>(lobe.texels[2]) * lobe.texels[2]));
      const double energy = lobe_energy({base.distribution, base.lobe}, 1.0) / lobe_energy(wider, 1.0);
      for (std::size_t d = 0; d < directions.size(); ++d)
        expected[d] += energy * twin.density(base.distribution, wider.parameter, directions[d]);
      deviations += lobe.texels[2];
    }
    EXPECT_GT(deviations, 0.0) << "the gate: lobes are widened as well as stretched";
    EXPECT_LT(relative_l2(densities(best_lobes_method(), material, {{"k", "2"}}, directions), expected), 1e-3)
        << "distribution " << static_cast<int>(base.distribution);
  }
}

// Under the same filter the remaining error is that of the lobes: less with more of them, and less than tan_gmm's.
TEST(BestLobes, PicturesComeNearExactOnes) {
  const std::array<std::pair<Base, const char*>, 2> settings{{{bases[0], "trilinear"}, {bases[3], "shaded:2"}}};
  for (const auto& [base, filter_text] : sweep(settings, 1)) {
    const BaseBrdf brdf{base.distribution, GeometryTerm::none, FresnelTerm::none, true};
    Scene scene = square_scene(random_normals(32, 32, 0.5F, 8), {.brdf = brdf, .base_color = glm::vec3(0.0F)});
    scene.materials[0].lobe_parameter = base.lobe;
    TestRenderer renderer(scene, {24, 24});
    const FootprintFilter filter = parse_footprint_filter(filter_text, "");
    const Image exact = renderer.frame(exact_method(), {}, filter, 0, 6.0);
    const auto error = [&](const Method& method, const char* text) {
      return compare_images(renderer.frame(method, text, filter, 0, 6.0), exact, 1.0F).value().relative_rmse;
    };
    const double best = error(best_lobes_method(), "best_lobes:k=8");
    EXPECT_LT(best, 0.7 * error(tan_gmm_method(), "tan_gmm:n=8")) << filter_text;
    EXPECT_LT(best, 0.7 * error(best_lobes_method(), "best_lobes:k=1")) << filter_text;
    EXPECT_LT(best, 0.05) << filter_text;
  }
}

// A roughness of its own in every texel: the finest level has the texel's, whatever the lobes were fitted with.
TEST(BestLobes, FinestLevelTakesTheTexelsOwnRoughness) {
  Scene scene = square_scene(random_normals(16, 16, 0.5F, 5), {});
  auto roughness = std::make_shared<Image>(16, 16, 2);
  for (std::size_t i = 0; i < roughness->texels.size(); i += 2) roughness->texels[i] = i % 4 == 0 ? 0.25F : 0.7F;
  scene.materials[0].metallic_roughness_map = TextureMap{.name = "stripes", .image = roughness, .coordinates = {}};
  TestRenderer renderer(scene);
  const Image reference = renderer.reference(16, 3).mean;
  const Image finest = renderer.supersampled(best_lobes_method(), 16, 3).mean;
  EXPECT_LT(compare_images(finest, reference, 1.0F).value().relative_rmse, 1e-4);
}

TEST(BestLobes, TheSameAtAnyNumberOfThreads) {
  const Material material = lobe_material(random_normals(16, 16, 0.5F, 9), ggx, 0.2F);
  const auto with_threads = [&](std::size_t threads) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    return baked(material, {});
  };
  const Prefiltered one = with_threads(1);
  EXPECT_EQ(one, with_threads(2));
  EXPECT_EQ(one, with_threads(4));
}

TEST(BestLobes, ReportProgressAndStop) {
  const Material material = lobe_material(random_normals(16, 16, 0.5F, 8), blinn_phong, 64.0F);
  double last = 0.0;
  int calls = 0;
  (void)baked(material, {}, [&](std::string_view, double fraction) {
    EXPECT_TRUE(fraction >= last && fraction <= 1.0) << fraction;
    last = fraction;
    ++calls;
  });
  EXPECT_GE(calls, 5);
  const auto stop = [](std::string_view, double) { throw Error(ErrorKind::interrupted, "", "stopped"); };
  EXPECT_THROW((void)baked(material, {}, stop), Error);
}

}  // namespace
}  // namespace footprint::testing
