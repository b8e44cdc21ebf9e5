# Language, warnings and build type for every target.
set(CMAKE_CXX_STANDARD 20)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
if(NOT CMAKE_BUILD_TYPE AND NOT CMAKE_CONFIGURATION_TYPES)
  set(CMAKE_BUILD_TYPE Release CACHE STRING "Build type" FORCE)
endif()

option(FOOTPRINT_WERROR "Treat warnings as errors" OFF)
option(FOOTPRINT_TESTS "Build the tests" ON)
option(FOOTPRINT_BENCH "Build the benchmarks and the programs of scripts/studies" ON)
option(FOOTPRINT_UNITY "Compile sources of a library or test eight at once" ON)
option(FOOTPRINT_SANITIZE "Build with the address and undefined-behaviour sanitizers" OFF)
option(FOOTPRINT_FUZZ "Build libFuzzer targets for the readers (Clang, with FOOTPRINT_SANITIZE)" OFF)

add_library(footprint_settings INTERFACE)
target_include_directories(footprint_settings INTERFACE "$<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}>"
                                                        "$<INSTALL_INTERFACE:include/footprint>")
target_compile_features(footprint_settings INTERFACE cxx_std_20)  # for projects that use the build folder
target_compile_options(footprint_settings INTERFACE -Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wno-sign-conversion
                                                    -Wnon-virtual-dtor -Woverloaded-virtual)
# Inlined, std::optional of a structure looks uninitialised to GCC 13 and 14 where a default is read into, and a reference
# that a function finds by a name looks like one to that name. GCC 12, clang and the sanitizers look for what really is.
target_compile_options(footprint_settings INTERFACE
  "$<$<AND:$<CXX_COMPILER_ID:GNU>,$<VERSION_GREATER_EQUAL:$<CXX_COMPILER_VERSION>,13>>:-Wno-maybe-uninitialized;-Wno-dangling-reference>")
if(FOOTPRINT_WERROR)
  target_compile_options(footprint_settings INTERFACE -Werror)
endif()
if(FOOTPRINT_SANITIZE)
  target_compile_options(footprint_settings INTERFACE -fsanitize=address,undefined -fno-omit-frame-pointer
                                                      -fno-sanitize-recover=undefined)
  # Instrumented, std::regex of GCC 12's library looks uninitialised to it (GCC bug 105562).
  target_compile_options(footprint_settings INTERFACE $<$<CXX_COMPILER_ID:GNU>:-Wno-maybe-uninitialized>)
  target_link_options(footprint_settings INTERFACE -fsanitize=address,undefined)
endif()
if(FOOTPRINT_FUZZ)
  target_compile_options(footprint_settings INTERFACE -fsanitize=fuzzer-no-link)
endif()

# gold links in a tenth of the time that the default linker takes; there are some ninety programs.
find_program(FOOTPRINT_GOLD ld.gold)
if(FOOTPRINT_GOLD AND CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  add_link_options(-fuse-ld=gold)
endif()

# ccache keeps an object that starts from precompiled headers only where it need not look into them for __TIME__.
find_program(FOOTPRINT_CCACHE ccache)
if(FOOTPRINT_CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER "${CMAKE_COMMAND}" -E env CCACHE_SLOPPINESS=pch_defines,time_macros "${FOOTPRINT_CCACHE}")
endif()
