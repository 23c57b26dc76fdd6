/// @file laps.cpp
/// @brief Makes a longer log from one by driving it forwards and backwards in turn (scripts/long-runs.sh).
///
/// On the way back, the readings come in reverse order with mirrored times: odometry and scans are those of a
/// robot that reverses along its path.

#include <mrpt/obs/CObservation.h>

#include <cstdlib>
#include <iostream>
#include <vector>

#include "base/Errors.h"
#include "files/RawlogWriter.h"
#include "readings/LogReader.h"
#include "readings/RawlogSource.h"

namespace {

using namespace hybrid_slam;
using mrpt::obs::CObservation;

void write(const std::string& log, int laps, const std::string& output) {
  std::vector<CObservation::Ptr> all;
  std::vector<double> times;  // s
  readings::LogReader reader(log);
  while (const auto object = reader.next())
    readings::forEachObservation(object, [&](const CObservation::Ptr& observation) {
      if (observation->timestamp == INVALID_TIMESTAMP) return;
      all.push_back(observation);
      times.push_back(mrpt::Clock::toDouble(observation->timestamp));
    });
  if (all.empty()) throw InputError("no observations", log, "expected a rawlog with times");
  const double lap = times.back() - times.front() + 0.1;
  files::RawlogWriter writer(output);
  for (int k = 0; k < laps; ++k)
    for (size_t i = 0; i < all.size(); ++i) {
      const size_t from = k % 2 == 0 ? i : all.size() - 1 - i;
      const double since = k % 2 == 0 ? times[from] - times.front() : times.back() - times[from];
      all[from]->timestamp = mrpt::Clock::fromDouble(times.front() + k * lap + since);
      writer.write(*all[from]);
    }
  writer.finish();
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 4) return std::cerr << "usage: hybrid-slam-laps LOG LAPS OUT.rawlog\n", 2;
  try {
    write(argv[1], std::atoi(argv[2]), argv[3]);
  } catch (const std::exception& e) {
    return std::cerr << "hybrid-slam-laps: error: " << e.what() << "\n", 1;
  }
}
