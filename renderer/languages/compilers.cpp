// CMake says what the build lacks.
#include "renderer/languages/compilers.hpp"

#include <fmt/format.h>

#include <string_view>

namespace footprint {
namespace {

constexpr std::string_view missing = FOOTPRINT_MISSING_COMPILERS;  // empty: the component is complete

}  // namespace

Error missing_compilers(const std::string& place) {
  return {ErrorKind::machine, place, fmt::format("this program was built without {}", missing),
          "install libvulkan-dev, glslang-dev, glslang-tools and libspirv-cross-c-shared-dev, and build it with "
          "-DFOOTPRINT_SHADER_COMPILERS=ON"};
}

void require_compilers(const std::string& place) {
  if (!missing.empty()) throw missing_compilers(place);
}

}  // namespace footprint
