#include "study/simulation/EarlierSimulation.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <cmath>
#include <exception>
#include <fstream>
#include <memory>
#include <string>

#include "base/Errors.h"
#include "files/RawlogReader.h"
#include "study/simulation/BuildingPlan.h"

namespace hybrid_slam::simulation {

namespace fs = std::filesystem;

namespace {

bool hasContent(const fs::path& file) {
  std::error_code ignored;
  return fs::is_regular_file(file, ignored) && fs::file_size(file, ignored) > 0;
}

/// Returns the time of the first scan, s; NaN without one.
double startOfRawlog(const fs::path& file) {
  files::RawlogReader reader(file.string());
  for (int i = 0; i < 10; ++i) {  // before it: a comment, odometry, an action
    mrpt::serialization::CSerializable::Ptr object = reader.next();
    const auto frame = std::dynamic_pointer_cast<mrpt::obs::CSensoryFrame>(object);
    if (frame && !frame->empty()) object = *frame->begin();
    if (const auto scan = std::dynamic_pointer_cast<mrpt::obs::CObservation2DRangeScan>(object))
      return mrpt::Clock::toDouble(scan->timestamp);
  }
  return std::nan("");
}

double startOfTruth(const fs::path& file) {
  double start = std::nan("");
  std::ifstream(file) >> start;
  return start;
}

bool isPng(const fs::path& file) {
  std::string start(4, ' ');
  std::ifstream(file, std::ios::binary).read(start.data(), 4);
  return start == "\x89PNG";
}

bool isPlanOrEmpty(const fs::path& file) {
  if (hasContent(file)) BuildingPlan::load(file.string());
  return true;
}

bool isSimulation(const SimulationFiles& files, double startTime) {
  const auto isStart = [&](double time) { return std::abs(time - startTime) < 1e-5; };
  try {
    return isPng(files.picture) && isStart(startOfTruth(files.truth)) &&
           isStart(startOfRawlog(files.rawlog)) && isPlanOrEmpty(files.plan);
  } catch (const std::exception&) {
    return false;
  }
}

}  // namespace

SimulationFiles::SimulationFiles(const fs::path& log) : rawlog(log), truth(log), picture(log), plan(log) {
  truth.replace_extension(".tum");
  picture.replace_extension(".png");
  plan.replace_extension(".truth.plan");
}

void expectReplaceable(const SimulationFiles& files, double startTime) {
  if (isSimulation(files, startTime)) return;
  for (const fs::path& file : {files.rawlog, files.truth, files.picture, files.plan})
    if (hasContent(file))
      throw InputError(
          "the output exists and is no earlier simulation", file.string(),
          "expected the name of a new log, or of a simulated one with the same start_time and with its "
          ".tum and .png");
}

}  // namespace hybrid_slam::simulation
