# A test's own sources run for a moment and take long to optimise; the libraries under test are as they are shipped.
set(FOOTPRINT_TEST_OPTIONS $<$<CONFIG:Release>:-O1>)
set(FOOTPRINT_FAST_OPTIONS $<$<CONFIG:Release>:-O1>)

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

# footprint_compile_fast(TARGET ...): compiles targets that only read and write text at -O1: the inline code of CLI11, toml++
# and nlohmann's JSON, of which each object has a copy, compiles 1.5 times as slowly at -O3. Headers that were read at -O3 do
# not serve them (GCC 14 refuses them).
function(footprint_compile_fast)
  foreach(target IN LISTS ARGN)
    target_compile_options(${target} PRIVATE ${FOOTPRINT_FAST_OPTIONS})
    if(TARGET footprint_precompiled_fast)
      set_target_properties(${target} PROPERTIES PRECOMPILE_HEADERS_REUSE_FROM footprint_precompiled_fast)
      add_dependencies(${target} footprint_precompiled_fast)
    endif()
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

# The tiers of tests, as ctest labels. fast: what to run at each edit, without OpenGL but for one small frame per method;
# full: everything else that scripts/test and CI run; nightly: only with `ctest -C nightly` (scripts/test --nightly).
set(FOOTPRINT_TEST_TIERS fast full nightly)

# footprint_set_tier(NAME TIER): labels a test; called by the three functions that define tests.
function(footprint_set_tier name tier)
  if(NOT tier IN_LIST FOOTPRINT_TEST_TIERS)
    message(FATAL_ERROR "test ${name}: TIER is `${tier}`, not one of: ${FOOTPRINT_TEST_TIERS}")
  endif()
  set_property(TEST ${name} APPEND PROPERTY LABELS ${tier})
endfunction()

# footprint_add_test(NAME [TIER tier] SOURCES ... LIBRARIES ...): one GTest binary, one ctest entry; of the tier `full`
# unless named.
function(footprint_add_test name)
  if(NOT FOOTPRINT_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "TIER" "SOURCES;LIBRARIES" ${ARGN})
  if(NOT ARG_TIER)
    set(ARG_TIER full)
  endif()
  add_executable(${name} ${ARG_SOURCES})
  target_link_libraries(${name} PRIVATE footprint_settings ${ARG_LIBRARIES} GTest::gtest_main)
  target_compile_options(${name} PRIVATE ${FOOTPRINT_TEST_OPTIONS})
  footprint_reuse_headers(${name} footprint_precompiled_tests)
  footprint_unite(${name})
  add_test(NAME ${name} COMMAND ${name})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${FOOTPRINT_TEST_SECONDS} ENVIRONMENT "${FOOTPRINT_TEST_ENVIRONMENT}")
  footprint_set_tier(${name} ${ARG_TIER})
endfunction()

# footprint_add_command_test(NAME TIER tier COMMAND ... [TIMEOUT seconds] [ENVIRONMENT name=value ...]): one ctest entry of
# any command; exit code 77 skips it, because a package is missing.
function(footprint_add_command_test name)
  if(NOT FOOTPRINT_TESTS)
    return()
  endif()
  cmake_parse_arguments(ARG "" "TIER;TIMEOUT" "COMMAND;ENVIRONMENT" ${ARGN})
  if(NOT ARG_TIMEOUT)
    set(ARG_TIMEOUT ${FOOTPRINT_TEST_SECONDS})
  endif()
  if(ARG_TIER STREQUAL nightly)
    set(only CONFIGURATIONS nightly)
  endif()
  add_test(NAME ${name} COMMAND ${ARG_COMMAND} ${only})
  set_tests_properties(${name} PROPERTIES TIMEOUT ${ARG_TIMEOUT} SKIP_RETURN_CODE 77)
  set_property(TEST ${name} PROPERTY ENVIRONMENT "FOOTPRINT_PROGRAM=$<TARGET_FILE:footprint>"
                                                 "FOOTPRINT_SOURCE_DIR=${PROJECT_SOURCE_DIR}"
                                                 "FOOTPRINT_HAS_COMPILERS=${FOOTPRINT_HAS_COMPILERS}" ${ARG_ENVIRONMENT})
  footprint_set_tier(${name} ${ARG_TIER})
endfunction()

# footprint_add_script_test(NAME TIER tier SCRIPT file.py [ARGUMENTS ...] ...): such an entry of a Python script of the
# current folder; further arguments are those of footprint_add_command_test.
function(footprint_add_script_test name)
  cmake_parse_arguments(ARG "" "SCRIPT" "ARGUMENTS" ${ARGN})
  footprint_add_command_test(${name} COMMAND "${FOOTPRINT_PYTHON}" -B "${CMAKE_CURRENT_SOURCE_DIR}/${ARG_SCRIPT}"
                                             ${ARG_ARGUMENTS} ${ARG_UNPARSED_ARGUMENTS})
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
