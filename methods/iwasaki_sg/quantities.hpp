// The figures of the method that experiments ask for by [[quantity]].
#pragma once

#include <vector>

#include "renderer/pipeline/quantity.hpp"

namespace footprint::iwasaki_sg {

/// Those of its README's table.
[[nodiscard]] std::vector<Quantity> quantity_table();

}  // namespace footprint::iwasaki_sg
