# footprint_export_build_tree(): makes find_package(Footprint) find this build folder, so that a method can be built
# outside of the tree. Call it after all libraries are declared.
function(footprint_export_build_tree)
  get_property(libraries GLOBAL PROPERTY FOOTPRINT_LIBRARIES)
  get_property(FOOTPRINT_METHODS GLOBAL PROPERTY FOOTPRINT_METHODS)
  get_property(FOOTPRINT_STUDIES GLOBAL PROPERTY FOOTPRINT_STUDIES)
  export(TARGETS footprint_settings ${libraries} FILE "${PROJECT_BINARY_DIR}/FootprintTargets.cmake")
  configure_file("${FOOTPRINT_CMAKE_DIR}/FootprintConfig.cmake.in" "${PROJECT_BINARY_DIR}/FootprintConfig.cmake" @ONLY)
endfunction()
