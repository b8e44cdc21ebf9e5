// The tables of a run, and the answer in a few sentences: in Markdown, and as printed text.
#pragma once

#include <string>
#include <vector>

#include "results/report/records.hpp"

namespace footprint {

/// The error and fps table in Markdown, aligned so that it also reads well in a terminal.
[[nodiscard]] std::string results_table(const Results& results);

/// "a zoom from distance 1 to 8", "an orbit by 60 degrees at distance 1".
/// results: of an animation (`way`).
[[nodiscard]] std::string path_words(const Results& results);

/// Two tables in Markdown, one line per method: means over the frames and the worst frame's flicker; the causes of
/// flicker. results: of an animation (`way`).
[[nodiscard]] std::string animation_table(const Results& results);

/// The text that the program prints: for each distance the most accurate method and the cheapest that improves on
/// `direct`, then one row per method and distance, the smallest error first. At most about 110 columns wide with short
/// names.
[[nodiscard]] std::string results_summary(const Results& results);

/// The answer at one distance.
struct DistanceAnswer {
  std::vector<std::string> sentences;  ///< the most accurate; then the cheapest that improves on `direct`, if another
  std::vector<std::string> methods = {};  ///< to show: `direct`, that cheapest one, the most accurate; what there is
};
[[nodiscard]] DistanceAnswer answer_at(const Results& results, double distance);

/// "-59%": the record's error over that of `direct` at its distance; empty for `direct`, and if either is not known.
[[nodiscard]] std::string change_from_direct(const Results& results, const Record& record);

}  // namespace footprint
