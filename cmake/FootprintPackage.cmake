# footprint_package(): what CPack makes of the installed tree, by `scripts/package`: footprint_VERSION_amd64.deb, with
# its dependencies worked out by dpkg-shlibdeps, footprint-dev with what methods out of the tree are built from, and
# python3-footprint.
function(footprint_package)
  # Libraries that are opened at run time, which no linker sees, and data.
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_DEPENDS
      "libegl1, libegl-mesa0 | libegl-vendor, libgl1-mesa-dri | libgl1, fonts-dejavu-core")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_RECOMMENDS "assimp-testmodels, glmark2-data, blender-data, libvulkan1, mesa-vulkan-drivers")
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_SUGGESTS "libosmesa6, footprint-dev, ffmpeg")
  footprint_development_packages(development)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "cmake, g++, ${development}")

  # It reads the formats of the program's own version.
  set(CPACK_DEBIAN_PYTHON_PACKAGE_DEPENDS "footprint (= ${PROJECT_VERSION}), python3, python3-numpy")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_RECOMMENDS "python3-openimageio, python3-pandas")
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SUGGESTS "python3-matplotlib, jupyter-notebook")
  footprint_python_scripts(CPACK_DEBIAN_PYTHON_PACKAGE_CONTROL_EXTRA)

  set(CPACK_GENERATOR DEB)
  set(CPACK_PACKAGE_NAME footprint)
  set(CPACK_PACKAGE_VENDOR Footprint)
  set(CPACK_PACKAGE_CONTACT "Footprint's developers <footprint@localhost>")
  set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "${PROJECT_DESCRIPTION}")
  set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
  set(CPACK_STRIP_FILES ON)
  set(CPACK_COMPONENTS_ALL runtime development python)
  set(CPACK_DEB_COMPONENT_INSTALL ON)
  set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
  set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
  set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
  set(CPACK_DEBIAN_RUNTIME_PACKAGE_NAME footprint)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME footprint-dev)
  set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_NAME python3-footprint)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SECTION python)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_ARCHITECTURE all)
  set(CPACK_DEBIAN_PYTHON_PACKAGE_SHLIBDEPS OFF)
  include(CPack)
endfunction()

# footprint_development_packages(VARIABLE): the Debian packages of headers that scripts/packages.txt builds with, and what
# their CMake files insist on, commas between.
function(footprint_development_packages variable)
  file(STRINGS scripts/packages.txt lines REGEX "^((lib|nlohmann|glslang)[a-z0-9-]*-dev|(openimageio|glslang)-tools) ")
  list(TRANSFORM lines REPLACE " .*" "")
  list(JOIN lines ", " packages)
  set(${variable} "${packages}" PARENT_SCOPE)
endfunction()

# footprint_python_scripts(VARIABLE): what dpkg runs, as Debian's policy asks of Python packages: compiles the modules after
# the installation, and removes what was compiled before their removal.
function(footprint_python_scripts variable)
  set(scripts postinst prerm)
  set(commands py3compile py3clean)
  foreach(script command IN ZIP_LISTS scripts commands)
    set(file "${PROJECT_BINARY_DIR}/python_package/${script}")
    file(WRITE "${file}" "#!/bin/sh\nset -e\n${command} -p python3-footprint\n")
    file(CHMOD "${file}" PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
    list(APPEND files "${file}")
  endforeach()
  set(${variable} "${files}" PARENT_SCOPE)
endfunction()
