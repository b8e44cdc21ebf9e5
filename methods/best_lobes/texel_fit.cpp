// Levenberg-Marquardt over weights, means, deviations and spreads of the lobes on a lattice of directions. Starts are
// the best lobes of one fewer and another where most is missing; clusters about k-means++ seeds, and EM from those; and
// the lobes of other methods. No step goes up, so the best end is no worse than any start.
#include "methods/best_lobes/lobe_shapes.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <numbers>

#include "methods/best_lobes/starts.hpp"
#include "methods/fournier/least_squares.hpp"

namespace footprint::best_lobes {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using fournier::Peak;
using LobeVector = Eigen::VectorXd;

constexpr double cells_per_width = 16.0;
constexpr double smallest_cell = 1.0 / 8192.0;
constexpr double spacing_over_width = 0.75;
constexpr double spacing_of_ggx = 0.6;  // its peak is sharper
constexpr int coarse = 3;               // of the lattice far from the normals, in spacings
constexpr double most_directions = 3600.0;
constexpr double few_directions = 900.0;  // where those would not do
constexpr double reach = 4.0;             // of the fine lattice beyond the normals, in widths of the base lobe
constexpr double good_enough = 1e-4;      // relative error that no further lobe improves
constexpr double negligible_square = 1e-8;
constexpr double least_root = 0.05;  // of the base lobe's deviation: at 0 the derivative by a deviation vanishes
constexpr double widest = 10.0;      // without it a lobe that hides energy below the horizon would widen forever
constexpr double least_weight = 1e-3;
constexpr std::uint64_t cluster_seeds = 2;
constexpr std::size_t trials = 3;  // from the best starts
constexpr int trial_evaluations = 10;
constexpr int last_evaluations = 200;
constexpr double fit_tolerance = 1e-4;
constexpr double horizon = 0.999;  // the farthest mean

struct Box {
  Vector2d lower, upper;
};

Box box_of(const std::vector<PlaneNormal>& normals, double beyond) {
  Vector2d lower = normals[0].at, upper = normals[0].at;
  for (const PlaneNormal& normal : normals) {
    lower = lower.cwiseMin(normal.at);
    upper = upper.cwiseMax(normal.at);
  }
  return {lower.array() - beyond, upper.array() + beyond};
}

// The part of a square of the plane that is above the horizon.
double part_above(double x, double y, double edge) {
  constexpr int samples = 8;
  if (std::hypot(x, y) + edge < 1.0) return 1.0;
  int above = 0;
  for (int i = 0; i < samples * samples; ++i) {
    const double a = x + edge * ((i % samples + 0.5) / samples - 0.5);
    const double b = y + edge * ((i / samples + 0.5) / samples - 0.5);
    above += a * a + b * b < 1.0 ? 1 : 0;
  }
  return static_cast<double>(above) / (samples * samples);
}

void add_square(double x, double y, double edge, Directions& directions) {
  const double part = part_above(x, y, edge);
  if (part <= 0.0) return;
  directions.x.push_back(x);
  directions.y.push_back(y);
  directions.root_of_angle.push_back(2.0 * edge * std::sqrt(part) / (1.0 + x * x + y * y));
}

// All directions above the surface: squares of the plane, `coarse` times as wide beyond the box.
Directions directions_of(const Box& box, double spacing) {
  Directions directions;
  const double edge = coarse * spacing;
  const int half = static_cast<int>(std::ceil(1.0 / edge));
  for (int row = -half; row < half; ++row) {
    for (int column = -half; column < half; ++column) {
      const double x = (column + 0.5) * edge, y = (row + 0.5) * edge;
      const bool near = x + 0.5 * edge > box.lower.x() && x - 0.5 * edge < box.upper.x() &&
                        y + 0.5 * edge > box.lower.y() && y - 0.5 * edge < box.upper.y();
      const int across = near ? coarse : 1;
      const double own = edge / across;
      for (int i = 0; i < across * across; ++i)
        add_square(x + own * (i % across - 0.5 * (across - 1)), y + own * (i / across - 0.5 * (across - 1)), own,
                   directions);
    }
  }
  return directions;
}

// The lattice about the normals, and the lobes that it resolves: wider ones than the base lobe if it would take more
// than `most_directions`; then fewer do, because the fit is no bound.
struct Lattice {
  Directions directions;
  double widened = 1.0;  // of the base lobe's variance
};

Lattice build_lattice(const std::vector<PlaneNormal>& normals, const LobeFamily& family) {
  double finest = 1.0, coarsest = 0.5;  // of the plane's scale over the normals
  for (const PlaneNormal& normal : normals) {
    const double scale = std::sqrt(plane_variance(normal.at));
    finest = std::min(finest, scale);
    coarsest = std::max(coarsest, scale);
  }
  const bool is_ggx = family.distribution() == NormalDistribution::ggx;
  const Box box = box_of(normals, reach * family.width() * coarsest);
  const Vector2d sides = box.upper.cwiseMin(1.0) - box.lower.cwiseMax(-1.0);
  const double wanted = (is_ggx ? spacing_of_ggx : spacing_over_width) * family.width() * finest;
  const double inside = std::min(sides.prod(), std::numbers::pi);
  const double area = inside + (std::numbers::pi - inside) / (coarse * coarse);
  const bool is_resolved = area <= most_directions * wanted * wanted;
  const double spacing = is_resolved ? wanted : std::sqrt(area / few_directions);
  return {directions_of(box, spacing), (spacing / wanted) * (spacing / wanted)};
}

// The squared distance between lobes and target as a function of the parameters of the lobes: for each the root of its
// weight, its mean p as p / (1 - |p|^2)^(1/2), so that no mean leaves the hemisphere, its deviation and its root.
// Weights are relative to their sum, or to the target's.
class Distance {
 public:
  Distance(const std::vector<PlaneNormal>& normals, const LobeFamily& family, Weights weights)
      : normals_(&normals),
        weights_(weights),
        lattice_(build_lattice(normals, family)),
        family_(family.distribution(), family.variance() * lattice_.widened, family.shape()) {
    target_ = LobeVector::Zero(static_cast<Eigen::Index>(lattice_.directions.size()));
    for (const PlaneNormal& normal : normals)
      family_.add_round(normal.weight, normal.at, normal.spread, lattice_.directions, target_);
    norm_ = target_.squaredNorm();
  }

