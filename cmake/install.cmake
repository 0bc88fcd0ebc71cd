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
install(FILES ${PROJECT_SOURCE_DIR}/LICENSE DESTINATION ${CMAKE_INSTALL_DOCDIR})
