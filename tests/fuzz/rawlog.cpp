/// @file rawlog.cpp
/// @brief Rawlogs, from their bytes to readings, as hybrid-slam reads them.

#include <exception>

#include "MemoryFile.h"
#include "readings/RawlogSource.h"

using namespace hybrid_slam;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::MemoryFile file(data, size);
  try {
    const readings::InputOptions options;
    readings::RawlogSource source(file.path(), options, readings::summarise(file.path(), options));
    while (source.next())
      ;
  } catch (const std::exception&) {
  }
  return 0;
}
