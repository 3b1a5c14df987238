# Install rules: the program, the library with its headers and package files, the built-in
# configuration. Included after every target is there.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(SLALOM_INSTALL_CONFIG_DIR ${CMAKE_INSTALL_DATADIR}/slalom/config)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/slalom)

install(TARGETS slalom EXPORT slalomTargets ARCHIVE DESTINATION ${CMAKE_INSTALL_LIBDIR})
if(TARGET slalom_app)
  install(TARGETS slalom_app RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
endif()
install(DIRECTORY include/slalom DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}
        FILES_MATCHING PATTERN "*.hpp")
install(DIRECTORY config/ DESTINATION ${SLALOM_INSTALL_CONFIG_DIR})
install(FILES LICENSE CHANGELOG.md DESTINATION ${CMAKE_INSTALL_DOCDIR})

install(EXPORT slalomTargets NAMESPACE slalom:: DESTINATION ${package_dir})
export(EXPORT slalomTargets NAMESPACE slalom:: FILE ${PROJECT_BINARY_DIR}/slalomTargets.cmake)
configure_package_config_file(cmake/slalomConfig.cmake.in
  ${PROJECT_BINARY_DIR}/slalomConfig.cmake INSTALL_DESTINATION ${package_dir}
  PATH_VARS SLALOM_INSTALL_CONFIG_DIR)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/slalomConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/slalomConfig.cmake
              ${PROJECT_BINARY_DIR}/slalomConfigVersion.cmake
              cmake/FindIpopt.cmake cmake/FindKnitro.cmake DESTINATION ${package_dir})
