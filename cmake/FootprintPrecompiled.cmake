# Precompiled headers of the tests: GTest, GLM and the standard library are read once a build and not once a source. A
# source keeps its own includes all the same; a build with FOOTPRINT_PRECOMPILE=OFF, and clang-tidy, hold it to them.
# Libraries have none: with them GCC 12 at -O3 warns of std::string's own code (-Warray-bounds) where nothing is wrong.
option(FOOTPRINT_PRECOMPILE "Read the headers of GTest, GLM and the standard library once for all tests" ON)

if(FOOTPRINT_TESTS AND FOOTPRINT_PRECOMPILE)
  # An object library whose headers the tests reuse (footprint_add_test), compiled with the options of the tests.
  set(source "${PROJECT_BINARY_DIR}/precompiled_tests.cpp")
  file(CONFIGURE OUTPUT "${source}" CONTENT "// CMake precompiles headers for a target that has a source.\n")
  add_library(footprint_precompiled_tests OBJECT "${source}")
  target_link_libraries(footprint_precompiled_tests PRIVATE footprint_settings glm::glm GTest::gtest)
  target_compile_options(footprint_precompiled_tests PRIVATE ${FOOTPRINT_TEST_OPTIONS})
  target_precompile_headers(
    footprint_precompiled_tests
    PRIVATE <algorithm> <array> <chrono> <cmath> <filesystem> <fstream> <functional> <map> <memory> <numeric> <optional>
            <random> <ranges> <span> <string> <string_view> <variant> <vector> <glm/glm.hpp> <gtest/gtest.h>)
endif()
