// Values, integrals and convolutions in closed form, and the fits of lobes to a density and to a tabulated BRDF.
#include "methods/iwasaki_sg/spherical_gaussian.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <span>

#include "methods/iwasaki_sg/lobe_fit.hpp"
#include "renderer/lobes/lobe.hpp"

namespace footprint::iwasaki_sg {
namespace {

using std::numbers::pi;

constexpr int candidates = most_lobes;  // candidate sharpnesses of a lobe
constexpr int nodes = 400;              // of the integrals over u
constexpr double widest = 0.5;          // sharpness of the widest candidate
constexpr double sharper =
    12.0;  // the sharpest candidate's over 1 / width: GGX is a mixture of exponentials up to there

// tan^2 at u = 1 - cos.
double tangent_squared(double u) {
  const double c = 1.0 - u;
  return u * (2.0 - u) / (c * c);
}

std::vector<BrdfLobe> without_empty(std::vector<BrdfLobe> lobes) {
  std::erase_if(lobes, [](const BrdfLobe& lobe) { return !(lobe.amplitude > 0.0); });
  return lobes;
}

constexpr std::size_t h_cells = TabulatedBrdf::theta_h_cells, d_cells = TabulatedBrdf::theta_d_cells;

// The mean over all phi_d of each cell of theta_h and theta_d, [theta_h][theta_d]; below 0 if the table has no value
// because it was not measured or is below the horizon.
std::vector<glm::dvec3> means_over_phi(const TabulatedBrdf& brdf) {
  constexpr std::size_t p_cells = TabulatedBrdf::phi_d_cells;
  std::vector<glm::dvec3> means;
  for (std::size_t cell = 0; cell < h_cells * d_cells; ++cell) {
    glm::dvec3 sum(0.0);
    int count = 0;
    for (std::size_t p = 0; p < p_cells; ++p) {
      const glm::vec3& value = brdf.values[cell * p_cells + p];
      if (value == glm::vec3(0.0F)) continue;
      sum += glm::dvec3(value);
      ++count;
    }
    means.push_back(count > 0 ? sum / static_cast<double>(count) : glm::dvec3(-1.0));
  }
  return means;
}

// The mean over theta_d up to 45 degrees of each cell of theta_h. The last cells, which have values only below the
// horizon, repeat the one before them.
std::vector<glm::dvec3> half_angle_profile(std::span<const glm::dvec3> means) {
  std::vector<glm::dvec3> profile;
  for (std::size_t h = 0; h < h_cells; ++h) {
    glm::dvec3 sum(0.0);
    int count = 0;
    for (std::size_t d = 0; d < d_cells / 2; ++d) {
      const glm::dvec3& mean = means[h * d_cells + d];
      if (mean.x < 0.0) continue;
      sum += mean;
      ++count;
    }
    profile.push_back(count > 0 ? sum / static_cast<double>(count) : (h > 0 ? profile.back() : glm::dvec3(0.0)));
  }
  return profile;
}

glm::dvec3 lobe_sum(std::span<const ColorLobe> lobes, double u) {
  glm::dvec3 sum(0.0);
  for (const ColorLobe& lobe : lobes) sum += glm::dvec3(lobe.amplitude) * std::exp(-lobe.sharpness * u);
  return sum;
}

// The best factor on the lobes for each cell of theta_d, over the solid angle of half vectors. Cells without values and
// channels without lobes repeat the cell before them.
std::vector<glm::vec3> rise_of(std::span<const glm::dvec3> means, const TabulatedLobes& fitted) {
  std::vector<glm::vec3> rise;
  for (std::size_t d = 0; d < d_cells; ++d) {
    glm::dvec3 products(0.0), squares(0.0);
    for (std::size_t h = 0; h < h_cells; ++h) {
      const glm::dvec3& mean = means[h * d_cells + d];
      if (mean.x < 0.0) continue;
      const double theta = tabulated_angles(static_cast<int>(h), 0, 0).x;
      const double solid_angle = std::sin(theta) * std::sqrt(theta);  // cells are evenly spaced in the root of theta
      const glm::dvec3 own = lobe_sum(fitted.lobes, 1.0 - std::cos(theta));
      products += solid_angle * own * (mean - glm::dvec3(fitted.diffuse));
      squares += solid_angle * own * own;
    }
    glm::vec3 factor = rise.empty() ? glm::vec3(1.0F) : rise.back();
    for (int c = 0; c < 3; ++c) {
      if (squares[c] > 0.0) factor[c] = static_cast<float>(std::max(products[c] / squares[c], 0.0));
    }
    rise.push_back(factor);
  }
  return rise;
}

}  // namespace

using std::numbers::pi;

double value(const SphericalGaussian& lobe, const glm::dvec3& direction) {
  return std::exp(-lobe.sharpness * one_minus_dot(lobe.axis, direction));
}

double convolution(const SphericalGaussian& a, const SphericalGaussian& b) {
  const double sum = a.sharpness + b.sharpness;
  const double z = glm::length(a.sharpness * a.axis + b.sharpness * b.axis);
  // The limit of sinh(z) / z at 0.
  if (z < 1e-4) return 4.0 * pi * std::exp(-sum) * (1.0 + z * z / 6.0);
  // z - sum without cancellation: z^2 = sum^2 - 2 eta1 eta2 (1 - cos).
  const double fall = -2.0 * a.sharpness * b.sharpness * one_minus_dot(a.axis, b.axis) / (z + sum);
  return -2.0 * pi * std::exp(fall) * std::expm1(-2.0 * z) / z;
}

double approximate_convolution(const SphericalGaussian& a, const SphericalGaussian& b) {
  const double sum = a.sharpness + b.sharpness;
  return 2.0 * pi / sum * std::exp(-a.sharpness * b.sharpness / sum * one_minus_dot(a.axis, b.axis));
}

std::vector<BrdfLobe> fit_lobes(const std::function<double(double)>& value_at, double width) {
  const double most = std::max(sharper / width, 4.0 * widest);
  std::vector<double> sharpness(candidates);
  for (int i = 0; i < candidates; ++i) {
    sharpness[static_cast<std::size_t>(i)] = most * std::pow(widest / most, i / (candidates - 1.0));
  }
  // Nodes u = w^3, because the core is narrow. Solid angle is 2 pi du. Each candidate has unit norm.
  LobeMatrix a = LobeMatrix::Zero(candidates, candidates);
  LobeVector b = LobeVector::Zero(candidates);
  for (int k = 0; k < nodes; ++k) {
    const double w = (k + 0.5) / nodes;
    const double u = w * w * w, du = 3.0 * w * w / nodes;
    LobeVector row(candidates);
    for (int i = 0; i < candidates; ++i) {
      const double eta = sharpness[static_cast<std::size_t>(i)];
      row[i] = std::exp(-eta * u) * std::sqrt(2.0 * eta);
    }
    a += du * row * row.transpose();
    b += du * value_at(u) * row;
  }
  a += 1e-10 * LobeMatrix::Identity(candidates, candidates);
  const LobeVector x = solve_non_negative(a, b);
  std::vector<BrdfLobe> lobes;
  for (int i = 0; i < candidates; ++i) {
    const double eta = sharpness[static_cast<std::size_t>(i)];
    lobes.push_back({eta, x[i] > 1e-9 * x.maxCoeff() ? x[i] * std::sqrt(2.0 * eta) : 0.0});
  }
  return lobes;
}

std::vector<BrdfLobe> lobes_of(const Lobe& lobe) {
  const double p = lobe.parameter, p2 = p * p;
  switch (lobe.distribution) {
    case NormalDistribution::blinn_phong:
      return {{p + 1.0, (p + 1.0) / (2.0 * pi)}};
    case NormalDistribution::vmf:
      return {{p, 1.0 / vmf_integral(p)}};
    case NormalDistribution::beckmann:
      return without_empty(fit_lobes(
          [p2](double u) {
            const double c2 = (1.0 - u) * (1.0 - u);
            return c2 < 1e-6 ? 0.0 : std::exp(-tangent_squared(u) / p2) / (pi * p2 * c2 * c2);
          },
          p2));
    case NormalDistribution::ggx:
      break;
  }
  return without_empty(fit_lobes(
      [p2](double u) {
        const double d = p2 * (1.0 - u) * (1.0 - u) + u * (2.0 - u);
        return p2 / (pi * d * d);
      },
      p2));
}

TabulatedLobes lobes_of(const TabulatedBrdf& brdf) {
  const std::vector<glm::dvec3> means = means_over_phi(brdf);
  const std::vector<glm::dvec3> profile = half_angle_profile(means);
  glm::dvec3 diffuse = profile.front();
  for (const glm::dvec3& value : profile) diffuse = glm::min(diffuse, value);
  const auto at = [&](double u) {
    const double root = std::sqrt(std::acos(std::clamp(1.0 - u, 0.0, 1.0)) / (0.5 * pi));
    const double position =
        std::clamp(root * TabulatedBrdf::theta_h_cells - 0.5, 0.0, static_cast<double>(profile.size() - 1));
    const auto low = std::min(static_cast<std::size_t>(position), profile.size() - 2);
    return glm::mix(profile[low], profile[low + 1], position - static_cast<double>(low)) - diffuse;
  };
  // The width of the core: where the sum of the channels has fallen to 1/e.
  const auto gray = [&](double u) { return at(u).x + at(u).y + at(u).z; };
  double width = 1e-6;
  while (width < 0.5 && gray(width) > gray(0.0) / std::numbers::e) width *= 1.1;
  TabulatedLobes out;
  out.diffuse = glm::vec3(diffuse);
  for (int c = 0; c < 3; ++c) {
    const std::vector<BrdfLobe> fitted = fit_lobes([&](double u) { return at(u)[c]; }, width);
    out.lobes.resize(fitted.size(), {0.0, glm::vec3(0.0F)});
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      out.lobes[i].sharpness = fitted[i].sharpness;
      out.lobes[i].amplitude[c] = static_cast<float>(fitted[i].amplitude);
    }
  }
  std::erase_if(out.lobes, [](const ColorLobe& lobe) { return lobe.amplitude == glm::vec3(0.0F); });
  out.rise = rise_of(means, out);
  return out;
}

glm::dvec3 rise_at(const TabulatedLobes& lobes, double theta_d) {
  const double last = static_cast<double>(lobes.rise.size()) - 1.0;
  const double position = std::clamp(theta_d / (0.5 * pi) * (last + 1.0) - 0.5, 0.0, last);
  const auto low = std::min(static_cast<std::size_t>(position), lobes.rise.size() - 2);
  return glm::mix(glm::dvec3(lobes.rise[low]), glm::dvec3(lobes.rise[low + 1]), position - static_cast<double>(low));
}

double value(const std::vector<BrdfLobe>& lobes, double u) {
  double sum = 0.0;
  for (const BrdfLobe& lobe : lobes) sum += lobe.amplitude * std::exp(-lobe.sharpness * u);
  return sum;
}

}  // namespace footprint::iwasaki_sg
