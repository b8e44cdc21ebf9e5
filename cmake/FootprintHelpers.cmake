# A test's own sources run for a moment and take long to optimise; the libraries under test are as they are shipped.
set(FOOTPRINT_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)

# With the headers read beforehand GCC 12 at -O3 forgets that they are the system's, and warns of std::string's own code
# where nothing is wrong; a build without them keeps these warnings.
set(FOOTPRINT_PRECOMPILED_OPTIONS -Wno-array-bounds -Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread)
list(TRANSFORM FOOTPRINT_PRECOMPILED_OPTIONS REPLACE "(.+)" "$<$<CXX_COMPILER_ID:GNU>:\\1>")

# footprint_reuse_headers(TARGET NAME): TARGET starts from what footprint_precompile(NAME) read; nothing if the library
# is missing, as in a project that uses this build folder.
function(footprint_reuse_headers target name)
  if(NOT TARGET ${name})
    return()
  endif()
  target_precompile_headers(${target} REUSE_FROM ${name})
  target_link_libraries(${target} PRIVATE fmt::fmt)  # its macros are part of what was read
  # ccache preprocesses a source: with this the result names the precompiled file instead of its content.
  target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-fpch-preprocess> ${FOOTPRINT_PRECOMPILED_OPTIONS})
endfunction()

# Eight sources are compiled at once, as one: reading and instantiating headers takes longer than
# compiling the source itself. Set FOOTPRINT_UNITY=OFF while you edit one of them, so that it is compiled separately. Names of
# sources united must differ: an anonymous namespace is then one for all of them, which GCC takes for a header's.
# footprint_unite(TARGET ...): such targets; all libraries and tests are.
function(footprint_unite)
  set_target_properties(${ARGN} PROPERTIES UNITY_BUILD "${FOOTPRINT_UNITY}" UNITY_BUILD_BATCH_SIZE 8)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CXX_COMPILER_ID:GNU>:-Wno-subobject-linkage>)
  endforeach()
endfunction()

# footprint_compile_fast(TARGET ...): of sources that read and write text and do no more: CLI11's, toml++'s and nlohmann's
# inline code, of which each object has a copy, takes the compiler half as long again at -O3.
function(footprint_compile_fast)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

# footprint_add_library(NAME SOURCES ... LIBRARIES ...): a static library with the project's settings.
function(footprint_add_library name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_library(${name} STATIC ${ARG_SOURCES})
  target_link_libraries(${name} PUBLIC footprint_settings ${ARG_LIBRARIES})
  footprint_unite(${name})
  footprint_reuse_headers(${name} footprint_precompiled)
  set_property(GLOBAL APPEND PROPERTY FOOTPRINT_LIBRARIES ${name})
endfunction()

# The time limit of a test program: instrumented bakes run ten times slower.
set(FOOTPRINT_TEST_SECONDS 300)
if(FOOTPRINT_SANITIZE)
  set(FOOTPRINT_TEST_SECONDS 3000)
endif()

# Tests draw hundreds of programs once each, so llvmpipe's compiler leaves its optimisation passes out, which takes a tenth
# to two fifths off where no program is cached by an earlier run; other drivers do not know the word. Threads of OpenMP,
# which a library of OpenImageIO starts, sleep while they wait. The end-to-end tests draw as users do.
set(FOOTPRINT_TEST_ENVIRONMENT GALLIVM_PERF=nopt OMP_WAIT_POLICY=passive)

# footprint_add_test(NAME SOURCES ... LIBRARIES ...): one GTest binary, one ctest entry.
function(footprint_add_test name)
  if(NOT FOOTPRINT_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE footprint_settings ${ARG_LIBRARIES} GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${FOOTPRINT_TEST_OPTIONS})
  footprint_reuse_headers(${name} footprint_precompiled_tests)
  footprint_unite(${name})
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${FOOTPRINT_TEST_SECONDS} ENVIRONMENT "${FOOTPRINT_TEST_ENVIRONMENT}")
endfunction()

# footprint_embed(TARGET SYMBOL PATTERN ...): the texts of the files that match as `extern const EmbeddedTexts SYMBOL` in
# namespace footprint (renderer/core/embedded_texts.hpp), so that the program needs no file of its own at run
# time. A file that is added is in the table without another line; without a match the table is not made.
function(footprint_embed target symbol)
  file(GLOB texts CONFIGURE_DEPENDS ${ARGN})
  if(NOT texts)
    return()
  endif()
  list(JOIN texts "|" inputs)
  set(generated "${CMAKE_CURRENT_BINARY_DIR}/embedded_${symbol}.cpp")
  add_custom_command(
    OUTPUT "${generated}"
    COMMAND "${CMAKE_COMMAND}" "-DINPUTS=${inputs}" -DOUTPUT=${generated} -DSYMBOL=${symbol}
            -P "${FOOTPRINT_CMAKE_DIR}/EmbedTexts.cmake"
    DEPENDS ${texts} "${FOOTPRINT_CMAKE_DIR}/EmbedTexts.cmake"
    COMMENT "Embedding the texts of ${symbol}"
    VERBATIM)
  target_sources(${target} PRIVATE "${generated}")
endfunction()
set(FOOTPRINT_CMAKE_DIR "${CMAKE_CURRENT_LIST_DIR}" CACHE INTERNAL "Footprint's CMake scripts")
