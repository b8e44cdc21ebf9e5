// Animations made up for the tests of this folder.
#pragma once

#include "results/report/records.hpp"

namespace footprint {

/// Two methods in three frames of an orbit; every optional figure there in some records and absent in others.
[[nodiscard]] Results example_animation();

/// The example animation with names that could break a page.
[[nodiscard]] Results hostile_animation();

}  // namespace footprint
