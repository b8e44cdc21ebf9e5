// Guards against the faults of naive forms, each removed in turn: its check passes with the project's own
// function, and fails with a twin here without the guard. The list is printed, with both figures:
//   build/release/tests/properties/footprint_guards_test
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/glm.hpp>
#include <glm/gtc/packing.hpp>
#include <limits>
#include <memory>
#include <numbers>
#include <string_view>
#include <vector>

#include "methods/iwasaki_sg/spherical_gaussian.hpp"
#include "methods/tan_gmm/em.hpp"
#include "renderer/bake/material_maps.hpp"
#include "renderer/bake/slope_moments.hpp"
#include "renderer/image/mipmap.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::testing {
namespace {

using iwasaki_sg::SphericalGaussian;
using std::numbers::pi;

constexpr double infinite = std::numeric_limits<double>::infinity();

// The relative difference of `found` from `expected`; infinite for NaN.
double off(double found, double expected) {
  const double error = std::abs(found - expected) / std::abs(expected);
  return std::isnan(error) ? infinite : error;
}

using Convolution = std::function<double(const SphericalGaussian&, const SphericalGaussian&)>;

// 1 to 3: products of spherical Gaussians.
double convolution_by_sinh(const SphericalGaussian& a, const SphericalGaussian& b) {
  const double z = glm::length(a.sharpness * a.axis + b.sharpness * b.axis);
  return 4.0 * pi * std::exp(-a.sharpness - b.sharpness) * std::sinh(z) / z;
}

double convolution_without_series(const SphericalGaussian& a, const SphericalGaussian& b) {
  const double sum = a.sharpness + b.sharpness, z = glm::length(a.sharpness * a.axis + b.sharpness * b.axis);
  return -2.0 * pi * std::exp(z - sum) * std::expm1(-2.0 * z) / z;
}

double off_where_sharp(const Convolution& convolution) {
  const SphericalGaussian one{{0, 0, 1}, 100}, other{{0, 0, 1}, 1000};
  return off(convolution(one, other), 2.0 * pi / 1100.0);
}

double off_where_opposite(const Convolution& convolution) {
  return off(convolution({{0, 0, 1}, 1}, {{0, 0, -1}, 1}), 4.0 * pi * std::exp(-2.0));
}

// One Gaussian in the angle (Iwasaki 2012, equation 14) is exact to 1e-20 there.
double off_where_very_sharp(const Convolution& convolution) {
  const double angle = 1.2345e-5;
  const SphericalGaussian one{{0, 0, 1}, 1e10}, other{{std::sin(angle), 0, std::cos(angle)}, 1e10};
  return off(convolution(one, other), approximate_convolution(one, other));
}

// 4: a lobe as wide as the sphere.
double vmf_peak_by_quotient(double kappa) { return kappa / (2.0 * pi * (1.0 - std::exp(-2.0 * kappa))); }
double off_where_flat(const std::function<double(double)>& peak) { return off(peak(0.0), 1.0 / (4.0 * pi)); }

// 5: the value of a narrow lobe two widths from its axis, in the 32 bits of shaders.
using Value = std::function<double(const glm::vec3& axis, const glm::vec3& h, double kappa)>;
double value_by_difference(const glm::vec3& axis, const glm::vec3& h, double kappa) {
  const glm::vec3 d = h - axis;
  return lobe_shape({NormalDistribution::vmf, kappa}, 0.5F * glm::dot(d, d));
}
double value_by_dot(const glm::vec3& axis, const glm::vec3& h, double kappa) {
  return std::exp(static_cast<float>(kappa) * (glm::dot(axis, h) - 1.0F));
}
double off_where_narrow(const Value& value) {
  double worst = 0.0;
  for (int i = 0; i < 100; ++i) {
    const double tilt = 0.01 * i, angle = 0.002;
    const glm::vec3 axis(std::sin(tilt), 0.0, std::cos(tilt)), h(std::sin(tilt + angle), 0.0, std::cos(tilt + angle));
    const glm::dvec3 d = glm::dvec3(h) - glm::dvec3(axis);
    worst = std::max(worst, off(value(axis, h, 1e6), std::exp(-1e6 * 0.5 * glm::dot(d, d))));
  }
  return worst;
}

// 7 and 8: concentration and length of the mean vector.
double shortfall_by_arc_cosine(double kappa) {
  const auto k = static_cast<float>(kappa);  // r^3 - k r^2 - 3 r + k = 0, the root between 0 and 1
  const float p = -3.0F - k * k / 3.0F, q = -2.0F * k * k * k / 27.0F;
  const float angle = std::acos(std::clamp(1.5F * q / p * std::sqrt(-3.0F / p), -1.0F, 1.0F)) / 3.0F;
  const float third = 2.0F * static_cast<float>(pi) / 3.0F;
  return 1.0F - (2.0F * std::sqrt(-p / 3.0F) * std::cos(angle - third) + k / 3.0F);
}
double kappa_by_length(double q) {
  const float r = 1.0F - static_cast<float>(q);
  return (3.0F * r - r * r * r) / (1.0F - r * r);
}
double off_through_shortfall(const std::function<double(double)>& shortfall) {
  return off(vmf_kappa_of_shortfall(shortfall(1e4)), 1e4);
}
double off_at_a_kappa(const std::function<double(double)>& kappa) { return off(kappa(vmf_shortfall(1e6)), 1e6); }

// 13: equal slopes in half floats, whose moments round to a spread that no slopes have.
double negative_eigenvalue(const std::function<glm::dmat2(const SlopeMoments&)>& covariance_of) {
  double least = 0.0;
  for (int i = 1; i < 200; ++i) {
    const auto half = [](double x) {
      return static_cast<double>(glm::unpackHalf1x16(glm::packHalf1x16(static_cast<float>(x))));
    };
    const glm::dvec2 b(0.013 * i, 0.007 * i);
    const SlopeMoments m{{half(b.x), half(b.y)}, {half(b.x * b.x), half(b.x * b.y), half(b.x * b.y), half(b.y * b.y)}};
    const glm::dmat2 c = covariance_of(m);
    least = std::min(least, 0.5 * (c[0][0] + c[1][1]) - std::hypot(0.5 * (c[0][0] - c[1][1]), c[0][1]));
  }
  return -least;
}
glm::dmat2 plain_covariance(const SlopeMoments& m) { return m.second - glm::outerProduct(m.mean, m.mean); }

// 14: four equal normals, onto which a Gaussian shrinks.
using Maximise = std::function<void(const tan_gmm::Expectation&, tan_gmm::Gaussian&)>;
double infinite_likelihood(const Maximise& maximise) {
  tan_gmm::Samples samples;
  for (int i = 0; i < 4; ++i) samples.add(0.25F, 0.5F, 0.0F, 1.0F);
  std::vector<tan_gmm::Gaussian> mixture{{.alpha = 1.0F, .x = 0.25F, .y = 0.5F, .variance = 0.1F}};
  maximise(tan_gmm::expectation(samples, mixture), mixture.front());
  return std::isfinite(tan_gmm::expectation(samples, mixture).log_likelihood) ? 0.0 : infinite;
}
void floored(const tan_gmm::Expectation& e, tan_gmm::Gaussian& g) {
  tan_gmm::maximise(e, tan_gmm::Prior(0.0), tan_gmm::MStep::exact, {&g, 1});
}
void unfloored(const tan_gmm::Expectation& e, tan_gmm::Gaussian& g) {
  g.variance = static_cast<float>(e.moments[0].scatter / (2.0 * e.moments[0].weight));
}

// 15: a sample a thousand deviations from every Gaussian.
using Responsibilities = std::function<double(const tan_gmm::Samples&, const std::vector<tan_gmm::Gaussian>&)>;
double lost_sample(const Responsibilities& sum_of) {
  tan_gmm::Samples samples;
  samples.add(0.9F, 0.0F, 0.0F, 1.0F);
  const tan_gmm::Gaussian far{.alpha = 0.5F, .x = -0.1F, .y = 0.0F, .variance = 1e-6F};
  return off(sum_of(samples, {far, far}), 1.0);
}
double by_log_sum_exp(const tan_gmm::Samples& samples, const std::vector<tan_gmm::Gaussian>& mixture) {
  const tan_gmm::Expectation e = tan_gmm::expectation(samples, mixture);
  return e.moments[0].weight + e.moments[1].weight;
}
double by_quotients(const tan_gmm::Samples& samples, const std::vector<tan_gmm::Gaussian>& mixture) {
  double all = 0.0, shares = 0.0;
  std::vector<double> values;
  for (const tan_gmm::Gaussian& g : mixture) {
    const double x = samples.x[0] - g.x, y = samples.y[0] - g.y;
    values.push_back(g.alpha * std::exp(-(x * x + y * y) / (2.0 * g.variance)) / (2.0 * pi * g.variance));
    all += values.back();
  }
  for (const double value : values) shares += value / all;
  return shares;
}

// 25 and 27: maps with a texel that has no normal, and of sizes that are no power of two.
using Chain = std::function<std::vector<Image>(const Image&)>;
double off_beside_an_invalid_texel(const Chain& chain) {
  Image map(4, 4, 4, 0.0F);
  for (std::size_t i = 1; i < 16; ++i) {
    map.texels[4 * i] = 0.6F;
    map.texels[4 * i + 2] = 0.8F;
    map.texels[4 * i + 3] = 1.0F;
  }
  return off(chain(map).back().texels[0], 0.6F);
}
double off_at_an_odd_size(const Chain& chain) {
  Image ramp(457, 1, 1);
  for (int x = 0; x < 457; ++x) ramp.at(x, 0)[0] = static_cast<float>(x);
  return off(chain(ramp).back().texels[0], 228.0);
}
std::vector<Image> chain_of_pairs(const Image& finest) {
  std::vector<Image> chain{finest};
  while (chain.back().width > 1) {
    const Image& fine = chain.back();
    Image coarse(fine.width / 2, 1, 1);
    for (int x = 0; x < coarse.width; ++x)
      coarse.at(x, 0)[0] = 0.5F * (fine.at(2 * x, 0)[0] + fine.at(2 * x + 1, 0)[0]);
    chain.push_back(std::move(coarse));
  }
  return chain;
}

// 28: a texel at the horizon.
double no_slope_at_the_horizon(const std::function<glm::dvec2(const glm::dvec3&)>& slope) {
  return std::isfinite(glm::length(slope({1.0, 0.0, 0.0}))) ? 0.0 : infinite;
}

// A clear coat that is a mirror, and one whose map has a texel without a normal.
Material coated(float roughness, const glm::vec4& texel) {
  Image normals(1, 1, 4);
  for (int c = 0; c < 4; ++c) normals.texels[static_cast<std::size_t>(c)] = texel[c];
  Material material;
  material.coat = ClearCoat{};
  material.coat->roughness = roughness;
  material.coat->normal_map = TextureMap{"normals", std::make_shared<const Image>(std::move(normals)), {}};
  return material;
}
using TexelsOf = std::function<Image(const Material&)>;
// GGX's peak, alpha^2 / (pi alpha^4).
double off_at_a_mirrors_peak(const TexelsOf& widths) {
  const double alpha2 = widths(coated(0.0F, {0, 0, 1, 1})).texels.front();
  return off(alpha2 / (pi * alpha2 * alpha2), 1e6 / pi);
}
Image plain_widths(const Material& material) {
  return Image(1, 1, 1, std::pow(material.coat.value_or(ClearCoat{}).roughness, 4.0F));
}
double off_without_a_normal(const TexelsOf& normals) { return off(normals(coated(0.0F, {0, 0, 0, 0})).texels[2], 1.0); }
Image plain_normals(const Material& material) {
  return material.coat.value_or(ClearCoat{}).normal_map.value_or(TextureMap{}).image.decoded();
}

struct Guard {
  std::string_view hard_case, guard;
  double bound, with, without;  // of the figure; what it is with the project's function and with the guard left out
};

std::vector<Guard> guards() {
  const Convolution real = iwasaki_sg::convolution;
  return {
      {"sinh overflows", "product of Gaussians by exponents below 0", 2e-6, off_where_sharp(real),
       off_where_sharp(convolution_by_sinh)},
      {"opposite Gaussians, 0 / 0", "series about 0", 1e-6, off_where_opposite(real),
       off_where_opposite(convolution_without_series)},
      {"|z| - S cancels", "difference from that of the axes", 1e-7, off_where_very_sharp(real),
       off_where_very_sharp(convolution_without_series)},
      {"kappa 0, 0 / 0", "series about 0", 1e-6, off_where_flat(vmf_peak), off_where_flat(vmf_peak_by_quotient)},
      {"n.h of a narrow lobe in 32 bits", "|h - n|^2 / 2", 1e-4, off_where_narrow(value_by_difference),
       off_where_narrow(value_by_dot)},
      {"cubic root in 32 bits", "Newton's steps in 1 - r", 1e-6, off_through_shortfall(vmf_shortfall),
       off_through_shortfall(shortfall_by_arc_cosine)},
      {"r near 1 in 32 bits", "1 - r is stored", 1e-6, off_at_a_kappa(vmf_kappa_of_shortfall),
       off_at_a_kappa(kappa_by_length)},
      {"M - B B^T of equal slopes", "nearest matrix without a negative eigenvalue", 1e-12,
       negative_eigenvalue(covariance), negative_eigenvalue(plain_covariance)},
      {"a Gaussian shrinks onto one normal", "floor of the variance", 0.0, infinite_likelihood(floored),
       infinite_likelihood(unfloored)},
      {"all densities underflow, 0 / 0", "log-sum-exp", 1e-6, lost_sample(by_log_sum_exp), lost_sample(by_quotients)},
      {"a texel without a normal", "weight 0", 1e-5, off_beside_an_invalid_texel(weighted_mip_chain),
       off_beside_an_invalid_texel(mip_chain)},
      {"odd sizes lose a row", "shares of three texels", 1e-6, off_at_an_odd_size(mip_chain),
       off_at_an_odd_size(chain_of_pairs)},
      {"slope at the horizon", "steepest slope", 0.0,
       no_slope_at_the_horizon([](const glm::dvec3& n) { return slope_of(n); }),
       no_slope_at_the_horizon([](const glm::dvec3& n) { return -glm::dvec2(n) / n.z; })},
      {"a coat of roughness 0, 0 / 0", "alpha of at least 1e-3", 1e-5, off_at_a_mirrors_peak(coat_width_map_of),
       off_at_a_mirrors_peak(plain_widths)},
      {"a coat's texel without a normal", "the surface's own", 0.0, off_without_a_normal(coat_normal_map_of),
       off_without_a_normal(plain_normals)},
  };
}

TEST(Guards, EachPassesAndFailsWithoutIt) {
  fmt::print("{:34} {:46} {:>8} {:>10} {:>10}\n", "hard case", "guard", "bound", "with it", "without");
  for (const Guard& guard : guards()) {
    fmt::print("{:34} {:46} {:8.0e} {:10.2g} {:10.2g}\n", guard.hard_case, guard.guard, guard.bound, guard.with,
               guard.without);
    EXPECT_LE(guard.with, guard.bound) << guard.hard_case;
    EXPECT_GT(guard.without, guard.bound)
        << guard.hard_case << ": nothing falls where " << guard.guard << " is taken out";
  }
}

}  // namespace
}  // namespace footprint::testing
