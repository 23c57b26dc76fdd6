# cpack: a Debian package of each component (scripts/package.sh). Their dependencies follow from what was linked
# (dpkg-shlibdeps) and what find_package found.

set(CPACK_GENERATOR DEB)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_COMPONENTS_ALL library development programs)
if(HYBRID_SLAM_GUI)
  list(APPEND CPACK_COMPONENTS_ALL window)
endif()
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
  OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
# The maintainer of the packages, from Debian's variables.
set(maintainer "hybrid-slam developers")
set(email "packages@hybrid-slam.invalid")
if(DEFINED ENV{DEBEMAIL})
  set(email $ENV{DEBEMAIL})
  if(DEFINED ENV{DEBFULLNAME})
    set(maintainer $ENV{DEBFULLNAME})
  endif()
endif()
set(CPACK_PACKAGE_CONTACT "${maintainer} <${email}>")

# The same version builds for several releases of Debian, whose packages must differ.
file(STRINGS /etc/os-release release REGEX "^VERSION_ID=")
string(REGEX REPLACE "[^0-9]" "" release "${release}")
set(CPACK_DEBIAN_PACKAGE_RELEASE 1~deb${release})
set(debian_version ${PROJECT_VERSION}-${CPACK_DEBIAN_PACKAGE_RELEASE})

set(library libhybrid-slam${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
set(CPACK_DEBIAN_LIBRARY_PACKAGE_NAME ${library})
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_NAME libhybrid-slam-dev)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_NAME hybrid-slam)
set(CPACK_DEBIAN_WINDOW_PACKAGE_NAME hybrid-slam-gui)
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SECTION libs)
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_SECTION libdevel)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SECTION science)
set(CPACK_DEBIAN_WINDOW_PACKAGE_SECTION science)

# The first line is the summary.
set(CPACK_PACKAGE_DESCRIPTION_SUMMARY "")
set(about "hybrid-slam makes maps from a robot's laser and odometry. Each particle
of its Rao-Blackwellized filter holds an occupancy grid and a database of
line segments, whose directions keep the heading from drifting.")
set(CPACK_COMPONENT_LIBRARY_DESCRIPTION "2D laser SLAM with grids and lines (libraries)
${about}

This package contains the shared libraries.")
set(CPACK_COMPONENT_DEVELOPMENT_DESCRIPTION "2D laser SLAM with grids and lines (development files)
${about}

This package contains the headers and the CMake package hybrid_slam.")
set(CPACK_COMPONENT_PROGRAMS_DESCRIPTION "2D laser SLAM with grids and lines (programs)
${about}

This package contains the programs for logs and live robots, their
settings, a simulated data set and the documentation.")
set(CPACK_COMPONENT_WINDOW_DESCRIPTION "2D laser SLAM with grids and lines (graphical interface)
${about}

This package contains the window that replays logs and maps live data.")

# Dependencies.
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_LIBRARY_OUTPUT_DIRECTORY})
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS ON)
set(CPACK_DEBIAN_PACKAGE_GENERATE_SHLIBS_POLICY ">=")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA ${PROJECT_SOURCE_DIR}/packaging/triggers)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS ON)
set(CPACK_COMPONENT_DEVELOPMENT_DEPENDS library)
set(CPACK_COMPONENT_PROGRAMS_DEPENDS library)
set(CPACK_COMPONENT_WINDOW_DEPENDS library programs)
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_RECOMMENDS "gnuplot-nox | gnuplot")  # the plots of slam-compare
# The log of config-ini/malaga.ini; rawlog-edit (doc/own-log.md).
set(CPACK_DEBIAN_PROGRAMS_PACKAGE_SUGGESTS "hybrid-slam-gui, mrpt-common, mrpt-apps")
set(CPACK_DEBIAN_WINDOW_PACKAGE_RECOMMENDS "libgl1-mesa-dri, xdg-utils")  # xdg-open shows the pages (F1)

# The Debian package that has a file of this machine, appended to development_depends.
function(hybrid_slam_needs_package_of file)
  execute_process(COMMAND dpkg-query --search ${file} OUTPUT_VARIABLE owner ERROR_QUIET)
  if(NOT owner MATCHES "^([a-z0-9.+-]+)")
    message(STATUS "${file} belongs to no Debian package: libhybrid-slam-dev will not depend on it")
  elseif(NOT CMAKE_MATCH_1 IN_LIST development_depends)
    set(development_depends ${development_depends} ${CMAKE_MATCH_1} PARENT_SCOPE)
  endif()