  [[nodiscard]] const LobeFamily& family() const { return family_; }
  [[nodiscard]] const std::vector<PlaneNormal>& normals() const { return *normals_; }
  [[nodiscard]] double norm() const { return norm_; }
  [[nodiscard]] bool sees_the_base_lobe() const { return lattice_.widened <= 1.0; }
  [[nodiscard]] bool is_resolved(std::size_t lobes) const {
    return static_cast<std::size_t>(target_.size()) > lobes * static_cast<std::size_t>(per_lobe()) && norm_ > 0.0;
  }

  [[nodiscard]] LobeVector parameters_of(std::vector<FittedLobe> lobes) const {
    LobeVector x(per_lobe() * static_cast<Eigen::Index>(lobes.size()));
    Eigen::Index at = 0;
    for (FittedLobe& lobe : lobes) {
      x[at] = std::sqrt(lobe.weight);
      lobe.mean *= std::min(horizon / std::max(lobe.mean.norm(), 1e-12), 1.0);
      lobe.mean /= std::sqrt(1.0 - lobe.mean.squaredNorm());
      for (Eigen::Index k = 0; k + 1 < per_lobe(); ++k) x[at + 1 + k] = lobe.parameter(k);
      at += per_lobe();
    }
    return x;
  }

  [[nodiscard]] std::vector<FittedLobe> lobes_at(const LobeVector& x) const {
    std::vector<FittedLobe> lobes;
    double sum = 0.0;
    for (Eigen::Index at = 0; at < x.size(); at += per_lobe()) {
      FittedLobe lobe{.weight = x[at] * x[at]};
      for (Eigen::Index k = 0; k + 1 < per_lobe(); ++k)
        lobe.parameter(k) = k < 2 ? x[at + 1 + k] : std::clamp(x[at + 1 + k], -widest, widest);
      lobe.mean /= std::sqrt(1.0 + lobe.mean.squaredNorm());
      sum += lobe.weight;
      lobes.push_back(lobe);
    }
    if (weights_ == Weights::of_target)
      for (FittedLobe& lobe : lobes) lobe.weight /= std::max(sum, 1e-300);
    return lobes;
  }

