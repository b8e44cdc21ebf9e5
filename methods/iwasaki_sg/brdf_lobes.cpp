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
    if (x[i] > 1e-9 * x.maxCoeff()) lobes.push_back({eta, x[i] * std::sqrt(2.0 * eta)});
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
      return fit_lobes(
          [p2](double u) {
            const double c2 = (1.0 - u) * (1.0 - u);
            return c2 < 1e-6 ? 0.0 : std::exp(-tangent_squared(u) / p2) / (pi * p2 * c2 * c2);
          },
          p2);
    case NormalDistribution::ggx:
      break;
  }
  return fit_lobes(
      [p2](double u) {
        const double d = p2 * (1.0 - u) * (1.0 - u) + u * (2.0 - u);
        return p2 / (pi * d * d);
      },
      p2);
}

std::vector<BrdfLobe> ward_lobes(double alpha) {
  const double a2 = alpha * alpha;
  return fit_lobes([a2](double u) { return u >= 1.0 ? 0.0 : std::exp(-tangent_squared(u) / a2) / (4.0 * pi * a2); },
                   a2);
}

double value(const std::vector<BrdfLobe>& lobes, double u) {
  double sum = 0.0;
  for (const BrdfLobe& lobe : lobes) sum += lobe.amplitude * std::exp(-lobe.sharpness * u);
  return sum;
}

}  // namespace footprint::iwasaki_sg
