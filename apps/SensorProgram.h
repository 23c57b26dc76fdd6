/// @file SensorProgram.h
/// @brief Lets programs with sensors or sockets survive device faults.
#pragma once

#include <csignal>
#include <cstdlib>
#include <iostream>

#include "sensors/SensorThread.h"

namespace hybrid_slam {

/// Ignores SIGPIPE, by which MRPT's sockets would end the program when a device hangs up.
inline void ignoreHangUps() { std::signal(SIGPIPE, SIG_IGN); }

/// Exits immediately if a driver thread is still running. Call last. @return `code`
inline int leaveDrivers(int code) {
  std::cout.flush();
  if (sensors::SensorThread::leftBehind() > 0) std::_Exit(code);
  return code;
}

}  // namespace hybrid_slam
