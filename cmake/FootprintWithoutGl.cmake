# Targets that run without GL. Configuring the build checks that none of them links footprint_gl, directly or
# indirectly.

# footprint_without_gl(TARGET ...): names such targets.
function(footprint_without_gl)
  set_property(GLOBAL APPEND PROPERTY FOOTPRINT_WITHOUT_GL ${ARGN})
endfunction()

# footprint_find_link(TARGET LIBRARY PATH): the libraries over which TARGET links LIBRARY, in the variable PATH; empty
# where it does not.
function(footprint_find_link target library path)
  set(open "${target}")
  set(seen "")
  set(${path} "" PARENT_SCOPE)
  while(open)
    list(POP_FRONT open chain)
    string(REGEX REPLACE ".* > " "" last "${chain}")
    if(last STREQUAL library)
      set(${path} "${chain}" PARENT_SCOPE)
      return()
    endif()
    if(NOT TARGET "${last}" OR last IN_LIST seen)
      continue()
    endif()
    list(APPEND seen "${last}")
    foreach(property LINK_LIBRARIES INTERFACE_LINK_LIBRARIES)
      get_target_property(links "${last}" ${property})
      if(NOT links)
        continue()
      endif()
      string(REGEX REPLACE "\\$<LINK_ONLY:([^>]*)>" "\\1" links "${links}")
      list(TRANSFORM links PREPEND "${chain} > ")
      list(APPEND open ${links})
    endforeach()
  endwhile()
endfunction()

# footprint_check_without_gl(): an error where one of them links footprint_gl, or where the search would not see it. Call
# it after all targets are declared.
function(footprint_check_without_gl)
  footprint_find_link(footprint_pipeline footprint_gl path)
  if(NOT path)
    message(FATAL_ERROR "footprint_pipeline links footprint_gl, and footprint_find_link does not see it")
  endif()
  get_property(targets GLOBAL PROPERTY FOOTPRINT_WITHOUT_GL)
  foreach(target IN LISTS targets)
    footprint_find_link(${target} footprint_gl path)
    if(path)
      message(FATAL_ERROR "${target} must run without GL, and links it: ${path}")
    endif()
  endforeach()
endfunction()
