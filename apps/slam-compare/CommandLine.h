/// @file CommandLine.h
/// @brief The command line of slam-compare.
#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "InputFiles.h"
#include "OutputArgument.h"
#include "Program.h"
#include "SettingArguments.h"
#include "base/Errors.h"
#include "readings/LogFormats.h"
#include "study/comparison/Groups.h"
#include "study/comparison/RunEvaluation.h"

namespace hybrid_slam {

struct CommandLine {
  InputFiles files;
  std::string output, reference, relations, odometry, floorplan;
  std::vector<std::string> methods{"hybrid", "general"}, particles, variants, settings;
  int seeds = 30, firstSeed = 1, jobs = 0;
  std::optional<double> revisits;  // m
  comparison::SuccessCriterion criterion;
  bool isReportOnly = false, isListOnly = false, isQuiet = false;
};

inline void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "slam-compare " HYBRID_SLAM_VERSION);
  line.files.add(app, logMeans());
  addOutput(app, line.output, "folder for runs, tables and report, created if missing")->required();
  app.add_option("-m,--methods", line.methods,
                 "list of hybrid, general, linemap, ortho, stock; the first is the baseline of the tests")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->capture_default_str();
  app.add_option("-n,--particles", line.particles,
                 "particle counts for all methods or one (default: the INI file's)")
      ->delimiter(',')
      ->allow_extra_args(false)
      ->type_name("[METHOD:]N");
  app.add_option("--seeds", line.seeds, "runs per group")->capture_default_str();
  app.add_option("--first-seed", line.firstSeed, "first seed; the others count up from it")
      ->capture_default_str();
  app.add_option("--variant", line.variants,
                 "extra group with these settings on top of the INI file, for METHOD or all methods; @FILE: "
                 "another INI file; repeatable")
      ->type_name("[METHOD/]NAME:SECTION.KEY=VALUE[,...]")
      ->allow_extra_args(false);
  addSettings(app, line.settings, "override a key of the INI file for all runs; repeatable");
  app.add_option("-j,--jobs", line.jobs, "parallel runs; 0: one per core")->capture_default_str();
  app.add_option("--reference", line.reference, "TUM file of true poses, for ATE, return error, success");
  app.add_option("--relations", line.relations, "relations file, for the relations metric, success");
  app.add_option("--odometry", line.odometry,
                 "file `t x y theta` to extrapolate poses to the relations' times");
  app.add_option("--floorplan", line.floorplan,
                 "floor plan in the reference's frame, for map errors and doubled walls");
  app.add_option("--revisits", line.revisits,
                 "revisit error between scans up to DISTANCE apart, m (slam-eval revisits)")
      ->type_name("DISTANCE");
  app.add_option("--success-trans", line.criterion.returnTrans,
                 "success bound: position error at the return, m")
      ->capture_default_str();
  app.add_option("--success-rot", line.criterion.returnRot, "success bound: heading error at the return, deg")
      ->capture_default_str();
  app.add_option("--success-doubled", line.criterion.doubledShare, "success bound: share of doubled wall")
      ->capture_default_str();
  app.add_option("--success-relations", line.criterion.relations,
                 "success bound: mean translation error of the relations, m")
      ->capture_default_str();
  app.add_option("--success-revisit", line.criterion.revisits,
                 "success bound: median revisit error, m; needs at least one revisit")
      ->capture_default_str();
  app.add_flag("--report-only", line.isReportOnly, "start no runs; tables and report of the finished ones");
  app.add_flag("--list", line.isListOnly,
               "start no runs; print the name of each, a tab, and its command without `-o FOLDER`");
  addQuiet(app, line.isQuiet);
  app.footer(
      "Runs: DIR/runs/METHOD[-VARIANT]-PARTICLES-SEED/. Results: DIR/results.csv, summary.csv,\n"
      "summary.json, report.html. Finished runs are kept: after Ctrl-C the same command continues.\n"
      "Exit: 0 done, 1 interrupted or a run failed, 2 wrong command line or input.");
}

/// @throws InputError for a wrong value, or options that do not go together
inline void check(const CommandLine& line) {
  const auto expect = [](bool isRight, const std::string& option, const std::string& expected) {
    if (!isRight) throw InputError("wrong value", "option " + option, expected);
  };
  expect(line.seeds >= 1 && line.seeds <= 1000, "--seeds", "expected 1..1000");
  expect(line.firstSeed >= 0 && line.firstSeed <= std::numeric_limits<int>::max() - line.seeds + 1,
         "--first-seed", "expected 0 or more, and a last seed of at most 2147483647");
  expect(line.jobs >= 0, "--jobs", "expected 0 or more");
  expect(line.criterion.returnTrans > 0, "--success-trans", "expected a number of metres above 0");
  expect(line.criterion.returnRot > 0, "--success-rot", "expected a number of degrees above 0");
  expect(line.criterion.doubledShare > 0, "--success-doubled", "expected a share above 0");
  expect(line.criterion.relations > 0, "--success-relations", "expected a number of metres above 0");
  expect(line.criterion.revisits > 0, "--success-revisit", "expected a number of metres above 0");
  expect(line.revisits.value_or(1) > 0, "--revisits", "expected a number of metres above 0");
  if (line.files.log.empty())
    throw InputError("no log", "command line", "expected slam-compare [config.ini] LOG -o DIR");
  for (const std::string& setting : line.settings) comparison::checkSetting(setting, "option --set");
  if (!line.odometry.empty() && line.relations.empty())
    throw InputError("odometry without relations", "option --odometry", "expected --relations as well");
  if (!line.floorplan.empty() && line.reference.empty())
    throw InputError("floor plan without reference", "option --floorplan",
                     "expected --reference as well, which places the maps in the plan");
}

}  // namespace hybrid_slam
