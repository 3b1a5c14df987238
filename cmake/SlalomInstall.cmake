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
              cmake/FindKnitro.cmake DESTINATION ${package_dir})

# `make package`: a Debian package of what is installed. Its dependencies are found by the linker's
# own list (dpkg-shlibdeps); whoever links the library in it needs what slalomConfig.cmake looks for.
set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME slalom)
set(CPACK_PACKAGE_CONTACT "the Slalom project")
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "plans and drives trajectories for fast ground vehicles")
set(CPACK_RESOURCE_FILE_LICENSE ${PROJECT_SOURCE_DIR}/LICENSE)
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "libfmt-dev, libyaml-cpp-dev, libsqlite3-dev, libsleef-dev")
set(CPACK_DEBIAN_PACKAGE_SUGGESTS coinor-libipopt1v5)  # looked for when solver `ipopt` is asked for
include(CPack)
