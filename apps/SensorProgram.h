/// @file SensorProgram.h
/// @brief For programs with sensors or sockets: survive device faults.
#pragma once

#include <csignal>
#include <cstdlib>
#include <iostream>

#include "sensors/SensorThread.h"

namespace hybrid_slam {

/// Without this, SIGPIPE from MRPT's sockets ends the program when a device hangs up.
inline void ignoreHangUps() { std::signal(SIGPIPE, SIG_IGN); }

/// Call last: exits immediately if a driver thread is still running. @return `code`
inline int leaveDrivers(int code) {
  std::cout.flush();
  if (sensors::SensorThread::leftBehind() > 0) std::_Exit(code);
  return code;
}

}  // namespace hybrid_slam
