# How methods get into a program; works in Footprint's tree and, after find_package(Footprint), out of it.

# footprint_add_method(NAME [SOURCES extra.cpp ...] [LIBRARIES ...]): a prefiltering method in the folder NAME, or in the
# current folder where that holds NAME.cpp, with NAME.cpp (which defines `const Method& NAME_method()`), its *.glsl (whose
# texts are footprint::embedded::NAME_glsl) and a test program of all its *_test.cpp. Nothing else has to change: the
# registry is written from these lines.
function(footprint_add_method name)
  cmake_parse_arguments(ARG "" "" "SOURCES;LIBRARIES" ${ARGN})
  set(folder "${CMAKE_CURRENT_SOURCE_DIR}/${name}")
  if(EXISTS "${CMAKE_CURRENT_SOURCE_DIR}/${name}.cpp")
    set(folder "${CMAKE_CURRENT_SOURCE_DIR}")
  endif()
  list(TRANSFORM ARG_SOURCES PREPEND "${folder}/")
  footprint_add_library(footprint_method_${name} SOURCES "${folder}/${name}.cpp" ${ARG_SOURCES}
                        LIBRARIES footprint_pipeline ${ARG_LIBRARIES})
  footprint_embed(footprint_method_${name} ${name}_glsl "${folder}/*.glsl")
  set_property(GLOBAL APPEND PROPERTY FOOTPRINT_METHODS ${name})
  file(GLOB tests CONFIGURE_DEPENDS "${folder}/*_test.cpp")
  if(tests)
    footprint_add_test(footprint_${name}_test SOURCES ${tests}
                       LIBRARIES footprint_method_${name} footprint_testing)
  endif()
endfunction()

# footprint_write_registry(FILE LIBRARIES): the C++ source of the registry of all methods added so far, and the list of
# their libraries in the variable LIBRARIES.
function(footprint_write_registry file libraries)
  get_property(names GLOBAL PROPERTY FOOTPRINT_METHODS)
  set(FOOTPRINT_METHOD_DECLARATIONS "")
  set(FOOTPRINT_METHOD_ADDRESSES "")
  foreach(name IN LISTS names)
    string(APPEND FOOTPRINT_METHOD_DECLARATIONS "[[nodiscard]] const Method& ${name}_method();\n")
    list(APPEND FOOTPRINT_METHOD_ADDRESSES "&${name}_method()")
  endforeach()
  list(LENGTH names FOOTPRINT_METHOD_COUNT)
  list(JOIN FOOTPRINT_METHOD_ADDRESSES ", " FOOTPRINT_METHOD_ADDRESSES)
  configure_file("${FOOTPRINT_CMAKE_DIR}/../methods/registry.cpp.in" "${file}" @ONLY)
  list(TRANSFORM names PREPEND footprint_method_)
  set(${libraries} "${names}" PARENT_SCOPE)
endfunction()

# footprint_finish_methods(TARGET): the library of all methods added so far, with their registry.
function(footprint_finish_methods target)
  footprint_write_registry("${CMAKE_CURRENT_BINARY_DIR}/registry.cpp" libraries)
  footprint_add_library(${target} SOURCES "${CMAKE_CURRENT_BINARY_DIR}/registry.cpp" LIBRARIES ${libraries})
endfunction()

# footprint_add_program(TARGET): the program `footprint` with all methods added so far, those of other projects too. Its
# own registry takes the place of the one in footprint_methods: a linker looks into an archive only for what it still
# lacks.
function(footprint_add_program target)
  footprint_write_registry("${CMAKE_CURRENT_BINARY_DIR}/registry.cpp" libraries)
  add_executable(${target} "${FOOTPRINT_CMAKE_DIR}/../app/main.cpp" "${CMAKE_CURRENT_BINARY_DIR}/registry.cpp")
  target_link_libraries(${target} PRIVATE footprint_commands ${libraries})
endfunction()