  [[nodiscard]] fournier::Squares operator()(const LobeVector& x) const {
    const std::vector<FittedLobe> lobes = lobes_at(x);
    const Eigen::Index rows = target_.size();
    Eigen::MatrixXd jacobian(rows, x.size());
    LobeVector sum = LobeVector::Zero(rows);
    double squares = 0.0;
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      const Eigen::Index at = static_cast<Eigen::Index>(i) * per_lobe();
      family_.evaluate(lobes[i], lattice_.directions, jacobian.col(at), jacobian.middleCols(at + 1, per_lobe() - 1));
      sum += lobes[i].weight * jacobian.col(at);
      squares += x[at] * x[at];
    }
    for (std::size_t i = 0; i < lobes.size(); ++i) {
      const Eigen::Index at = static_cast<Eigen::Index>(i) * per_lobe();
      if (weights_ == Weights::free) {
        jacobian.col(at) *= 2.0 * x[at];
      } else {
        jacobian.col(at) = (2.0 * x[at] / std::max(squares, 1e-300)) * (jacobian.col(at) - sum);
      }
      jacobian.middleCols(at + 1, per_lobe() - 1) *= lobes[i].weight;
      const Vector2d& mean = lobes[i].mean;
      const Eigen::Matrix2d by_place =
          std::sqrt(1.0 - mean.squaredNorm()) * (Eigen::Matrix2d::Identity() - mean * mean.transpose());
      jacobian.middleCols(at + 1, 2) = (jacobian.middleCols(at + 1, 2) * by_place).eval();
    }
    const LobeVector residual = sum - target_;
    fournier::Squares out{.q = residual.squaredNorm(), .gradient = jacobian.transpose() * residual, .gram = {}};
    out.gram.setZero(x.size(), x.size());
    out.gram.selfadjointView<Eigen::Lower>().rankUpdate(jacobian.transpose());
    out.gram.triangularView<Eigen::StrictlyUpper>() = out.gram.transpose();
    // Weight, deviation and the diagonal of the root enter by their squares. The second derivatives of the residual by
    // them, which J^T J lacks, add gradient / x. Without that, steps towards 0 overshoot, the more the nearer they are.
    for (Eigen::Index at = 0; at < x.size(); at += per_lobe())
      for (const Eigen::Index k : {0, 3, 4, 6})
        if (k < per_lobe() && x[at + k] != 0.0)
          out.gram(at + k, at + k) += std::max(out.gradient[at + k] / x[at + k], 0.0);
    return out;
  }

  [[nodiscard]] double of(const LobeVector& x) const {
    const double q = missing(lobes_at(x)).squaredNorm();
    return std::isfinite(q) ? q : std::numeric_limits<double>::infinity();
  }

  [[nodiscard]] LobeVector missing(const std::vector<FittedLobe>& lobes) const {
    LobeVector left = target_;
    LobeVector values(target_.size());
    Eigen::MatrixXd unused(target_.size(), family_.parameters());
    for (const FittedLobe& lobe : lobes) {
      family_.evaluate(lobe, lattice_.directions, values, unused);
      left -= lobe.weight * values;
    }
    return left;
  }

  // The direction of the greatest density that lobes lack.
  [[nodiscard]] Vector2d place_of_most(const LobeVector& left) const {
    Eigen::Index most = 0;
    left.maxCoeff(&most);
    const auto i = static_cast<std::size_t>(most);
    return {lattice_.directions.x[i], lattice_.directions.y[i]};
  }

 private:
  // The root of the weight, then the family's.
  [[nodiscard]] Eigen::Index per_lobe() const { return 1 + family_.parameters(); }

  const std::vector<PlaneNormal>* normals_;
  Weights weights_;
  Lattice lattice_;
  LobeFamily family_;
  LobeVector target_;
  double norm_ = 0.0;
};

// Parameters, and what they leave.
struct Minimum {
  LobeVector x;
  double q = std::numeric_limits<double>::infinity();
  bool converged = true;
};

