// The costs that `footprint cost` estimates: cost.json, cost.csv and the table.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "results/report/json_archive.hpp"
#include "results/report/records.hpp"

namespace footprint {

/// Mean rounds per pixel of the loops that depend on the pixel; 0 if the method has no such loop.
struct LoopTrips {
  double probes = 0, lobes = 0, rounds = 0;
};

/// The estimated cost of one method on one GPU, per pixel that the object covers (docs/gpu-cost.md).
struct GpuCost {
  std::string gpu;
  double cost_ns = 0;  ///< the largest of the next three; equal to milliseconds per million pixels
  std::string bound;   ///< arithmetic, textures or bandwidth: which one that is
  double arithmetic_ns = 0, texture_ns = 0, bandwidth_ns = 0;
  double alu_clocks = 0;    ///< of one SIMD
  double issue_clocks = 0;  ///< the driver's inverse throughput, with one round per loop
  double texture_reads = 0;
  std::map<std::string, double> reads_by_format;
  double bytes_fetched = 0;      ///< by all reads, before any cache
  double bytes_from_memory = 0;  ///< of those, new to the pixel; and its output
  double loop_rounds = 1;        ///< of the loops that the compiler did not unroll
  int instructions = 0, registers = 0, waves = 0, shader_bytes = 0, scratch_bytes = 0;
  double compile_seconds = 0;
  std::optional<std::string> failure;  ///< why there is no estimate; all figures are 0 then
};

/// The costs of one method.
struct MethodCosts {
  std::string method;
  LoopTrips trips;
  double lookups = 0;  ///< texture lookups per pixel, counted on the software renderer
  double map_bytes = 0;
  std::vector<GpuCost> gpus;
};

/// The costs of some methods over one scene.
struct CostReport {
  ToolInfo tool;
  BackendInfo backend;
  SceneInfo scene;
  std::string footprint, compiler;
  int width = 0, height = 0;
  double distance = 1;
  std::vector<MethodCosts> methods;
};

template <class Archive>
void fields(Archive& archive, Is<LoopTrips> auto& value) {
  archive("probes", value.probes);
  archive("lobes", value.lobes);
  archive("rounds", value.rounds);
}

template <class Archive>
void fields(Archive& archive, Is<GpuCost> auto& value) {
  archive("gpu", value.gpu);
  archive("cost_ns", value.cost_ns);
  archive("bound", value.bound);
  archive("arithmetic_ns", value.arithmetic_ns);
  archive("texture_ns", value.texture_ns);
  archive("bandwidth_ns", value.bandwidth_ns);
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
void fields(Archive& archive, Is<MethodCosts> auto& value) {
  archive("method", value.method);
  archive("trips", value.trips);
  archive("lookups", value.lookups);
  archive("map_bytes", value.map_bytes);
  archive("gpus", value.gpus);
}

/// The document of docs/gpu-cost.md, "schema": "footprint-cost/1".
[[nodiscard]] std::string cost_json(const CostReport& report);

/// One line per method and GPU, RFC 4180.
[[nodiscard]] std::string cost_csv(const CostReport& report);

/// One Markdown table per GPU: a line per method, with its cost over that of the first method.
[[nodiscard]] std::string cost_table(const CostReport& report);

/// Writes cost.json, cost.csv and table.md into `folder`, each atomically. Throws Error (machine).
void write_cost(const CostReport& report, const std::filesystem::path& folder);

}  // namespace footprint
