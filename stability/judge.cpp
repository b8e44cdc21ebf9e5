// Bound first, then what is known.
#include <fmt/format.h>

#include <algorithm>

#include "stability/hard_run.hpp"

namespace footprint::stability {
namespace {

bool names(std::string_view limit, std::string_view method) {
  return limit.empty() || limit == method || limit == method.substr(0, method.find(':'));
}

}  // namespace

void judge(HardRow& row, std::span<const KnownLimit> limits) {
  const auto known = std::ranges::find_if(limits, [&](const KnownLimit& limit) {
    return names(limit.method, row.method) && limit.hard_case == row.hard_case && limit.figure == row.figure;
  });
  const bool held = row.value <= row.bound;  // false for a NaN
  row.verdict = Verdict::held;
  if (known == limits.end()) {
    if (held) return;
    row.verdict = Verdict::fell;
    row.why = fmt::format("{:.3g} is over {:.3g}", row.value, row.bound);
    return;
  }
  row.why = known->why;
  if (!held && row.value <= known->most) {
    row.verdict = known->guarded ? Verdict::guarded : Verdict::out_of_range;
    return;
  }
  if (held && known->method != row.method) return;  // what a whole method is granted one storage may do without
  row.verdict = Verdict::fell;
  row.why = held ? fmt::format("{:.3g} is within {:.3g}: remove it from the list of limits", row.value, row.bound)
                 : fmt::format("{:.3g} is over the {:.3g} that is known of it", row.value, known->most);
}

}  // namespace footprint::stability
