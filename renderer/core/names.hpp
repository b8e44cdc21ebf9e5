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

/// The candidate with the smallest Damerau-Levenshtein distance to `wrong`, ignoring case. Empty if the distance
/// exceeds half the length of `wrong` (at least 2), or without candidates.
[[nodiscard]] std::string nearest_name(std::string_view wrong, std::span<const std::string> candidates);

/// A hint for an Error: "did you mean `toksvig`? known: direct, naive_mip, toksvig". Lists at most 20 candidates, and
/// the number of others.
[[nodiscard]] std::string suggestion(std::string_view wrong, std::span<const std::string> candidates);

/// The index of a name, or of a number from 0 if no name is equal to it.
[[nodiscard]] std::optional<std::size_t> find_entry(std::string_view wanted, std::span<const std::string> names);

/// The index of `word` among `known`. Throws Error (usage): "PLACE: unknown WHAT `WORD`", with the nearest right one.
[[nodiscard]] std::size_t find_word(std::span<const std::string> known, std::string_view word, std::string_view what,
                                    std::string_view place);

/// A word for a value. Tables write out each word beside its value, so that a renamed enumerator keeps its word.
template <class Value>
struct Word {
  Value value;
  std::string_view name;
};

/// The words of a table, in its order.
template <class Value, std::size_t count>
[[nodiscard]] std::vector<std::string> word_names(const std::array<Word<Value>, count>& words) {
  std::vector<std::string> names;
  names.reserve(count);
  for (const Word<Value>& word : words) names.emplace_back(word.name);
  return names;
}

/// The value of `word`. Throws as find_word.
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

/// The text with ASCII letters in lower case.
[[nodiscard]] std::string lower_case(std::string text);

/// A path's extension in lower case, with its dot.
[[nodiscard]] std::string lower_extension(const std::filesystem::path& path);

/// The names, of which those that occur more than once are followed by their index: "steel [0]", "steel [3]". All are
/// distinct.
[[nodiscard]] std::vector<std::string> told_apart(std::vector<std::string> names);

/// A part of a file name: letters, digits, '-', '.' and '_' of the text, and '_' for other characters.
[[nodiscard]] std::string file_stem(const std::string& text);

/// A stem per name, in their order. All are non-empty, not hidden, and distinct even if the file system ignores case;
/// the index is appended to duplicates.
[[nodiscard]] std::vector<std::string> distinct_stems(const std::vector<std::string>& names);

}  // namespace footprint
