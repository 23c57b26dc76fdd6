/// @file SensorProgram.h
/// @brief Lets programs with sensors survive device faults.
#pragma once

#include <cstdlib>
#include <iostream>

#include "sensors/SensorThread.h"

namespace hybrid_slam {

/// Exits immediately if a driver thread is still running. Call last. @return `code`
inline int leaveDrivers(int code) {
  std::cout.flush();
  if (sensors::SensorThread::leftBehind() > 0) std::_Exit(code);
  return code;
}

}  // namespace hybrid_slam
