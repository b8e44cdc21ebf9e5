// The figures of the method that experiments ask for by [[quantity]].
#pragma once

#include <span>

#include "methods/quantities.hpp"

namespace footprint {

/// Those of the method's README.
[[nodiscard]] std::span<const Quantity> iwasaki_sg_quantities();

}  // namespace footprint
