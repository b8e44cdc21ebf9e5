// Which machine this is.
#pragma once

#include <string>

namespace footprint {

/// The name that this machine goes by on its network; "?" where it has none. Times belong to one.
[[nodiscard]] std::string host_name();

}  // namespace footprint
