// Results to JSON; parse_results.cpp is the way back.
#include <cmath>

#include "results/report/experiment_json.hpp"
#include "results/report/report.hpp"
#include "results/report/results_document.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

Json number(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json number(const std::optional<double>& value) { return value ? number(*value) : Json(nullptr); }

Json options_json(const Record& record) {
  Json options = Json::object();
  for (const auto& [name, value] : record.options) {
    options[name] = std::visit([](const auto& held) { return Json(held); }, value);
  }
  return options;
}

Json error_json(const std::optional<RecordError>& error) {
  if (!error) return nullptr;
  return {{"normalized_color", number(error->normalized_color)},
          {"relative_rmse", number(error->relative_rmse)},
          {"relmse", number(error->relmse)},
          {"psnr", number(error->psnr)},
          {"energy_bias", number(error->energy_bias)},
          {"noise_floor", number(error->noise_floor)},
          {"representation", number(error->representation)},
          {"filtering", number(error->filtering)}};
}

Json other_references_json(const Record& record) {
  Json others = Json::array();
  for (const OtherReference& other : record.other_references) {
    others.push_back({{"spp", other.spp},
                      {"normalized_color", number(other.normalized_color)},
                      {"noise_floor", number(other.noise_floor)}});
  }
  return others;
}

Json flicker_json(const std::optional<Flicker>& flicker) {
  if (!flicker) return nullptr;
  return {
      {"mean", number(flicker->mean)}, {"p99", number(flicker->p99)}, {"noise_floor", number(flicker->noise_floor)}};
}

Json time_json(const Record& record) {
  return {{"frame_ms",
           {{"median", number(record.frame_ms.median)},
            {"min", number(record.frame_ms.minimum)},
            {"p90", number(record.frame_ms.p90)}}},
          {"frame_build_ms", number(record.frame_build_ms)},
          {"fps", number(record.fps)},
          {"ratio_to_direct",
           {{"median", number(record.ratio_to_direct.median)},
            {"min", number(record.ratio_to_direct.minimum)},
            {"max", number(record.ratio_to_direct.maximum)}}}};
}

Json record_json(const Record& record) {
  return {{"scene", record.scene},
          {"method", record.method},
          {"options", options_json(record)},
          {"distance", number(record.distance)},
          {"frame", record.frame},
          {"size", Json::array({record.width, record.height})},
          {"error", error_json(record.error)},
          {"equivalent_spp", number(record.equivalent_spp)},
          {"equivalent_bound", record.equivalent_bound},
          {"other_references", other_references_json(record)},
          {"flicker", flicker_json(record.flicker)},
          {"time", time_json(record)},
          {"precompute",
           {{"seconds", number(record.precompute_seconds)},
            {"bytes", record.precompute_bytes},
            {"cached", record.precompute_cached}}},
          {"effects", {{"on", record.effects_on}, {"left_out", record.effects_left_out}}},
          {"images",
           {{"color", record.images.color}, {"reference", record.images.reference}, {"error", record.images.error}}}};
}

Json supersampling_json(const SupersamplingPoint& point) {
  return {{"distance", number(point.distance)},
          {"spp", point.spp},
          {"normalized_color", number(point.normalized_color)},
          {"ms", number(point.ms)}};
}

Json scene_json(const SceneInfo& scene) {
  return {{"name", scene.name},
          {"source", scene.source},
          {"triangles", scene.triangles},
          {"materials", scene.materials},
          {"lights", scene.lights},
          {"exposure", number(scene.exposure)},
          {"exposure_source", scene.exposure_source},
          {"defaults", scene.defaults},
          {"warnings", scene.warnings}};
}

}  // namespace

nlohmann::ordered_json results_document(const Results& results) {
  Json supersampling = Json::array();
  for (const SupersamplingPoint& point : results.supersampling) supersampling.push_back(supersampling_json(point));
  Json records = Json::array();
  for (const Record& record : results.records) records.push_back(record_json(record));
  return {{"schema", results_schema},
          {"tool", {{"name", results.tool.name}, {"version", results.tool.version}}},
          {"backend",
           {{"name", results.backend.name},
            {"renderer", results.backend.renderer},
            {"version", results.backend.version},
            {"cpu", results.backend.cpu}}},
          {"scene", scene_json(results.scene)},
          {"reference",
           {{"spp", results.reference.spp},
            {"filter", results.reference.filter},
            {"seed", results.reference.seed},
            {"standard_error", number(results.reference.standard_error)}}},
          {"experiment", results.experiment ? experiment_json(*results.experiment) : Json(nullptr)},
          {"error_scale", number(results.error_scale)},
          {"supersampling", std::move(supersampling)},
          {"records", std::move(records)}};
}

std::string json_text(const nlohmann::ordered_json& document, int indent) {
  return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string results_json(const Results& results) { return json_text(results_document(results), 2) + "\n"; }

}  // namespace footprint
