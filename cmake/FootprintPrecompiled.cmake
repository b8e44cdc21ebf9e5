# Precompiled headers: the standard library, GLM and fmt are read once per build and not once per source, GTest too for tests.
# A source keeps its own includes all the same; a build with FOOTPRINT_PRECOMPILE=OFF, and clang-tidy, check them.
option(FOOTPRINT_PRECOMPILE "Read the headers of the standard library, GLM, fmt and GTest once per build" ON)

# footprint_precompile(NAME OPTIONS ... HEADERS ... LIBRARIES ...): an object library whose headers others reuse
# (footprint_reuse_headers of FootprintHelpers.cmake); they are compiled with the same options.
function(footprint_precompile name)
  cmake_parse_arguments(ARG "" "" "OPTIONS;HEADERS;LIBRARIES" ${ARGN})
  set(source "${PROJECT_BINARY_DIR}/${name}.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "// CMake precompiles headers for a target that has a source.\n")
  add_library(${name} OBJECT "${source}")
  target_link_libraries(${name} PRIVATE footprint_settings glm::glm fmt::fmt ${ARG_LIBRARIES})
  target_compile_options(${name} PRIVATE ${ARG_OPTIONS})
  target_precompile_headers(
    ${name}
    PRIVATE <algorithm> <array> <chrono> <cmath> <cstdint> <filesystem> <fstream> <functional> <map> <memory> <numbers>
            <numeric> <optional> <random> <ranges> <set> <span> <sstream> <string> <string_view> <variant> <vector>
            <fmt/format.h> <fmt/ranges.h> <glm/glm.hpp> ${ARG_HEADERS})
endfunction()

if(FOOTPRINT_PRECOMPILE)
  footprint_precompile(footprint_precompiled OPTIONS ${FOOTPRINT_PRECOMPILED_OPTIONS})
  footprint_precompile(footprint_precompiled_fast OPTIONS ${FOOTPRINT_FAST_OPTIONS} ${FOOTPRINT_PRECOMPILED_OPTIONS})
  if(FOOTPRINT_TESTS)
    footprint_precompile(footprint_precompiled_tests OPTIONS ${FOOTPRINT_TEST_OPTIONS} ${FOOTPRINT_PRECOMPILED_OPTIONS}
                         HEADERS <gtest/gtest.h> LIBRARIES GTest::gtest)
  endif()
endif()
