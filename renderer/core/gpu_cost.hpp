// The estimated cost of a method on a GPU, and the textures that it is due to, as plain values: for what records draws,
// what estimates them, and what reports it.
#pragma once

#include <compare>
#include <map>
#include <optional>
#include <string>

namespace footprint {

/// The texels of one target that a program draws into: floats.
struct ColorTarget {
  int channels = 4;  ///< 1, 2 or 4
  int bits = 16;     ///< of a channel: 16 or 32

  [[nodiscard]] double bytes() const { return channels * bits / 8.0; }
  friend auto operator<=>(const ColorTarget&,
                          const ColorTarget&) = default;  // NOLINT(modernize-use-nullptr): no pointer
};

/// A texture of a program, as far as its reads depend on it.
struct ReadTexture {
  std::string name;
  int bits = 128;          ///< of a texel
  bool trilinear = false;  ///< samples blend two mip levels
  double bytes = 0;        ///< of all levels and layers
  double finest_texels =
      0;  ///< of the finest level, if samples read it whatever the footprint; 0: samples read levels that fit
};

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
  int vertex_instructions = 0;  ///< of the vertex shader, which no cost above includes
  double compile_seconds = 0;
  std::optional<std::string> failure;  ///< why the estimate is missing; all figures are 0 then
};

}  // namespace footprint
