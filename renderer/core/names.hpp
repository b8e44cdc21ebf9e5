// Names that users write: tables of words, the nearest right name for a wrong one, and file names made of any text.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

/// The candidate with the smallest Damerau-Levenshtein distance to `wrong`, compared without case; empty if none is
/// nearer than half the length of `wrong` (at least 2), or if `candidates` is empty.
[[nodiscard]] std::string nearest_name(std::string_view wrong, std::span<const std::string> candidates);

/// A sentence for an Error's hint: "did you mean `toksvig`? known: direct, naive_mip, toksvig"; of many candidates the
/// first 20, and how many more there are.
[[nodiscard]] std::string suggestion(std::string_view wrong, std::span<const std::string> candidates);

/// The place among `names` of a name, or of a number from 0 where no name is written so.
[[nodiscard]] std::optional<std::size_t> find_entry(std::string_view wanted, std::span<const std::string> names);

/// The index of `word` among `known`. Throws Error (usage): "PLACE: unknown WHAT `WORD`", with the nearest right one.
[[nodiscard]] std::size_t find_word(std::span<const std::string> known, std::string_view word, std::string_view what,
                                    std::string_view place);

/// A word and what it stands for.
template <class Value>
struct Word {
  Value value;
  std::string_view name;
};

/// The words of a table, in its order.
template <class Value, std::size_t count>
[[nodiscard]] std::vector<std::string> word_names(const std::array<Word<Value>, count>& words) {
  std::vector<std::string> names;
  for (const Word<Value>& word : words) names.emplace_back(word.name);
  return names;
}

/// What `word` stands for. Throws Error (usage): those of find_word.
template <class Value, std::size_t count>
[[nodiscard]] Value word_value(const std::array<Word<Value>, count>& words, std::string_view word,
                               std::string_view what, std::string_view place) {
  return words[find_word(word_names(words), word, what, place)].value;
}

/// The word for `value`, which must be one of the table's.
template <class Value, std::size_t count>
[[nodiscard]] constexpr std::string_view word_for(const std::array<Word<Value>, count>& words, const Value& value) {
  return std::ranges::find(words, value, &Word<Value>::value)->name;
}

/// ASCII letters in lower case; all else stays.
[[nodiscard]] std::string lower_case(std::string text);

/// A path's extension in lower case, with its dot.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// A file name part from any text: letters, digits, '-', '.' and '_' stay, all else becomes '_'.
[[nodiscard]] std::string file_stem(const std::string& text);

/// One for each name, in their order, none empty or hidden and all different, also where a file system takes upper and
/// lower case for one: a stem that comes twice has the name's number added.
[[nodiscard]] std::vector<std::string> distinct_stems(const std::vector<std::string>& names);

}  // namespace footprint
