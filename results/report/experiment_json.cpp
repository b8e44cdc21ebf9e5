// See experiment_json.hpp.
#include "results/report/experiment_json.hpp"

#include <cmath>

#include "results/report/results_document.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

Json claim_json(const ClaimOutcome& claim) {
  Json figures = Json::array();
  for (const ClaimFigure& figure : claim.figures) {
    figures.push_back(
        {{"measure", figure.measure}, {"value", json_number(figure.value)}, {"at_noise_floor", figure.at_noise_floor}});
  }
  return {{"name", claim.name},
          {"text", claim.text},
          {"inequality", claim.inequality},
          {"expect", claim.expect},
          {"outcome", claim.outcome},
          {"as_expected", claim.as_expected()},
          {"reason", claim.reason},
          {"problem", claim.problem},
          {"left", json_number(claim.left)},
          {"right", json_number(claim.right)},
          {"figures", std::move(figures)}};
}

ClaimOutcome parse_claim(const JsonNode& node) {
  node.with_keys({"name", "text", "inequality", "expect", "outcome", "as_expected", "reason", "problem", "left",
                  "right", "figures"});
  ClaimOutcome claim{.name = node["name"].text(),
                     .text = node["text"].text(),
                     .inequality = node["inequality"].text(),
                     .expect = node["expect"].text(),
                     .outcome = node["outcome"].text(),
                     .reason = node["reason"].text(),
                     .problem = node["problem"].text(),
                     .left = node["left"].optional_number(),
                     .right = node["right"].optional_number(),
                     .figures = {}};
  for (const JsonNode& figure : node["figures"].elements()) {
    figure.with_keys({"measure", "value", "at_noise_floor"});
    claim.figures.push_back({.measure = figure["measure"].text(),
                             .value = figure["value"].number_or(std::nan("")),
                             .at_noise_floor = figure["at_noise_floor"].flag()});
  }
  if (node["as_expected"].flag() != claim.as_expected()) node["as_expected"].fail("contradicts expect and outcome");
  return claim;
}

Json published_json(const PublishedFigure& figure) {
  return {{"figure", figure.figure},
          {"measure", figure.measure},
          {"unit", figure.unit},
          {"published", json_number(figure.published)},
          {"measured", json_number(figure.measured)},
          {"note", figure.note}};
}

PublishedFigure parse_published(const JsonNode& node) {
  node.with_keys({"figure", "measure", "unit", "published", "measured", "note"});
  return {.figure = node["figure"].text(),
          .measure = node["measure"].text(),
          .unit = node["unit"].text(),
          .published = node["published"].number(),
          .measured = node["measured"].optional_number(),
          .note = node["note"].text()};
}

Json threshold_json(const ThresholdOutcome& threshold) {
  return {{"measure", threshold.measure},
          {"limit", json_number(threshold.limit)},
          {"measured", json_number(threshold.measured)},
          {"held", threshold.held()},
          {"problem", threshold.problem}};
}

ThresholdOutcome parse_threshold(const JsonNode& node) {
  node.with_keys({"measure", "limit", "measured", "held", "problem"});
  ThresholdOutcome threshold{.measure = node["measure"].text(),
                             .limit = node["limit"].number(),
                             .measured = node["measured"].optional_number(),
                             .problem = node["problem"].text()};
  if (node["held"].flag() != threshold.held()) node["held"].fail("contradicts limit and measured");
  return threshold;
}

}  // namespace

Json experiment_json(const ExperimentReport& report) {
  Json published = Json::array(), claims = Json::array(), thresholds = Json::array();
  for (const PublishedFigure& figure : report.published) published.push_back(published_json(figure));
  for (const ClaimOutcome& claim : report.claims) claims.push_back(claim_json(claim));
  for (const ThresholdOutcome& threshold : report.thresholds) thresholds.push_back(threshold_json(threshold));
  return {{"name", report.name},
          {"title", report.title},
          {"description", report.description},
          {"file", report.file},
          {"quick", report.quick},
          {"published", std::move(published)},
          {"claims", std::move(claims)},
          {"thresholds", std::move(thresholds)},
          {"pictures", report.pictures}};
}

ExperimentReport parse_experiment(const JsonNode& node) {
  node.with_keys({"name", "title", "description", "file", "quick", "published", "claims", "thresholds", "pictures"});
  ExperimentReport report{.name = node["name"].text(),
                          .title = node["title"].text(),
                          .description = node["description"].text(),
                          .file = node["file"].text(),
                          .quick = node["quick"].flag(),
                          .published = {},
                          .claims = {},
                          .thresholds = {},
                          .pictures = node["pictures"].texts()};
  for (const JsonNode& figure : node["published"].elements()) report.published.push_back(parse_published(figure));
  for (const JsonNode& claim : node["claims"].elements()) report.claims.push_back(parse_claim(claim));
  for (const JsonNode& limit : node["thresholds"].elements()) report.thresholds.push_back(parse_threshold(limit));
  return report;
}

}  // namespace footprint
