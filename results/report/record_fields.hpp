// The fields of results.json, matrix.json, region.json, ndf.json and recommend.json that are not listed beside their
// structure: those of structures of the renderer, and those that differ from the members. Listed once for the writer,
// the reader (json_archive.hpp) and the schemas of docs/.
#pragma once

#include <charconv>

#include "results/report/command_reports.hpp"
#include "results/report/figure_table.hpp"
#include "results/report/figures.hpp"
#include "results/report/json_archive.hpp"
#include "results/report/ranking.hpp"
#include "results/report/recommendation.hpp"
#include "results/report/region_report.hpp"
#include "results/report/report.hpp"

namespace footprint {

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

void fields(auto& archive, Is<HistorySettings> auto& value) {
  archive("frames", value.frames);
  archive("alpha", value.alpha);
  archive("clamp", value.clamp);
  archive("jitter", value.jitter);
}

void fields(auto& archive, Is<FlickerFigures> auto& value) {
  archive("mean", value.mean);
  archive("p99", value.p99);
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
  archive("vertex_instructions", value.vertex_instructions);
  archive("compile_seconds", value.compile_seconds);
  archive("failure", value.failure);
}

void fields(auto& archive, Is<RecordError> auto& value) {
  for (const Figure& figure : record_figures()) {
    const auto add = [&](auto member) { archive(metric_name(figure), value.*member); };
    if (figure.metric) std::visit(add, *figure.metric);
  }
  archive("luminances", value.luminances);
  archive("reference_luminances", value.reference_luminances);
  archive("noise_floor", value.noise_floor);
  archive("representation", value.representation);
  archive("filtering", value.filtering);
  fields(archive, value.causes);
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
  archive("undecidable", value.undecidable);
  archive("left", value.left);
  archive("right", value.right);
  archive("figures", value.figures);
}

void fields(auto& archive, Is<ThresholdOutcome> auto& value) {
  archive("measure", value.measure);
  archive("limit", value.limit);
  archive("measured", value.measured);
  archive.derived("held", value.passed());
  archive("problem", value.problem);
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
  archive("way", value.animation);
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

void fields(auto& archive, const RegionReport& value) {
  archive("schema", "footprint-region/1");
  archive("tool", value.tool);
  archive("backend", value.backend);
  archive("experiment", value.experiment);
  archive("title", value.title);
  archive("file", value.file);
  archive("quick", value.quick);
  archive("axes", value.axes);
  archive("settings", value.settings);
  archive("claims", value.claims);
}

void fields(auto& archive, const Recommendation& value) {
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
  archive("materials", value.materials);
}

}  // namespace footprint
