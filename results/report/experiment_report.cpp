// Lays out the outcome of an experiment as tables and sentences, in Markdown and in HTML; outcomes as text, each format
// with its own escapes; baselines as JSON, and their differences.
#include "results/report/experiment_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <nlohmann/json.hpp>
#include <optional>
#include <string_view>

#include "renderer/core/error.hpp"
#include "results/report/page.hpp"

namespace footprint {
namespace {

constexpr const char* floor_mark = " *";

// Three figures: errors with as many decimals as they need.
std::string figure_text(const std::optional<double>& value) {
  if (!value) return "n/a";
  return std::abs(*value) < 1 ? error_text(*value) : three_figures(*value);
}

std::string with_unit(const std::optional<double>& value, const std::string& unit) {
  const std::string text = figure_text(value);
  return value && !unit.empty() ? text + " " + unit : text;
}

Table published_table(const ExperimentReport& report) {
  Table table{.heading = "Measured and published",
              .columns = {{"Printed in", false}, {"Measure", false}, {"Published"}, {"Measured"}, {"Note", false}}};
  for (const PublishedFigure& figure : report.published) {
    table.rows.push_back({figure.figure, figure.measure, with_unit(figure.published, figure.unit),
                          with_unit(figure.measured, figure.unit), figure.note});
  }
  return table;
}

// The words for a verdict as people write it.
std::string_view in_words(Verdict verdict) {
  return verdict == Verdict::not_reproduced ? "not reproduced" : word_for(verdict_words, verdict);
}

std::string outcome_text(const ClaimOutcome& claim) {
  const std::string_view outcome = in_words(claim.outcome);
  return claim.as_expected() ? std::string(outcome) : fmt::format("{}, expected {}", outcome, in_words(claim.expect));
}

std::string figures_text(const ClaimOutcome& claim) {
  std::vector<std::string> parts;
  for (const ClaimFigure& figure : claim.figures) {
    parts.push_back(
        fmt::format("{} = {}{}", figure.measure, figure_text(figure.value), figure.at_noise_floor ? floor_mark : ""));
  }
  if (!claim.problem.empty()) parts.push_back(claim.problem);
  return fmt::format("{}", fmt::join(parts, "; "));
}

Table claims_table(const ExperimentReport& report) {
  Table table{.heading = "Claims",
              .columns = {{"Claim", false}, {"Inequality", false}, {"Left"}, {"Right"}, {"Outcome", false}}};
  for (const ClaimOutcome& claim : report.claims) {
    table.rows.push_back(
        {claim.name, claim.inequality, figure_text(claim.left), figure_text(claim.right), outcome_text(claim)});
  }
  return table;
}

Table second_verdicts_table(const ExperimentReport& report) {
  Table table{.heading = "Claims over times, by estimated cost",
              .columns = {{"Claim", false}, {"GPU", false}, {"Left"}, {"Right"}, {"Outcome", false}}};
  for (const SecondVerdict& verdict : report.second_verdicts) {
    table.rows.push_back({verdict.claim, verdict.gpu, figure_text(verdict.left), figure_text(verdict.right),
                          verdict.problem.empty() ? std::string(in_words(verdict.outcome)) : verdict.problem});
  }
  return table;
}

Table thresholds_table(const ExperimentReport& report) {
  Table table{.heading = "Thresholds", .columns = {{"Measure", false}, {"At most"}, {"Measured"}, {"", false}}};
  for (const ThresholdOutcome& threshold : report.thresholds) {
    table.rows.push_back({threshold.measure, figure_text(threshold.limit),
                          threshold.problem.empty() ? figure_text(threshold.measured) : threshold.problem,
                          threshold.passed() ? "passed" : "failed"});
  }
  return table;
}

// Folded if all passed.
std::string thresholds_html(const ExperimentReport& report) {
  if (report.thresholds.empty()) return {};
  const auto passed = std::ranges::count_if(report.thresholds, &ThresholdOutcome::passed);
  const auto all = std::ssize(report.thresholds);
  return fmt::format("<details{}><summary>{} of {} thresholds passed</summary>\n{}</details>\n",
                     passed == all ? "" : " open", passed, all, html_table(thresholds_table(report)));
}

// The sides of a claim by estimated cost, a line per GPU that has an estimate.
std::vector<std::string> estimate_lines(const ClaimOutcome& claim, const std::vector<SecondVerdict>& verdicts) {
  std::vector<std::string> lines;
  for (const SecondVerdict& verdict : verdicts) {
    if (verdict.claim != claim.name || !verdict.left || !verdict.right) continue;
    lines.push_back(fmt::format("Estimated for {}: {} against {}.", verdict.gpu, figure_text(verdict.left),
                                figure_text(verdict.right)));
  }
  return lines;
}

// The text of a claim with its figures, estimates, why no figure decides it, and the reason for its expected verdict:
// one line, or several if there is more than the usual two sentences.
std::vector<std::string> claim_lines(const ClaimOutcome& claim, const std::vector<SecondVerdict>& verdicts) {
  const std::string expected = fmt::format("Expected to be {}: {}", in_words(claim.expect), claim.reason);
  std::vector<std::string> lines = estimate_lines(claim, verdicts);
  if (!claim.undecidable.empty() && claim.undecidable != claim.reason)
    lines.push_back(fmt::format("Undecided: {}.", claim.undecidable));
  std::string first = fmt::format("{}: {} {} Figures: {}.", claim.name, claim.text,
                                  claim.as_expected() ? "" : "NOT AS EXPECTED.", figures_text(claim));
  if (lines.empty()) return {first + " " + expected};
  lines.insert(lines.begin(), std::move(first));
  lines.push_back(expected);
  return lines;
}

// A claim as an item of a Markdown list, whose further lines are indented.
std::string claim_item(const ClaimOutcome& claim, const std::vector<SecondVerdict>& verdicts) {
  std::string text;
  for (const std::string& line : claim_lines(claim, verdicts))
    text += (text.empty() ? "- " : "  ") + markdown_escaped(line) + "\n";
  return text;
}

std::size_t undecidable_count(const std::vector<ClaimOutcome>& claims) {
  return static_cast<std::size_t>(
      std::ranges::count_if(claims, [](const ClaimOutcome& claim) { return !claim.undecidable.empty(); }));
}

std::string summary(const ExperimentReport& report) {
  const std::size_t failed = report.shortfalls().size(), checks = report.claims.size() + report.thresholds.size();
  const std::size_t undecided = undecidable_count(report.claims);
  std::string text;
  if (checks > 0) text = fmt::format("All {} claims and thresholds are as expected.", checks);
  if (failed > 0) text = fmt::format("{} of {} claims and thresholds failed.", failed, checks);
  if (undecided > 0) text.insert(text.size() - 1, fmt::format(", {} undecided", undecided));
  if (!report.quick) return text;
  if (!text.empty()) text += " ";
  return text + "Test run (--quick): smaller than the experiment, so this is not a measurement.";
}

// XML 1.0: characters that no document may contain, not even escaped, become blanks.
std::string xml_escaped(std::string_view text) {
  std::string out = escaped(html_escaped(text), {{'\n', "&#10;"}});
  std::ranges::replace_if(
      out, [](unsigned char c) { return c < 0x20; }, ' ');
  return out;
}

// Text as workflow commands take it: a property also ends at a comma, and its name at a colon.
std::string command_escaped(std::string_view text, bool is_property) {
  const std::string out = escaped(text, {{'%', "%25"}, {'\r', "%0D"}, {'\n', "%0A"}});
  return is_property ? escaped(out, {{':', "%3A"}, {',', "%2C"}}) : out;
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
  if (!outcome.failure.empty()) {
    return head + fmt::format(">\n      <failure message=\"{0}\">{0}</failure>\n    </testcase>\n",
                              xml_escaped(outcome.failure));
  }
  if (outcome.undecided.empty()) return head + "/>\n";
  return head + fmt::format(">\n      <skipped message=\"{}\"/>\n    </testcase>\n", xml_escaped(outcome.undecided));
}

// The attributes of a suite, or of all: tests, failures and, where there are any, skipped tests.
std::string junit_counts(std::span<const CheckOutcome> outcomes) {
  const auto failed = std::ranges::count_if(outcomes, [](const CheckOutcome& o) { return !o.failure.empty(); });
  const auto skipped = std::ranges::count_if(outcomes, [](const CheckOutcome& o) { return !o.undecided.empty(); });
  const std::string counts = fmt::format(R"(tests="{}" failures="{}")", outcomes.size(), failed);
  return skipped == 0 ? counts : counts + fmt::format(R"( skipped="{}")", skipped);
}

constexpr const char* baseline_schema = "footprint-baseline/1";

using Figures = std::map<std::string, double>;
using Records = std::map<std::string, Figures>;

template <class Map>
const typename Map::mapped_type* find(const Map& map, const std::string& key) {
  const auto found = map.find(key);
  return found == map.end() ? nullptr : &found->second;
}

// The difference of a figure in words; none without one.
std::optional<std::string> difference(const std::string& name, const double* before, const double* now,
                                      double tolerance) {
  if (before == nullptr) return fmt::format("{} {:.6g}, missing in the baseline", name, *now);
  if (now == nullptr) return fmt::format("{} is missing, was {:.6g}", name, *before);
  const double allowed = name == "bytes" ? 0.0 : tolerance;
  if (std::abs(*now - *before) <= allowed) return {};
  return fmt::format("{} {:.6g}, was {:.6g}", name, *now, *before);
}

std::string differences(const Figures* before, const Figures* now, double tolerance) {
  if (before == nullptr) return "this record is missing in the baseline";
  if (now == nullptr) return "this record is missing in the run";
  Figures all = *before;
  all.insert(now->begin(), now->end());
  std::string text;
  for (const auto& [name, figure] : all) {
    const auto found = difference(name, find(*before, name), find(*now, name), tolerance);
    if (found) text += (text.empty() ? "" : "; ") + *found;
  }
  return text;
}

}  // namespace

std::string shortfall_of(const ClaimOutcome& claim) {
  return fmt::format("{}: {} ({})", outcome_text(claim), claim.inequality, figures_text(claim));
}

std::string shortfall_of(const ThresholdOutcome& threshold) {
  return fmt::format(
      "at most {}, {}", figure_text(threshold.limit),
      threshold.problem.empty() ? "measured " + figure_text(threshold.measured) : "not measured: " + threshold.problem);
}

std::vector<std::string> ExperimentReport::shortfalls() const { return shortfalls_of(check_outcomes(*this)); }

std::string experiment_markdown(const ExperimentReport& report) {
  std::string text = fmt::format("\n## Experiment {}\n\n{}\n\n{}\n", markdown_escaped(report.name),
                                 markdown_escaped(report.title), summary(report));
  for (const Table& table :
       {published_table(report), claims_table(report), second_verdicts_table(report), thresholds_table(report)}) {
    text += markdown_section(table, 3);
    if (table.rows.empty() || table.heading != "Claims") continue;
    text += "\n";
    for (const ClaimOutcome& claim : report.claims) text += claim_item(claim, report.second_verdicts);
  }
  for (const std::string& line : report.shortfalls()) text += fmt::format("\n**Failed:** {}\n", markdown_escaped(line));
  return text;
}

std::string experiment_html(const ExperimentReport& report) {
  std::string html = fmt::format(
      "<section aria-labelledby=\"experiment-title\" id=\"experiment\">\n<h2 "
      "id=\"experiment-title\">{}</h2>\n<p>{}</p>\n"
      "<p class=\"outcome {}\">{}</p>\n",
      html_escaped(report.title), html_escaped(report.description), report.shortfalls().empty() ? "note" : "warning",
      html_escaped(summary(report)));
  for (const std::string& picture : report.pictures) {
    html += fmt::format("<p><img class=\"figure\" src=\"{0}\" alt=\"{0}\"></p>\n", html_escaped(picture));
  }
  html += html_table(published_table(report)) + html_table(claims_table(report));
  if (!report.claims.empty()) html += "<ul>\n";
  for (const ClaimOutcome& claim : report.claims)
    html += fmt::format("<li>{}</li>\n",
                        html_escaped(fmt::format("{}", fmt::join(claim_lines(claim, report.second_verdicts), " "))));
  if (!report.claims.empty()) html += "</ul>\n";
  return html + html_table(second_verdicts_table(report)) + thresholds_html(report) + "</section>\n";
}

std::vector<CheckOutcome> check_outcomes(const ExperimentReport& report) {
  std::vector<CheckOutcome> outcomes;
  for (const ClaimOutcome& claim : report.claims) {
    outcomes.push_back({.suite = report.name,
                        .name = "claim " + claim.name,
                        .failure = claim.as_expected() ? "" : shortfall_of(claim),
                        .undecided = claim.as_expected() ? claim.undecidable : "",
                        .place = claim.place});
  }
  for (const ThresholdOutcome& threshold : report.thresholds) {
    outcomes.push_back({.suite = report.name,
                        .name = "threshold " + threshold.measure,
                        .failure = threshold.passed() ? "" : shortfall_of(threshold),
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
      fmt::format("<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n<testsuites {}>\n", junit_counts(outcomes));
  while (!outcomes.empty()) {
    const auto end = std::ranges::find_if(
        outcomes, [&](const CheckOutcome& outcome) { return outcome.suite != outcomes.front().suite; });
    const auto suite = outcomes.first(static_cast<std::size_t>(end - outcomes.begin()));
    xml += fmt::format("  <testsuite name=\"{}\" {}>\n", xml_escaped(suite.front().suite), junit_counts(suite));
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

BaselineFigures baseline_figures(const Results& results) {
  BaselineFigures figures;
  Records& records = figures[results.experiment ? results.experiment->name : results.scene.name];
  for (const Record& record : results.records) {
    Figures& own = records[fmt::format("{} at {}", record.method, record.distance)];
    own["bytes"] = static_cast<double>(record.precompute_bytes);
    if (record.error) own["error"] = record.error->normalized_color;
    if (record.error && record.error->causes.shading) own["shading"] = *record.error->causes.shading;
    if (record.flicker) own["flicker"] = record.flicker->mean;
  }
  return figures;
}

std::string baseline_json(const Baseline& baseline) {
  const nlohmann::ordered_json document{
      {"schema", baseline_schema}, {"tolerance", baseline.tolerance}, {"figures", baseline.figures}};
  return document.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

Baseline parse_baseline(const std::string& text, const std::string& place) {
  const auto refuse = [&](const std::string& why) {
    throw Error(ErrorKind::usage, place, why, "delete it and use --update-baseline to write a new one");
  };
  Baseline baseline;
  try {
    const nlohmann::json document = nlohmann::json::parse(text);
    if (!document.is_object() || document.value("schema", "") != baseline_schema)
      refuse(fmt::format("is not a baseline of format {}", baseline_schema));
    baseline.tolerance = document.at("tolerance");
    baseline.figures = document.at("figures").get<BaselineFigures>();
  } catch (const nlohmann::json::exception&) {
    refuse("is damaged");
  }
  if (!(baseline.tolerance >= 0.0)) refuse("has a tolerance below 0");
  return baseline;
}

std::vector<CheckOutcome> compare_with_baseline(const Baseline& baseline, const BaselineFigures& now,
                                                const std::string& file) {
  static const Records none;
  std::vector<CheckOutcome> outcomes;
  for (const auto& [experiment, records] : now) {
    const Records* const known = find(baseline.figures, experiment);
    const Records& before = known == nullptr ? none : *known;
    Records all = before;
    all.insert(records.begin(), records.end());
    for (const auto& [name, figures] : all) {
      outcomes.push_back({.suite = experiment,
                          .name = "baseline " + name,
                          .failure = differences(find(before, name), find(records, name), baseline.tolerance),
                          .place = file});
    }
  }
  return outcomes;
}

}  // namespace footprint
