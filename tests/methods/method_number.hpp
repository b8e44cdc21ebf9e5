// The number of a method, by which tests take turns at a sweep, and the methods that some tests leave out.
#pragma once

#include <algorithm>

#include "methods/registry.hpp"
#include "tests/support/sweep.hpp"

namespace footprint::testing {

/// The place of a method in all_methods(), from 0.
[[nodiscard]] inline std::size_t method_number(const Method& method) {
  return static_cast<std::size_t>(std::ranges::find(all_methods(), &method) - all_methods().begin());
}

/// Whether a method's fits of a test's maps take tens of seconds, so that only `scripts/test --all` has the test.
[[nodiscard]] inline bool fits_take_long(const Method& method) {
  return method.info.name == "best_lobes" && !all_tests();
}

}  // namespace footprint::testing
