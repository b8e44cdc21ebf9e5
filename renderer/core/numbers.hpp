// Numbers from text, whatever the locale, and random ones that are equal on every machine.
#pragma once

#include <charconv>
#include <optional>
#include <random>
#include <string_view>
#include <system_error>

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

/// Uniform in [0, 1): the generator's 53 high bits.
[[nodiscard]] inline double uniform(std::mt19937_64& random) {
  return static_cast<double>(random() >> 11U) * 0x1.0p-53;
}

}  // namespace footprint
