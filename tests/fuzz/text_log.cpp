/// @file text_log.cpp
/// @brief Text logs of every format, as log2rawlog reads them.

#include "MemoryFile.h"
#include "base/Errors.h"
#include "readings/TextLog.h"

using namespace hybrid_slam;

namespace {

void read(const std::string& path, const readings::LogConversionOptions& options) {
  try {
    readings::TextLog log(path, options, [](size_t, const std::string&) {});
    while (log.next())
      ;
  } catch (const InputError&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::MemoryFile file(data, size);
  readings::LogConversionOptions options;
  read(file.path(), options);
  options.actionObservation = true;
  for (const readings::LogFormat* format : readings::logFormats()) {
    options.format = format;
    read(file.path(), options);
  }
  return 0;
}
