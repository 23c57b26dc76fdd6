/// @file ini.cpp
/// @brief Configuration files, and their saved form.

#include "MemoryFile.h"
#include "base/Errors.h"
#include "run/Configuration.h"

using namespace hybrid_slam;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::MemoryFile file(data, size);
  try {
    run::Configuration configuration(file.path(), {});
    const std::string text = configuration.text();
    const fuzz::MemoryFile again(reinterpret_cast<const uint8_t*>(text.data()), text.size());
    run::Configuration(again.path(), {});
  } catch (const InputError&) {
  }
  return 0;
}
