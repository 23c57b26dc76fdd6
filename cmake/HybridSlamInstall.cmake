# cmake --install: the package for find_package(hybrid_slam), settings, data and documentation.
# Programs, libraries and headers: HybridSlamTargets.cmake. Each component is a Debian package (HybridSlamPackages.cmake).

include(CMakePackageConfigHelpers)
set(package ${CMAKE_INSTALL_LIBDIR}/cmake/hybrid_slam)

configure_package_config_file(cmake/hybrid_slamConfig.cmake.in ${PROJECT_BINARY_DIR}/hybrid_slamConfig.cmake
  INSTALL_DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/hybrid_slamConfigVersion.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/hybrid_slamConfig.cmake ${PROJECT_BINARY_DIR}/hybrid_slamConfigVersion.cmake
  DESTINATION ${package} COMPONENT development)
install(EXPORT hybrid_slam NAMESPACE hybrid_slam:: FILE hybrid_slamTargets.cmake
  DESTINATION ${package} COMPONENT development)

# The INI files name the data set by a relative path, so both are installed side by side.
install(DIRECTORY config-ini workflow DESTINATION ${hybrid_slam_data} COMPONENT programs)
install(DIRECTORY datasets/csie DESTINATION ${hybrid_slam_data}/datasets COMPONENT programs)
install(FILES README.md CITATION.cff CONTRIBUTING.md DESTINATION ${hybrid_slam_pages} COMPONENT programs)
install(DIRECTORY doc DESTINATION ${hybrid_slam_pages} COMPONENT programs)
install(FILES LICENSE DESTINATION ${hybrid_slam_pages} COMPONENT license)

# One completion file serves all programs; the shell looks for it by the program's name.
set(completions ${CMAKE_INSTALL_DATADIR}/bash-completion/completions)
install(FILES packaging/hybrid-slam.bash DESTINATION ${completions} COMPONENT programs RENAME hybrid-slam)
install(FILES packaging/hybrid-slam.zsh DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions
  COMPONENT programs RENAME _hybrid-slam)
file(MAKE_DIRECTORY ${PROJECT_BINARY_DIR}/completions)
foreach(app IN LISTS hybrid_slam_apps)
  if(NOT app STREQUAL hybrid-slam)
    file(CREATE_LINK hybrid-slam ${PROJECT_BINARY_DIR}/completions/${app} SYMBOLIC)
    install(FILES ${PROJECT_BINARY_DIR}/completions/${app} DESTINATION ${completions} COMPONENT programs)
  endif()
endforeach()

if(HYBRID_SLAM_GUI)
  install(FILES packaging/hybrid-slam-gui.desktop DESTINATION ${CMAKE_INSTALL_DATADIR}/applications COMPONENT window)
  install(FILES packaging/hybrid-slam-gui.xml DESTINATION ${CMAKE_INSTALL_DATADIR}/mime/packages COMPONENT window)
  install(FILES packaging/hybrid-slam.svg DESTINATION ${CMAKE_INSTALL_DATADIR}/icons/hicolor/scalable/apps
    COMPONENT window)
endif()
