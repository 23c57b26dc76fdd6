#include "study/simulation/Simulation.h"

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/NoiseStream.h"
#include "study/simulation/Route.h"

namespace hybrid_slam::simulation {
namespace {

constexpr double kOdometryPhase = 0.03;  // s

/// A time at which a sensor is read, the motion changes or the wheels slip.
struct Event {
  enum Kind { motionChanges, slip, odometry, scan };
  double time;
  Kind kind;
  size_t index;
};

/// @param end  s; the simulation needs no readings after it
std::vector<Event> eventsOf(const Route& route, const std::vector<Slip>& slips, double odometryRate,
                            double scanRate, double end) {
  std::vector<Event> events;
  for (size_t i = 0; i < route.pieces().size(); ++i)
    events.push_back({route.pieces()[i].startTime, Event::motionChanges, i});
  for (size_t i = 0; i < slips.size(); ++i) events.push_back({slips[i].time, Event::slip, i});
  const auto addReadings = [&](Event::Kind kind, double rate, double phase) {
    for (size_t i = 0; phase + static_cast<double>(i) / rate <= end + 1e-9; ++i)
      events.push_back({phase + static_cast<double>(i) / rate, kind, i});
  };
  addReadings(Event::odometry, odometryRate, kOdometryPhase);
  addReadings(Event::scan, scanRate, 0);
  std::stable_sort(events.begin(), events.end(),
                   [](const Event& a, const Event& b) { return a.time < b.time; });
  return events;
}

double durationOf(const Route& route, int scans, double scanRate) {
  return scans > 0 ? std::min(route.duration(), scans / scanRate) : route.duration();
}

/// Limits the number of readings, which are in memory until they are written.
void expectBounded(const Route& route, int scans, double scanRate, size_t beamsOfScan, double odometryRate) {
  constexpr double kMostBeams = 5e7, kMostReadings = 2e6, kLongestPath = 1e5;  // m
  const double metres = route.progressAt(route.duration()).distance;
  if (!(metres <= kLongestPath))
    throw InputError("route too long: " + fixedText(metres / 1000, 1) + " km",
                     "section [simulation], key `route`",
                     "expected at most " + fixedText(kLongestPath / 1000, 0) + " km");
  const double seconds = durationOf(route, scans, scanRate);
  if (seconds * scanRate * static_cast<double>(beamsOfScan) > kMostBeams ||
      seconds * std::max(scanRate, odometryRate) > kMostReadings)
    throw InputError("too many readings: " + fixedText(seconds / 3600, 1) + " h",
                     "section [simulation], keys `route` and `scans`",
                     "expected a shorter route, a higher speed, lower rates, or fewer scans");
}

}  // namespace

void SimulationOptions::describe(OptionTable& t) {
  t.add("plan", plan, "floor plan file, relative to the INI file");
  t.add("things", things,
        "doors and boxes that differ between sessions, relative to the INI file; empty: none");
  t.add("route", route, "route file, relative to the INI file");
  t.add("form", form, {{RawlogForm::observations, "observations"}, {RawlogForm::pairs, "pairs"}},
        "observation-only rawlog, or action-observation pairs");
  t.add("seed", seed, 0, 2147483647,
        "seed of noise, doors and boxes: the same seed and session give the same bytes");
  t.add("session", session, 1, 1000000,
        "visit to the building: another one has other noise, doors and boxes");
  t.add("scans", scans, 0, 10000000, "stop after this many scans; 0: the whole route");
  t.add("start_time", startTime, 0, 4e9, "s", "UNIX time of the first scan");
  t.add("robot_radius", robotRadius, 0, 5, "m", "minimum distance of the path from all walls");
}

SimulatedLog simulate(const BuildingPlan& plan, const Route& route, const SimulationOptions& options,
                      const LaserOptions& laserOptions, const OdometryOptions& odometryOptions) {
  const Laser laser(laserOptions);
  const std::vector<Slip> slips = parseSlips(odometryOptions.slips);
  for (const Slip& slip : slips)
    if (slip.time > route.duration())
      throw InputError("slip after the end of the route", "section [odometry], key `slips`",
                       "expected times up to " + std::to_string(route.duration()) + " s");
  expectBounded(route, options.scans, laserOptions.rate, laser.beamCount(), odometryOptions.rate);
  route.checkClear(plan, options.robotRadius);

  SimulatedLog log;
  log.scanTime = laserOptions.scanTime;
  WheelOdometry wheels(odometryOptions);
  const auto timestampOf = [&options](double time) {
    return mrpt::Clock::fromDouble(options.startTime + std::round(time * 1e6) / 1e6);
  };
  Route::Progress last;
  uint64_t step = 0;
  const double end = durationOf(route, options.scans, laserOptions.rate);
  for (const Event& event : eventsOf(route, slips, odometryOptions.rate, laserOptions.rate, end)) {
    const Route::Progress now = route.progressAt(event.time);
    RandomStream odometryNoise = noiseStream(options.seed, options.session, NoiseSource::odometry, step++);
    wheels.move(now.distance - last.distance, now.rotation - last.rotation, odometryNoise);
    last = now;
    if (event.kind == Event::slip) {
      wheels.slip(slips[event.index]);
    } else if (event.kind == Event::odometry) {
      auto reading = mrpt::obs::CObservationOdometry::Create();
      reading->sensorLabel = "ODOMETRY";
      reading->timestamp = timestampOf(event.time);
      reading->odometry = mrpt::poses::CPose2D(wheels.reading());
      log.odometry.push_back(reading);
    } else if (event.kind == Event::scan) {
      const auto pose = route.poseAt(event.time);
      RandomStream laserNoise = noiseStream(options.seed, options.session, NoiseSource::laser, event.index);
      auto scan = mrpt::obs::CObservation2DRangeScan::Create(laser.scan(
          plan, [&](double seconds) { return route.poseAt(event.time + seconds); }, laserNoise));
      scan->timestamp = timestampOf(event.time);
      log.groundTruth.push_back({scan->timestamp, pose});
      log.scans.push_back(std::move(scan));
      log.odometryAtScans.push_back(wheels.reading());
      if (log.scans.size() == static_cast<size_t>(options.scans)) break;
    }
  }
  if (log.scans.size() < static_cast<size_t>(options.scans))
    throw InputError("the route ends after " + std::to_string(log.scans.size()) + " scans",
                     "section [simulation], key `scans`", "expected a longer route or fewer scans");
  return log;
}

}  // namespace hybrid_slam::simulation
