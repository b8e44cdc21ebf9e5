// Large footprints by lists, whose walks take so many steps and no more: the density against plain sums over maps whose
// bins lie in different ways, and pictures under more and more lights against one light's.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "renderer/image/metrics.hpp"
#include "tests/methods/bins_probe.hpp"
#include "tests/support/rendering.hpp"
#include "tests/support/sweep.hpp"

namespace footprint {
const Method& exact_method();
}  // namespace footprint

namespace footprint::testing {
namespace {

using atanasov_bins::bin_solid_angle;

// How the texels of a bin lie on the map: strewn, in squares of 4 x 4, along lines.
enum class Kind { noise, flakes, waves };
constexpr std::array<Kind, 3> kinds{Kind::noise, Kind::flakes, Kind::waves};

Image map_of(Kind kind, int size) {
  if (kind == Kind::noise) return random_normals(size, size, 0.4F, 21);
  Image map(size, size, 4, 1.0F);
  const Image flakes = random_normals(size / 4, size / 4, 0.4F, 22);
  for (int y = 0; y < size; ++y) {
    for (int x = 0; x < size; ++x) {
      const double u = 2.0 * std::numbers::pi * x / size, v = 2.0 * std::numbers::pi * y / size;
      const glm::dvec2 disc = 0.28 * glm::dvec2(std::sin(9.0 * u + std::cos(2.0 * v)), std::cos(9.0 * v));
      const glm::vec3 wave(glm::dvec3(disc, std::sqrt(1.0 - glm::dot(disc, disc))));
      std::copy_n(kind == Kind::waves ? &wave.x : flakes.at(x / 4, y / 4).data(), 3, map.at(x, y).begin());
    }
  }
  return map;
}

Parallelogram turned(const glm::dvec2& centre, const glm::dvec2& sides, double turn) {
  const glm::dvec2 along(std::cos(turn), std::sin(turn));
  return {centre, {sides.x * along, sides.y * glm::dvec2(-along.y, along.x)}};
}

// On a map of 1024 texels per side: near squares, long ones, over its border.
const std::vector<Parallelogram> large_footprints{
    turned({667.0, 377.0}, {100.0, 110.0}, 0.4), turned({682.0, 342.0}, {400.0, 60.0}, 0.7),
    turned({610.0, 510.0}, {320.0, 300.0}, 0.6), turned({688.0, 328.0}, {1000.0, 40.0}, 1.3),
    turned({460.0, 860.0}, {900.0, 800.0}, 1.2)};

using Inputs = std::vector<std::array<glm::vec4, 3>>;

Inputs inputs_of(const std::vector<Parallelogram>& footprints, double size, const std::vector<glm::dvec3>& directions) {
  Inputs inputs;
  for (const Parallelogram& p : footprints) {
    for (const glm::dvec3& h : directions) inputs.push_back(input_of(p, glm::dvec2(size), h));
  }
  return inputs;
}

// Root mean square of the differences over that of the exact densities.
double relative_error(std::span<const glm::vec4> found, std::span<const double> exact) {
  double off = 0.0, energy = 0.0;
  for (std::size_t i = 0; i < exact.size(); ++i) {
    off += std::pow(found[i].x - exact[i], 2.0);
    energy += exact[i] * exact[i];
  }
  return std::sqrt(off / energy);
}

// ---- the bin of the half vector ----

constexpr int m = 31;

// The error of each footprint, over all bins.
std::vector<double> errors_of_bins(Kind kind, const std::string& border) {
  const Image normals = map_of(kind, 1024);
  std::vector<glm::dvec3> middles;
  for (int bin = 0; bin < m * m; ++bin)
    middles.push_back(square_to_hemisphere((glm::dvec2(bin % m, bin / m) + 0.5) / double{m}));
  const Material material = material_of(normals, Wrap::repeat);
  const ProbedMethod probed{
      &atanasov_bins_method(), &material, {{"m", std::to_string(m)}, {"roughness", "bin"}, {"border", border}}};
  const std::vector<glm::vec4> found =
      probe_footprints(probed, "return vec4(ndf(e, c.xyz));", inputs_of(large_footprints, 1024.0, middles));
  std::vector<double> errors;
  for (std::size_t i = 0; i < large_footprints.size(); ++i) {
    std::vector<double> exact = shares_of_bins(normals, large_footprints[i], Wrap::repeat, m);
    for (double& share : exact) share /= bin_solid_angle(m);
    errors.push_back(relative_error(std::span(found).subspan(i * exact.size(), exact.size()), exact));
  }
  return errors;
}

// README. By texels the rounds are too few for the last footprint alone.
TEST(AtanasovBounded, BinsAreNearThePlainSum) {
  for (const Kind kind : kinds) {
    const std::vector<double> nodes = errors_of_bins(kind, "nodes"), texels = errors_of_bins(kind, "texels");
    for (std::size_t i = 0; i < nodes.size(); ++i) {
      EXPECT_LT(nodes[i], 0.031) << static_cast<int>(kind);
      EXPECT_GT(nodes[i], 1e-3) << static_cast<int>(kind) << ": no node was sampled";
      EXPECT_LT(texels[i], i + 1 < nodes.size() ? 1e-5 : 1e-3) << static_cast<int>(kind);
    }
  }
}

// More copies of a map than are walked: its mean.
TEST(AtanasovBounded, ManyMapsAreTheWholeMap) {
  const Image normals = map_of(Kind::noise, 16);
  const Material material = material_of(normals, Wrap::repeat);
  const Parallelogram wide = turned({3.0, 5.0}, {500.0, 20.0}, 0.4);
  const std::vector<double> shares = shares_of_bins(normals, wide, Wrap::repeat, m);
  std::vector<glm::dvec3> middles;
  for (int bin = 0; bin < m * m; ++bin)
    middles.push_back(square_to_hemisphere((glm::dvec2(bin % m, bin / m) + 0.5) / double{m}));
  const ProbedMethod probed{&atanasov_bins_method(), &material, {{"m", std::to_string(m)}, {"roughness", "bin"}}};
  const std::vector<glm::vec4> found =
      probe_footprints(probed, "return vec4(ndf(e, c.xyz) * binSolidAngle());", inputs_of({wide}, 16.0, middles));
  EXPECT_LT(relative_error(found, shares), 0.03);
}

// ---- lobes ----

double ggx_density(double alpha, const glm::dvec3& n, const glm::dvec3& h) {
  const double c = std::max(glm::dot(n, h), 0.0), d = c * c * (alpha * alpha - 1.0) + 1.0;
  return alpha * alpha / (std::numbers::pi * d * d);
}

double density_of(const Lobe& lobe, const glm::dvec3& n, const glm::dvec3& h) {
  return lobe.distribution == NormalDistribution::ggx ? ggx_density(lobe.parameter, n, h)
                                                      : beckmann_density(lobe.parameter, n, h);
}

const std::vector<glm::dvec3>& directions_about_z() {
  static const std::vector<glm::dvec3> directions = [] {
    std::vector<glm::dvec3> out;
    for (int i = 0; i < 40; ++i) {
      const double sine = 0.6 * std::sqrt((i + 0.5) / 40.0), angle = 2.39996 * i;
      out.emplace_back(sine * std::cos(angle), sine * std::sin(angle), std::sqrt(1.0 - sine * sine));
    }
    return out;
  }();
  return directions;
}

std::vector<double> lobes_summed(const Image& normals, const Parallelogram& p, Wrap wrap, const Lobe& lobe) {
  std::vector<double> sums(directions_about_z().size(), 0.0);
  double area = 0.0;
  for_each_texel(p, {normals.width, normals.height}, wrap, [&](int x, int y, double covered) {
    const std::span<const float> n = normals.at(x, y);
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] += covered * density_of(lobe, {n[0], n[1], n[2]}, directions_about_z()[i]);
    area += covered;
  });
  for (double& sum : sums) sum /= area;
  return sums;
}

// The largest over the footprints; each over all directions.
double error_of_lobes(const Image& normals, const std::vector<Parallelogram>& footprints, Wrap wrap, const Lobe& lobe,
                      const std::map<std::string, std::string>& options = {}) {
  Material material = material_of(normals, wrap);
  if (options.empty()) {
    material.brdf.distribution = lobe.distribution;
    material.lobe_parameter = static_cast<float>(lobe.parameter);
  }
  const ProbedMethod probed{&atanasov_bins_method(), &material, options};
  const std::vector<glm::vec4> found = probe_footprints(probed, "return vec4(ndf(e, c.xyz));",
                                                        inputs_of(footprints, normals.width, directions_about_z()));
  double worst = 0.0;
  for (std::size_t i = 0; i < footprints.size(); ++i) {
    const std::vector<double> exact = lobes_summed(normals, footprints[i], wrap, lobe);
    worst = std::max(worst, relative_error(std::span(found).subspan(i * exact.size(), exact.size()), exact));
  }
  return worst;
}

constexpr Lobe narrow{NormalDistribution::beckmann, 0.02}, medium{NormalDistribution::beckmann, 0.1},
    tailed{NormalDistribution::ggx, 0.1}, wide{NormalDistribution::ggx, 0.3};

// README: 1.7 to 5.1%.
TEST(AtanasovBounded, LobesAreNearThePlainSum) {
  for (const Kind kind : kinds) {
    const Image normals = map_of(kind, 1024);
    for (const Lobe& lobe : sweep(std::array{narrow, medium, tailed, wide}, 2, static_cast<std::size_t>(kind))) {
      EXPECT_LT(error_of_lobes(normals, large_footprints, Wrap::repeat, lobe), 0.055)
          << static_cast<int>(kind) << ", " << lobe_text(lobe);
    }
    const Lobe flake{NormalDistribution::beckmann, 0.04};
    EXPECT_LT(
        error_of_lobes(normals, large_footprints, Wrap::repeat, flake, {{"roughness", "flakes"}, {"alpha", "0.04"}}),
        0.055)
        << static_cast<int>(kind);
  }
}

// Footprints of several maps, and of one that reaches far over its border.
TEST(AtanasovBounded, SeveralMapsAreNearThePlainSum) {
  const std::vector<Parallelogram> footprints{turned({50.0, 70.0}, {190.0, 170.0}, 0.4),
                                              turned({50.0, 70.0}, {330.0, 280.0}, 1.0)};
  for (const Kind kind : kinds) {
    const Image normals = map_of(kind, 128);
    const auto first = static_cast<std::size_t>(kind);
    for (const Wrap wrap : sweep(std::array{Wrap::repeat, Wrap::mirrored_repeat, Wrap::clamp_to_edge}, 2, first)) {
      for (const Lobe& lobe : sweep(std::array{medium, tailed}, 1, first)) {
        EXPECT_LT(error_of_lobes(normals, footprints, wrap, lobe), wrap == Wrap::clamp_to_edge ? 0.03 : 0.055)
            << static_cast<int>(kind) << ", wrap " << static_cast<int>(wrap) << ", " << lobe_text(lobe);
      }
    }
  }
}

// ---- pictures ----

// The picture under so many lights, all of them the same, over their number.
Image picture(const Scene& scene, std::size_t lights, const Method& method, const std::string& text) {
  Scene many = scene;
  many.lights.resize(lights, scene.lights[0]);
  Image image = TestRenderer(many, {8, 8}).frame(method, text);
  for (float& value : image.texels) value /= static_cast<float>(lights);
  return image;
}

Scene lit_square(Kind kind, NormalDistribution distribution) {
  const BaseBrdf brdf{distribution, GeometryTerm::smith, FresnelTerm::none, false};
  return square_scene(map_of(kind, 1024), {.brdf = brdf, .roughness = 0.3F});
}

struct LightCount {
  std::size_t lights;
  double error, energy;  // README
};
constexpr std::array<LightCount, 5> light_counts{
    {{1, 0.045, 0.01}, {16, 0.045, 0.02}, {48, 0.1, 0.03}, {192, 0.22, 0.04}, {600, 0.4, 0.07}}};

// Pixels of 128 x 128 texels, each light with a 65535th part of fewer rounds (README): none is left out.
TEST(AtanasovBounded, ManyLightsAreAsOne) {
  for (const Kind kind : kinds) {
    for (const NormalDistribution distribution :
         sweep(std::array{NormalDistribution::beckmann, NormalDistribution::ggx}, 1, static_cast<std::size_t>(kind))) {
      const Scene scene = lit_square(kind, distribution);
      const Image exact = picture(scene, 1, exact_method(), "exact:kernel=areas:texels=256");
      const std::size_t first = static_cast<std::size_t>(kind) + (distribution == NormalDistribution::ggx ? 2 : 0);
      for (const auto& [lights, error, energy] : sweep(light_counts, 2, first)) {
        const auto found = compare_images(picture(scene, lights, atanasov_bins_method(), "atanasov_bins"), exact, 1.0F);
        EXPECT_LT(found.value().relative_rmse, error) << static_cast<int>(kind) << ", " << lights;
        EXPECT_LT(std::abs(found.value().energy_bias), energy) << static_cast<int>(kind) << ", " << lights;
      }
    }
  }
}

TEST(AtanasovBounded, ManyLightsAreAsOneInEveryMode) {
  const Scene scene = lit_square(Kind::flakes, NormalDistribution::beckmann);
  const std::array<std::pair<std::string, double>, 5> modes{{{"atanasov_bins:roughness=bin", 1e-5},
                                                             {"atanasov_bins:roughness=flakes", 0.25},
                                                             {"atanasov_bins:border=texels", 0.1},
                                                             {"atanasov_bins:footprint=box", 0.09},
                                                             {"atanasov_bins:footprint=filter", 0.22}}};
  for (const auto& [text, error] : sweep(modes, 3)) {
    const Image one = picture(scene, 1, atanasov_bins_method(), text);
    const Image many = picture(scene, 48, atanasov_bins_method(), text);
    EXPECT_LT(compare_images(many, one, 1.0F).value().relative_rmse, error) << text;
  }
}

}  // namespace
}  // namespace footprint::testing
