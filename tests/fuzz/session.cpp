/// @file session.cpp
/// @brief Session files, from their decompressed bytes to a run that continues.

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <exception>

#include "MemoryFile.h"
#include "files/Gzip.h"
#include "files/TemporaryFolder.h"
#include "run/FilterRun.h"

using namespace hybrid_slam;

namespace {

readings::Reading wallAhead() {
  auto scan = std::make_shared<mrpt::obs::CObservation2DRangeScan>();
  scan->aperture = 1;
  scan->maxRange = 5;
  scan->resizeScan(5);
  for (size_t i = 0; i < 5; ++i) {
    scan->setScanRange(i, 1);
    scan->setScanRangeValidity(i, true);
  }
  return {{scan}, 1, {0.5, 0, 0}};
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string zipped = files::gzipped({reinterpret_cast<const char*>(data), size});
  const fuzz::MemoryFile file(reinterpret_cast<const uint8_t*>(zipped.data()), zipped.size());
  static const files::TemporaryFolder folder;
  try {
    run::SessionReader session(file.path());
    run::Configuration configuration("", {"particle_filter.particles=2", "run.output=" + folder.path("out")});
    run::FilterRun run(configuration);
    run.resume(session);
    run.process(wallAhead());
  } catch (const std::exception&) {
  }
  return 0;
}
