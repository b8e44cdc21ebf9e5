// Compares a figure with the case's bound first, then with the known limits.
#include <fmt/format.h>

#include <algorithm>

#include "tests/hard_cases/hard_run.hpp"

namespace footprint::hard_cases {
namespace {

bool names(std::string_view limit, std::string_view method) {
  return limit.empty() || limit == method || limit == method.substr(0, method.find(':'));
}

}  // namespace

void judge(HardRow& row, std::span<const KnownLimit> limits, bool whole) {
  const auto known = std::ranges::find_if(limits, [&](const KnownLimit& limit) {
    return names(limit.method, row.method) && limit.hard_case == row.hard_case && limit.figure == row.figure;
  });
  const bool passed = row.value <= row.bound;  // false for a NaN
  row.verdict = Verdict::passed;
  if (known == limits.end()) {
    if (passed) return;
    row.verdict = Verdict::failed;
    row.why = fmt::format("{:.3g} is over {:.3g}", row.value, row.bound);
    return;
  }
  row.why = known->why;
  // A limit of the whole method need not apply to one storage.
  if (passed && (!whole || known->method != row.method)) return;
  if (!passed && row.value <= known->most) {
    row.verdict = known->guarded ? Verdict::guarded : Verdict::out_of_range;
    return;
  }
  row.verdict = Verdict::failed;
  row.why = passed ? fmt::format("{:.3g} is within {:.3g}: remove it from the list of limits", row.value, row.bound)
                   : fmt::format("{:.3g} is over the {:.3g} of its known limit", row.value, known->most);
}

}  // namespace footprint::hard_cases
