# One CMake target per folder: libs/NAME -> hybrid_slam::NAME, its *_test.cpp -> hybrid_slam_NAME_test.

include(GNUInstallDirs)

# Where the settings, the data and the pages go (HybridSlamInstall.cmake) and the programs look for them
# (libs/files/InstalledFiles.h).
set(hybrid_slam_data ${CMAKE_INSTALL_DATADIR}/hybrid_slam)
set(hybrid_slam_pages ${CMAKE_INSTALL_DATAROOTDIR}/doc/hybrid-slam)

# s for one test, or one suite of GoogleTest, on a busy machine; ends one that hangs.
set(hybrid_slam_test_timeout 600)
if(HYBRID_SLAM_SANITIZE)
  set(hybrid_slam_test_timeout 1200)
endif()

set(shadow -Wshadow)
if(CMAKE_UNITY_BUILD)  # a local name may shadow a constant of another file, which clang cannot leave out
  set(shadow $<$<CXX_COMPILER_ID:GNU>:-Wshadow=local>)
endif()
add_library(hybrid_slam_flags INTERFACE)
target_compile_options(hybrid_slam_flags INTERFACE
  -Wall -Wextra -Wpedantic ${shadow} -Wconversion -Wno-sign-conversion $<$<BOOL:${HYBRID_SLAM_WERROR}>:-Werror>
  $<$<CONFIG:Release>:-O3>
  # The same bytes on every run and for every number of threads: no contraction that depends on inlining.
  -ffp-contract=off)
if(HYBRID_SLAM_SANITIZE)
  # With the assertions of Eigen (no NDEBUG: CMakePresets.json) and of libstdc++.
  target_compile_options(hybrid_slam_flags INTERFACE -fsanitize=${HYBRID_SLAM_SANITIZE} -fno-omit-frame-pointer)
  target_compile_definitions(hybrid_slam_flags INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(hybrid_slam_flags INTERFACE -fsanitize=${HYBRID_SLAM_SANITIZE})
  if(HYBRID_SLAM_SANITIZE MATCHES undefined)
    # Not alignment: MRPT's own operator new aligns its classes to 16 bytes, where some ask for 32.
    target_compile_options(hybrid_slam_flags INTERFACE -fno-sanitize=alignment -fno-sanitize-recover=undefined)
  endif()
endif()
if(HYBRID_SLAM_FUZZ)
  target_compile_options(hybrid_slam_flags INTERFACE -fsanitize=fuzzer-no-link)
endif()

# hybrid_slam_install_library(NAME): hybrid_slam::NAME of the installed package.
function(hybrid_slam_install_library name)
  set_target_properties(hybrid_slam_${name} PROPERTIES EXPORT_NAME ${name})
  install(TARGETS hybrid_slam_${name} EXPORT hybrid_slam
    LIBRARY COMPONENT library NAMELINK_COMPONENT development
    ARCHIVE COMPONENT development)
endfunction()

# hybrid_slam_library(NAME TARGET...): every .cpp of the folder but the tests, linked with TARGET..., all whose headers
# the folder includes (tests/declared-dependencies.py).
function(hybrid_slam_library name)
  file(GLOB sources CONFIGURE_DEPENDS *.cpp)
  file(GLOB headers CONFIGURE_DEPENDS *.h)
  set(tests ${sources})
  list(FILTER sources EXCLUDE REGEX "_test\\.cpp$")
  list(FILTER tests INCLUDE REGEX "_test\\.cpp$")
  add_library(hybrid_slam_${name} ${sources})
  add_library(hybrid_slam::${name} ALIAS hybrid_slam_${name})
  # Until version 1.0 the interface may change with the minor version.
  set_target_properties(hybrid_slam_${name} PROPERTIES
    VERSION ${PROJECT_VERSION} SOVERSION ${PROJECT_VERSION_MAJOR}.${PROJECT_VERSION_MINOR})
  target_compile_features(hybrid_slam_${name} PUBLIC cxx_std_17)
  target_include_directories(hybrid_slam_${name} PUBLIC
    $<BUILD_INTERFACE:${PROJECT_SOURCE_DIR}/libs> $<INSTALL_INTERFACE:${CMAKE_INSTALL_INCLUDEDIR}/hybrid_slam>)
  # The flags are for our own sources, not for those of programs that use the installed library.
  target_link_libraries(hybrid_slam_${name} PUBLIC ${ARGN} PRIVATE $<BUILD_INTERFACE:hybrid_slam_flags>)
  hybrid_slam_install_library(${name})
  file(RELATIVE_PATH folder ${PROJECT_SOURCE_DIR}/libs ${CMAKE_CURRENT_SOURCE_DIR})
  install(FILES ${headers} DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/hybrid_slam/${folder} COMPONENT development)
  if(tests AND HYBRID_SLAM_TESTS)
    hybrid_slam_test(${name} ${tests})
    target_link_libraries(hybrid_slam_${name}_test PRIVATE hybrid_slam::${name})
  endif()
endfunction()

# hybrid_slam_test(NAME FILE...): one GoogleTest program, its suites known to ctest one by one.
function(hybrid_slam_test name)
  add_executable(hybrid_slam_${name}_test ${ARGN})
  target_include_directories(hybrid_slam_${name}_test PRIVATE ${PROJECT_SOURCE_DIR} ${PROJECT_SOURCE_DIR}/libs)
  target_link_libraries(hybrid_slam_${name}_test PRIVATE hybrid_slam_flags GTest::gmock GTest::gtest_main)
  set(suites ${CMAKE_CURRENT_BINARY_DIR}/hybrid_slam_${name}_suites)
  file(GENERATE OUTPUT ${suites}.cmake CONTENT "set(PROGRAM [[$<TARGET_FILE:hybrid_slam_${name}_test>]])
set(LIST [[${suites}.txt]])\nset(TIMEOUT ${hybrid_slam_test_timeout})
include([[${PROJECT_SOURCE_DIR}/cmake/GoogleTestSuites.cmake]])\n")
  set_property(DIRECTORY APPEND PROPERTY TEST_INCLUDE_FILES ${suites}.cmake)
endfunction()

# hybrid_slam_app(NAME TARGET...): apps/NAME/main.cpp, with what is beside it in apps/ -> program NAME.
function(hybrid_slam_app name)
  add_executable(${name} main.cpp)
  target_include_directories(${name} PRIVATE ${PROJECT_SOURCE_DIR}/apps)
  target_compile_definitions(${name} PRIVATE
    HYBRID_SLAM_PROGRAM="${name}" HYBRID_SLAM_VERSION="${PROJECT_VERSION}")
  target_link_libraries(${name} PRIVATE ${ARGN} CLI11::CLI11 hybrid_slam_flags)
  set(component programs)
  if(name STREQUAL hybrid-slam-gui)
    set(component window)
  endif()
  install(TARGETS ${name} RUNTIME COMPONENT ${component})
endfunction()

# hybrid_slam_program_test(FILE PROGRAM MACRO TARGET...): FILE.cpp runs PROGRAM, whose path MACRO holds.
function(hybrid_slam_program_test file program macro)
  hybrid_slam_test(${file} ${file}_test.cpp)
  target_link_libraries(hybrid_slam_${file}_test PRIVATE ${ARGN})
  target_compile_definitions(hybrid_slam_${file}_test PRIVATE ${macro}="$<TARGET_FILE:${program}>")
  add_dependencies(hybrid_slam_${file}_test ${program})
endfunction()
