// See options.hpp.
#include "app/options.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

#include "renderer/core/error.hpp"
#include "renderer/core/suggest.hpp"
#include "renderer/scene/scene.hpp"

namespace footprint {
namespace {

constexpr std::string_view distance_mend = "give factors on the camera's distance, for example 1,2,4,8";

Error does_not_fit(std::string_view option, std::string_view text, std::string_view why, std::string_view mend) {
  return {ErrorKind::usage, std::string(option), fmt::format("`{}` {}", text, why), std::string(mend)};
}

// The whole of `text` as a number; empty if it is none or does not fit the type.
template <typename Number>
std::optional<Number> whole_number(std::string_view text) {
  Number number{};
  const char* end = text.data() + text.size();
  const auto [stop, status] = std::from_chars(text.data(), end, number);
  if (status != std::errc{} || stop != end) return std::nullopt;
  return number;
}

std::optional<double> positive(std::string_view text) {
  const auto number = whole_number<double>(text);
  if (!number || !std::isfinite(*number) || *number <= 0.0) return std::nullopt;
  return number;
}

}  // namespace

glm::ivec2 parse_size(std::string_view text) {
  constexpr std::string_view mend = "give WIDTHxHEIGHT in pixels, for example 512x512";
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) throw does_not_fit("--size", text, "is no frame size", mend);
  glm::ivec2 size{0};
  for (int axis = 0; axis < 2; ++axis) {
    const std::string_view digits = axis == 0 ? text.substr(0, cross) : text.substr(cross + 1);
    const bool is_count = !digits.empty() && digits.find_first_not_of("0123456789") == std::string_view::npos;
    if (!is_count) throw does_not_fit("--size", text, "is no frame size", mend);
    // Digits that do not fit the type are a number all the same, and far over the limit.
    const std::uint64_t side = whole_number<std::uint64_t>(digits).value_or(std::numeric_limits<std::uint64_t>::max());
    if (side == 0) throw does_not_fit("--size", text, "has no pixels", mend);
    if (side > max_frame_side) {
      throw does_not_fit("--size", text, fmt::format("has a side of more than {} pixels", max_frame_side), mend);
    }
    size[axis] = static_cast<int>(side);
  }
  return size;
}

double parse_distance(std::string_view text) {
  const auto distance = positive(text);
  if (!distance) throw does_not_fit("--distance", text, "is no positive number", distance_mend);
  if (*distance < smallest_distance || *distance > largest_distance) {
    throw does_not_fit("--distance", text, fmt::format("is not within {} to {}", smallest_distance, largest_distance),
                       distance_mend);
  }
  return *distance;
}

std::vector<double> parse_distances(std::string_view text) {
  std::vector<double> distances;
  for (std::size_t start = 0; start <= text.size();) {
    const std::size_t stop = std::min(text.find(',', start), text.size());
    const std::string_view part = text.substr(start, stop - start);
    const double distance = parse_distance(part);
    if (std::ranges::find(distances, distance) != distances.end()) {
      throw does_not_fit("--distance", part, "is given twice", distance_mend);
    }
    distances.push_back(distance);
    start = stop + 1;
  }
  return distances;
}

std::optional<float> parse_exposure(std::string_view text) {
  if (text == "auto") return std::nullopt;
  const auto exposure = positive(text);
  const float narrowed = exposure ? static_cast<float>(*exposure) : 0.0F;
  if (narrowed > 0.0F && std::isfinite(narrowed)) return narrowed;
  throw does_not_fit("--exposure", text, "is no exposure", "give `auto` or a positive factor on radiance");
}

std::size_t parse_choice(std::string_view option, const std::string& word, std::span<const std::string> choices) {
  const auto choice = std::ranges::find(choices, word);
  if (choice == choices.end()) throw does_not_fit(option, word, "is not known", suggestion(word, choices));
  return static_cast<std::size_t>(choice - choices.begin());
}

}  // namespace footprint