endfunction()
set(development_depends)
foreach(package IN LISTS hybrid_slam_found)  # by its CMake package, or the library that CMake's own module found
  string(TOUPPER ${package} PACKAGE)
  set(found ${${package}_DIR} ${${package}_LIBRARIES} ${${PACKAGE}_LIBRARIES})
  if(found)
    list(GET found 0 found)
    hybrid_slam_needs_package_of(${found})
  elseif(NOT package STREQUAL Threads)  # a part of the compiler's libc6-dev
    message(FATAL_ERROR "no file of ${package} is known, so libhybrid-slam-dev would not depend on it")
  endif()
endforeach()
foreach(header IN LISTS hybrid_slam_headers)
  hybrid_slam_needs_package_of(${header})
endforeach()
if(HYBRID_SLAM_GUI)  # hybrid_slam_wx links these
  foreach(library_option IN LISTS wxWidgets_LIBRARIES)
    if(library_option MATCHES "^-l(wx.+)")
      find_library(wx_library NAMES ${CMAKE_MATCH_1} NO_CACHE)
      hybrid_slam_needs_package_of(${wx_library})
      unset(wx_library)
    endif()
  endforeach()
endif()
list(SORT development_depends)
list(JOIN development_depends ", " CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS)

# Man pages of --help.
find_program(HELP2MAN help2man REQUIRED)
foreach(app IN LISTS hybrid_slam_apps)
  set(page ${PROJECT_BINARY_DIR}/man/${app}.1.gz)
  add_custom_command(OUTPUT ${page}
    COMMAND ${PROJECT_SOURCE_DIR}/cmake/man-page.sh $<TARGET_FILE:${app}>
    ${CMAKE_INSTALL_PREFIX}/${hybrid_slam_pages} ${page}
    DEPENDS ${app} ${PROJECT_SOURCE_DIR}/cmake/man-page.sh VERBATIM)
  add_custom_target(${app}-man ALL DEPENDS ${page})
  set(component programs)
  if(app STREQUAL hybrid-slam-gui)
    set(component window)
  endif()
  install(FILES ${page} DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT ${component})
endforeach()

# Files that Debian requires of a package. A plain `cmake --install` leaves them out.
string(TIMESTAMP debian_date "%a, %d %b %Y %H:%M:%S +0000" UTC)  # SOURCE_DATE_EPOCH where it is set
foreach(component IN LISTS CPACK_COMPONENTS_ALL)
  string(TOUPPER ${component} COMPONENT)
  set(name ${CPACK_DEBIAN_${COMPONENT}_PACKAGE_NAME})
  set(folder ${PROJECT_BINARY_DIR}/debian/${name})
  set(shared ${CMAKE_INSTALL_DATAROOTDIR}/doc/${name})
  configure_file(packaging/changelog.Debian.in ${folder}/changelog.Debian @ONLY)
  execute_process(COMMAND gzip -9nf ${folder}/changelog.Debian)
  install(FILES ${folder}/changelog.Debian.gz DESTINATION ${shared} COMPONENT ${component} EXCLUDE_FROM_ALL)
  install(FILES LICENSE DESTINATION ${shared} COMPONENT ${component} EXCLUDE_FROM_ALL RENAME copyright)
endforeach()
# The package of all libraries cannot have the name of one.
install(FILES packaging/libhybrid-slam.lintian-overrides DESTINATION ${CMAKE_INSTALL_DATADIR}/lintian/overrides
  COMPONENT library EXCLUDE_FROM_ALL RENAME ${library})
execute_process(COMMAND gzip -9nc ${PROJECT_SOURCE_DIR}/CHANGELOG.md
  OUTPUT_FILE ${PROJECT_BINARY_DIR}/debian/changelog.gz)
install(FILES ${PROJECT_BINARY_DIR}/debian/changelog.gz DESTINATION ${hybrid_slam_pages}
  COMPONENT programs EXCLUDE_FROM_ALL)

include(CPack)
