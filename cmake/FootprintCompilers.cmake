# The compilers of shaders: Vulkan's headers, glslang and SPIRV-Cross, one optional component. `footprint cost`, `--gpu`
# and shaders in other languages than GLSL need all of them; nothing else needs any.
if(NOT DEFINED FOOTPRINT_SHADER_COMPILERS)
  set(FOOTPRINT_SHADER_COMPILERS AUTO CACHE STRING
      "Compile and translate shaders, for `cost`, `--gpu` and `shader`: ON, OFF or AUTO, if all that it takes is found")
  set_property(CACHE FOOTPRINT_SHADER_COMPILERS PROPERTY STRINGS AUTO ON OFF)
endif()

# Sets FOOTPRINT_HAS_COMPILERS, and FOOTPRINT_MISSING_COMPILERS: what a build lacks, in words.
set(FOOTPRINT_HAS_COMPILERS ON)
set(FOOTPRINT_MISSING_COMPILERS "")
set(FOOTPRINT_COMPILER_PACKAGES VulkanHeaders glslang spirv_cross_c_shared)
set(FOOTPRINT_COMPILER_NAMES "Vulkan's headers" glslang SPIRV-Cross)
foreach(package name IN ZIP_LISTS FOOTPRINT_COMPILER_PACKAGES FOOTPRINT_COMPILER_NAMES)
  if(FOOTPRINT_SHADER_COMPILERS STREQUAL "AUTO")
    find_package(${package} CONFIG QUIET)
  elseif(FOOTPRINT_SHADER_COMPILERS)
    find_package(${package} CONFIG REQUIRED)
  endif()
  if(NOT FOOTPRINT_SHADER_COMPILERS OR NOT ${package}_FOUND)
    list(APPEND FOOTPRINT_MISSING_COMPILERS "${name}")
  endif()
endforeach()
if(FOOTPRINT_MISSING_COMPILERS)
  set(FOOTPRINT_HAS_COMPILERS OFF)
  list(JOIN FOOTPRINT_MISSING_COMPILERS ", " FOOTPRINT_MISSING_COMPILERS)
  message(STATUS "No compilers of shaders (`cost`, `--gpu` and all languages but GLSL are refused): without ${FOOTPRINT_MISSING_COMPILERS}")
endif()
