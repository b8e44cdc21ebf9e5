// The work of a compiled shader, counted in the compiler's own code, and the cost of a frame on a chip: the counted
// work against the published rates of the chip.
#pragma once

#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "renderer/core/gpu_chips.hpp"
#include "renderer/core/gpu_cost.hpp"

namespace footprint {

/// The reads of one texture by one pixel.
struct TextureReads {
  double samples = 0;  ///< filtered by its sampler
  double gathers = 0;  ///< four texels of one channel
  double loads = 0;    ///< one texel, without a sampler

  [[nodiscard]] double total() const { return samples + gathers + loads; }
};

/// The binding of reads whose descriptor is not known when the program is compiled.
inline constexpr int unknown_binding = -1;

/// Instructions of one wave.
struct Instructions {
  double full = 0;     ///< vector arithmetic at full rate, interpolation included
  double quarter = 0;  ///< vector arithmetic at a quarter of the rate: 1/x, roots, exp, log, sin, cos, 32-bit products
  double scalar = 0;   ///< scalar arithmetic and branches
  double memory = 0;   ///< scalar and vector memory, local memory, exports; without textures
  std::map<int, TextureReads> textures;  ///< by binding

  /// Adds another count, times `factor`.
  void add(const Instructions& other, double factor = 1.0);
  /// The reads of all textures.
  [[nodiscard]] double texture_reads() const;
};

/// The work of one program, each loop run once and both sides of each branch taken.
struct ShaderWork {
  Instructions straight;  ///< outside of loops
  Instructions looped;    ///< inside of loops that the compiler did not unroll
};

/// Counts the instructions in ACO's code.
/// code: CompiledStage::code.
/// descriptor_bytes: between the descriptors of two bindings in a set.
/// Throws Error (machine): the text is not such code.
[[nodiscard]] ShaderWork shader_work(const std::string& code, int descriptor_bytes);

/// The bytes between two descriptors, from the code of a program that reads the textures 0 and 1, in that order.
/// Throws Error (machine): it does not.
[[nodiscard]] int descriptor_bytes(const std::string& code);

/// A compiled program that counts `weight` times in a frame's work. The weights of one frame add up to 1: loops that
/// run n times cost what one round costs, and n - 1 times what a further round adds.
struct WeighedWork {
  double weight = 1;
  ShaderWork work;
};

/// The work of a frame per pixel: the weighed sum, with loops that were not unrolled run until the lookups agree with
/// those that were counted.
/// works: the programs of the frame; at least one.
/// lookups: texture lookups per pixel, counted on the software renderer.
/// loop_rounds: set to the mean rounds, below 1 if some pixels skip the loops; 1 without such loops, or if they read no
/// texture.
[[nodiscard]] Instructions frame_work(const std::vector<WeighedWork>& works, double lookups, double& loop_rounds);

/// The texels that a bilinear sample fetches from memory if neighbouring samples are far apart on the map: whole lines.
/// texels: of the map, per sample; above 1 the map is minified.
/// line_bytes: of a cache line, which stores a square of texels.
[[nodiscard]] double minified_sample_texels(double texels, double texel_bytes, double line_bytes);

/// The bytes of a frame's target: four half floats.
inline constexpr double frame_pixel_bytes = 8;

/// The estimate on a chip, without the passes before the frame, `ratio_to_direct` and what the driver reports of a
/// program.
/// textures: by binding.
/// written_bytes: of a pixel, in all targets.
/// Fails where the programs' difference is negative: the compiler has dropped work that a further round has.
/// finest_areas: of each pixel on maps with `finest_texels`; the whole map has 1. Empty: their texels fit the pixels.
[[nodiscard]] GpuCost estimate(const Chip& chip, const std::vector<WeighedWork>& works, double lookups,
                               const std::map<int, ReadTexture>& textures, double written_bytes = frame_pixel_bytes,
                               std::span<const float> finest_areas = {});

/// The time of a copy on a chip, which memory bounds: each byte is read and written once. Nanoseconds.
[[nodiscard]] double copy_ns(const Chip& chip, double bytes);

}  // namespace footprint
