/// @file main.cpp
/// @brief log2rawlog: converts text logs, bags and rawlogs to rawlogs and keeps their timestamps.
#include <mrpt/core/bits_math.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <map>
#include <optional>

#include "InputFiles.h"
#include "NumberRange.h"
#include "Program.h"
#include "Stop.h"
#include "TopicArguments.h"
#include "base/Numbers.h"
#include "readings/LogConversion.h"

namespace {

using namespace hybrid_slam;

struct CommandLine {
  std::string input, output, format, time = "ipc";
  readings::LogConversionOptions options;
  std::optional<double> angularStepDeg;
  TopicArguments topics;
};

void printSummary(const std::string& output, const readings::LogSummary& s) {
  std::printf("%s: %s%s, %zu scans, %zu odometry readings, %.1f s, path %.1f m", output.c_str(),
              s.format.c_str(), s.unit == "line" ? " log" : "", s.scans, s.odometryReadings,
              s.latest - s.earliest, s.pathLength);
  if (s.unit != "entry") std::printf(", %zu broken %ss", s.brokenLines, s.unit.c_str());
  const char* separator = "; skipped: ";
  for (const auto& [name, count] : s.otherRecords) {
    std::printf("%s%zu %s", separator, count, name.c_str());
    separator = ", ";
  }
  std::printf("\n");
}

/// A SICK laser reports "no return" as 8183 to 8191 units: cm in the 80 m mode, mm in the 8 m mode, where
/// they look like walls.
void warnOfNoReturns(const std::string& input, float longestRange) {
  const auto warnOf = [&](const char* mode, const char* limit) {
    std::cerr << "log2rawlog: warning: the longest readings are " << longestRange
              << " m, which a SICK laser in " << mode << " mode reports for no return: " << onOneLine(input)
              << "; --max-range " << limit << " drops them\n";
  };
  if (longestRange > 8.1829f && longestRange < 8.1911f) warnOf("8 m", "8.18");
  if (longestRange > 81.829f && longestRange < 81.911f) warnOf("80 m", "80");
}

void warnOfShortRange(const std::string& input, const readings::LogSummary& s, double maxRange) {
  if (2 * s.rangesBeyond > s.ranges)
    warn({std::to_string(s.rangesBeyond) + " of " + std::to_string(s.ranges) + " readings are at or beyond " +
          numberText(maxRange) + " m: " + input + "; --max-range makes them no returns"});
}

void warnOfOddities(const std::string& input, const readings::LogSummary& s) {
  const auto warnOf = [&](const readings::Oddity& odd, const std::string& what) {
    if (odd.count > 0)
      warn({counted(odd.count, what) + ": first in " + input + ", " + s.unit + " " +
            std::to_string(odd.first) + "; kept as logged"});
  };
  warnOf(s.impossibleOdometry, "impossible odometry reading(s): beyond 1e8 m or 1e6 rad");
  warnOf(s.odometryJumps, "odometry jump(s) of over 100 m or far above the robot's speed");
  warnOf(s.timeJumps, "time jump(s) of over a day");
}

void warnOfWrongSweeps(const std::string& input, const readings::LogSummary& s) {
  if (s.wrongSweeps > 0)
    warn({counted(s.wrongSweeps, "scan(s) with an impossible time from beam to beam: ") + input +
          "; they will not be corrected for the robot's motion"});
}

void warnOf(const readings::LogSummary& summary, const CommandLine& line) {
  warn(summary.notes);
  if (!summary.defect.empty())
    warn({summary.format + " " + summary.defect + ": " + line.input + "; converted up to this point"});
  warnOfNoReturns(line.input, summary.longestRange);
  if (line.options.maxRange) warnOfShortRange(line.input, summary, *line.options.maxRange);
  warnOfOddities(line.input, summary);
  warnOfWrongSweeps(line.input, summary);
}

void describe(CLI::App& app, CommandLine& line) {
  std::vector<std::string> keys;
  for (const readings::LogFormat* known : readings::logFormats()) keys.push_back(known->key);
  app.set_version_flag("--version", "log2rawlog " HYBRID_SLAM_VERSION);
  app.add_option("input", line.input, logMeans())->required()->type_name("in.clf[.gz]|in.bag|...");
  app.add_option("output", line.output, "the rawlog to write")->type_name("out.rawlog");
  line.topics.add(app, false);
  app.add_option("--format", line.format, "log format (default: detected from the content)")
      ->check(CLI::IsMember(keys));
  app.add_option("--time", line.time,
                 "CARMEN: use the message's own timestamp (ipc) or its arrival at the logger (logger)")
      ->capture_default_str()
      ->check(CLI::IsMember({"ipc", "logger"}));
  app.add_option("--period", line.options.period,
                 "DP-SLAM, whose logs have no timestamps: time between scans, s")
      ->capture_default_str()
      ->type_name("S")
      ->check(within(1e-6, 1e4));
  app.add_option("--max-range", line.options.maxRange,
                 "readings at or beyond this are no returns, m (default: " + readings::defaultMaxRanges() +
                     "; bags, rawlogs: as each scan states)")
      ->type_name("M")
      ->check(within(0.01, 1e4));
  app.add_option("--angular-step", line.angularStepDeg,
                 "angle between beams, deg (default: from the number of beams: 1 for 180 and 181, 0.5 for "
                 "360 and 361, ...); ROBOTLASER1 rows state their own")
      ->type_name("DEG")
      ->check(within(1e-3, 90.));
  app.add_option(
         "--laser-x", line.options.laserX,
         "front laser ahead of the robot's centre, m (default: PARAM robot_frontlaser_offset, else 0)")
      ->type_name("M")
      ->check(within(-100., 100.));
  CLI::Option* const scanTime =
      app.add_option("--scan-time", line.options.sweep.seconds,
                     "time from the first beam of a scan to the last, s, for the correction by the robot's "
                     "motion; 0: no correction (default: as a bag or rawlog states; unknown for text logs)")
          ->type_name("S")
          ->check(within(0, readings::kLongestSweep));
  app.add_option(
         "--scan-rate", line.options.sweep.rate,
         "turns of the lasers per second, instead of --scan-time: a scan over A deg takes A / 360 / HZ "
         "seconds")
      ->type_name("HZ")
      ->check(within(readings::kLowestRate, readings::kHighestRate))
      ->excludes(scanTime);
  app.add_flag("--action-observation", line.options.actionObservation,
               "write (action, sensory frame) pairs, which rbpf-slam needs, instead of single observations");
  app.add_flag("--strict", line.options.strict,
               "fail at the first broken line or message, or where a bag or rawlog is cut off");
}

/// Warns of the first broken lines or messages. A file of another format has thousands.
readings::BrokenLineReport brokenReport(const std::string& input) {
  constexpr size_t kMostReports = 10;
  const std::string unit = bags::isBag(input) ? "message" : "line";  // a rawlog has no broken entries
  return [=, broken = size_t{0}](size_t number, const std::string& why) mutable {
    if (++broken <= kMostReports)
      warn({"broken " + unit + ": " + input + ", " + unit + " " + std::to_string(number) + "; " + why});
    else if (broken == kMostReports + 1)
      warn({"more broken " + unit + "s: " + input + "; only counted from here on"});
  };
}

int convert(int argc, char** argv) {
  CommandLine line;
  CLI::App app{"Converts a robot's log into a rawlog, or a rawlog into one of the other form."};
  describe(app, line);
  if (const auto code = parse(app, argc, argv)) return *code;
  stopOnSignals();
  files::findInputFiles({&line.input});
  if (line.topics.wantsList) {
    printTopics(line.input);
    return 0;
  }
  if (line.output.empty())
    throw InputError("output is required", "command line", "expected log2rawlog LOG out.rawlog");

  readings::LogConversionOptions& options = line.options;
  options.isStopped = [] { return stop.load(); };
  options.format = readings::formatNamed(line.format);  // null: detected
  options.time = line.time == "ipc" ? readings::LogTime::ipc : readings::LogTime::logger;
  if (line.angularStepDeg) options.angularStep = mrpt::DEG2RAD(*line.angularStepDeg);
  const readings::LogSummary summary =
      readings::convertLog(line.input, line.output, options, brokenReport(line.input), line.topics.bag);
  warnOf(summary, line);
  printSummary(line.output, summary);
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return exitCodeOf([&] { return convert(argc, argv); });
}
