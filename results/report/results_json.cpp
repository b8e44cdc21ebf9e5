// Results as the document of docs/results.schema.json.
#include <cmath>
#include <nlohmann/json.hpp>

#include "results/report/experiment_json.hpp"
#include "results/report/figures.hpp"
#include "results/report/ranking.hpp"
#include "results/report/report.hpp"
#include "results/report/results_document.hpp"

namespace footprint {
namespace {

using Json = nlohmann::ordered_json;

Json options_json(const Record& record) {
  Json options = Json::object();
  for (const auto& [name, value] : record.options) {
    options[name] = std::visit([](const auto& held) { return Json(held); }, value);
  }
  return options;
}

Json error_json(const std::optional<RecordError>& error) {
  if (!error) return nullptr;
  return {{"normalized_color", json_number(error->normalized_color)},
          {"relative_rmse", json_number(error->relative_rmse)},
          {"relmse", json_number(error->relmse)},
          {"psnr", json_number(error->psnr)},
          {"energy_bias", json_number(error->energy_bias)},
          {"luminance_distance", json_number(error->luminance_distance)},
          {"luminances", error->luminances},
          {"reference_luminances", error->reference_luminances},
          {"noise_floor", json_number(error->noise_floor)},
          {"representation", json_number(error->representation)},
          {"filtering", json_number(error->filtering)},
          {"shading", json_number(error->causes.shading)},
          {"shading_floor", json_number(error->causes.shading_floor)},
          {"shading_noise", json_number(error->causes.shading_noise)},
          {"edges", json_number(error->causes.edges)},
          {"filter", json_number(error->causes.filter)},
          {"method", json_number(error->causes.method)},
          {"light", json_number(error->causes.light)}};
}

Json pixels_json(const PixelCounts& pixels) {
  return {{"object", pixels.object},
          {"unresolved", pixels.unresolved},
          {"interior", pixels.interior},
          {"minified", pixels.minified},
          {"bound", pixels.bound ? Json(*pixels.bound) : Json()},
          {"light", pixels.light ? Json(*pixels.light) : Json()}};
}

Json other_references_json(const Record& record) {
  Json others = Json::array();
  for (const OtherReference& other : record.other_references) {
    others.push_back({{"spp", other.spp},
                      {"normalized_color", json_number(other.normalized_color)},
                      {"noise_floor", json_number(other.noise_floor)}});
  }
  return others;
}

Json time_json(const Record& record) {
  const std::optional<FrameBuildTime>& build = record.frame_build;
  return {{"node", record.node},
          {"frame_ms",
           {{"median", json_number(record.frame_ms.median)},
            {"min", json_number(record.frame_ms.minimum)},
            {"p90", json_number(record.frame_ms.p90)}}},
          {"frame_build_ms", build ? json_number(build->ms) : Json()},
          {"frame_build", build ? Json(timing_name(build->timing)) : Json()},
          {"fps", json_number(record.fps)},
          {"fetches", record.work ? json_number(record.work->fetches) : Json(nullptr)},
          {"lobes", record.work ? json_number(record.work->lobes) : Json(nullptr)},
          {"ratio_to_direct",
           {{"median", json_number(record.ratio_to_direct.median)},
            {"low", json_number(record.ratio_to_direct.low)},
            {"high", json_number(record.ratio_to_direct.high)}}}};
}

Json record_json(const Record& record) {
  return {{"scene", record.scene},
          {"method", record.method},
          {"options", options_json(record)},
          {"distance", json_number(record.distance)},
          {"frame", record.frame},
          {"size", Json::array({record.width, record.height})},
          {"failure", record.failure ? Json(*record.failure) : Json()},
          {"pixels", pixels_json(record.pixels)},
          {"error", error_json(record.error)},
          {"equivalent_spp", json_number(equivalent_spp(record))},
          {"equivalent_bound", equivalent_bound(record)},
          {"other_references", other_references_json(record)},
          {"flicker", flicker_json(record.flicker)},
          {"time", time_json(record)},
          {"precompute",
           {{"seconds", json_number(record.precompute_seconds)},
            {"bytes", record.precompute_bytes},
            {"bytes_per_texel", json_number(record.precompute_bytes_per_texel)},
            {"cached", record.precompute_cached}}},
          {"effects", {{"on", record.effects_on}, {"left_out", record.effects_left_out}}},
          {"images",
           {{"color", record.images.color},
            {"reference", record.images.reference},
            {"error", record.images.error},
            {"error_shared", record.images.error_shared},
            {"interior", record.images.interior},
            {"standard_error", record.images.standard_error}}}};
}

Json pair_json(const MethodPair& pair) {
  return {{"distance", json_number(pair.distance)},
          {"methods", pair.methods},
          {"closer", Json::array({json_number(pair.closer[0]), json_number(pair.closer[1])})},
          {"picture", pair.picture}};
}

Json ndf_json(const FootprintNdf& figures) {
  return {{"footprint", figures.footprint},    {"method", figures.method},
          {"l2", json_number(figures.l2)},     {"energy", json_number(figures.energy)},
          {"peak", json_number(figures.peak)}, {"lobes", figures.lobes},
          {"picture", figures.picture}};
}

Json quantity_json(const QuantityFigure& figure) {
  return {{"name", figure.name},
          {"method", figure.method},
          {"quantity", figure.quantity},
          {"value", json_number(figure.value)}};
}

Json supersampling_json(const SupersamplingPoint& point) {
  return {{"distance", json_number(point.distance)},
          {"spp", point.spp},
          {"normalized_color", json_number(point.normalized_color)},
          {"shading", json_number(point.shading)},
          {"ms", json_number(point.ms)},
          {"node", point.node}};
}

}  // namespace

Json json_number(const std::optional<double>& value) {
  return value && std::isfinite(*value) ? Json(*value) : Json(nullptr);
}

Json flicker_json(const std::optional<Flicker>& flicker) {
  if (!flicker) return nullptr;
  return {{"mean", json_number(flicker->mean)},
          {"p99", json_number(flicker->p99)},
          {"noise_floor", json_number(flicker->noise_floor)}};
}

Json tool_json(const ToolInfo& tool) { return {{"name", tool.name}, {"version", tool.version}}; }

Json backend_json(const BackendInfo& backend) {
  return {{"name", backend.name}, {"renderer", backend.renderer}, {"version", backend.version}, {"cpu", backend.cpu}};
}

Json scene_json(const SceneInfo& scene) {
  return {{"name", scene.name},
          {"source", scene.source},
          {"triangles", scene.triangles},
          {"materials", scene.materials},
          {"lights", scene.lights},
          {"exposure", json_number(scene.exposure)},
          {"exposure_source", scene.exposure_source},
          {"defaults", scene.defaults},
          {"warnings", scene.warnings}};
}

Json reference_json(const ReferenceInfo& reference) {
  Json standard_errors = Json::array();
  for (const std::optional<double>& error : reference.standard_errors) standard_errors.push_back(json_number(error));
  return {{"spp", reference.spp},
          {"filter", reference.filter},
          {"seed", reference.seed},
          {"standard_errors", std::move(standard_errors)},
          {"samples", json_number(reference.samples)},
          {"seconds", json_number(reference.seconds)},
          {"environment", reference.environment.empty() ? Json(nullptr) : Json(reference.environment)}};
}

Json timing_json(const TimingInfo& timing) { return {{"frames", timing.frames}, {"processes", timing.processes}}; }

nlohmann::ordered_json results_document(const Results& results) {
  Json supersampling = Json::array();
  for (const SupersamplingPoint& point : results.supersampling) supersampling.push_back(supersampling_json(point));
  Json records = Json::array();
  for (const Record& record : results.records) records.push_back(record_json(record));
  Json pairs = Json::array();
  for (const MethodPair& pair : results.pairs) pairs.push_back(pair_json(pair));
  Json ndf = Json::array();
  for (const FootprintNdf& figures : results.ndf) ndf.push_back(ndf_json(figures));
  Json quantities = Json::array();
  for (const QuantityFigure& figure : results.quantities) quantities.push_back(quantity_json(figure));
  Json scales = Json::array();
  for (const ErrorScale& scale : results.error_scales)
    scales.push_back({{"distance", json_number(scale.distance)}, {"error", json_number(scale.error)}});
  return {{"schema", results_schema},
          {"tool", tool_json(results.tool)},
          {"backend", backend_json(results.backend)},
          {"scene", scene_json(results.scene)},
          {"reference", reference_json(results.reference)},
          {"footprint", results.footprint},
          {"timing", timing_json(results.timing)},
          {"experiment", results.experiment ? experiment_json(*results.experiment) : Json(nullptr)},
          {"ranking_warnings", ranking_warnings(results)},
          {"error_scale", json_number(results.error_scale)},
          {"error_scales", std::move(scales)},
          {"supersampling", std::move(supersampling)},
          {"records", std::move(records)},
          {"pairs", std::move(pairs)},
          {"ndf", std::move(ndf)},
          {"quantities", std::move(quantities)},
          {"files", results.files}};
}

std::string json_text(const nlohmann::ordered_json& document, int indent) {
  return document.dump(indent, ' ', false, Json::error_handler_t::replace);
}

std::string results_json(const Results& results) { return json_text(results_document(results), 2) + "\n"; }

}  // namespace footprint
