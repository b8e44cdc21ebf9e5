// Compares the records of a distance by their shading error, says in words what follows, and walks the supersampling
// curve from its right end to the last point that is not better than the method.
#include "results/report/ranking.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <string_view>

#include "renderer/core/error.hpp"
#include "results/report/figures.hpp"

namespace footprint {
namespace {

void check_curve(std::span<const CurvePoint> curve, double error) {
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

constexpr double standard_errors = 3;             // beyond which a difference is none of chance
constexpr double converged_standard_error = 0.5;  // of the mean radiance

// "a", "a and b", "a, b and c".
std::string enumerated(const std::vector<std::string>& parts) {
  if (parts.size() < 2) return parts.empty() ? std::string() : parts.front();
  return fmt::format("{} and {}", fmt::join(parts.begin(), parts.end() - 1, ", "), parts.back());
}

// The standard error of the difference of two records' errors. Both are against one reference, so that their noise is
// alike and the true one is less.
std::optional<double> difference_noise(const Record& a, const Record& b) {
  const std::optional<double>&of_a = a.error->causes.shading_noise, &of_b = b.error->causes.shading_noise;
  return of_a && of_b ? std::optional(std::hypot(*of_a, *of_b)) : std::nullopt;
}

std::string percent(std::size_t part, std::size_t whole) {
  const double share = 100.0 * static_cast<double>(part) / static_cast<double>(std::max<std::size_t>(whole, 1));
  return share > 0.0 && share < 1.0 ? "under 1%" : fmt::format("{:.0f}%", share);
}

// The records that are ranked, the best first.
DistanceRecords ranked(const DistanceRecords& records) {
  DistanceRecords sorted;
  std::ranges::copy_if(records, std::back_inserter(sorted),
                       [](const Record& r) { return ranked_error(r).has_value(); });
  std::ranges::stable_sort(sorted, {}, [](const Record& r) { return *ranked_error(r); });
  return sorted;
}

std::string with_error(const Record& record) {
  return fmt::format("{} ({})", record.method, error_text(*ranked_error(record)));
}

std::string who_is_best(const DistanceRecords& sorted, std::size_t best) {
  const Record& first = sorted.front();
  const std::size_t pixels = first.pixels.interior;
  if (best == 1) {
    return fmt::format("{} has the smallest shading error: {} over {} interior pixels.", first.method,
                       error_text(*ranked_error(first)), pixels);
  }
  std::vector<std::string> names;
  for (std::size_t i = 0; i < best; ++i) names.push_back(sorted[i].get().method);
  return fmt::format(
      "{} share the smallest shading error, {} over {} interior pixels: they differ by no more than the reference's "
      "noise.",
      enumerated(names), range_text(*ranked_error(first), *ranked_error(sorted[best - 1])), pixels);
}

std::string who_is_worse(const DistanceRecords& sorted, std::size_t best) {
  std::vector<std::string> names;
  for (std::size_t i = best; i < sorted.size(); ++i) names.push_back(with_error(sorted[i]));
  return fmt::format("Significantly worse: {}.", enumerated(names));
}

std::string where_it_is_closer(const Results& results, const DistanceRecords& sorted) {
  if (sorted.size() < 2) return {};
  const Record &first = sorted[0], &second = sorted[1];
  const auto closer = closer_share(results, first.distance, first.method, second.method);
  const auto farther = closer_share(results, first.distance, second.method, first.method);
  if (!closer || !farther) return {};
  return fmt::format(
      "{} is closer to the reference than {} in {:.0f}% of the interior pixels and farther in {:.0f}%; the rest are "
      "ties "
      "within noise.",
      first.method, second.method, 100.0 * *closer, 100.0 * *farther);
}

std::string worth_text(const Record& record) {
  if (!record.equivalent) return {};
  const auto [spp, side] = *record.equivalent;
  if (side == CurveSide::below) return ", and is less accurate than one frame of direct";
  const std::string count = side == CurveSide::above ? fmt::format("more than {:g}", spp) : equivalent_text(record);
  if (count == "1") return ", and is as accurate as one frame of direct";
  return fmt::format(", and is as accurate as the mean of {} frames of direct", count);
}

std::string price_text(const Record& record) {
  const TimeRatio& ratio = record.ratio_to_direct;
  if (!std::isfinite(ratio.median)) return fmt::format("takes {} ms per frame", three_figures(record.frame_ms.median));
  if (is_unit_frame(record)) return "is direct itself";
  return fmt::format("costs {} times as much as direct", ratio_text(ratio));
}

std::string what_it_costs(const Record& record) {
  if (is_unit_frame(record)) return {};  // against itself there is nothing to say
  return fmt::format("{} {}{}.", record.method, price_text(record), worth_text(record));
}

std::string what_the_bound_leaves(const Record& record) {
  const ErrorCauses& causes = record.error->causes;
  if (!causes.filter || !causes.method || !record.pixels.bound) return {};
  return fmt::format(
      "Even with the exact normal distribution, this footprint filter leaves an error of {}; {} differs from that "
      "result "
      "by {} (over {} pixels).",
      error_text(*causes.filter), record.method, error_text(*causes.method), *record.pixels.bound);
}

std::string what_the_lookup_costs(const Record& record) {
  const std::optional<double>& light = record.error->causes.light;
  if (!light || !record.pixels.light) return {};
  return fmt::format(
      "Its environment lookup is off by {}, compared with shading the whole environment by the same lobes (over {} "
      "pixels).",
      error_text(*light), *record.pixels.light);
}

std::string what_edges_add(const DistanceRecords& records) {
  std::vector<double> errors;
  for (const Record& record : records) {
    if (record.error && record.error->causes.edges) errors.push_back(*record.error->causes.edges);
  }
  if (errors.empty()) return {};
  const PixelCounts& pixels = records.front().get().pixels;
  const auto [least, most] = std::ranges::minmax(errors);
  const bool has_jitter = std::ranges::any_of(records, [](const Record& r) { return r.history && r.history->jitter; });
  return fmt::format("Edges make up {} of the object's pixels; the error there is {}, because {}.",
                     percent(pixels.object - pixels.interior, pixels.object), range_text(least, most),
                     has_jitter ? "only a history's jitter filters edges" : "no method filters edges");
}

bool has_nothing_to_filter(const PixelCounts& pixels) { return pixels.interior > 0 && pixels.minified == 0; }

bool is_all_noise(const DistanceRecords& records) {
  const DistanceRecords sorted = ranked(records);
  return sorted.size() > 1 && !is_better(sorted.front(), sorted.back());
}

// Whether the reference's noise floor is more than half of the least error measured against it.
bool is_mostly_noise(double least_error, const std::optional<double>& noise_floor) {
  return noise_floor && *noise_floor > 0.5 * least_error;
}

// Whether noise dominates: in the errors that rank methods if they exist, else in those over all of the object.
bool has_not_converged(const DistanceRecords& records) {
  const auto is_noise = [](const Record& r) {
    if (!r.error) return false;
    const std::optional<double> shading = ranked_error(r);
    return is_mostly_noise(shading.value_or(r.error->normalized_color),
                           shading ? r.error->causes.shading_floor : r.error->noise_floor);
  };
  return std::ranges::any_of(records, is_noise);
}

bool has_few(const PixelCounts& pixels) { return pixels.interior < few_pixels && pixels.interior >= too_few_pixels; }

// A sentence that starts with the distances for which `condition` is true; empty if there are none.
template <typename Condition>
std::string at_distances(const Results& results, Condition condition, std::string_view sentence) {
  std::vector<std::string> found;
  for (const double distance : distances_of(results)) {
    if (condition(records_at(results, distance))) found.push_back(fmt::format("{:.4g}", distance));
  }
  if (found.empty()) return {};
  return fmt::format("At distance{} {} {}", found.size() == 1 ? "" : "s", enumerated(found), sentence);
}

// A sentence on the frames of an animation in which the reference has not converged; empty without any.
std::string noisy_frames(const Results& results) {
  std::set<int> all, noisy;
  for (const Record& record : results.records) {
    all.insert(record.frame);
    if (record.error && is_mostly_noise(record.error->normalized_color, record.error->noise_floor))
      noisy.insert(record.frame);
  }
  if (noisy.empty()) return {};
  return fmt::format(
      "in {} of {} frames the reference has not converged: its noise floor is more than half of the least error; raise "
      "--spp",
      noisy.size(), all.size());
}

template <typename... Sentences>
std::vector<std::string> present_sentences(Sentences... sentences) {
  std::vector<std::string> all{std::move(sentences)...};
  std::erase(all, std::string());
  return all;
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
  check_curve(curve, error);
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

DistanceRecords records_at(const Results& results, double distance) {
  DistanceRecords records;
  std::ranges::copy_if(results.records, std::back_inserter(records),
                       [distance](const Record& r) { return r.distance == distance; });
  return records;
}

std::optional<double> ranked_error(const Record& record) {
  if (!record.error || record.pixels.interior < too_few_pixels) return {};
  return record.error->causes.shading;
}

bool is_better(const Record& a, const Record& b) {
  const std::optional<double> of_a = ranked_error(a), of_b = ranked_error(b);
  const std::optional<double> noise = of_a && of_b ? difference_noise(a, b) : std::nullopt;
  return noise && *of_b - *of_a > standard_errors * *noise;
}

std::optional<int> rank(const Record& record, const DistanceRecords& records) {
  if (!ranked_error(record)) return {};
  return 1 + static_cast<int>(
                 std::ranges::count_if(records, [&](const Record& other) { return is_better(other, record); }));
}

std::optional<std::string> linear_measures_warning(double distance, const std::optional<double>& standard_error) {
  if (!standard_error || *standard_error <= converged_standard_error) return {};
  return fmt::format(
      "distance {:g}: measures of linear radiance (relative RMSE, relMSE, energy bias) depend on a few very "
      "bright pixels: the reference's standard error is {:.2g} of the mean radiance",
      distance, *standard_error);
}

std::vector<std::string> ranking_warnings(const Results& results) {
  if (results.animation) return present_sentences(noisy_frames(results));
  const auto pixels = [](const DistanceRecords& records) { return records.front().get().pixels; };
  return present_sentences(
      at_distances(
          results, [](const auto& records) { return has_not_converged(records); },
          "the reference has not converged: its noise floor exceeds half of the smallest error, so all errors are "
          "partly noise; give --noise, or raise --spp and --spp-max"),
      at_distances(
          results, [&](const auto& records) { return pixels(records).object == 0; },
          "the object does not cover a whole pixel, so the error is unknown"),
      at_distances(
          results,
          [&](const auto& records) { return pixels(records).object > 0 && pixels(records).interior < too_few_pixels; },
          fmt::format("there are fewer than {} interior pixels, so methods are not ranked", too_few_pixels)),
      at_distances(
          results, [&](const auto& records) { return has_few(pixels(records)); },
          fmt::format("there are fewer than {} interior pixels (marked !), so the ranking is uncertain", few_pixels)),
      at_distances(
          results, [&](const auto& records) { return has_nothing_to_filter(pixels(records)); },
          "nothing needs filtering: no pixel's footprint spans more than one texel of a normal map"),
      at_distances(results, is_all_noise,
                   "the methods differ by no more than the reference's noise: raise --spp to separate them"));
}

std::string pixels_and_noise(const Record& record) {
  const PixelCounts& pixels = record.pixels;
  const std::string text = fmt::format("{} object pixels, {} of them interior ({})", pixels.object, pixels.interior,
                                       percent(pixels.interior, pixels.object));
  if (!record.error || !record.error->noise_floor) return text + "; the reference's noise is unknown.";
  return fmt::format("{}; noise floor {}, {} over interior pixels.", text, error_text(*record.error->noise_floor),
                     error_text(record.error->causes.shading_floor));
}

std::optional<double> closer_share(const Results& results, double distance, const std::string& method,
                                   const std::string& other) {
  for (const MethodPair& pair : results.pairs) {
    if (pair.distance != distance) continue;
    if (pair.methods[0] == method && pair.methods[1] == other) return pair.closer[0];
    if (pair.methods[1] == method && pair.methods[0] == other) return pair.closer[1];
  }
  return {};
}

std::vector<std::string> findings(const Results& results, double distance) {
  const DistanceRecords records = records_at(results, distance);
  const DistanceRecords sorted = ranked(records);
  if (sorted.empty()) return present_sentences(std::string("No method is ranked."), what_edges_add(records));
  const auto worse = std::ranges::find_if(sorted, [&](const Record& r) { return is_better(sorted.front(), r); });
  const auto best = static_cast<std::size_t>(worse - sorted.begin());
  const Record& cheapest =
      *std::ranges::min_element(sorted.begin(), worse, {}, [](const Record& r) { return r.frame_ms.median; });
  return present_sentences(
      has_nothing_to_filter(sorted.front().get().pixels)
          ? std::string("Nothing needs filtering here: no pixel's footprint spans more than one texel of a normal map.")
          : std::string(),
      sorted.size() > 1 ? who_is_best(sorted, best) : std::string(),
      best < sorted.size() ? who_is_worse(sorted, best) : std::string(), where_it_is_closer(results, sorted),
      what_it_costs(cheapest), what_the_bound_leaves(cheapest), what_the_lookup_costs(cheapest),
      what_edges_add(records));
}

}  // namespace footprint
