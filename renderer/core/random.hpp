// Random numbers that are equal on every machine; the standard's distributions may differ between libraries.
#pragma once

#include <random>

namespace footprint {

/// Uniform in [0, 1): the generator's 53 high bits.
[[nodiscard]] inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

}  // namespace footprint
