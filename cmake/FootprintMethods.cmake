# How methods get into a program; works in Footprint's tree and, after find_package(Footprint), out of it.

# footprint_add_method(NAME [SOURCES extra.cpp ...] [TEXTS other/text.glsl ...] [STUDY figures.cpp ...]
#                      [LIBRARIES ...] [BAKE_TESTS extra ...]):
# a prefiltering method in the folder NAME, or in the current folder where that contains NAME.cpp, with NAME.cpp (which
# defines `const Method& NAME_method()`), its *.glsl (whose texts are footprint::NAME_glsl) and a test program
# of its *_test.cpp. Without NAME.cpp the method is that of the head of NAME.glsl (docs/guides/method-files.md). Its library links footprint_bake; a method with GL code of its own names footprint_pipeline. TEXTS
# names texts of other methods' folders that the module includes too, from the current folder on. STUDY names sources in
# its folder study/, a library of their own that no picture needs; they define `std::span<const Quantity>
# NAME_quantities()` (methods/registry.hpp). BAKE_TESTS names tests of the precompute and of the study alone,
# extra_test.cpp: a program that links no GL. Nothing else has to change: the registry is written from these lines.
function(footprint_add_method name)
  cmake_parse_arguments(ARG "" "" "SOURCES;TEXTS;STUDY;LIBRARIES;BAKE_TESTS" ${ARGN})
  set(folder "${CMAKE_CURRENT_SOURCE_DIR}/${name}")
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${name}.cpp")
    set(folder "${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  list(TRANSFORM ARG_SOURCES PREPEND "${folder}/")
  set(source "${folder}/${name}.cpp")
  if(NOT EXISTS "${source}")
    set(source "${CMAKE_CURRENT_BINARY_DIR}/${name}.cpp")
    configure_file("${FOOTPRINT_CMAKE_DIR}/../methods/method_file.cpp.in" "${source}" @ONLY)
  endif()
  footprint_add_library(footprint_method_${name} SOURCES "${source}" ${ARG_SOURCES}
                        LIBRARIES footprint_bake ${ARG_LIBRARIES})
  list(TRANSFORM ARG_TEXTS PREPEND "${CMAKE_CURRENT_SOURCE_DIR}/")
  footprint_embed(footprint_method_${name} ${name}_glsl "${folder}/*.glsl" ${ARG_TEXTS})
  set_property(GLOBAL APPEND PROPERTY FOOTPRINT_METHODS ${name})
  set(libraries footprint_method_${name})
  if(ARG_STUDY)
    list(TRANSFORM ARG_STUDY PREPEND "${folder}/study/")
    footprint_add_library(footprint_study_${name} SOURCES ${ARG_STUDY} LIBRARIES ${libraries})
    set_property(GLOBAL APPEND PROPERTY FOOTPRINT_STUDIES ${name})
    set(libraries footprint_study_${name})
  endif()
  file(GLOB tests CONFIGURE_DEPENDS "${folder}/*_test.cpp" "${folder}/study/*_test.cpp")
  if(ARG_BAKE_TESTS AND FOOTPRINT_TESTS)
    list(TRANSFORM ARG_BAKE_TESTS REPLACE "(.+)" "${folder}/\\1_test.cpp")
    list(REMOVE_ITEM tests ${ARG_BAKE_TESTS})
    footprint_add_test(footprint_${name}_bake_test TIER fast SOURCES ${ARG_BAKE_TESTS}
                       LIBRARIES ${libraries} footprint_scene_testing)
    footprint_without_gl(footprint_${name}_bake_test)
  endif()
  if(tests)
    footprint_add_test(footprint_${name}_test SOURCES ${tests} LIBRARIES ${libraries} footprint_testing)
  endif()
endfunction()

# footprint_write_registry(SOURCES LIBRARIES): the C++ sources of the registry of all methods added so far and of their
# studies, written into the current binary folder, and the list of their libraries, in the variables of these names.
function(footprint_write_registry sources libraries)
  get_property(names GLOBAL PROPERTY FOOTPRINT_METHODS)
  get_property(studies GLOBAL PROPERTY FOOTPRINT_STUDIES)
  set(FOOTPRINT_METHOD_DECLARATIONS "")
  set(FOOTPRINT_METHOD_ADDRESSES "")
  foreach(name IN LISTS names)
    string(APPEND FOOTPRINT_METHOD_DECLARATIONS "[[nodiscard]] const Method& ${name}_method();\n")
    list(APPEND FOOTPRINT_METHOD_ADDRESSES "&${name}_method()")
  endforeach()
  list(LENGTH names FOOTPRINT_METHOD_COUNT)
  list(JOIN FOOTPRINT_METHOD_ADDRESSES ", " FOOTPRINT_METHOD_ADDRESSES)
  set(FOOTPRINT_STUDY_DECLARATIONS "")
  set(FOOTPRINT_STUDY_CASES "")
  foreach(name IN LISTS studies)
    string(APPEND FOOTPRINT_STUDY_DECLARATIONS "const Method& ${name}_method();\n"
                                               "std::span<const Quantity> ${name}_quantities();\n")
    string(APPEND FOOTPRINT_STUDY_CASES "  if (&method == &${name}_method()) return ${name}_quantities();\n")
  endforeach()
  foreach(source registry quantities)
    configure_file("${FOOTPRINT_CMAKE_DIR}/../methods/${source}.cpp.in" "${CMAKE_CURRENT_BINARY_DIR}/${source}.cpp"
                   @ONLY)
  endforeach()
  list(TRANSFORM names PREPEND footprint_method_)
  list(TRANSFORM studies PREPEND footprint_study_)
  set(${sources} "${CMAKE_CURRENT_BINARY_DIR}/registry.cpp" "${CMAKE_CURRENT_BINARY_DIR}/quantities.cpp" PARENT_SCOPE)
  set(${libraries} ${studies} ${names} PARENT_SCOPE)
endfunction()

# footprint_finish_methods(TARGET): the library of all methods added so far, with their registry.
function(footprint_finish_methods target)
  footprint_write_registry(sources libraries)
  footprint_add_library(${target} SOURCES ${sources} LIBRARIES ${libraries})
endfunction()

# footprint_add_program(TARGET): the program `footprint` with all methods added so far, those of other projects too. Its
# own registry takes the place of the one in footprint_methods: a linker looks into an archive only for what it still
# lacks.
function(footprint_add_program target)
  footprint_write_registry(sources libraries)
  add_executable(${target} "${FOOTPRINT_CMAKE_DIR}/../app/main.cpp"
                 ${sources})
  target_link_libraries(${target} PRIVATE footprint_commands ${libraries})
endfunction()
