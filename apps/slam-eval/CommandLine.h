/// @file CommandLine.h
/// @brief The command line of slam-eval.
#pragma once

#include <CLI/CLI.hpp>
#include <limits>
#include <string>
#include <utility>

#include "base/Errors.h"
#include "study/evaluation/RevisitError.h"

namespace hybrid_slam {

struct CommandLine {
  std::string trajectory, relations, odometry, reference, rawlog, covariances;
  std::string run;
  double noise = 0, noiseDegrees = 0;  // of the relations, m and deg
  std::string plan, truth;
  bool aligns = false;
  std::string delta = "1m";
  double relationTolerance = 0.006;  // s
  double referenceTolerance = 0.02;  // s
  evaluation::RevisitOptions revisits;
  double maxRange = std::numeric_limits<double>::infinity();  // m
  std::string laserPose = "auto";
};

/// The subcommands: each is true if it was given.
struct Commands {
  CLI::App *relations, *ate, *rpe, *revisits, *nees, *neesRelations, *plan;
};

inline void addTrajectory(CLI::App& command, CommandLine& line) {
  command.add_option("--trajectory", line.trajectory, "trajectory to evaluate, TUM file")->required();
}

inline void addRelations(CLI::App& command, CommandLine& line) {
  command.add_option("--relations", line.relations, "file `t1 t2 x y z roll pitch yaw`")->required();
  command.add_option("--odometry", line.odometry,
                     "file `t x y theta`, in log order, to interpolate between the trajectory's poses");
  command
      .add_option("--tolerance", line.relationTolerance,
                  "largest time difference between a relation and a pose, s; with odometry at most 0.006")
      ->capture_default_str();
}

inline void addReference(CLI::App& command, CommandLine& line) {
  command.add_option("--reference", line.reference, "reference trajectory, TUM file")->required();
  command
      .add_option("--tolerance", line.referenceTolerance,
                  "largest time difference between a pose and its reference pose, s")
      ->capture_default_str();
}

inline void addBeams(CLI::App& command, CommandLine& line) {
  command.add_option("--max-range", line.maxRange, "largest range of the beams used, m (default: the log's)");
  command
      .add_option("--laser-pose", line.laserPose,
                  "pose of the only laser on the robot: that in config.ini of the run, [input] laser_pose")
      ->capture_default_str();
}

inline void addRevisits(CLI::App& command, CommandLine& line) {
  addTrajectory(command, line);
  command.add_option("--rawlog", line.rawlog, "log the trajectory was estimated from")->required();
  command
      .add_option("--distance", line.revisits.distance,
                  "largest distance between the poses of two scans at one place, m")
      ->capture_default_str();
  command.add_option("--path", line.revisits.path, "least distance driven between the two scans, m")
      ->capture_default_str();
  addBeams(command, line);
}

inline void addNeesRelations(CLI::App& command, CommandLine& line) {
  addRelations(command, line);
  command.add_option("--run", line.run, "folder with the results of a run")->required();
  command.add_option("--rawlog", line.rawlog, "log of this run")->required();
  command.add_option("--noise", line.noise, "standard deviation of the relations in x and in y, m")
      ->capture_default_str();
  command.add_option("--noise-deg", line.noiseDegrees, "standard deviation of their rotation, deg")
      ->capture_default_str();
}

inline void addPlan(CLI::App& command, CommandLine& line) {
  command.add_option("--plan", line.plan, "plan to evaluate: .geojson, .dxf or .svg")->required();
  command.add_option("--truth", line.truth, "true plan: the same, or a floor plan of simul-floorplan")
      ->required();
  command.add_flag("--align", line.aligns, "first move the plan rigidly onto the truth");
  command.add_option("--rawlog", line.rawlog, "log of the laser, for the part of the true walls that it saw");
  command.add_option("--reference", line.reference, "its true poses in the frame of the true plan, TUM file");
  addBeams(command, line);
}

inline Commands describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "slam-eval " HYBRID_SLAM_VERSION);
  app.set_help_all_flag("--help-all", "Print the options of every subcommand and exit");
  app.require_subcommand(1);
  Commands all{};
  all.relations = app.add_subcommand("relations", "relations metric of Kuemmerle et al. 2009");
  addTrajectory(*all.relations, line);
  addRelations(*all.relations, line);
  all.ate = app.add_subcommand("ate", "absolute trajectory error after rigid alignment");
  addTrajectory(*all.ate, line);
  addReference(*all.ate, line);
  all.rpe = app.add_subcommand("rpe", "relative pose error over a fixed time or distance");
  addTrajectory(*all.rpe, line);
  addReference(*all.rpe, line);
  all.rpe->add_option("--delta", line.delta, "time or distance between the poses, `1s` or `0.5m`")
      ->capture_default_str();
  all.revisits =
      app.add_subcommand("revisits", "disagreement of scans at revisited places; needs no reference");
  addRevisits(*all.revisits, line);
  all.nees = app.add_subcommand("nees", "normalised estimation error squared (NEES) of covariances");
  addTrajectory(*all.nees, line);
  all.nees->add_option("--covariances", line.covariances, "covariance.csv of the same run")->required();
  addReference(*all.nees, line);
  all.neesRelations =
      app.add_subcommand("nees-relations", "NEES against relations: covariances between two poses");
  addNeesRelations(*all.neesRelations, line);
  all.plan = app.add_subcommand("plan", "a floor plan against the true one");
  addPlan(*all.plan, line);
  return all;
}

/// @throws InputError for a number out of its range
inline void check(const CommandLine& line) {
  for (const double tolerance : {line.relationTolerance, line.referenceTolerance})
    if (!(tolerance >= 0))
      throw InputError("wrong value", "option --tolerance", "expected a number of seconds, 0 or more");
  for (const auto& [option, deviation] :
       {std::pair("--noise", line.noise), {"--noise-deg", line.noiseDegrees}})
    if (!(deviation >= 0 && deviation <= 1e7))
      throw InputError("wrong value", std::string("option ") + option, "expected a number in 0..1e7");
  for (const auto& [option, metres] : {std::pair("--distance", line.revisits.distance),
                                       {"--path", line.revisits.path},
                                       {"--max-range", line.maxRange}})
    if (!(metres > 0))
      throw InputError("wrong value", std::string("option ") + option, "expected a number of metres above 0");
}

}  // namespace hybrid_slam
