// The colours of methods, the same on every page and in every figure.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace footprint {

/// The colours of palette.json in both themes, as "#rrggbb"; a place is an index into either.
struct Palette {
  std::vector<std::string> light, dark;
  std::vector<std::string> methods;  ///< in the order in which they choose a place
};

/// The palette of all reports: Okabe and Ito's colours, distinct for every kind of colour vision.
[[nodiscard]] const Palette& report_palette();

/// The place of each method's colour. A method of the palette has the same place everywhere, other methods follow.
/// If two methods share a place, such as two variants of one, the second takes the next free one. Colours repeat only
/// when all are taken.
/// methods: with their options, each once.
[[nodiscard]] std::vector<std::size_t> color_places(const std::vector<std::string>& methods);

}  // namespace footprint
