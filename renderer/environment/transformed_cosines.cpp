// Weighted least squares over drawn directions, minimised by the downhill simplex of Nelder and Mead (1965).
#include "renderer/environment/transformed_cosines.hpp"

#include <tbb/parallel_for.h>

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <glm/glm.hpp>
#include <numbers>

#include "renderer/environment/radiance_stack.hpp"

namespace footprint {
namespace {

using std::numbers::pi;

constexpr int view_columns = 40, width_rows = 32;
constexpr double widest_angle = 2.0 * pi / 3.0;
// Rings and sectors of the directions that are drawn, over half of the azimuths: the other half is their mirror image.
constexpr int fit_rings = 12, fit_sectors = 12;        // of the fit
constexpr int energy_rings = 96, energy_sectors = 48;  // of the energies
constexpr double stiffness = 0.02;                     // of the turn: in narrow lobes it and the shear are one
constexpr double least_energy = 1e-9;                  // below it nothing is fitted
constexpr int most_steps = 240;                        // of the simplex
constexpr double wide = 3.0;  // half of the directions are drawn from a lobe so much wider, for the tail

double ggx(double alpha2, double cosine) {
  const double rest = alpha2 * cosine * cosine + 1.0 - cosine * cosine;
  return cosine > 0.0 ? alpha2 / (pi * rest * rest) : 0.0;
}

// The integral of D (h.n).
double projected_area(const Lobe& lobe) {
  if (lobe.distribution == NormalDistribution::blinn_phong) return (lobe.parameter + 1.0) / (lobe.parameter + 2.0);
  if (lobe.distribution != NormalDistribution::vmf) return 1.0;
  return 1.0 / std::tanh(lobe.parameter) - 1.0 / lobe.parameter;
}

double beckmann_lambda(double alpha, double cosine) {
  const double a = cosine / (alpha * std::sqrt(std::max(1.0 - cosine * cosine, 1e-30)));
  return a < 1.6 ? (1.0 - 1.259 * a + 0.396 * a * a) / (3.535 * a + 2.181 * a * a) : 0.0;
}

double geometry_factor(const ReflectedLobeKind& kind, double alpha, const glm::dvec3& h, const glm::dvec3& wi,
                       const glm::dvec3& wo) {
  const double nl = wi.z, nv = std::max(wo.z, 1e-4);
  switch (kind.geometry) {
    case GeometryTerm::none:
      return 1.0;
    case GeometryTerm::tan:
      return tan_factor(h.z, glm::dot(wo, h), wo.z);
    case GeometryTerm::smith:
      if (kind.masked_as_ggx) return smith_factor(alpha * alpha, nl, wo.z);
      return 0.25 / ((1.0 + beckmann_lambda(alpha, nv) + beckmann_lambda(alpha, nl)) * nv);
    case GeometryTerm::ward:
      return nl / std::max(glm::dot(wi + wo, wi + wo), 1e-8);
  }
  return 1.0;
}

// A direction of light with what the lobe reflects from there, over the density of drawing it.
struct Drawn {
  glm::dvec3 wi;
  double value, weight;  // reflected, and 1 over density and number
  double schlick;
};

struct MirroredView {
  glm::dvec3 wo;
  double alpha, area;
  glm::dvec3 stretched;
  MirroredView(double angle, double width)
      : wo(-std::sin(angle), 0.0, std::cos(angle)),
        alpha(width),
        area(visible_area(wo.z, width * width)),
        stretched(glm::normalize(glm::dvec3(width * wo.x, 0.0, wo.z))) {}

