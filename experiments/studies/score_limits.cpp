// Reads limits and compares figures with them.
#include "experiments/studies/score_limits.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

constexpr std::string_view share_prefix = "share_above:";
constexpr std::string_view rejected_name = "rejected";

const ScoreMetric* metric_named(std::string_view name) {
  const auto found = std::ranges::find(score_metrics(), name, &ScoreMetric::key);
  return found == score_metrics().end() ? nullptr : &*found;
}

double number_in(const std::string& text, const std::string& place, double least, double most) {
  const auto number = parse_whole_of<double>(text);
  if (number && *number >= least && *number <= most) return *number;
  throw Error(ErrorKind::usage, place, fmt::format("`{:.80}` is not a number from {:g} to {:g}", text, least, most),
              "write --max normalized_color=0.02");
}

bool is_percentile(const std::string& name) {
  return name.size() > 1 && name.front() == 'p' && (std::isdigit(static_cast<unsigned char>(name[1])) != 0);
}

// The part of a name that is a number, which is taken off it.
double take_parameter(std::string& name, const std::string& place) {
  if (is_percentile(name)) {
    const double percent = number_in(name.substr(1), place, 0.0, 100.0);
    name = "p";
    return percent;
  }
  if (!name.starts_with(share_prefix)) return 0.0;
  const double error = number_in(name.substr(share_prefix.size()), place, 0.0, 1.0);
  name = share_prefix;
  return error;
}

}  // namespace

ScoreLimit parse_score_limit(const std::string& text) {
  const std::string place = fmt::format("--max {:.200}", text);
  const std::size_t equals = text.find('=');
  if (equals == std::string::npos || equals == 0)
    throw Error(ErrorKind::usage, place, "is not NAME=VALUE", "write --max normalized_color=0.02");
  ScoreLimit limit{.text = text, .name = text.substr(0, equals)};
  limit.most = number_in(text.substr(equals + 1), place, -1e300, 1e300);
  limit.parameter = take_parameter(limit.name, place);
  if (limit.name == "psnr")
    throw Error(ErrorKind::usage, place, "a larger PSNR is better, so it has no upper limit", "limit normalized_color");
  if (limit.name == "p" || limit.name == share_prefix || limit.name == rejected_name ||
      metric_named(limit.name) != nullptr)
    return limit;
  std::vector<std::string> names{"p99", std::string(share_prefix) + "0.1", std::string(rejected_name)};
  for (const ScoreMetric& metric : score_metrics()) names.emplace_back(metric.key);
  throw Error(ErrorKind::usage, place, fmt::format("`{:.80}` is no measure of a score", limit.name),
              suggestion(limit.name, names));
}

std::optional<double> figure_of(const ScoreLimit& limit, const PictureScore& score) {
  if (const ScoreMetric* metric = metric_named(limit.name)) {
    const std::optional<double> value = metric->value(score);
    return value ? std::optional(std::abs(*value)) : value;
  }
  if (limit.name == "p") return error_percentile(score, limit.parameter);
  if (limit.name == rejected_name) {
    if (!score.rejected) return {};
    return static_cast<double>(*score.rejected);
  }
  const auto first = std::ranges::upper_bound(score.pixel_errors, static_cast<float>(limit.parameter));
  const auto above = static_cast<double>(score.pixel_errors.end() - first);
  return above / static_cast<double>(score.pixel_errors.size());
}

std::vector<CheckOutcome> limit_outcomes(std::span<const ScoreLimit> limits, const PictureScore& score) {
  std::vector<CheckOutcome> outcomes;
  for (const ScoreLimit& limit : limits) {
    const std::optional<double> figure = figure_of(limit, score);
    std::string failure;
    if (!figure) {
      failure = limit.name == rejected_name ? "there was no test: give --significance" : "the image has no such figure";
    } else if (!(*figure <= limit.most)) {
      failure = fmt::format("it is {:.4g}", *figure);
    }
    outcomes.push_back(
        {.suite = score.name, .name = "limit " + limit.text, .failure = std::move(failure), .place = score.name});
  }
  return outcomes;
}

}  // namespace footprint
