# What `cmake --install` puts in place: the command with its scenes, and the CMake package that find_package(brickfall)
# finds: brickfall::brickfall (the engine), brickfall::report (docs/report.md), brickfall::machines and, where they were built,
# brickfall::scene, brickfall::take and brickfall::output.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/brickfall)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/brickfall DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
set(libraries brickfall brickfall_report brickfall_machines)
if(BRICKFALL_APPS)
  list(APPEND libraries brickfall_scene brickfall_take)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/scenes DESTINATION ${CMAKE_INSTALL_DATADIR}/brickfall
    FILES_MATCHING PATTERN "*.toml" PATTERN "*.obj" PATTERN "*.csv")
endif()
if(BRICKFALL_OUTPUT)
  list(APPEND libraries brickfall_output)
  install(TARGETS brickfall_cli RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
  install(FILES ${CMAKE_BINARY_DIR}/words/brickfall.1 DESTINATION ${CMAKE_INSTALL_MANDIR}/man1)
  install(FILES ${CMAKE_BINARY_DIR}/words/brickfall DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
  install(FILES ${CMAKE_BINARY_DIR}/words/_brickfall DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/site-functions)
  install(FILES ${CMAKE_BINARY_DIR}/words/brickfall.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d)
  # Where they were built: `make install` alone builds the command only.
  foreach(companion brickfall_render brickfall_view)
    if(TARGET ${companion})
      install(PROGRAMS $<TARGET_FILE:${companion}> DESTINATION ${CMAKE_INSTALL_BINDIR} OPTIONAL)
    endif()
  endforeach()
endif()
install(TARGETS ${libraries} EXPORT brickfallTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
install(EXPORT brickfallTargets NAMESPACE brickfall:: DESTINATION ${package_dir})

configure_package_config_file(${CMAKE_CURRENT_LIST_DIR}/brickfallConfig.cmake.in
  ${CMAKE_BINARY_DIR}/package/brickfallConfig.cmake INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(${CMAKE_BINARY_DIR}/package/brickfallConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/package/brickfallConfig.cmake ${CMAKE_BINARY_DIR}/package/brickfallConfigVersion.cmake
  DESTINATION ${package_dir})
set(pkgconfig brickfall)
if(BRICKFALL_OUTPUT)
  list(APPEND pkgconfig brickfall-output)
endif()
foreach(name IN LISTS pkgconfig)
  # Written when it is installed: only then is the place known (cmake --install --prefix).
  install(CODE "set(PROJECT_VERSION ${PROJECT_VERSION})\nset(CMAKE_INSTALL_LIBDIR ${CMAKE_INSTALL_LIBDIR})
set(CMAKE_INSTALL_INCLUDEDIR ${CMAKE_INSTALL_INCLUDEDIR})
get_filename_component(CMAKE_INSTALL_PREFIX \"\${CMAKE_INSTALL_PREFIX}\" ABSOLUTE)
configure_file(${CMAKE_CURRENT_LIST_DIR}/${name}.pc.in ${CMAKE_BINARY_DIR}/package/${name}.pc @ONLY)")
  install(FILES ${CMAKE_BINARY_DIR}/package/${name}.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig)
endforeach()

# Documents, with the links between them as they are in the source, and programs to begin with.
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE ${PROJECT_SOURCE_DIR}/THIRD_PARTY.md ${PROJECT_SOURCE_DIR}/README.md
  ${PROJECT_SOURCE_DIR}/CHANGELOG.md ${PROJECT_SOURCE_DIR}/CONTRIBUTING.md DESTINATION ${CMAKE_INSTALL_DOCDIR})
install(DIRECTORY ${PROJECT_SOURCE_DIR}/docs ${PROJECT_SOURCE_DIR}/examples DESTINATION ${CMAKE_INSTALL_DOCDIR})
# Scenes name it as ../docs/scene.schema.json, for editors.
install(FILES ${PROJECT_SOURCE_DIR}/docs/scene.schema.json DESTINATION ${CMAKE_INSTALL_DATADIR}/brickfall/docs)

# cpack -G DEB in the build folder: a package of what was built.
set(CPACK_PACKAGE_NAME brickfall)
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGE_CONTACT "The Brickfall authors <brickfall@localhost>")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "Knocks down brick walls: rigid-body physics, command and library")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_GENERATOR "DEB")
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "libzstd-dev")
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_STRIP_FILES ON)
include(CPack)
