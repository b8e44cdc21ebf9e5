// The fields of results.json, listed once for the writer and the reader (json_archive.hpp).
#pragma once

#include <charconv>

#include "results/report/figures.hpp"
#include "results/report/json_archive.hpp"
#include "results/report/records.hpp"

namespace footprint {

template <class Archive>
void fields(Archive& archive, Is<FrameTime> auto& value) {
  archive("median", value.median);
  archive("min", value.minimum);
  archive("p90", value.p90);
}

template <class Archive>
void fields(Archive& archive, Is<TimeRatio> auto& value) {
  archive("median", value.median);
  archive("low", value.low);
  archive("high", value.high);
}

template <class Archive>
void fields(Archive& archive, Is<PixelCounts> auto& value) {
  archive("object", value.object);
  archive("unresolved", value.unresolved);
  archive("interior", value.interior);
  archive("minified", value.minified);
  archive("bound", value.bound);
  archive("light", value.light);
}

template <class Archive>
void fields(Archive& archive, Is<RecordError> auto& value) {
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

template <class Archive>
void fields(Archive& archive, Is<PartFlicker> auto& value) {
  archive("mean", value.mean);
  archive("p99", value.p99);
}

template <class Archive>
void fields(Archive& archive, Is<Flicker> auto& value) {
  archive("mean", value.mean);
  archive("p99", value.p99);
  archive("noise_floor", value.noise_floor);
  archive("shading", value.causes.shading);
  archive("edges", value.causes.edges);
  archive("filter", value.causes.filter);
  archive("method", value.causes.method);
}

template <class Archive>
void fields(Archive& archive, Is<OtherReference> auto& value) {
  archive("spp", value.spp);
  archive("normalized_color", value.normalized_color);
  archive("noise_floor", value.noise_floor);
}

template <class Archive>
void fields(Archive& archive, Is<RecordImages> auto& value) {
  archive("color", value.color);
  archive("reference", value.reference);
  archive("error", value.error);
  archive("error_shared", value.error_shared);
  archive("interior", value.interior);
  archive("standard_error", value.standard_error);
}

template <class Archive>
void fields(Archive& archive, Is<MaterialError> auto& value) {
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

template <class Archive>
void fields(Archive& archive, Is<GpuCost> auto& value) {
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

template <class Archive>
void fields(Archive& archive, Is<Record> auto& value) {
  archive("scene", value.scene);
  archive("method", value.method);
  archive("options", value.options);
  archive("distance", value.distance);
  archive("degrees", value.degrees);
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

template <class Archive>
void fields(Archive& archive, Is<MethodPair> auto& value) {
  archive("distance", value.distance);
  archive("methods", value.methods);
  archive("closer", value.closer);
  archive("materials", value.materials);
  archive("picture", value.picture);
}

template <class Archive>
void fields(Archive& archive, Is<SupersamplingPoint> auto& value) {
  archive("distance", value.distance);
  archive("spp", value.spp);
  archive("normalized_color", value.normalized_color);
  archive("shading", value.shading);
  archive("ms", value.ms);
  archive("node", value.node);
}

template <class Archive>
void fields(Archive& archive, Is<ErrorScale> auto& value) {
  archive("distance", value.distance);
  archive("error", value.error);
}

template <class Archive>
void fields(Archive& archive, Is<FootprintNdf> auto& value) {
  archive("footprint", value.footprint);
  archive("method", value.method);
  archive("l2", value.l2);
  archive("energy", value.energy);
  archive("peak", value.peak);
  archive("lobes", value.lobes);
  archive("picture", value.picture);
}

template <class Archive>
void fields(Archive& archive, Is<QuantityFigure> auto& value) {
  archive("name", value.name);
  archive("method", value.method);
  archive("quantity", value.quantity);
  archive("value", value.value);
}

template <class Archive>
void fields(Archive& archive, Is<ToolInfo> auto& value) {
  archive("name", value.name);
  archive("version", value.version);
}

template <class Archive>
void fields(Archive& archive, Is<BackendInfo> auto& value) {
  archive("name", value.name);
  archive("renderer", value.renderer);
  archive("version", value.version);
  archive("cpu", value.cpu);
}

template <class Archive>
void fields(Archive& archive, Is<SceneInfo> auto& value) {
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

template <class Archive>
void fields(Archive& archive, Is<ReferenceInfo> auto& value) {
  archive("spp", value.spp);
  archive("filter", value.filter);
  archive("seed", value.seed);
  archive("standard_errors", value.standard_errors);
  archive("samples", value.samples);
  archive("seconds", value.seconds);
  archive("environment", value.environment);
}

template <class Archive>
void fields(Archive& archive, Is<TimingInfo> auto& value) {
  archive("frames", value.frames);
  archive("processes", value.processes);
}

template <class Archive>
void fields(Archive& archive, Is<AnimationWay> auto& value) {
  archive("path", value.path);
  archive("axis", value.axis);
}

template <class Archive>
void fields(Archive& archive, Is<PublishedFigure> auto& value) {
  archive("figure", value.figure);
  archive("measure", value.measure);
  archive("unit", value.unit);
  archive("published", value.published);
  archive("measured", value.measured);
  archive("note", value.note);
}

template <class Archive>
void fields(Archive& archive, Is<ClaimFigure> auto& value) {
  archive("measure", value.measure);
  archive("value", value.value);
  archive("at_noise_floor", value.at_noise_floor);
}

template <class Archive>
void fields(Archive& archive, Is<ClaimOutcome> auto& value) {
  archive("name", value.name);
  archive("text", value.text);
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

template <class Archive>
void fields(Archive& archive, Is<SecondVerdict> auto& value) {
  archive("claim", value.claim);
  archive("gpu", value.gpu);
  archive("left", value.left);
  archive("right", value.right);
  archive("outcome", value.outcome);
  archive("problem", value.problem);
}

template <class Archive>
void fields(Archive& archive, Is<ThresholdOutcome> auto& value) {
  archive("measure", value.measure);
  archive("limit", value.limit);
  archive("measured", value.measured);
  archive.derived("held", value.passed());
  archive("problem", value.problem);
}

template <class Archive>
void fields(Archive& archive, Is<ExperimentReport> auto& value) {
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

}  // namespace footprint
