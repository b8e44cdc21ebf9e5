// Damaged copies of files, for tests of readers.
#pragma once

#include <algorithm>
#include <cstddef>
#include <random>
#include <string>

namespace footprint::test {

/// One to four changes: a byte set, a digit changed (so that JSON survives and numbers go wrong), a piece cut out or
/// doubled.
[[nodiscard]] inline std::string damaged(std::string text, std::mt19937& random) {
  const auto below = [&](std::size_t end) { return static_cast<std::size_t>(random()) % end; };
  for (std::size_t change = 0, count = 1 + below(4); change < count && text.size() > 8; ++change) {
    const std::size_t at = below(text.size()), length = std::min(1 + below(8), text.size() - at);
    switch (below(6)) {
      case 0:
        text[at] = static_cast<char>(below(256));
        break;
      case 1:
        text.erase(at, length);
        break;
      case 2:
        text.insert(at, text.substr(at, length));
        break;
      default:
        if (const auto digit = text.find_first_of("0123456789", at); digit != std::string::npos) {
          text[digit] = "0123456789-."[below(12)];
        }
    }
  }
  return text;
}

}  // namespace footprint::test
