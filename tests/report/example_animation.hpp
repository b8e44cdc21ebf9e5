// Animations made up for the tests of this folder.
#pragma once

#include "results/report/animation_report.hpp"

namespace footprint {

/// Two methods in three frames of an orbit; every optional figure there in some records and absent in others.
[[nodiscard]] Animation example_animation();

/// The same with names that could break a page.
[[nodiscard]] Animation hostile_animation();

}  // namespace footprint
