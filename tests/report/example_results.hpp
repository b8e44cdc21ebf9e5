// Runs made up for the tests of this folder: one as a scene gives it, one with everything that could break a page.
#pragma once

#include "results/report/report.hpp"

namespace footprint {

/// Four methods at three distances with a supersampling curve; figures of a plausible size, every optional one there
/// in some records and absent in others.
[[nodiscard]] Results example_results();

/// Names with markup, quotes, commas, line breaks and bytes that are no UTF-8; absent and infinite figures.
[[nodiscard]] Results hostile_results();

/// A matrix of so many members, each with the twelve records of example_results() and figures of its own: every two
/// share a scene, under two footprint filters. Frames have flicker.
[[nodiscard]] MatrixResults example_matrix(std::size_t members);

}  // namespace footprint
