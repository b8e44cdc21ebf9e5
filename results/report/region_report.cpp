// Counts outcomes over a grid, and draws each claim's as a table of dots.
#include "results/report/region_report.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>

#include "results/report/page.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/report.hpp"

namespace footprint {
namespace {

constexpr std::string_view verdict_legend = "● true, ○ false, – undecided";

std::string_view dot_of(Verdict verdict) {
  if (verdict == Verdict::undecided) return "–";
  return verdict == Verdict::reproduced ? "●" : "○";
}

// "size 32x32"; a method says itself what it is.
std::string value_text(const RegionAxis& axis, const std::string& value) {
  return value.starts_with(axis.key) ? value : fmt::format("{} {}", axis.key, value);
}

// The values of one axis with which a claim has an outcome, in the axis' order.
std::vector<std::string> values_with(Verdict verdict, const RegionReport& report, const RegionClaim& claim,
                                     std::size_t axis) {
  std::set<std::string> found;
  for (std::size_t i = 0; i < claim.outcomes.size(); ++i) {
    if (claim.outcomes[i] == verdict) found.insert(report.settings[i].values[axis].second);
  }
  std::vector<std::string> values;
  std::ranges::copy_if(report.axes[axis].values, std::back_inserter(values),
                       [&](const std::string& value) { return found.contains(value); });
  return values;
}

// "all of them with distance 0.5 or 1 and footprint trilinear"; empty where no axis restricts the outcome.
std::string restriction(Verdict verdict, const RegionReport& report, const RegionClaim& claim) {
  std::vector<std::string> parts;
  for (std::size_t axis = 0; axis < report.axes.size(); ++axis) {
    const std::vector<std::string> values = values_with(verdict, report, claim, axis);
    if (values.size() < report.axes[axis].values.size())
      parts.push_back(value_text(report.axes[axis], fmt::format("{}", fmt::join(values, " or "))));
  }
  return parts.empty() ? std::string() : fmt::format(", all of them with {}", fmt::join(parts, " and "));
}

std::string stated_words(Verdict stated) {
  if (stated == Verdict::undecided) return "at the stated setting it is undecided";
  return fmt::format("at the stated setting it is {}", stated == Verdict::reproduced ? "true" : "false");
}

// One row per combination of all axes but the last, one column per value of the last.
Table map_of(const RegionReport& report, const RegionClaim& claim) {
  Table table;
  const RegionAxis& last = report.axes.back();
  for (std::size_t axis = 0; axis + 1 < report.axes.size(); ++axis)
    table.columns.push_back({report.axes[axis].key, false});
  for (const std::string& value : last.values) table.columns.push_back({value_text(last, value), false});
  for (std::size_t i = 0; i < claim.outcomes.size(); i += last.values.size()) {
    std::vector<std::string>& row = table.rows.emplace_back();
    for (std::size_t axis = 0; axis + 1 < report.axes.size(); ++axis)
      row.push_back(report.settings[i].values[axis].second);
    for (std::size_t j = 0; j < last.values.size(); ++j) row.emplace_back(dot_of(claim.outcomes[i + j]));
  }
  return table;
}

std::string heading_of(const RegionReport& report) {
  return fmt::format("Where the claims of {} are true", report.title);
}

std::string lede_of(const RegionReport& report) {
  return fmt::format("{} settings of what the paper leaves open. {}.{}", report.settings.size(), verdict_legend,
                     report.quick ? " Test run (--quick): no measurement." : "");
}

}  // namespace

std::size_t RegionClaim::count(Verdict verdict) const {
  return static_cast<std::size_t>(std::ranges::count(outcomes, verdict));
}

std::string region_sentence(const RegionReport& report, const RegionClaim& claim) {
  const std::size_t held = claim.count(Verdict::reproduced), undecided = claim.count(Verdict::undecided);
  std::string text = fmt::format("True in {} of {} settings", held, claim.outcomes.size());
  if (held > 0) text += restriction(Verdict::reproduced, report, claim);
  if (undecided > 0) text += fmt::format(", undecided in {}", undecided);
  return fmt::format("{}; {}.", text, stated_words(claim.stated));
}

std::string region_json(const RegionReport& report) {
  RegionReport whole = report;
  for (RegionClaim& claim : whole.claims) claim.sentence = region_sentence(report, claim);
  return json_text(to_json_value(whole), 2) + "\n";
}

std::string region_table(const RegionReport& report) {
  std::string text = fmt::format("# {}\n\n{}\n", markdown_escaped(heading_of(report)), lede_of(report));
  for (const RegionClaim& claim : report.claims)
    text += fmt::format("\n## {}\n\n{} {}\n\n{}", markdown_escaped(claim.name), markdown_escaped(claim.text),
                        markdown_escaped(region_sentence(report, claim)), markdown_table(map_of(report, claim)));
  return text;
}

std::string region_page(const RegionReport& report) {
  Page page{.title = heading_of(report),
            .eyebrow = "the settings that a paper leaves open",
            .lede = lede_of(report),
            .text = region_table(report)};
  for (const RegionClaim& claim : report.claims)
    page.sections.push_back({.heading = claim.name,
                             .sentences = {claim.text, claim.inequality, region_sentence(report, claim)},
                             .table = map_of(report, claim)});
  return page_html(page);
}

void write_region(const RegionReport& report, const RunFolder& folder) {
  folder.write_document("region.json", region_json(report));
  folder.write_text("table.md", [&] { return region_table(report); });
  folder.write_text("index.html", [&] { return region_page(report); });
}

}  // namespace footprint
