/// @file SensorProgram.h
/// @brief What programs that use sensors or sockets do besides: they outlive a device's faults.
#pragma once

#include <csignal>
#include <cstdlib>
#include <iostream>

#include "sensors/SensorThread.h"

namespace hybrid_slam {

/// MRPT's sockets would end the program when a device hangs up.
inline void ignoreHangUps() { std::signal(SIGPIPE, SIG_IGN); }

/// Last of all: ends the program at once where a driver is still at work. @return the exit code, as it came
inline int leaveDrivers(int code) {
  std::cout.flush();
  if (sensors::SensorThread::leftBehind() > 0) std::_Exit(code);
  return code;
}

}  // namespace hybrid_slam
