// The nearest name by optimal string alignment, upper and lower case alike; none where all are too far off.
#include "renderer/core/suggest.hpp"

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <string>
#include <vector>

#include "renderer/core/file_names.hpp"

namespace footprint {
namespace {

// Optimal string alignment: insertions, deletions, substitutions and swaps of neighbours each cost one.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::vector<std::size_t>> d(a.size() + 1, std::vector<std::size_t>(b.size() + 1));
  for (std::size_t i = 0; i <= a.size(); ++i) d[i][0] = i;
  for (std::size_t j = 0; j <= b.size(); ++j) d[0][j] = j;
  for (std::size_t i = 1; i <= a.size(); ++i) {
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const std::size_t substitution = d[i - 1][j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      d[i][j] = std::min({d[i - 1][j] + 1, d[i][j - 1] + 1, substitution});
      const bool swapped = i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1];
      if (swapped) d[i][j] = std::min(d[i][j], d[i - 2][j - 2] + 1);
    }
  }
  return d[a.size()][b.size()];
}

}  // namespace

std::string nearest_name(std::string_view wrong, std::span<const std::string> candidates) {
  constexpr std::size_t longest_compared = 64;  // keeps the table small for a hostile key
  if (wrong.size() > longest_compared) return {};
  std::string best;
  std::size_t best_distance = std::max<std::size_t>(2, wrong.size() / 2) + 1;
  for (const std::string& candidate : candidates) {
    const std::size_t distance = edit_distance(lower_case(std::string(wrong)), lower_case(candidate));
    if (distance < best_distance) {
      best_distance = distance;
      best = candidate;
    }
  }
  return best;
}

std::string suggestion(std::string_view wrong, std::span<const std::string> candidates) {
  constexpr std::size_t most_listed = 20;  // a longer list hides what is wrong
  std::string known;
  for (const std::string& candidate : candidates.first(std::min(candidates.size(), most_listed)))
    known += (known.empty() ? "" : ", ") + candidate;
  if (candidates.size() > most_listed) known += " and " + std::to_string(candidates.size() - most_listed) + " more";
  const std::string nearest = nearest_name(wrong, candidates);
  return (nearest.empty() ? std::string{} : "did you mean `" + nearest + "`? ") + "known: " + known;
}

std::optional<std::size_t> find_entry(std::string_view wanted, std::span<const std::string> names) {
  if (const auto named = std::ranges::find(names, wanted); named != names.end()) {
    return static_cast<std::size_t>(named - names.begin());
  }
  std::size_t index = 0;
  const char* const end = wanted.data() + wanted.size();
  const auto [stop, status] = std::from_chars(wanted.data(), end, index);
  if (status != std::errc{} || stop != end || index >= names.size()) return {};
  return index;
}

}  // namespace footprint
