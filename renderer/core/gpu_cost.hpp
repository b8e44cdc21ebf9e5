// The estimated cost of a method on a GPU as a plain value, for what estimates it and what reports it.
#pragma once

#include <map>
#include <optional>
#include <string>

namespace footprint {

/// The estimated cost of one method on one GPU, per pixel that the object covers (docs/explanation/gpu-cost.md).
struct GpuCost {
  std::string gpu;
  double cost_ns = 0;                     ///< largest of the next three, and passes_ns; milliseconds per million pixels
  std::string bound;                      ///< arithmetic, textures or bandwidth: which of the three is the largest
  std::optional<double> ratio_to_direct;  ///< cost_ns over that of `direct` under the filter of the time unit
  double arithmetic_ns = 0, texture_ns = 0, bandwidth_ns = 0;
  double passes_ns = 0;     ///< of the passes that each frame repeats before it draws, over the object's pixels
  double alu_clocks = 0;    ///< of one SIMD
  double issue_clocks = 0;  ///< the driver's inverse throughput, with one round per loop
  double texture_reads = 0;
  std::map<std::string, double> reads_by_format;
  double bytes_fetched = 0;      ///< by all reads, before any cache
  double bytes_from_memory = 0;  ///< of those, new to the pixel; and its output
  double loop_rounds = 1;        ///< of the loops that the compiler did not unroll
  int instructions = 0, registers = 0, waves = 0, shader_bytes = 0, scratch_bytes = 0;
  double compile_seconds = 0;
  std::optional<std::string> failure;  ///< why the estimate is missing; all figures are 0 then
};

}  // namespace footprint
