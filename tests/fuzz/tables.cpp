/// @file tables.cpp
/// @brief Text files of numbers: TUM trajectories, odometry, relations, covariances.

#include "MemoryFile.h"
#include "base/Errors.h"
#include "files/Trajectory.h"
#include "study/evaluation/NormalizedError.h"
#include "study/evaluation/RelationErrors.h"

using namespace hybrid_slam;

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const fuzz::MemoryFile file(data, size);
  const auto read = [&file](auto load) {
    try {
      load(file.path());
    } catch (const InputError&) {
    }
  };
  read(files::loadTum);
  read(files::loadOdometry);
  read(evaluation::loadRelations);
  read(evaluation::loadCovariances);
  return 0;
}
