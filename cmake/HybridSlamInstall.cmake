# cmake --install: the package for find_package(hybrid_slam), settings, data and documentation.
# Programs, libraries and headers: HybridSlamTargets.cmake.

include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/hybrid_slam)
set(data ${CMAKE_INSTALL_DATADIR}/hybrid_slam)
set(documentation ${CMAKE_INSTALL_DATAROOTDIR}/doc/hybrid_slam)

configure_package_config_file(cmake/hybrid_slamConfig.cmake.in ${PROJECT_BINARY_DIR}/hybrid_slamConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hybrid_slamConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hybrid_slamConfig.cmake ${PROJECT_BINARY_DIR}/hybrid_slamConfigVersion.cmake
  DESTINATION ${package})
install(EXPORT hybrid_slam NAMESPACE hybrid_slam:: FILE hybrid_slamTargets.cmake DESTINATION ${package})

# The INI files name the data set by its place beside them.
install(DIRECTORY config-ini DESTINATION ${data})
install(DIRECTORY datasets/csie DESTINATION ${data}/datasets)
install(FILES README.md LICENSE DESTINATION ${documentation})
install(DIRECTORY doc DESTINATION ${documentation})
