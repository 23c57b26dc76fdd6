# Finds everything that the build needs. The installed package finds the dependencies of the libraries again
# (hybrid_slam_find_dependencies), and Debian's package of the headers depends on them (hybrid_slam_found, _headers).

# hybrid_slam_find(PACKAGE...): find_package.
macro(hybrid_slam_find)
  find_package(${ARGN} REQUIRED)
  string(REPLACE ";" " " package "${ARGN}")
  string(APPEND hybrid_slam_find_dependencies "find_dependency(${package})\n")
  list(APPEND hybrid_slam_found ${ARGV0})
endmacro()

# hybrid_slam_find_library(NAME HEADER): a library without a CMake package on Debian 12, linked by its name.
macro(hybrid_slam_find_library name header)
  find_path(HYBRID_SLAM_${name}_HEADERS ${header} REQUIRED)
  string(APPEND hybrid_slam_find_dependencies "find_path(HYBRID_SLAM_${name}_HEADERS ${header} REQUIRED)\n")
  list(APPEND hybrid_slam_headers ${HYBRID_SLAM_${name}_HEADERS}/${header})
endmacro()

foreach(module core system serialization config comms math random poses img bayes opengl obs maps slam hwdrivers io)
  hybrid_slam_find(mrpt-${module} 2.5)
endforeach()
hybrid_slam_find(Eigen3)
hybrid_slam_find(TBB)
hybrid_slam_find(ZLIB)
hybrid_slam_find(BZip2)
hybrid_slam_find(SQLite3)
hybrid_slam_find_library(zstd zstd.h)
hybrid_slam_find_library(lz4 lz4frame.h)
hybrid_slam_find_library(dxflib dxflib/dl_dxf.h)
hybrid_slam_find(Threads)
hybrid_slam_find(nlohmann_json)
hybrid_slam_find(yaml-cpp)
hybrid_slam_find(OpenCV COMPONENTS core imgcodecs imgproc)
find_package(CLI11 REQUIRED)

if(HYBRID_SLAM_STUDY)
  hybrid_slam_find(nanoflann)
endif()

if(HYBRID_SLAM_GUI)
  hybrid_slam_find(mrpt-gui 2.5)
  find_package(wxWidgets 3.2 REQUIRED COMPONENTS gl propgrid core base)
  find_package(X11 REQUIRED)
endif()

if(HYBRID_SLAM_TESTS)
  find_package(GTest REQUIRED)
  # ROS's own library writes the bags of the tests.
  find_path(ROSBAG_HEADERS rosbag/bag.h REQUIRED)
  add_library(hybrid_slam_rosbag INTERFACE)
  target_include_directories(hybrid_slam_rosbag SYSTEM INTERFACE ${ROSBAG_HEADERS}/pluginlib
    ${ROSBAG_HEADERS}/class_loader ${ROSBAG_HEADERS}/rcutils ${ROSBAG_HEADERS}/rcpputils
    ${ROSBAG_HEADERS}/ament_index_cpp)
  target_link_libraries(hybrid_slam_rosbag INTERFACE
    rosbag_storage roscpp_serialization rostime cpp_common roslz4 console_bridge boost_filesystem boost_system
    class_loader roslib)
  find_package(Python3 3.9 COMPONENTS Interpreter REQUIRED)
endif()
