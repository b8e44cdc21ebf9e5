// The number of a method, by which tests take turns at a sweep.
#pragma once

#include <algorithm>

#include "methods/registry.hpp"

namespace footprint::testing {

/// The place of a method in all_methods(), from 0.
[[nodiscard]] inline std::size_t method_number(const Method& method) {
  return static_cast<std::size_t>(std::ranges::find(all_methods(), &method) - all_methods().begin());
}

}  // namespace footprint::testing
