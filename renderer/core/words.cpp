// The search for a word among the known ones, and the error where it is none of them.
#include "renderer/core/words.hpp"

#include <fmt/format.h>

#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"

namespace footprint {

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
