// The cost of a frame on a chip: the counted work of a program against the chip's rates.
#pragma once

#include <map>
#include <span>
#include <string>
#include <vector>

#include "renderer/core/gpu_cost.hpp"
#include "renderer/gpu_cost/chips.hpp"
#include "renderer/gpu_cost/shader_work.hpp"

namespace footprint {

/// What a texture costs to read.
struct TextureCost {
  std::string name;
  int bits = 128;          ///< of a texel
  bool trilinear = false;  ///< samples blend two mip levels
  double bytes = 0;        ///< of all levels and layers
  double finest_texels =
      0;  ///< of the finest level, if samples read it whatever the footprint; 0: samples read levels that fit
};

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
/// finest_areas: of each pixel on maps with `finest_texels`; the whole map has 1. Empty: their texels fit the pixels.
[[nodiscard]] GpuCost estimate(const Chip& chip, const std::vector<WeighedWork>& works, double lookups,
                               const std::map<int, TextureCost>& textures, double written_bytes = frame_pixel_bytes,
                               std::span<const float> finest_areas = {});

/// The time of a copy on a chip, which memory bounds: each byte is read and written once. Nanoseconds.
[[nodiscard]] double copy_ns(const Chip& chip, double bytes);

}  // namespace footprint