Minimum minimum_from(const Distance& distance, LobeVector x, int evaluations) {
  Minimum out;
  out.converged = fournier::minimise(
      [&](const LobeVector& at) { return distance(at); },
      {.tolerance = fit_tolerance, .most_evaluations = evaluations, .negligible = negligible_square * distance.norm()},
      x);
  out.q = distance.of(x);
  out.x = std::move(x);
  return out;
}

// The best lobes of one fewer, and a narrow one where most is missing of the target.
std::vector<FittedLobe> one_more(const Distance& distance, std::vector<FittedLobe> lobes) {
  constexpr double share = 0.1;
  for (FittedLobe& lobe : lobes) lobe.weight *= 1.0 - share;
  const Vector2d place = distance.place_of_most(distance.missing(lobes));
  const double variance = distance.family().variance() * plane_variance(place);
  lobes.push_back(lobe_of_spread(share, place, {variance, 0.0, variance}, distance.family().shape()));
  return lobes;
}

// Lobes that a step can widen and weigh.
std::vector<FittedLobe> movable(std::vector<FittedLobe> lobes, const LobeFamily& family) {
  const double least = least_root * std::sqrt(family.variance());
  for (FittedLobe& lobe : lobes) {
    lobe.weight = std::max(lobe.weight, least_weight);
    lobe.deviation = std::max(lobe.deviation, least);
    for (const Eigen::Index k : {0, 2})
      if (family.shape() == Shape::stretched)
        lobe.root[k] = std::max(lobe.root[k], least * std::sqrt(plane_variance(lobe.mean)));
  }
  return lobes;
}

Minimum best_of_starts(const Distance& distance, const std::vector<FittedLobe>& fewer, std::size_t count,
                       std::vector<std::vector<FittedLobe>> starts) {
  const LobeFamily& family = distance.family();
  if (!fewer.empty()) starts.push_back(one_more(distance, fewer));
  for (std::uint64_t seed = 0; seed < (count > 1 ? cluster_seeds : 1); ++seed) {
    starts.push_back(clusters(distance.normals(), count, family, seed));
    if (count > 1) starts.push_back(by_em(distance.normals(), starts.back(), family));
  }
  std::vector<Minimum> given;
  for (const std::vector<FittedLobe>& start : starts) {
    const LobeVector x = distance.parameters_of(start);
    given.push_back({x, distance.of(x), true});
  }
  std::ranges::stable_sort(given, {}, &Minimum::q);
  Minimum best = given.front();
  const auto take = [&](Minimum found) {
    if (found.q < best.q) best = std::move(found);
  };
  given.resize(std::min(given.size(), trials));
  for (const Minimum& start : given)
    take(
        minimum_from(distance, distance.parameters_of(movable(distance.lobes_at(start.x), family)), trial_evaluations));
  Minimum last = minimum_from(distance, best.x, last_evaluations);
  best.converged = last.converged;
  take(std::move(last));
  return best;
}

}  // namespace

double cell_edge(const LobeFamily& family) { return std::max(family.width() / cells_per_width, smallest_cell); }

LobeFit fit_lobes(std::span<const Peak> target, std::size_t count, const LobeFamily& family, const Starts& starts,
                  Weights weights) {
  const std::vector<PlaneNormal> normals = plane_normals(target);
  double total = 0.0;
  for (const Peak& peak : target) total += peak.weight;
  const Distance distance(normals, family, weights);
  LobeFit fit{.lobes = {}, .error = std::numeric_limits<double>::infinity()};
  for (std::size_t k = 1; k <= count && fit.error > good_enough; ++k) {
    if (!distance.is_resolved(k)) {
      if (fit.lobes.empty()) fit = {.lobes = clusters(normals, k, family, 0), .error = 0.0};
      break;
    }
    const Minimum best = best_of_starts(distance, fit.lobes, k, starts(k));
    const double error = std::sqrt(best.q / distance.norm());
    if (error < fit.error) fit = {.lobes = distance.lobes_at(best.x), .error = error, .converged = best.converged};
  }
  fit.resolved = distance.sees_the_base_lobe();
  std::ranges::stable_sort(fit.lobes, std::greater{}, &FittedLobe::weight);
  for (FittedLobe& lobe : fit.lobes) lobe.weight *= total;
  return fit;
}

}  // namespace footprint::best_lobes
