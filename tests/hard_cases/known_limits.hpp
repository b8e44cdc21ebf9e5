// Known limits of methods, with the largest figure allowed. Every run measures each entry, and fails if a case passes
// although it is listed.
#pragma once

#include <span>
#include <string_view>

namespace footprint::hard_cases {

/// A case in which a method exceeds the case's bound.
struct KnownLimit {
  std::string_view method;     ///< with options, or a name for any options; empty: every method
  std::string_view hard_case;  ///< its name
  std::string_view figure;     ///< energy, limit, twin, mean, coat or step
  double most = 0.0;           ///< largest value of the figure
  bool guarded = false;        ///< true: the figure is the error that a guard introduces; else out of range
  std::string_view why;        ///< the range, as in the method's README
};

[[nodiscard]] std::span<const KnownLimit> known_limits();

}  // namespace footprint::hard_cases
