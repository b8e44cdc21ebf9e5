// The GPUs whose costs can be estimated: their names and their published rates (docs/explanation/gpu-cost.md cites
// them).
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

/// The rates of a generation of AMD's GPUs. A wave has 64 pixels.
struct Generation {
  std::string_view name;
  int simds;                     ///< of a compute unit
  double full_clocks;            ///< of a SIMD for a vector instruction of one wave
  double quarter_clocks;         ///< for one at a quarter of the rate
  bool has_transcendental_unit;  ///< a unit of its own runs them beside other instructions, and takes full_clocks to
                                 ///< start one
  double scalar_clocks;          ///< of a SIMD for a scalar instruction
  double filtered_per_clock;     ///< bilinear samples of a compute unit, of texels of 32 bits
  double rate_64, rate_128;      ///< factors on that for texels of 64 and 128 bits
  double line_bytes;             ///< of a line of the last cache before memory
};

/// A product.
struct Chip {
  std::string_view name;    ///< as on the command line
  std::string_view family;  ///< the driver's name: RADV_FORCE_FAMILY
  const Generation* generation;
  int compute_units;
  double ghz;  ///< published peak clock
  double gigabytes_per_second;
};

/// All chips, oldest first.
[[nodiscard]] std::span<const Chip> chips();

/// Their names.
[[nodiscard]] std::vector<std::string> chip_names();

/// The chips of names as a user writes them, in any case; `all` stands for all of them.
/// Throws Error (usage, at `place`): no chip has such a name; the message lists all, and the nearest.
[[nodiscard]] std::vector<const Chip*> chips_named(std::string_view place, const std::vector<std::string>& names);

}  // namespace footprint
