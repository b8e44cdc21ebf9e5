// Walks the supersampling curve from its right end to the last point that is not better than the method.
#include "results/report/equivalent_spp.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "renderer/core/error.hpp"

namespace footprint {
namespace {

void check(std::span<const CurvePoint> curve, double error) {
  const auto fits = [](double value) { return std::isfinite(value) && value >= 0; };
  if (!fits(error)) throw Error(ErrorKind::usage, "equivalent samples", fmt::format("the error is {}", error));
  for (const CurvePoint& point : curve) {
    if (!fits(point.error) || !fits(point.spp) || point.spp == 0) {
      throw Error(ErrorKind::usage, "supersampling curve",
                  fmt::format("{} samples per pixel with an error of {}", point.spp, point.error));
    }
  }
}

/// The count between `left` and `right` where the curve falls to `error`; left.error >= error > right.error.
double crossing(const CurvePoint& left, const CurvePoint& right, double error) {
  const bool logarithmic = right.error > 0;
  const double part = logarithmic ? std::log(left.error / error) / std::log(left.error / right.error)
                                  : (left.error - error) / (left.error - right.error);
  return left.spp * std::pow(right.spp / left.spp, part);
}

}  // namespace

std::vector<CurvePoint> supersampling_curve(std::span<const SupersamplingPoint> points, double distance,
                                            std::optional<double> SupersamplingPoint::*error) {
  std::vector<CurvePoint> curve;
  for (const SupersamplingPoint& point : points) {
    if (point.distance == distance && point.*error) curve.push_back({static_cast<double>(point.spp), *(point.*error)});
  }
  return curve;
}

std::optional<EquivalentSamples> equivalent_samples(std::span<const CurvePoint> curve, double error) {
  check(curve, error);
  if (curve.empty()) return std::nullopt;
  std::vector<CurvePoint> sorted(curve.begin(), curve.end());
  std::ranges::stable_sort(sorted, {}, &CurvePoint::spp);

  // From the right: the last measured point that is not better than the method.
  const auto last = std::ranges::find_if(sorted.rbegin(), sorted.rend(),
                                         [error](const CurvePoint& point) { return point.error >= error; });
  if (last == sorted.rend()) return EquivalentSamples{sorted.front().spp, CurveSide::below};
  if (last == sorted.rbegin()) {
    return EquivalentSamples{last->spp, last->error == error ? CurveSide::within : CurveSide::above};
  }
  return EquivalentSamples{crossing(*last, *(last - 1), error), CurveSide::within};
}

}  // namespace footprint
