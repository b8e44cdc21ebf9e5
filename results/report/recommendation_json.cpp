// A recommendation as the document of docs/recommend.schema.json.
#include <nlohmann/json.hpp>

#include "results/report/recommendation.hpp"
#include "results/report/results_document.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

template <typename Value>
Json or_null(const std::optional<Value>& value) {
  return value ? Json(*value) : Json();
}

Json candidate_json(const Candidate& candidate) {
  return {{"method", candidate.method},
          {"footprint", candidate.footprint},
          {"errors", candidate.errors},
          {"error", json_number(candidate.error)},
          {"worst", json_number(candidate.worst)},
          {"noise", json_number(candidate.noise)},
          {"cost",
           {{"median", json_number(candidate.cost.median)},
            {"low", json_number(candidate.cost.low)},
            {"high", json_number(candidate.cost.high)}}},
          {"bytes", candidate.bytes},
          {"bake_seconds", json_number(candidate.bake_seconds)}};
}

Json advice_json(const MaterialAdvice& advice, const Limits& limits) {
  Json candidates = Json::array();
  for (const Candidate& candidate : advice.candidates) candidates.push_back(candidate_json(candidate));
  Json closer;
  if (advice.closer_than_plain) closer = *advice.closer_than_plain;
  return {{"material", advice.material},
          {"distances", advice.distances},
          {"pixels", advice.pixels},
          {"chosen", or_null(advice.choice.chosen)},
          {"tied", advice.choice.tied},
          {"better", or_null(advice.choice.better)},
          {"nearest", or_null(advice.choice.nearest)},
          {"filter_nothing", advice.choice.filter_nothing},
          {"closer_than_plain", std::move(closer)},
          {"command", advice.command},
          {"words", advice_sentences(advice, limits)},
          {"candidates", std::move(candidates)}};
}

}  // namespace

std::string recommendation_json(const Recommendation& recommendation) {
  Json materials = Json::array();
  for (const MaterialAdvice& advice : recommendation.materials)
    materials.push_back(advice_json(advice, recommendation.limits));
  Json left_out = Json::array();
  for (const auto& [method, reason] : recommendation.left_out)
    left_out.push_back({{"method", method}, {"reason", reason}});
  const Json document{{"schema", "footprint-recommend/1"},
                      {"tool", tool_json(recommendation.tool)},
                      {"backend", backend_json(recommendation.backend)},
                      {"scene", scene_json(recommendation.scene)},
                      {"reference", reference_json(recommendation.reference)},
                      {"size", {recommendation.width, recommendation.height}},
                      {"distances", recommendation.distances},
                      {"limits",
                       {{"max_error", or_null(recommendation.limits.max_error)},
                        {"max_cost", or_null(recommendation.limits.max_cost)},
                        {"max_bytes", or_null(recommendation.limits.max_bytes)}}},
                      {"exhaustive", recommendation.exhaustive},
                      {"tried", recommendation.tried},
                      {"measured", recommendation.measured},
                      {"coarse", or_null(recommendation.coarse)},
                      {"left_out", std::move(left_out)},
                      {"reports", recommendation.reports},
                      {"materials", std::move(materials)}};
  return json_text(document, 2) + "\n";
}

}  // namespace footprint
