// See brdf_lobes.hpp.
#include "methods/iwasaki_sg/brdf_lobes.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "methods/iwasaki_sg/amplitudes.hpp"
#include "methods/iwasaki_sg/spherical_gaussian.hpp"

namespace footprint::iwasaki_sg {
namespace {

using std::numbers::pi;

constexpr int candidates = most_lobes;  // sharpnesses that share a lobe between them
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

// The mean over theta_d up to 45 degrees and all phi_d, of each cell of theta_h; the last that have values only below
// the horizon take what comes before them.
std::vector<glm::dvec3> half_angle_profile(const TabulatedBrdf& brdf) {
  std::vector<glm::dvec3> profile;
  constexpr int d_cells = TabulatedBrdf::theta_d_cells, p_cells = TabulatedBrdf::phi_d_cells;
  for (int h = 0; h < TabulatedBrdf::theta_h_cells; ++h) {
    glm::dvec3 sum(0.0);
    int count = 0;
    for (int d = 0; d < d_cells / 2; ++d) {
      for (int p = 0; p < p_cells; ++p) {
        const glm::vec3& value = brdf.values[static_cast<std::size_t>((h * d_cells + d) * p_cells + p)];
        if (value == glm::vec3(0.0F)) continue;  // not measured, or below the horizon
        sum += glm::dvec3(value);
        ++count;
      }
    }
    profile.push_back(count > 0 ? sum / static_cast<double>(count) : (h > 0 ? profile.back() : glm::dvec3(0.0)));
  }
  return profile;
}

}  // namespace

std::vector<BrdfLobe> fit_lobes(const std::function<double(double)>& value_at, double width) {
  const double most = std::max(sharper / width, 4.0 * widest);
  std::vector<double> sharpness(candidates);
  for (int i = 0; i < candidates; ++i) {
    sharpness[static_cast<std::size_t>(i)] = most * std::pow(widest / most, i / (candidates - 1.0));
  }
  // Nodes u = w^3: the core is narrow. Solid angle is 2 pi du. Each candidate is taken with unit norm.
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

std::vector<BrdfLobe> lobes_of(NormalDistribution distribution, double parameter) {
  const double p = parameter, p2 = p * p;
  switch (distribution) {
    case NormalDistribution::blinn_phong:
      return {{p + 1.0, (p + 1.0) / (2.0 * pi)}};
    case NormalDistribution::vmf:
      return {{p, 1.0 / integral(p)}};
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

std::vector<ColorLobe> lobes_of(const TabulatedBrdf& brdf) {
  const std::vector<glm::dvec3> profile = half_angle_profile(brdf);
  glm::dvec3 diffuse = profile.front();
  for (const glm::dvec3& value : profile) diffuse = glm::min(diffuse, value);
  const auto at = [&](double u) {
    const double root = std::sqrt(std::acos(std::clamp(1.0 - u, 0.0, 1.0)) / (0.5 * pi));
    const double place =
        std::clamp(root * TabulatedBrdf::theta_h_cells - 0.5, 0.0, static_cast<double>(profile.size() - 1));
    const auto low = std::min(static_cast<std::size_t>(place), profile.size() - 2);
    return glm::mix(profile[low], profile[low + 1], place - static_cast<double>(low)) - diffuse;
  };
  // The core's width: where the sum of the channels has fallen to 1/e.
  const auto gray = [&](double u) { return at(u).x + at(u).y + at(u).z; };
  double width = 1e-6;
  while (width < 0.5 && gray(width) > gray(0.0) / std::numbers::e) width *= 1.1;
  std::vector<ColorLobe> lobes{{0.0, glm::vec3(diffuse)}};
  for (int c = 0; c < 3; ++c) {
    const std::vector<BrdfLobe> fitted = fit_lobes([&](double u) { return at(u)[c]; }, width);
    lobes.resize(1 + fitted.size(), {0.0, glm::vec3(0.0F)});
    for (std::size_t i = 0; i < fitted.size(); ++i) {
      lobes[1 + i].sharpness = fitted[i].sharpness;
      lobes[1 + i].amplitude[c] = static_cast<float>(fitted[i].amplitude);
    }
  }
  std::erase_if(lobes, [](const ColorLobe& lobe) { return lobe.sharpness > 0.0 && lobe.amplitude == glm::vec3(0.0F); });
  return lobes;
}

double value(const std::vector<BrdfLobe>& lobes, double u) {
  double sum = 0.0;
  for (const BrdfLobe& lobe : lobes) sum += lobe.amplitude * std::exp(-lobe.sharpness * u);
  return sum;
}

}  // namespace footprint::iwasaki_sg
