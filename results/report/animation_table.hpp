// The table of an animation: means over its frames, and the worst of them.
#pragma once

#include <string>

#include "results/report/records.hpp"

namespace footprint {

/// "a zoom from distance 1 to 8", "an orbit by 60 degrees at distance 1".
/// results: of an animation (`way`).
[[nodiscard]] std::string path_words(const Results& results);

/// Two tables in Markdown, one line per method: means over the frames and the worst frame's flicker; the causes of
/// flicker. results: of an animation (`way`).
[[nodiscard]] std::string animation_table(const Results& results);

}  // namespace footprint
