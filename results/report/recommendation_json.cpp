// A recommendation as the document of docs/recommend.schema.json.
#include "results/report/recommendation.hpp"
#include "results/report/record_fields.hpp"
#include "results/report/results_document.hpp"

namespace footprint {

void fields(JsonWriter& archive, const Candidate& value) {
  archive("method", value.method);
  archive("footprint", value.footprint);
  archive("errors", value.errors);
  archive("error", value.error);
  archive("worst", value.worst);
  archive("noise", value.noise);
  archive("cost", value.cost);
  archive("bytes", value.bytes);
  archive("bake_seconds", value.bake_seconds);
}

void fields(JsonWriter& archive, const Limits& value) {
  archive("max_error", value.max_error);
  archive("max_cost", value.max_cost);
  archive("max_bytes", value.max_bytes);
}

void fields(JsonWriter& archive, const LeftOutMethod& value) {
  archive("method", value.method);
  archive("reason", value.reason);
}

// The advice and the limits that its sentences name.
struct WrittenAdvice {
  const MaterialAdvice& advice;
  const Limits& limits;
};

void fields(JsonWriter& archive, const WrittenAdvice& value) {
  const MaterialAdvice& advice = value.advice;
  archive("material", advice.material);
  archive("distances", advice.distances);
  archive("pixels", advice.pixels);
  archive("chosen", advice.choice.chosen);
  archive("tied", advice.choice.tied);
  archive("better", advice.choice.better);
  archive("nearest", advice.choice.nearest);
  archive("filter_nothing", advice.choice.filter_nothing);
  archive("closer_than_plain", advice.closer_than_plain);
  archive("command", advice.command);
  archive("words", advice_sentences(advice, value.limits));
  archive("candidates", advice.candidates);
}

void fields(JsonWriter& archive, const Recommendation& value) {
  std::vector<WrittenAdvice> materials;
  for (const MaterialAdvice& advice : value.materials) materials.push_back({advice, value.limits});
  archive("schema", "footprint-recommend/1");
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("reference", value.reference);
  archive("size", std::tie(value.width, value.height));
  archive("distances", value.distances);
  archive("limits", value.limits);
  archive("exhaustive", value.exhaustive);
  archive("tried", value.tried);
  archive("measured", value.measured);
  archive("coarse", value.coarse);
  archive("left_out", value.left_out);
  archive("reports", value.reports);
  archive("materials", materials);
}

std::string recommendation_json(const Recommendation& recommendation) {
  return json_text(to_json_value(recommendation), 2) + "\n";
}

}  // namespace footprint