  // Over solid angle of the reflected direction.
  [[nodiscard]] double density(const glm::dvec3& h) const { return ggx(alpha * alpha, h.z) / (4.0 * area); }
};

// The light that a lobe reflects from `across` x `around` directions drawn from each of `views`, which mirror a view in
// normals of GGX.
std::vector<Drawn> draws(const ReflectedLobeKind& kind, double alpha, const std::vector<MirroredView>& views,
                         int across, int around) {
  const Lobe lobe = lobe_from_alpha(kind.distribution, static_cast<float>(alpha));
  const glm::dvec3 wo = views.front().wo;
  std::vector<Drawn> drawn;
  for (const MirroredView& view : views) {
    for (int i = 0; i < across * around; ++i) {
      const glm::dvec3 h =
          visible_normal(view.stretched, view.alpha, (i / around + 0.5) / across, pi * (i % around + 0.5) / around);
      const double oh = glm::dot(h, wo);
      const glm::dvec3 wi = 2.0 * oh * h - wo;
      if (oh <= 0.0 || wi.z <= 0.0) continue;
      double density = 0.0;
      for (const MirroredView& each : views) density += each.density(h);
      const double u = 0.5 * (h.x * h.x + h.y * h.y + (1.0 - h.z) * (1.0 - h.z));
      drawn.push_back({.wi = wi,
                       .value = lobe_density(lobe, u) / projected_area(lobe) * geometry_factor(kind, alpha, h, wi, wo),
                       .weight = 1.0 / (across * around * density),
                       .schlick = std::pow(1.0 - std::clamp(oh, 0.0, 1.0), 5.0)});
    }
  }
  return drawn;
}

// A matrix with what its density needs.
class Density {
 public:
  Density(const TransformedCosine& cosine, double wider)
      : along_(wider * cosine.along),
        across_(wider * cosine.across),
        shear_(cosine.shear),
        sine_(std::sin(cosine.angle)),
        cosine_(std::cos(cosine.angle)),
        scale_(1.0 / (pi * along_ * across_)) {
    const double x = -along_ * sine_, z = cosine_ - shear_ * sine_;
    scale_ *= 2.0 / (1.0 + z / std::hypot(x, z));  // the share above the plane of the axis
  }

  [[nodiscard]] double operator()(const glm::dvec3& w) const {
    const double z = sine_ * w.x + cosine_ * w.z;
    if (z <= 0.0) return 0.0;
    const double x = (cosine_ * w.x - sine_ * w.z - shear_ * z) / along_, y = w.y / across_;
    const double squared = x * x + y * y + z * z;
    return scale_ * z / (squared * squared);
  }

 private:
  double along_, across_, shear_, sine_, cosine_, scale_;
};

// The density of both terms of a lobe.
auto whole_density(const TransformedCosine& cosine) {
  return [first = Density(cosine, 1.0), wider = Density(cosine, wider_cosine),
          excess = cosine.excess](const glm::dvec3& w) {
    const double value = first(w);
    return excess == 0.0 ? value : value + excess * (value - wider(w));
  };
}

using Parameters = Eigen::Array<double, 5, 1>;  // along, across, shear, turn from the mean direction, excess

class FitError {
 public:
  FitError(const ReflectedLobeKind& kind, double view_angle, double alpha) : alpha_(alpha) {
    const MirroredView own(view_angle, alpha);
    for (const Drawn& d : draws(kind, alpha, {own}, energy_rings, energy_sectors)) {
      fit_.energy += d.value * d.weight;
      fit_.schlick += d.value * d.weight * d.schlick;
    }
    drawn_ = draws(kind, alpha, {own, MirroredView(view_angle, wide * alpha)}, fit_rings, fit_sectors);
    glm::dvec2 mean(0.0);
    for (const Drawn& d : drawn_) {
      sum_ += d.value * d.weight;
      mean += d.value * d.weight * glm::dvec2(d.wi.x, d.wi.z);
    }
    fit_.angle = std::atan2(mean.x, mean.y);
  }

  [[nodiscard]] double operator()(const Parameters& p) const {
    const auto density = whole_density(with(p));
    double sum = p[4] < 0.0 ? p[4] * p[4] * drawn_.front().value : 0.0;  // no negative excess
    sum += stiffness * p[3] * p[3] / (alpha_ * alpha_) * sum_;
    for (const Drawn& d : drawn_) {
      const double difference = density(d.wi) - d.value / sum_;
      sum += difference * difference * d.weight;
    }
    return sum;
  }

  [[nodiscard]] TransformedCosine with(const Parameters& p) const {
    TransformedCosine cosine = fit_;
    cosine.along = alpha_ * std::exp(p[0]);
    cosine.across = alpha_ * std::exp(p[1]);
    cosine.shear = alpha_ * p[2];
    cosine.angle += p[3];
    cosine.excess = std::max(p[4], 0.0);
    return cosine;
  }

  [[nodiscard]] double energy() const { return sum_; }

