// The number of a method, by which tests take turns at a sweep, and the size of its maps.
#pragma once

#include <algorithm>

#include "methods/registry.hpp"
#include "tests/support/sweep.hpp"

namespace footprint::testing {

/// The place of a method in all_methods(), from 0.
[[nodiscard]] inline std::size_t method_number(const Method& method) {
  return static_cast<std::size_t>(std::ranges::find(all_methods(), &method) - all_methods().begin());
}

/// The side of a test's square map for a method: `side`, or for best_lobes, whose fits of larger maps take tens of
/// seconds, a quarter of it and at least `least`. `scripts/test --all` has whole maps.
[[nodiscard]] inline int map_side(const Method& method, int side, int least = 1) {
  return method.info.name == "best_lobes" && !all_tests() ? std::max(side / 4, least) : side;
}

}  // namespace footprint::testing
