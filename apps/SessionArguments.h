/// @file SessionArguments.h
/// @brief Command-line options for sessions and maps of earlier runs.
#pragma once

#include <mrpt/core/bits_math.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "NumberRange.h"
#include "base/Errors.h"
#include "base/Numbers.h"
#include "files/InstalledFiles.h"
#include "readings/ScanGrouper.h"
#include "run/Configuration.h"
#include "run/SessionFile.h"

namespace hybrid_slam {

struct SessionArguments {
  std::string resume, continueFrom, localizeIn, priorPlan, start;
  double checkpointEvery = 0;

  /// --checkpoint-every
  void addCheckpoints(CLI::App& app) {
    app.add_option("--checkpoint-every", checkpointEvery,
                   "interval at which session.hslam is saved to the output folder")
        ->type_name("SECONDS")
        ->check(within(0.001, 1e9));
  }
  /// Adds --checkpoint-every and --resume.
  void addResume(CLI::App& app) {
    addCheckpoints(app);
    app.add_option(
           "--resume", resume,
           "resume the run that saved this session (or folder of results), with its configuration, log and "
           "output folder")
        ->type_name("FILE");
  }
  /// Adds --continue, --localize, --prior-plan and --start.
  void addMap(CLI::App& app) {
    const std::string maps = " this session (or folder of results), map.yaml or gridmap";
    app.add_option("--continue", continueFrom, "continue mapping in" + maps)->type_name("FILE");
    app.add_option("--localize", localizeIn, "localise in" + maps + ", which does not change")
        ->type_name("FILE");
    app.add_option(
           "--prior-plan", priorPlan,
           "begin with the lines of this floor plan (.geojson, .dxf or .svg); pose and scale are found from "
           "the scans")
        ->type_name("FILE");
    app.add_option("--start", start,
                   "pose in this map or plan at the start of the log (m, deg; default: found from the scans)")
        ->type_name("X,Y,DEG");
  }
  /// @throws InputError for options that exclude each other
  void addTo(run::RunOptions& run) const {
    std::string mode;
    const auto add = [&mode](const char* option, const std::string& value) {
      if (value.empty()) return;
      if (!mode.empty())
        throw InputError(mode + " and " + option + " exclude each other", "command line", "expected one");
      mode = option;
    };
    add("--resume", resume), add("--continue", continueFrom), add("--localize", localizeIn);
    add("--prior-plan", priorPlan);
    if (!start.empty() && continueFrom.empty() && localizeIn.empty() && priorPlan.empty())
      throw InputError("--start without a map", "command line",
                       "expected --continue, --localize or --prior-plan as well");
    if (!localizeIn.empty() && checkpointEvery > 0)
      throw InputError("--checkpoint-every with --localize", "command line",
                       "expected one: localisation leaves the map as it is");
    run.resume = resume, run.continueFrom = continueFrom, run.localizeIn = localizeIn;
    run.priorPlan = priorPlan;
    files::findInputFiles({&run.resume, &run.continueFrom, &run.localizeIn, &run.priorPlan});
    for (std::string* session : {&run.resume, &run.continueFrom, &run.localizeIn})
      *session = run::sessionIn(*session);
    run.checkpointEvery = checkpointEvery;
    if (!start.empty()) run.start = startPose();
  }

 private:
  mrpt::math::TPose2D startPose() const {
    std::vector<double> values;
    for (const std::string& field : readings::labelsOf(start))
      values.push_back(parseFinite(field).value_or(NAN));
    const auto isWrong = [](double value) { return std::isnan(value); };
    if (values.size() != 3 || std::any_of(values.begin(), values.end(), isWrong))
      throw InputError("wrong pose `" + start + "`", "command line, option --start", "expected X,Y,DEG");
    for (const double value : values)
      if (std::abs(value) > 1e6)
        throw InputError("start too far away", "command line, option --start",
                         "expected at most 1e6 m and deg");
    return {values[0], values[1], mrpt::DEG2RAD(values[2])};
  }
};

}  // namespace hybrid_slam