 private:
  double alpha_;
  TransformedCosine fit_;
  std::vector<Drawn> drawn_;
  double sum_ = 0.0;
};

struct SimplexVertex {
  Parameters at;
  double error;
};

Parameters between(const Parameters& a, const Parameters& b, double t) { return a + t * (b - a); }

// Over the first `count` parameters.
Parameters least(const FitError& error, const Parameters& start, std::size_t count) {
  std::vector<SimplexVertex> simplex(count + 1);
  for (std::size_t i = 0; i < simplex.size(); ++i) {
    simplex[i].at = start;
    if (i > 0) simplex[i].at[static_cast<Eigen::Index>(i) - 1] += i == 5 ? 1.0 : 0.1;
    simplex[i].error = error(simplex[i].at);
  }
  SimplexVertex& worst = simplex.back();
  for (int step = 0; step < most_steps; ++step) {
    std::ranges::sort(simplex, {}, &SimplexVertex::error);
    if (worst.error - simplex.front().error < 1e-7 * simplex.front().error) break;
    Parameters middle = Parameters::Zero();
    for (std::size_t i = 0; i < count; ++i) middle = between(middle, simplex[i].at, 1.0 / static_cast<double>(i + 1));
    const auto tried = [&](double t) {
      const Parameters at = between(middle, worst.at, t);
      return SimplexVertex{at, error(at)};
    };
    SimplexVertex next = tried(-1.0);
    if (next.error < simplex.front().error) {
      if (const SimplexVertex further = tried(-2.0); further.error < next.error) next = further;
    } else if (next.error >= simplex[count - 1].error) {
      next = next.error < worst.error ? tried(-0.5) : tried(0.5);
    }
    if (next.error < worst.error) {
      worst = next;
      continue;
    }
    for (std::size_t i = 1; i < simplex.size(); ++i) {
      simplex[i].at = between(simplex[0].at, simplex[i].at, 0.5);
      simplex[i].error = error(simplex[i].at);
    }
  }
  return std::ranges::min_element(simplex, {}, &SimplexVertex::error)->at;
}

Parameters parameters_of(const TransformedCosine& c, double alpha) {
  return {std::log(c.along / alpha), std::log(c.across / alpha), c.shear / alpha, 0.0, c.excess};
}

}  // namespace

double transformed_density(const TransformedCosine& cosine, const glm::dvec3& w) {
  return w.z > 0.0 ? whole_density(cosine)(w) : 0.0;
}

TransformedCosine fit_transformed_cosine(const ReflectedLobeKind& kind, double view_angle, double alpha,
                                         const TransformedCosine& start) {
  const FitError error(kind, view_angle, alpha);
  if (!(error.energy() > least_energy)) return error.with(parameters_of(start, alpha));
  const bool has_tail = kind.distribution == NormalDistribution::ggx;
  return error.with(least(error, parameters_of(start, alpha), has_tail ? 4 : 5));
}

double cosine_angle(int x, int count) { return widest_angle * x / (count - 1); }

double cosine_alpha(int y, int count) {
  return smallest_alpha * std::pow(1.0 / smallest_alpha, static_cast<double>(y) / (count - 1));
}

std::vector<Image> make_cosine_table(const ReflectedLobeKind& kind) {
  std::vector<Image> layers(2, Image(view_columns, width_rows, 4));
  tbb::parallel_for(0, width_rows, [&](int y) {
    const double alpha = cosine_alpha(y, width_rows);
    TransformedCosine fit{.along = 2.0 * alpha, .across = 2.0 * alpha};
    for (int x = 0; x < view_columns; ++x) {
      const double angle = cosine_angle(x, view_columns);
      fit = fit_transformed_cosine(kind, angle, alpha, fit);
      const Parameters shape = parameters_of(fit, alpha);
      const auto texel = layers[0].at(x, y);
      texel[0] = static_cast<float>(fit.angle - angle);
      for (int i = 0; i < 3; ++i) texel[static_cast<std::size_t>(i) + 1] = static_cast<float>(shape[i]);
      const auto energies = layers[1].at(x, y);
      energies[0] = static_cast<float>(fit.energy);
      energies[1] = static_cast<float>(fit.schlick);
      energies[2] = static_cast<float>(fit.excess);
    }
  });
  return layers;
}

}  // namespace footprint
