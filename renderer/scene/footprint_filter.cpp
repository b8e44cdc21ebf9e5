// The words of footprint filters: one table that reading, writing and help share.
#include "renderer/scene/footprint_filter.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <vector>

#include "renderer/core/error.hpp"
#include "renderer/core/names.hpp"
#include "renderer/core/numbers.hpp"

namespace footprint {
namespace {

using Kind = FootprintFilterKind;

constexpr int most_draws = 16;  // as many digits as a sample grid has (sample_draws.glsl)
constexpr int most_depth = 12;  // 4096 texels along an edge

// At most as many probes along one axis as hardware has; N x N parts of a box: 64 lookups or shadings per pixel.
constexpr auto words = std::to_array<FootprintFilterWord>({
    {Kind::trilinear, "trilinear", 1, 1},
    {Kind::anisotropic, "anisotropic", 1, 16},
    {Kind::box, "box", 1, 8},
    {Kind::area, "area", 1, 8},
    {Kind::ewa, "ewa", 1, 16},
    {Kind::shaded, "shaded", 1, 8},
    {Kind::hardware, "hardware", 1, 16},
    {Kind::stochastic, "stochastic", 1, most_draws, true},
    {Kind::stochastic_gaussian, "stochastic_gaussian", 1, most_draws, true},
    {Kind::stochastic_trilinear, "stochastic_trilinear", 1, most_draws, true},
});

const FootprintFilterWord& word_of(Kind kind) { return *std::ranges::find(words, kind, &FootprintFilterWord::kind); }

bool takes_number(const FootprintFilterWord& word) { return word.most > 1; }

std::string form_of(const FootprintFilterWord& word) {
  if (word.stochastic)
    return fmt::format("{}[:N[:DEPTH]] ({} to {}, 0 to {})", word.name, word.least, word.most, most_depth);
  return takes_number(word) ? fmt::format("{}:N ({} to {})", word.name, word.least, word.most) : std::string(word.name);
}

}  // namespace

std::span<const FootprintFilterWord> footprint_filter_words() { return words; }

std::string footprint_filter_choices() {
  std::vector<std::string> forms;
  std::ranges::transform(words, std::back_inserter(forms), form_of);
  return fmt::format("{}", fmt::join(forms, ", "));
}

FootprintFilter parse_footprint_filter(std::string_view text, std::string_view place) {
  const std::size_t colon = text.find(':');
  std::vector<std::string> names;
  std::ranges::transform(words, std::back_inserter(names), [](const auto& word) { return std::string(word.name); });
  const FootprintFilterWord& word = words.at(find_word(names, text.substr(0, colon), "footprint filter", place));
  const auto refuse = [&](const std::string& what) {
    return Error(ErrorKind::usage, std::string(place), fmt::format("footprint filter `{}` {}", text, what),
                 "write " + form_of(word));
  };
  if (colon == std::string_view::npos) {
    if (takes_number(word) && !word.stochastic) throw refuse("has no number");
    return {word.kind, 1};
  }
  if (!takes_number(word)) throw refuse("has a number, and takes none");
  const auto number = [&](std::string_view digits, int least, int most) {
    const auto value = parse_whole_of<int>(digits);
    if (!value) throw refuse("has no whole number behind the colon");
    if (*value < least || *value > most) throw refuse("is out of range");
    return *value;
  };
  const std::size_t second = word.stochastic ? text.find(':', colon + 1) : std::string_view::npos;
  const int count = number(text.substr(colon + 1, second - colon - 1), word.least, word.most);
  if (second == std::string_view::npos) return {word.kind, count};
  return {word.kind, count, number(text.substr(second + 1), 0, most_depth)};
}

std::string footprint_filter_text(const FootprintFilter& filter) {
  const FootprintFilterWord& word = word_of(filter.kind);
  if (!takes_number(word)) return std::string(word.name);
  const std::string text = fmt::format("{}:{}", word.name, filter.count);
  return filter.depth == finest_depth ? text : fmt::format("{}:{}", text, filter.depth);
}

bool is_stochastic(const FootprintFilter& filter) { return word_of(filter.kind).stochastic; }

void require_one_lookup(const FootprintFilter& filter, std::string_view place) {
  if (!is_stochastic(filter)) return;
  throw Error(ErrorKind::usage, std::string(place),
              fmt::format("footprint filter `{}` draws other texels in each frame", footprint_filter_text(filter)),
              "take another filter, for example --footprint trilinear");
}

}  // namespace footprint
