// Reader of the MERL BRDF database's binary files.
#pragma once

#include <filesystem>

#include "renderer/microgeometry/tabulated_brdf.hpp"

namespace footprint {

/// Reads a file of three 32-bit sizes (90, 90, 180) and as many doubles for red, green and blue, little-endian, in the
/// database's units (1/1500, 1.15/1500 and 1.66/1500 sr^-1). Cells without a measurement (below 0) are 0.
/// Errors (usage), naming the file: missing, other sizes, too short or too long, a value that is not finite.
[[nodiscard]] TabulatedBrdf read_merl(const std::filesystem::path& file);

}  // namespace footprint
