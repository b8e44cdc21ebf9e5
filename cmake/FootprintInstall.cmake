# The files that `cmake --install` and CPack put under a prefix, in three components:
#   runtime      the program, scenes, experiments, published figures, documents, manual pages, shell completions
#   development  headers, libraries and find_package(Footprint) for methods out of the tree
#   python       the package that runs the program from Python, and its example
include(GNUInstallDirs)
set(CMAKE_INSTALL_DOCDIR "${CMAKE_INSTALL_DATADIR}/doc/footprint")

# footprint_install_program(TARGET): the program, and all that it reads or that describes it. The program itself writes
# its completions and manual pages during the installation.
function(footprint_install_program target)
  set(data "${CMAKE_INSTALL_DATADIR}/footprint")
  install(TARGETS ${target} RUNTIME COMPONENT runtime)
  install(DIRECTORY scenes DESTINATION "${data}" COMPONENT runtime
          FILES_MATCHING PATTERN "scene.toml" PATTERN "*.png" PATTERN "README.md" PATTERN "surfaces" EXCLUDE)
  install(DIRECTORY experiments DESTINATION "${data}" COMPONENT runtime
          FILES_MATCHING PATTERN "*.toml" PATTERN "README.md")
  install(DIRECTORY results/published DESTINATION "${data}/results" COMPONENT runtime FILES_MATCHING PATTERN "*.toml")
  install(FILES results/quick_model.json DESTINATION "${data}/results" COMPONENT runtime)
  install(DIRECTORY docs DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)  # where the front page looks for them
  install(FILES README.md CHANGELOG.md CITATION.cff CONTRIBUTING.md DESTINATION "${CMAKE_INSTALL_DOCDIR}" COMPONENT runtime)
  install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DOCDIR}" RENAME copyright COMPONENT runtime)

  set(written "${CMAKE_CURRENT_BINARY_DIR}/self_description")
  install(CODE "execute_process(COMMAND \"${PROJECT_SOURCE_DIR}/packaging/self_description\" \"$<TARGET_FILE:${target}>\"
                                        \"${written}\" COMMAND_ERROR_IS_FATAL ANY)" COMPONENT runtime)
  install(DIRECTORY "${written}/man/" DESTINATION "${CMAKE_INSTALL_MANDIR}/man1" COMPONENT runtime)
  install(FILES "${written}/footprint" DESTINATION "${CMAKE_INSTALL_DATADIR}/bash-completion/completions" COMPONENT runtime)
  install(FILES "${written}/_footprint" DESTINATION "${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions" COMPONENT runtime)
  install(FILES "${written}/footprint.fish" DESTINATION "${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d"
          COMPONENT runtime)
endfunction()

# footprint_install_development(): what find_package(Footprint) needs. CMake's scripts find the program's main.cpp, the
# registries' templates and the method to copy where they find them in the tree: beside their own folder.
function(footprint_install_development)
  get_property(libraries GLOBAL PROPERTY FOOTPRINT_LIBRARIES)
  get_property(FOOTPRINT_METHODS GLOBAL PROPERTY FOOTPRINT_METHODS)
  get_property(FOOTPRINT_STUDIES GLOBAL PROPERTY FOOTPRINT_STUDIES)
  set(parts "${CMAKE_INSTALL_DATADIR}/footprint/development")
  set(config "${CMAKE_INSTALL_LIBDIR}/cmake/Footprint")
  install(TARGETS footprint_settings ${libraries} EXPORT FootprintTargets
          ARCHIVE DESTINATION "${CMAKE_INSTALL_LIBDIR}/footprint" COMPONENT development)
  install(EXPORT FootprintTargets DESTINATION "${config}" COMPONENT development)
  set(headers app experiments methods renderer results scenes)
  if(FOOTPRINT_TESTS)
    list(APPEND headers tests)
  endif()
  install(DIRECTORY ${headers} DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/footprint" COMPONENT development
          FILES_MATCHING PATTERN "*.hpp" PATTERN "template" EXCLUDE)
  install(DIRECTORY "${PROJECT_BINARY_DIR}/renderer/gl/generated/renderer" COMPONENT development
          DESTINATION "${CMAKE_INSTALL_INCLUDEDIR}/footprint" FILES_MATCHING PATTERN "*.hpp")
  install(DIRECTORY cmake DESTINATION "${parts}" COMPONENT development FILES_MATCHING PATTERN "*.cmake")
  install(FILES app/main.cpp DESTINATION "${parts}/app" COMPONENT development)
  install(FILES methods/method_file.cpp.in methods/quantities.cpp.in methods/registry.cpp.in DESTINATION "${parts}/methods" COMPONENT development)
  install(DIRECTORY methods/template DESTINATION "${parts}/methods" COMPONENT development)

  # The configuration of an installed tree names its own scripts relative to itself.
  file(RELATIVE_PATH up "/${config}" "/${parts}/cmake")
  set(FOOTPRINT_SCRIPTS "\${CMAKE_CURRENT_LIST_DIR}/${up}")
  configure_file("${FOOTPRINT_CMAKE_DIR}/FootprintConfig.cmake.in" "${PROJECT_BINARY_DIR}/installed/FootprintConfig.cmake"
                 @ONLY)
  install(FILES "${PROJECT_BINARY_DIR}/installed/FootprintConfig.cmake" DESTINATION "${config}" COMPONENT development)
endfunction()

# footprint_install_python(): where Debian's Python looks, and any other by PYTHONPATH.
function(footprint_install_python)
  install(DIRECTORY python/footprint DESTINATION lib/python3/dist-packages COMPONENT python FILES_MATCHING PATTERN "*.py")
  install(DIRECTORY python/examples DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/python3-footprint" COMPONENT python)
  install(FILES LICENSE DESTINATION "${CMAKE_INSTALL_DATADIR}/doc/python3-footprint" RENAME copyright COMPONENT python)
endfunction()
