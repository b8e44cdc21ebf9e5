// JSON to Results, strictly; results_json.cpp is the way there.
#include <limits>

#include "results/report/experiment_json.hpp"
#include "results/report/json_node.hpp"
#include "results/report/report.hpp"
#include "results/report/results_document.hpp"

namespace footprint {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
constexpr double not_a_number = std::numeric_limits<double>::quiet_NaN();

std::map<std::string, std::variant<double, std::string>> parse_options(const JsonNode& node) {
  std::map<std::string, std::variant<double, std::string>> options;
  for (const auto& [name, value] : node.members()) {
    if (value.is_text()) {
      options.emplace(name, value.text());
    } else {
      options.emplace(name, value.number());
    }
  }
  return options;
}

std::optional<RecordError> parse_error(const JsonNode& node) {
  if (node.is_null()) return std::nullopt;
  node.with_keys({"normalized_color", "relative_rmse", "relmse", "psnr", "energy_bias", "noise_floor", "representation",
                  "filtering"});
  return RecordError{.normalized_color = node["normalized_color"].number(),
                     .relative_rmse = node["relative_rmse"].number_or(infinity),
                     .relmse = node["relmse"].number_or(infinity),
                     .psnr = node["psnr"].number_or(infinity),
                     .energy_bias = node["energy_bias"].number_or(infinity),
                     .noise_floor = node["noise_floor"].optional_number(),
                     .representation = node["representation"].number(),
                     .filtering = node["filtering"].number()};
}

std::vector<OtherReference> parse_other_references(const JsonNode& node) {
  std::vector<OtherReference> others;
  for (const JsonNode& other : node.elements()) {
    other.with_keys({"spp", "normalized_color", "noise_floor"});
    others.push_back({.spp = other["spp"].whole<int>(1),
                      .normalized_color = other["normalized_color"].number(),
                      .noise_floor = other["noise_floor"].optional_number()});
  }
  return others;
}

std::optional<Flicker> parse_flicker(const JsonNode& node) {
  if (node.is_null()) return std::nullopt;
  node.with_keys({"mean", "p99", "noise_floor"});
  return Flicker{
      .mean = node["mean"].number(), .p99 = node["p99"].number(), .noise_floor = node["noise_floor"].optional_number()};
}

void parse_time(const JsonNode& node, Record& record) {
  node.with_keys({"frame_ms", "frame_build_ms", "frame_build", "fps", "ratio_to_direct"});
  const JsonNode frame = node["frame_ms"].with_keys({"median", "min", "p90"});
  record.frame_ms = {frame["median"].number(), frame["min"].number(), frame["p90"].number()};
  record.frame_build_ms = node["frame_build_ms"].optional_number();
  if (record.frame_build_ms) record.frame_build = node["frame_build"].text();
  record.fps = node["fps"].number_or(infinity);
  const JsonNode ratio = node["ratio_to_direct"].with_keys({"median", "min", "max"});
  record.ratio_to_direct = {ratio["median"].number_or(not_a_number), ratio["min"].number_or(not_a_number),
                            ratio["max"].number_or(not_a_number)};
}

void parse_size(const JsonNode& node, Record& record) {
  const std::vector<JsonNode> size = node.elements();
  if (size.size() != 2) node.fail("must be [width, height]");
  record.width = size[0].whole<int>(1);
  record.height = size[1].whole<int>(1);
}

Record parse_record(const JsonNode& node) {
  node.with_keys({"scene", "method", "options", "distance", "frame", "size", "error", "equivalent_spp",
                  "equivalent_bound", "other_references", "flicker", "time", "precompute", "effects", "images"});
  Record record;
  record.scene = node["scene"].text();
  record.method = node["method"].text();
  record.options = parse_options(node["options"]);
  record.distance = node["distance"].number();
  record.frame = node["frame"].whole<int>();
  parse_size(node["size"], record);
  record.error = parse_error(node["error"]);
  record.equivalent_spp = node["equivalent_spp"].optional_number();
  record.equivalent_bound = node["equivalent_bound"].text();
  record.other_references = parse_other_references(node["other_references"]);
  record.flicker = parse_flicker(node["flicker"]);
  parse_time(node["time"], record);
  const JsonNode precompute = node["precompute"].with_keys({"seconds", "bytes", "bytes_per_texel", "cached"});
  record.precompute_seconds = precompute["seconds"].number();
  record.precompute_bytes = precompute["bytes"].whole<std::uint64_t>();
  record.precompute_bytes_per_texel = precompute["bytes_per_texel"].optional_number();
  record.precompute_cached = precompute["cached"].flag();
  const JsonNode effects = node["effects"].with_keys({"on", "left_out"});
  record.effects_on = effects["on"].texts();
  record.effects_left_out = effects["left_out"].texts();
  const JsonNode images = node["images"].with_keys({"color", "reference", "error"});
  record.images = {images["color"].text(), images["reference"].text(), images["error"].text()};
  return record;
}

NdfFigures parse_ndf(const JsonNode& node) {
  node.with_keys({"footprint", "method", "l2", "energy", "peak", "lobes", "picture"});
  return {.footprint = node["footprint"].text(),
          .method = node["method"].text(),
          .l2 = node["l2"].number_or(not_a_number),
          .energy = node["energy"].number_or(not_a_number),
          .peak = node["peak"].number_or(not_a_number),
          .lobes = node["lobes"].whole<int>(),
          .picture = node["picture"].text()};
}

QuantityFigure parse_quantity(const JsonNode& node) {
  node.with_keys({"name", "method", "quantity", "value"});
  return {.name = node["name"].text(),
          .method = node["method"].text(),
          .quantity = node["quantity"].text(),
          .value = node["value"].number_or(not_a_number)};
}

SupersamplingPoint parse_supersampling(const JsonNode& node) {
  node.with_keys({"distance", "spp", "normalized_color", "ms"});
  return {node["distance"].number(), node["spp"].whole<int>(1), node["normalized_color"].optional_number(),
          node["ms"].number()};
}

SceneInfo parse_scene(const JsonNode& node) {
  node.with_keys(
      {"name", "source", "triangles", "materials", "lights", "exposure", "exposure_source", "defaults", "warnings"});
  return {.name = node["name"].text(),
          .source = node["source"].text(),
          .triangles = node["triangles"].whole<std::size_t>(),
          .materials = node["materials"].whole<std::size_t>(),
          .lights = node["lights"].whole<std::size_t>(),
          .exposure = node["exposure"].number(),
          .exposure_source = node["exposure_source"].text(),
          .defaults = node["defaults"].texts(),
          .warnings = node["warnings"].texts()};
}

Results parse_document(const JsonNode& node) {
  if (node.has("schema") && node["schema"].text() != results_schema) {
    node["schema"].fail("unknown schema `" + node["schema"].text() + "`",
                        std::string("this version reads `") + results_schema + "`");
  }
  node.with_keys({"schema", "tool", "backend", "scene", "reference", "timing", "experiment", "error_scale",
                  "supersampling", "records", "ndf", "quantities"});
  Results results;
  const JsonNode tool = node["tool"].with_keys({"name", "version"});
  results.tool = {tool["name"].text(), tool["version"].text()};
  const JsonNode backend = node["backend"].with_keys({"name", "renderer", "version", "cpu"});
  results.backend = {backend["name"].text(), backend["renderer"].text(), backend["version"].text(),
                     backend["cpu"].text()};
  results.scene = parse_scene(node["scene"]);
  const JsonNode reference = node["reference"].with_keys({"spp", "filter", "seed", "standard_error", "environment"});
  results.reference = {reference["spp"].whole<int>(1), reference["filter"].text(),
                       reference["seed"].whole<std::uint64_t>(), reference["standard_error"].optional_number(),
                       reference["environment"].is_null() ? "" : reference["environment"].text()};
  const JsonNode timing = node["timing"].with_keys({"frames", "processes"});
  results.timing = {timing["frames"].whole<int>(1), timing["processes"].whole<int>(1)};
  if (!node["experiment"].is_null()) results.experiment = parse_experiment(node["experiment"]);
  results.error_scale = node["error_scale"].number();
  for (const JsonNode& point : node["supersampling"].elements()) {
    results.supersampling.push_back(parse_supersampling(point));
  }
  for (const JsonNode& record : node["records"].elements()) results.records.push_back(parse_record(record));
  for (const JsonNode& figures : node["ndf"].elements()) results.ndf.push_back(parse_ndf(figures));
  for (const JsonNode& figure : node["quantities"].elements()) results.quantities.push_back(parse_quantity(figure));
  return results;
}

}  // namespace

Results parse_results(const std::string& json, const std::string& source) {
  JsonNode::Json document;
  try {
    document = JsonNode::Json::parse(json);
  } catch (const JsonNode::Json::exception& fault) {
    const std::string text = fault.what();  // "[json.exception.parse_error.101] parse error at line 1, column 5: ..."
    const std::size_t bracket = text.find("] ");
    throw Error(ErrorKind::usage, source, bracket == std::string::npos ? text : text.substr(bracket + 2),
                "results.json is written by `footprint compare` or `footprint run`");
  }
  return parse_document({document, source});
}

}  // namespace footprint
