// Sweeps over many values, of which tests take a few by default and all with `scripts/test --all`.
#pragma once

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <span>
#include <vector>

namespace footprint::testing {

/// Whether tests take whole sweeps: the environment variable FOOTPRINT_ALL_TESTS is set.
[[nodiscard]] inline bool all_tests() { return std::getenv("FOOTPRINT_ALL_TESTS") != nullptr; }

/// The values of a sweep: all of them with all_tests(), else `count`, beginning at number `first` and continuing at the
/// front. With a different `first` per test, a few values per test cover the sweep.
template <class Range>
[[nodiscard]] auto sweep(const Range& values, std::size_t count, std::size_t first = 0) {
  using Value = std::remove_cvref_t<decltype(*std::begin(values))>;
  std::vector<Value> out(std::begin(values), std::end(values));
  if (out.empty() || all_tests()) return out;
  std::ranges::rotate(out, out.begin() + static_cast<std::ptrdiff_t>(first % out.size()));
  if (count < out.size()) out.erase(out.begin() + static_cast<std::ptrdiff_t>(count), out.end());
  return out;
}

}  // namespace footprint::testing
