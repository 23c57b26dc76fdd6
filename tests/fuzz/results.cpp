/// @file results.cpp
/// @brief What slam-compare reads of a run: metrics.json, origin.json, checksums.json, config.ini, steps.csv.

#include <exception>
#include <fstream>

#include "files/TemporaryFolder.h"
#include "study/comparison/RunEvaluation.h"
#include "study/comparison/SpreadTable.h"

using namespace hybrid_slam;

namespace {

template <class Read>
void tryTo(const Read& read) {
  try {
    read();
  } catch (const std::exception&) {
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  static const files::TemporaryFolder runs;
  static const comparison::RunFolder folder(runs.path(""), "run");
  std::filesystem::create_directories(folder.path());
  const auto write = [&](const char* name) {
    std::ofstream(folder.file(name), std::ios::binary)
        .write(reinterpret_cast<const char*>(data), static_cast<std::streamsize>(size));
  };
  for (const char* name : {"metrics.json", "origin.json", "config.ini", "steps.csv"}) write(name);
  tryTo([] { folder.damage(); });
  tryTo([] { folder.expect({}); });
  std::filesystem::remove(folder.file("origin.json"));
  tryTo([] { comparison::evaluateRun({}, folder, {}); });
  tryTo([] {
    const auto steps = comparison::loadSpread(folder.file("steps.csv").string());
    comparison::meanSpread(steps);
    comparison::spreadBands({steps}, 20);
  });
  write("checksums.json");
  tryTo([] { folder.damage(); });
  std::filesystem::remove(folder.file("checksums.json"));
  return 0;
}
