// An experiment's claims, thresholds and published figures as JSON objects.
#include "results/report/experiment_json.hpp"

#include <nlohmann/json.hpp>

#include "results/report/figures.hpp"
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
          {"expect", verdict_name(claim.expect)},
          {"outcome", verdict_name(claim.outcome)},
          {"as_expected", claim.as_expected()},
          {"reason", claim.reason},
          {"problem", claim.problem},
          {"left", json_number(claim.left)},
          {"right", json_number(claim.right)},
          {"figures", std::move(figures)}};
}

Json published_json(const PublishedFigure& figure) {
  return {{"figure", figure.figure},
          {"measure", figure.measure},
          {"unit", figure.unit},
          {"published", json_number(figure.published)},
          {"measured", json_number(figure.measured)},
          {"note", figure.note}};
}

Json threshold_json(const ThresholdOutcome& threshold) {
  return {{"measure", threshold.measure},
          {"limit", json_number(threshold.limit)},
          {"measured", json_number(threshold.measured)},
          {"held", threshold.held()},
          {"problem", threshold.problem}};
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

}  // namespace footprint
