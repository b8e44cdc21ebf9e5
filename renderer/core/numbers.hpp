// Numbers from text, whatever the locale.
#pragma once

#include <charconv>
#include <optional>
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

}  // namespace footprint
