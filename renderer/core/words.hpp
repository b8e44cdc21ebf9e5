// Words that users write for values: one way to read them, and the nearest right one where a word is wrong.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

/// The index of `word` among `known`. Errors (usage): "PLACE: unknown WHAT `WORD`", with the nearest right one.
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

/// What `word` stands for. Errors (usage): those of find_word.
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

}  // namespace footprint
