// Names are compared by optimal string alignment, without case.
#include "renderer/core/names.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

constexpr std::size_t longest_stem = 100;  // file systems allow 255 bytes, including what is appended

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

std::string lower_case(std::string text) {
  std::ranges::transform(text, text.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return text;
}

std::string lower_extension(const std::filesystem::path& path) { return lower_case(path.extension().string()); }

std::string file_stem(const std::string& text) {
  std::string stem = text;
  std::ranges::replace_if(
      stem, [](unsigned char c) { return std::isalnum(c) == 0 && c != '-' && c != '.' && c != '_'; }, '_');
  return stem;
}

std::vector<std::string> told_apart(std::vector<std::string> names) {
  std::map<std::string, int> counts;
  for (const std::string& name : names) ++counts[name];
  for (std::size_t i = 0; i < names.size(); ++i) {
    if (counts[names[i]] == 1) continue;
    std::string name = names[i];
    do {
      name += fmt::format(" [{}]", i);
    } while (counts.contains(name));  // as a name of the input, or of one before
    counts[name] = 1;
    names[i] = std::move(name);
  }
  return names;
}

std::vector<std::string> distinct_stems(const std::vector<std::string>& names) {
  std::vector<std::string> stems;
  std::set<std::string> taken;
  for (std::size_t i = 0; i < names.size(); ++i) {
    std::string stem = file_stem(names[i]).substr(0, longest_stem);
    if (stem.empty() || stem.front() == '.') stem.insert(0, "_");
    while (!taken.insert(lower_case(stem)).second) stem += fmt::format(".{}", i);
    stems.push_back(std::move(stem));
  }
  return stems;
}

std::string nearest_name(std::string_view wrong, std::span<const std::string> candidates) {
  constexpr std::size_t longest_compared = 64;  // bounds the table for hostile keys
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
  constexpr std::size_t most_listed = 20;  // a longer list would hide the message
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
  const auto index = parse_whole_of<std::size_t>(wanted);
  return index && *index < names.size() ? index : std::nullopt;
}

std::size_t find_word(std::span<const std::string> known, std::string_view word, std::string_view what,
                      std::string_view place) {
  const auto found = std::ranges::find(known, word);
  if (found == known.end()) {
    throw Error(ErrorKind::usage, std::string(place), fmt::format("unknown {} `{:.80}`", what, word),
                suggestion(word, known));
  }
  return static_cast<std::size_t>(found - known.begin());
}

}  // namespace footprint
