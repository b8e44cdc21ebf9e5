// Outcomes as text, each format with its own escapes.
#include "results/report/check_outcomes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string_view>

#include "results/report/experiment_section.hpp"

namespace footprint {
namespace {

// XML 1.0: characters that no document may hold, not even escaped, become blanks.
std::string xml_escaped(std::string_view text) {
  std::string out;
  for (const char c : text) {
    switch (c) {
      case '&':
        out += "&amp;";
        break;
      case '<':
        out += "&lt;";
        break;
      case '>':
        out += "&gt;";
        break;
      case '"':
        out += "&quot;";
        break;
      case '\n':
        out += "&#10;";
        break;
      default:
        out += static_cast<unsigned char>(c) < 0x20 ? ' ' : c;
    }
  }
  return out;
}

// As workflow commands take them: a property also ends at a comma, and its name at a colon.
std::string command_escaped(std::string_view text, bool is_property) {
  std::string out;
  for (const char c : text) {
    const bool special = c == '%' || c == '\r' || c == '\n' || (is_property && (c == ':' || c == ','));
    out += special ? fmt::format("%{:02X}", static_cast<unsigned>(c)) : std::string(1, c);
  }
  return out;
}

// FILE:LINE, or FILE, as properties of a workflow command.
std::string place_property(const std::string& place) {
  if (place.empty()) return {};
  const std::size_t colon = place.rfind(':');
  const bool has_line = colon != std::string::npos && colon + 1 < place.size() &&
                        place.find_first_not_of("0123456789", colon + 1) == std::string::npos;
  const std::string file = command_escaped(has_line ? place.substr(0, colon) : place, true);
  return has_line ? fmt::format("file={},line={},", file, place.substr(colon + 1)) : fmt::format("file={},", file);
}

std::string test_case(const CheckOutcome& outcome) {
  const std::string head =
      fmt::format(R"(    <testcase classname="{}" name="{}")", xml_escaped(outcome.suite), xml_escaped(outcome.name));
  if (outcome.failure.empty()) return head + "/>\n";
  return head + fmt::format(">\n      <failure message=\"{0}\">{0}</failure>\n    </testcase>\n",
                            xml_escaped(outcome.failure));
}

std::size_t failures_among(std::span<const CheckOutcome> outcomes) {
  return static_cast<std::size_t>(
      std::ranges::count_if(outcomes, [](const CheckOutcome& outcome) { return !outcome.failure.empty(); }));
}

}  // namespace

std::vector<CheckOutcome> check_outcomes(const ExperimentReport& report) {
  std::vector<CheckOutcome> outcomes;
  for (const ClaimOutcome& claim : report.claims) {
    outcomes.push_back({.suite = report.name,
                        .name = "claim " + claim.name,
                        .failure = claim.as_expected() ? "" : shortfall_of(claim),
                        .place = claim.place});
  }
  for (const ThresholdOutcome& threshold : report.thresholds) {
    outcomes.push_back({.suite = report.name,
                        .name = "threshold " + threshold.measure,
                        .failure = threshold.held() ? "" : shortfall_of(threshold),
                        .place = threshold.place});
  }
  return outcomes;
}

std::vector<std::string> shortfalls_of(std::span<const CheckOutcome> outcomes) {
  std::vector<std::string> lines;
  for (const CheckOutcome& outcome : outcomes) {
    if (!outcome.failure.empty()) lines.push_back(outcome.name + ": " + outcome.failure);
  }
  return lines;
}

std::string junit_xml(std::span<const CheckOutcome> outcomes) {
  std::string xml =
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites tests=\"{}\" failures=\"{}\">\n",
                  outcomes.size(), failures_among(outcomes));
  while (!outcomes.empty()) {
    const auto end = std::ranges::find_if(
        outcomes, [&](const CheckOutcome& outcome) { return outcome.suite != outcomes.front().suite; });
    const auto suite = outcomes.first(static_cast<std::size_t>(end - outcomes.begin()));
    xml += fmt::format("  <testsuite name=\"{}\" tests=\"{}\" failures=\"{}\">\n", xml_escaped(suite.front().suite),
                       suite.size(), failures_among(suite));
    for (const CheckOutcome& outcome : suite) xml += test_case(outcome);
    xml += "  </testsuite>\n";
    outcomes = outcomes.subspan(suite.size());
  }
  return xml + "</testsuites>\n";
}

std::string github_annotations(std::span<const CheckOutcome> outcomes) {
  std::string text;
  for (const CheckOutcome& outcome : outcomes) {
    if (outcome.failure.empty()) continue;
    text += fmt::format("::error {}title={}::{}\n", place_property(outcome.place),
                        command_escaped(outcome.suite + ": " + outcome.name, true),
                        command_escaped(outcome.failure, false));
  }
  return text;
}

}  // namespace footprint
