// How a glTF file is refused: an error of usage with the place in the file and what helps.
#pragma once

#include <string>

#include "renderer/core/error.hpp"

namespace footprint {

[[noreturn]] inline void refuse_gltf(const std::string& place, const std::string& message,
                                     const std::string& hint = "repair the file or export it again") {
  throw Error(ErrorKind::usage, place, message, hint);
}

}  // namespace footprint
