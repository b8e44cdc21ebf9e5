// "Did you mean ...?": the nearest right name for a wrong one.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace footprint {

/// The candidate with the smallest Damerau-Levenshtein distance to `wrong`, compared without case; empty if none is
/// nearer than half the length of `wrong` (at least 2), or if `candidates` is empty.
[[nodiscard]] std::string nearest_name(std::string_view wrong, std::span<const std::string> candidates);

/// A sentence for an Error's hint: "did you mean `toksvig`? known: direct, naive_mip, toksvig"; of many candidates the
/// first 20, and how many more there are.
[[nodiscard]] std::string suggestion(std::string_view wrong, std::span<const std::string> candidates);

/// The place among `names` of a name, or of a number from 0 where no name is written so.
[[nodiscard]] std::optional<std::size_t> find_entry(std::string_view wanted, std::span<const std::string> names);

}  // namespace footprint
