// Numbers and lists from text, whatever the locale, and random ones that are equal on every machine.
#pragma once

#include <algorithm>
#include <charconv>
#include <cstddef>
#include <optional>
#include <random>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

namespace footprint {

/// The whole of `text` as a number; empty if it is not one, or does not fit the type.
template <typename Number>
[[nodiscard]] std::optional<Number> parse_whole_of(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  if (status != std::errc{} || stop != end) return std::nullopt;
  return number;
}

/// The parts of a text between separators; one empty part of an empty text.
[[nodiscard]] inline std::vector<std::string> parts_of(std::string_view text, char separator = ',') {
  std::vector<std::string> parts;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t stop = std::min(text.find(separator, start), text.size());
    parts.emplace_back(text.substr(start, stop - start));
    start = stop + 1;
  }
  return parts;
}

/// Uniform in [0, 1): the generator's 53 high bits.
[[nodiscard]] inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

}  // namespace footprint
