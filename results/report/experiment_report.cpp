// Lays out what became of an experiment as tables and sentences, in Markdown and in HTML.
#include "results/report/experiment_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string_view>

#include "results/report/check_outcomes.hpp"
#include "results/report/figures.hpp"
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
              .columns = {{"Printed in", false}, {"Measure", false}, {"Published"}, {"Measured"}, {"Note", false}},
              .rows = {}};
  for (const PublishedFigure& figure : report.published) {
    table.rows.push_back({figure.figure, figure.measure, with_unit(figure.published, figure.unit),
                          with_unit(figure.measured, figure.unit), figure.note});
  }
  return table;
}

// As people write it.
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
              .columns = {{"Claim", false}, {"Inequality", false}, {"Left"}, {"Right"}, {"Outcome", false}},
              .rows = {}};
  for (const ClaimOutcome& claim : report.claims) {
    table.rows.push_back(
        {claim.name, claim.inequality, figure_text(claim.left), figure_text(claim.right), outcome_text(claim)});
  }
  return table;
}

Table second_verdicts_table(const ExperimentReport& report) {
  Table table{.heading = "Claims over times, by estimated cost",
              .columns = {{"Claim", false}, {"GPU", false}, {"Left"}, {"Right"}, {"Outcome", false}},
              .rows = {}};
  for (const SecondVerdict& verdict : report.second_verdicts) {
    table.rows.push_back({verdict.claim, verdict.gpu, figure_text(verdict.left), figure_text(verdict.right),
                          verdict.problem.empty() ? std::string(in_words(verdict.outcome)) : verdict.problem});
  }
  return table;
}

Table thresholds_table(const ExperimentReport& report) {
  Table table{
      .heading = "Thresholds", .columns = {{"Measure", false}, {"At most"}, {"Measured"}, {"", false}}, .rows = {}};
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

// The text of a claim, its figures, and the reason for its expected verdict.
std::string claim_sentence(const ClaimOutcome& claim) {
  return fmt::format("{}: {} {} Figures: {}. Expected to be {}: {}", claim.name, claim.text,
                     claim.as_expected() ? "" : "NOT AS EXPECTED.", figures_text(claim), in_words(claim.expect),
                     claim.reason);
}

std::string outcome_in_words(std::size_t fell_short, std::size_t checks) {
  if (checks == 0) return {};
  if (fell_short > 0) return fmt::format("{} of {} claims and thresholds failed.", fell_short, checks);
  return fmt::format("All {} claims and thresholds are as expected.", checks);
}

std::string summary(const ExperimentReport& report) {
  std::string text = outcome_in_words(report.shortfalls().size(), report.claims.size() + report.thresholds.size());
  if (!report.quick) return text;
  if (!text.empty()) text += " ";
  return text + "Test run (--quick): smaller than the experiment, so this is not a measurement.";
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
    if (table.rows.empty()) continue;
    text += fmt::format("\n### {}\n\n{}", table.heading, markdown_table(table.columns, table.rows));
    if (table.heading != "Claims") continue;
    text += "\n";
    for (const ClaimOutcome& claim : report.claims)
      text += fmt::format("- {}\n", markdown_escaped(claim_sentence(claim)));
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
    html += fmt::format("<li>{}</li>\n", html_escaped(claim_sentence(claim)));
  if (!report.claims.empty()) html += "</ul>\n";
  return html + html_table(second_verdicts_table(report)) + thresholds_html(report) + "</section>\n";
}

}  // namespace footprint
