// Values of command-line options that are more than a number or a word.
#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace footprint {

/// The most pixels a side that a frame size may name; what memory holds is asked later, by whoever takes it.
inline constexpr int max_frame_side = 10'000'000;

/// "WIDTHxHEIGHT" in pixels. Errors (usage): not that form, a side of 0 or over `max_frame_side`.
[[nodiscard]] glm::ivec2 parse_size(std::string_view text);

/// A factor on the camera's distance. Errors (usage): not a number, not within `smallest_distance` to
/// `largest_distance`.
[[nodiscard]] double parse_distance(std::string_view text);

/// "1,2,4": such factors, in the order given. Errors (usage): those of each, given twice, none at all.
[[nodiscard]] std::vector<double> parse_distances(std::string_view text);

/// A positive factor on radiance, or "auto" for an empty value. Errors (usage): anything else.
[[nodiscard]] std::optional<float> parse_exposure(std::string_view text);

/// Index of `word` in `choices`. Errors (usage) name `option` and the nearest right choice.
[[nodiscard]] std::size_t parse_choice(std::string_view option, const std::string& word,
                                       std::span<const std::string> choices);

}  // namespace footprint
