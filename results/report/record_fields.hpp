// The fields of results.json, matrix.json, ndf.json and recommend.json, listed once for the writer, the reader
// (json_archive.hpp) and the schemas of docs/.
#pragma once

#include <charconv>

#include "results/report/figures.hpp"
#include "results/report/json_archive.hpp"
#include "results/report/ndf_report.hpp"
#include "results/report/ranking.hpp"
#include "results/report/recommendation.hpp"
#include "results/report/report.hpp"

namespace footprint {

void fields(auto& archive, Is<FrameTime> auto& value) {
  archive("median", value.median);
  archive("min", value.minimum);
  archive("p90", value.p90);
}

void fields(auto& archive, Is<TimeRatio> auto& value) {
  archive("median", value.median);
  archive("low", value.low);
  archive("high", value.high);
}

void fields(auto& archive, Is<PixelCounts> auto& value) {
  archive("object", value.object);
  archive("unresolved", value.unresolved);
  archive("interior", value.interior);
  archive("minified", value.minified);
  archive("bound", value.bound);
  archive("light", value.light);
}

void fields(auto& archive, Is<RecordError> auto& value) {
  archive("normalized_color", value.normalized_color);
  archive("relative_rmse", value.relative_rmse);
  archive("relmse", value.relmse);
  archive("psnr", value.psnr);
  archive("energy_bias", value.energy_bias);
  archive("luminance_distance", value.luminance_distance);
  archive("luminances", value.luminances);
  archive("reference_luminances", value.reference_luminances);
  archive("noise_floor", value.noise_floor);
  archive("representation", value.representation);
  archive("filtering", value.filtering);
  archive("shading", value.causes.shading);
  archive("shading_floor", value.causes.shading_floor);
  archive("shading_noise", value.causes.shading_noise);
  archive("edges", value.causes.edges);
  archive("filter", value.causes.filter);
  archive("method", value.causes.method);
  archive("light", value.causes.light);
}

void fields(auto& archive, Is<PartFlicker> auto& value) {
  archive("mean", value.mean);
  archive("p99", value.p99);
}

void fields(auto& archive, Is<Flicker> auto& value) {
  archive("mean", value.mean);
  archive("p99", value.p99);
  archive("noise_floor", value.noise_floor);
  archive("ghosting", value.ghosting);
  archive("shading", value.causes.shading);
  archive("edges", value.causes.edges);
  archive("filter", value.causes.filter);
  archive("method", value.causes.method);
}

void fields(auto& archive, Is<OtherReference> auto& value) {
  archive("spp", value.spp);
  archive("normalized_color", value.normalized_color);
  archive("noise_floor", value.noise_floor);
}

void fields(auto& archive, Is<RecordImages> auto& value) {
  archive("color", value.color);
  archive("reference", value.reference);
  archive("error", value.error);
  archive("error_shared", value.error_shared);
  archive("flip", value.flip);
  archive("interior", value.interior);
  archive("standard_error", value.standard_error);
}

void fields(auto& archive, Is<MaterialError> auto& value) {
  archive("material", value.material);
  archive("pixels", value.pixels);
  archive("shading", value.shading);
  archive("noise", value.noise);
  archive("bytes", value.bytes);
}

/// Reads a number of samples and its bound ("<1", ">64", "" or "n/a") as equivalent_spp and equivalent_bound write
/// them.
[[nodiscard]] inline std::optional<EquivalentSamples> equivalent_from(std::optional<double> spp,
                                                                      const std::string& bound) {
  if (spp) return EquivalentSamples{.spp = *spp, .side = CurveSide::within};
  EquivalentSamples end{.spp = 1, .side = bound.starts_with('<') ? CurveSide::below : CurveSide::above};
  const char* last = bound.data() + bound.size();
  if (bound.size() < 2 || std::from_chars(bound.data() + 1, last, end.spp).ptr != last) return {};
  return end;
}

void fields(auto& archive, Is<GpuCost> auto& value) {
  archive("gpu", value.gpu);
  archive("cost_ns", value.cost_ns);
  archive("bound", value.bound);
  archive("ratio_to_direct", value.ratio_to_direct);
  archive("arithmetic_ns", value.arithmetic_ns);
  archive("texture_ns", value.texture_ns);
  archive("bandwidth_ns", value.bandwidth_ns);
  archive("passes_ns", value.passes_ns);
  archive("alu_clocks", value.alu_clocks);
  archive("issue_clocks", value.issue_clocks);
  archive("texture_reads", value.texture_reads);
  archive("reads_by_format", value.reads_by_format);
  archive("bytes_fetched", value.bytes_fetched);
  archive("bytes_from_memory", value.bytes_from_memory);
  archive("loop_rounds", value.loop_rounds);
  archive("instructions", value.instructions);
  archive("registers", value.registers);
  archive("waves", value.waves);
  archive("shader_bytes", value.shader_bytes);
  archive("scratch_bytes", value.scratch_bytes);
  archive("compile_seconds", value.compile_seconds);
  archive("failure", value.failure);
}

void fields(auto& archive, Is<HistoryInfo> auto& value) {
  archive("frames", value.frames);
  archive("alpha", value.alpha);
  archive("clamp", value.clamp);
  archive("jitter", value.jitter);
}

template <class Archive>
void fields(Archive& archive, Is<Record> auto& value) {
  archive("scene", value.scene);
  archive("method", value.method);
  archive("options", value.options);
  archive("history", value.history);
  archive("distance", value.distance);
  archive("degrees", value.degrees);
  archive("seconds", value.seconds);
  archive("frame", value.frame);
  archive("size", std::tie(value.width, value.height));
  archive("failure", value.failure);
  archive("pixels", value.pixels);
  archive("error", value.error);
  archive.derived("equivalent_spp", equivalent_spp(value));
  archive.derived("equivalent_bound", equivalent_bound(value));
  if constexpr (Archive::reads)
    value.equivalent = equivalent_from(from_json_value<std::optional<double>>(archive.at("equivalent_spp")),
                                       archive.at("equivalent_bound"));
  archive("other_references", value.other_references);
  archive("flicker", value.flicker);
  archive("highlight_energy", value.highlight_energy);
  archive("reference_highlight_energy", value.reference_highlight_energy);
  archive.group("time", [&](auto& time) {
    time("node", value.node);
    time("frame_ms", value.frame_ms);
    time("frame_build_ms", value.frame_build_ms);
    time("frame_build", value.frame_build);
    time("fps", value.fps);
    time("fetches", value.fetches);
    time("lobes", value.lobes);
    time("ratio_to_direct", value.ratio_to_direct);
  });
  archive("gpu_costs", value.gpu_costs);
  archive("materials", value.materials);
  archive.group("precompute", [&](auto& precompute) {
    precompute("seconds", value.precompute_seconds);
    precompute("bytes", value.precompute_bytes);
    precompute("bytes_per_texel", value.precompute_bytes_per_texel);
    precompute("cached", value.precompute_cached);
  });
  archive.group("effects", [&](auto& effects) {
    effects("on", value.effects_on);
    effects("left_out", value.effects_left_out);
  });
  archive("images", value.images);
}

void fields(auto& archive, Is<MethodPair> auto& value) {
  archive("distance", value.distance);
  archive("methods", value.methods);
  archive("closer", value.closer);
  archive("materials", value.materials);
  archive("picture", value.picture);
}

void fields(auto& archive, Is<SupersamplingPoint> auto& value) {
  archive("distance", value.distance);
  archive("spp", value.spp);
  archive("normalized_color", value.normalized_color);
  archive("shading", value.shading);
  archive("ms", value.ms);
  archive("node", value.node);
}

void fields(auto& archive, Is<ErrorScale> auto& value) {
  archive("distance", value.distance);
  archive("error", value.error);
}

void fields(auto& archive, Is<FootprintNdf> auto& value) {
  archive("footprint", value.footprint);
  archive("method", value.method);
  archive("l2", value.l2);
  archive("energy", value.energy);
  archive("peak", value.peak);
  archive("lobes", value.lobes);
  archive("picture", value.picture);
}

void fields(auto& archive, Is<QuantityFigure> auto& value) {
  archive("name", value.name);
  archive("method", value.method);
  archive("quantity", value.quantity);
  archive("value", value.value);
}

void fields(auto& archive, Is<ToolInfo> auto& value) {
  archive("name", value.name);
  archive("version", value.version);
}

void fields(auto& archive, Is<BackendInfo> auto& value) {
  archive("name", value.name);
  archive("renderer", value.renderer);
  archive("version", value.version);
  archive("cpu", value.cpu);
}

void fields(auto& archive, Is<SceneInfo> auto& value) {
  archive("name", value.name);
  archive("source", value.source);
  archive("triangles", value.triangles);
  archive("materials", value.materials);
  archive("lights", value.lights);
  archive("exposure", value.exposure);
  archive("exposure_source", value.exposure_source);
  archive("defaults", value.defaults);
  archive("warnings", value.warnings);
}

void fields(auto& archive, Is<ReferenceInfo> auto& value) {
  archive("spp", value.spp);
  archive("filter", value.filter);
  archive("seed", value.seed);
  archive("standard_errors", value.standard_errors);
  archive("samples", value.samples);
  archive("seconds", value.seconds);
  archive("environment", value.environment);
}

void fields(auto& archive, Is<TimingInfo> auto& value) {
  archive("frames", value.frames);
  archive("processes", value.processes);
}

void fields(auto& archive, Is<AnimationWay> auto& value) {
  archive("path", value.path);
  archive("axis", value.axis);
}

void fields(auto& archive, Is<PublishedFigure> auto& value) {
  archive("figure", value.figure);
  archive("measure", value.measure);
  archive("unit", value.unit);
  archive("published", value.published);
  archive("measured", value.measured);
  archive("note", value.note);
}

void fields(auto& archive, Is<ClaimFigure> auto& value) {
  archive("measure", value.measure);
  archive("value", value.value);
  archive("at_noise_floor", value.at_noise_floor);
}

void fields(auto& archive, Is<ClaimOutcome> auto& value) {
  archive("name", value.name);
  archive("text", value.text);
  archive("source", value.source);
  archive("inequality", value.inequality);
  archive("expect", value.expect);
  archive("outcome", value.outcome);
  archive.derived("as_expected", value.as_expected());
  archive("reason", value.reason);
  archive("problem", value.problem);
  archive("left", value.left);
  archive("right", value.right);
  archive("figures", value.figures);
}

void fields(auto& archive, Is<SecondVerdict> auto& value) {
  archive("claim", value.claim);
  archive("gpu", value.gpu);
  archive("left", value.left);
  archive("right", value.right);
  archive("outcome", value.outcome);
  archive("problem", value.problem);
}

void fields(auto& archive, Is<ThresholdOutcome> auto& value) {
  archive("measure", value.measure);
  archive("limit", value.limit);
  archive("measured", value.measured);
  archive.derived("held", value.passed());
  archive("problem", value.problem);
}

void fields(auto& archive, Is<ExperimentReport> auto& value) {
  archive("name", value.name);
  archive("title", value.title);
  archive("description", value.description);
  archive("file", value.file);
  archive("quick", value.quick);
  archive("published", value.published);
  archive("claims", value.claims);
  archive("second_verdicts", value.second_verdicts);
  archive("thresholds", value.thresholds);
  archive("pictures", value.pictures);
}

template <class Archive>
void fields(Archive& archive, Is<Results> auto& value) {
  archive.derived("schema", results_schema);
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("scene", value.scene);
  archive("reference", value.reference);
  archive("footprint", value.footprint);
  archive("timing", value.timing);
  archive("way", value.way);
  archive("film", value.film);
  archive.derived("experiment", value.experiment);  // judged again from the figures
  if constexpr (!Archive::reads) archive.derived("ranking_warnings", ranking_warnings(value));
  archive("error_scale", value.error_scale);
  archive("error_scales", value.error_scales);
  archive("supersampling", value.supersampling);
  archive("records", value.records);
  archive("pairs", value.pairs);
  archive("ndf", value.ndf);
  archive("quantities", value.quantities);
  archive("files", value.files);
}

void fields(auto& archive, const MatrixMember& value) {
  archive("folder", value.folder);
  archive("coordinates", value.results.coordinates);
  archive("scene", value.results.scene.name);
  archive("footprint", value.results.footprint);
  archive("spp", value.results.reference.spp);
  archive("seed", value.results.reference.seed);
  archive("records", value.results.records.size());
}

void fields(auto& archive, const MatrixResults& value) {
  archive("schema", "footprint-matrix/1");
  archive("tool", value.members.front().results.tool);
  archive("backend", value.members.front().results.backend);
  archive("experiment", value.report);
  archive("left_out", value.left_out);
  archive("members", value.members);
}

void fields(auto& archive, const NdfImages& value) {
  archive("density", value.density);
  archive("picture", value.picture);
  archive("difference", value.difference);
}

void fields(auto& archive, const NdfRecord& value) {
  archive("l2", value.l2);
  archive("energy", value.energy);
  archive("peak", value.peak);
  archive("lobes", value.lobes);
  archive("options", value.options);
  archive("images", value.images);
}

void fields(auto& archive, const ExactNdfRecord& value) {
  archive("energy", value.energy);
  archive("expected_energy", value.expected_energy);
  archive("peak", value.peak);
  archive.group("images", [&](auto& images) {
    images("density", value.images.density);
    images("picture", value.images.picture);
  });
}

void fields(auto& archive, const NdfResults& value) {
  std::vector<std::pair<std::string, NdfRecord>> methods;
  for (const NdfRecord& record : value.records) methods.emplace_back(record.method, record);
  archive("schema", ndf_schema);
  archive("tool", ToolInfo{.name = "footprint", .version = value.version});
  archive.group("source", [&](auto& source) {
    source("path", value.source);
    source("kind", value.kind);
    source("material", value.material);
    source("width", value.map_size[0]);
    source("height", value.map_size[1]);
  });
  archive.group("lobe", [&](auto& lobe) {
    lobe("narrowest", value.lobe);
    lobe("varies", value.lobe_varies);
  });
  archive.group("footprint", [&](auto& footprint) {
    footprint("u0", value.footprint[0]);
    footprint("v0", value.footprint[1]);
    footprint("u1", value.footprint[2]);
    footprint("v1", value.footprint[3]);
  });
  archive.group("texels", [&](auto& texels) {
    texels("area", value.texels);
    texels("valid_share", value.valid_share);
    texels("distinct", value.facets);
  });
  archive.group("fetch", [&](auto& fetch) {
    fetch("level", value.level);
    fetch("filter", value.filter);
  });
  archive.group("grid", [&](auto& grid) {
    grid("resolution", value.resolution);
    grid("directions", value.directions);
    grid("fine_enough", value.fine_enough);
  });
  archive.group("pictures", [&](auto& pictures) {
    pictures("scale", value.scale);
    pictures("strip", value.strip);
  });
  archive("truth", value.exact);
  archive("methods", methods);
  archive("notes", value.notes);
}

void fields(auto& archive, const Candidate& value) {
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

void fields(auto& archive, const Limits& value) {
  archive("max_error", value.max_error);
  archive("max_cost", value.max_cost);
  archive("gpu", value.gpu);
  archive("max_bytes", value.max_bytes);
}

void fields(auto& archive, const LeftOutMethod& value) {
  archive("method", value.method);
  archive("reason", value.reason);
}

/// The advice with its sentences.
struct WrittenAdvice {
  MaterialAdvice advice;
  std::vector<std::string> words;
};

void fields(auto& archive, const WrittenAdvice& value) {
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
  archive("words", value.words);
  archive("candidates", advice.candidates);
}

void fields(auto& archive, const Recommendation& value) {
  std::vector<WrittenAdvice> materials;
  for (const MaterialAdvice& advice : value.materials)
    materials.push_back({advice, advice_sentences(advice, value.limits)});
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

}  // namespace footprint
