// What is known not to hold, and how far it may be off: each entry is measured by every run, and a run says so where
// one holds after all.
#pragma once

#include <span>
#include <string_view>

namespace footprint::stability {

/// A case that a method does not hold.
struct KnownLimit {
  std::string_view method;     ///< with its options, or its name alone: whatever its options; empty: every method
  std::string_view hard_case;  ///< by its name
  std::string_view figure;     ///< energy, limit, twin, mean, coat or step
  double most = 0.0;           ///< the most that the figure may be
  bool guarded = false;        ///< a guard bites there, and the figure is what it costs; else it is out of range
  std::string_view why;        ///< the range, as the method's README has it
};

[[nodiscard]] std::span<const KnownLimit> known_limits();

}  // namespace footprint::stability
