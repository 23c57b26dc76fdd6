/// @file bag.cpp
/// @brief ROS 1 bags, MCAP files and databases, from their bytes to readings, as hybrid-slam reads them.

#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <string>

#include "bags/Bag.h"
#include "readings/RawlogSource.h"

using namespace hybrid_slam;

/// Opens the input as a file with a name, which SQLite needs.
extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const std::string path = "/dev/shm/fuzz-bag-" + std::to_string(getpid());
  std::ofstream(path, std::ios::binary)
      .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  try {
    const readings::InputOptions options;
    if (bags::isBag(path)) {
      readings::RawlogSource source(path, options, readings::summarise(path, options));
      while (source.next())
        ;
    }
  } catch (const std::exception&) {
  }
  std::remove(path.c_str());
  return 0;
}
