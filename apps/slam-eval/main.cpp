/// @file main.cpp
/// @brief slam-eval: evaluates a trajectory against a reference or itself, JSON on standard output
/// (doc/slam-eval.md).

#include <mrpt/core/bits_math.h>

#include <CLI/CLI.hpp>
#include <Eigen/Dense>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <iostream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "CommandLine.h"
#include "Program.h"
#include "base/Numbers.h"
#include "files/Trajectory.h"
#include "readings/EndPointReader.h"
#include "run/FinishedPath.h"
#include "run/JsonText.h"
#include "run/PlanFiles.h"
#include "study/evaluation/AbsoluteTrajectoryError.h"
#include "study/evaluation/NormalizedError.h"
#include "study/evaluation/PlanComparison.h"
#include "study/evaluation/RelationErrors.h"
#include "study/evaluation/RelativePoseError.h"
#include "study/evaluation/RevisitError.h"
#include "study/simulation/FloorPlanFile.h"

namespace {

using namespace hybrid_slam;
using Json = nlohmann::ordered_json;

constexpr double kRadToDeg = mrpt::RAD2DEG(1.0);

/// Parses "1.5s" or "0.5m".
evaluation::RpeDelta parseDelta(const std::string& text) {
  evaluation::RpeDelta delta;
  const char* const end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, delta.length);
  const std::string unit(stop, end);
  if (error != std::errc() || !std::isfinite(delta.length) || delta.length <= 0 ||
      (unit != "s" && unit != "m"))
    throw InputError("wrong value `" + text + "`", "option --delta",
                     "expected a positive number with its unit, as in `1s` or `0.5m`");
  delta.unit = unit == "s" ? evaluation::RpeDelta::Unit::seconds : evaluation::RpeDelta::Unit::metres;
  return delta;
}

void warnOfUnused(size_t relations, size_t used, const CommandLine& line, const std::string& trajectory) {
  if (used < relations && line.odometry.empty())
    warn({std::to_string(relations - used) + " of " + std::to_string(relations) +
          " relations not used: no pose within " + numberText(line.relationTolerance) +
          " s of their times in " + trajectory + "; --odometry carries poses to them"});
}

Json relationsJson(const CommandLine& line) {
  const files::Trajectory trajectory = files::loadTum(line.trajectory);
  const std::vector<evaluation::Relation> relations = evaluation::loadRelations(line.relations);
  const files::Trajectory odometry =
      line.odometry.empty() ? files::Trajectory() : files::loadOdometry(line.odometry);
  const evaluation::RelationErrors errors = evaluation::evaluateRelations(
      trajectory, relations, line.odometry.empty() ? nullptr : &odometry, line.relationTolerance);
  warnOfUnused(errors.relations, errors.used, line, line.trajectory);
  return {{"relations", errors.relations},
          {"used", errors.used},
          {"trans_mean_m", errors.translation.mean},
          {"trans_std_m", errors.translation.std},
          {"trans_median_m", errors.translation.median},
          {"trans_max_m", errors.translation.max},
          {"rot_mean_deg", errors.rotation.mean * kRadToDeg},
          {"rot_std_deg", errors.rotation.std * kRadToDeg}};
}

/// Adds the fields PREFIX_rmse_UNIT, PREFIX_mean_UNIT, ...
void addStatistics(Json& json, const std::string& prefix, const std::string& unit,
                   const evaluation::ErrorStatistics& errors, double scale) {
  json[prefix + "_rmse_" + unit] = errors.rmse * scale;
  json[prefix + "_mean_" + unit] = errors.mean * scale;
  json[prefix + "_median_" + unit] = errors.median * scale;
  json[prefix + "_std_" + unit] = errors.std * scale;
  json[prefix + "_max_" + unit] = errors.max * scale;
}

Json ateJson(const CommandLine& line) {
  const files::Trajectory trajectory = files::loadTum(line.trajectory),
                          reference = files::loadTum(line.reference);
  const evaluation::AteErrors errors =
      evaluation::absoluteTrajectoryError(trajectory, reference, line.referenceTolerance);
  if (2 * errors.pairs < trajectory.size())
    warn({"only " + std::to_string(errors.pairs) + " of " + std::to_string(trajectory.size()) + " poses of " +
          line.trajectory + " have a pose of " + line.reference + " at their times"});
  Json json{{"poses", trajectory.size()}, {"pairs", errors.pairs}};
  addStatistics(json, "trans", "m", errors.translation, 1);
  json["alignment"] = {{"x_m", errors.alignment.x},
                       {"y_m", errors.alignment.y},
                       {"phi_deg", errors.alignment.phi * kRadToDeg}};
  return json;
}

Json rpeJson(const CommandLine& line) {
  const evaluation::RpeDelta delta = parseDelta(line.delta);
  const files::Trajectory trajectory = files::loadTum(line.trajectory),
                          reference = files::loadTum(line.reference);
  const evaluation::RpeErrors errors =
      evaluation::relativePoseError(trajectory, reference, delta, line.referenceTolerance);
  Json json{{"delta", line.delta}, {"pairs", errors.pairs}};
  addStatistics(json, "trans", "m", errors.translation, 1);
  addStatistics(json, "rot", "deg", errors.rotation, kRadToDeg);
  return json;
}

void addNees(Json& json, const evaluation::NormalizedErrors& errors) {
  json["nees_mean"] = errors.mean;
  json["nees_median"] = errors.median;
  json["inside_95"] = errors.inside95;
  json["inside_95_x"] = errors.insideAxes.x();
  json["inside_95_y"] = errors.insideAxes.y();
  json["inside_95_heading"] = errors.insideAxes.z();
}

Json neesJson(const CommandLine& line) {
  const evaluation::NormalizedErrors errors = evaluation::normalizedErrors(
      files::loadTum(line.trajectory), evaluation::loadCovariances(line.covariances),
      files::loadTum(line.reference), line.referenceTolerance);
  Json json{{"pairs", errors.pairs}};
  addNees(json, errors);
  return json;
}

Json neesRelationsJson(const CommandLine& line) {
  const run::FinishedPath path = run::readFinishedPath(line.run, line.rawlog, warn);
  const std::vector<evaluation::Relation> relations = evaluation::loadRelations(line.relations);
  const files::Trajectory odometry =
      line.odometry.empty() ? files::Trajectory() : files::loadOdometry(line.odometry);
  const std::vector<evaluation::PlacedRelation> placed = evaluation::placeRelations(
      path.trajectory, relations, line.odometry.empty() ? nullptr : &odometry, line.relationTolerance);
  warnOfUnused(relations.size(), placed.size(), line, line.run + "/trajectory.tum");
  const Eigen::Vector3d noise(line.noise, line.noise, mrpt::DEG2RAD(line.noiseDegrees));
  const Eigen::Matrix3d ofRelation = noise.cwiseAbs2().asDiagonal();
  std::vector<Eigen::Matrix3d> covariances;
  for (const auto& [motion, first, second] : placed)
    covariances.push_back(
        path.covariances.between(path.at(first.pose, first.row), path.at(second.pose, second.row)) +
        ofRelation);
  const evaluation::NormalizedErrors errors = evaluation::normalizedErrors(placed, covariances);
  Json json{{"relations", relations.size()}, {"used", errors.pairs}};
  addNees(json, errors);
  return json;
}

std::vector<readings::EndPoints> loadEndPoints(const CommandLine& line) {
  readings::InputOptions input;
  input.laserPose = line.laserPose;
  input.check();
  return readings::loadEndPoints(line.rawlog, input, line.maxRange, warn);
}

Json revisitsJson(const CommandLine& line) {
  const files::Trajectory trajectory = files::loadTum(line.trajectory);
  const evaluation::RevisitErrors errors =
      evaluation::revisitErrors(trajectory, loadEndPoints(line), line.revisits);
  const auto figure = [&](double value) { return errors.revisits > 0 ? Json(value) : Json(); };
  return {{"scans", errors.scans},
          {"revisits", errors.revisits},
          {"median_m", figure(errors.error.median)},
          {"mean_m", figure(errors.error.mean)},
          {"p95_m", figure(errors.p95)},
          {"max_m", figure(errors.error.max)},
          {"apart", errors.apart}};
}

/// The walls of a drawing or of a floor plan for simul-floorplan, whose arcs become pieces of at most 0.1 m.
std::vector<PlanLine> loadWalls(const std::string& file) {
  const std::string end = std::filesystem::path(file).extension();
  if (end == ".geojson" || end == ".json" || end == ".dxf" || end == ".svg") return run::loadPlan(file);
  std::vector<PlanLine> walls;
  double length = 0;
  for (const simulation::Wall& wall : simulation::readWalls(file)) {
    run::checkPlanLength(length += wall.length(), file);
    const int pieces = wall.isArc() ? static_cast<int>(std::ceil(wall.length() / 0.1)) : 1;
    for (int i = 0; i < pieces; ++i)
      walls.push_back({wall.pointAt(static_cast<double>(i) / pieces), wall.pointAt((i + 1.0) / pieces)});
  }
  return walls;
}

Json planJson(const CommandLine& line) {
  if (line.rawlog.empty() != line.reference.empty())
    throw InputError("--rawlog and --reference belong together", "command line", "expected both or neither");
  std::vector<PlanLine> plan = loadWalls(line.plan);
  const std::vector<PlanLine> truth = loadWalls(line.truth);
  std::vector<mrpt::math::TPoint2D> ends;
  if (!line.rawlog.empty())
    ends = evaluation::placedEndPoints(loadEndPoints(line), files::loadTum(line.reference));
  const mrpt::math::TPose2D alignment =
      line.aligns ? evaluation::alignmentOf(plan, truth) : mrpt::math::TPose2D();
  plan = evaluation::moved(std::move(plan), alignment);
  const evaluation::PlanErrors errors = evaluation::comparePlans(plan, truth, ends);
  Json json{{"truth_m", errors.truth},
            {"seen_m", errors.foundOfSeen ? Json(errors.seen) : Json()},
            {"plan_m", errors.plan},
            {"found_percent", errors.found},
            {"found_of_seen_percent", errors.foundOfSeen ? Json(*errors.foundOfSeen) : Json()},
            {"false_percent", errors.wrong},
            {"median_distance_m", errors.medianDistance},
            {"median_angle_deg", errors.medianAngle * kRadToDeg}};
  if (line.aligns)
    json["alignment"] = {{"x_m", alignment.x}, {"y_m", alignment.y}, {"phi_deg", alignment.phi * kRadToDeg}};
  return json;
}

int evaluate(int argc, char** argv) {
  CommandLine line;
  CLI::App app("Evaluates a trajectory against a reference or itself; prints JSON. Manual: doc/slam-eval.md.",
               "slam-eval");
  const Commands commands = describe(app, line);
  if (const auto code = parse(app, argc, argv)) return *code;
  files::findInputFiles({&line.trajectory, &line.relations, &line.odometry, &line.reference, &line.rawlog,
                         &line.covariances, &line.plan, &line.truth});
  check(line);
  const Json json = *commands.relations       ? relationsJson(line)
                    : *commands.ate           ? ateJson(line)
                    : *commands.revisits      ? revisitsJson(line)
                    : *commands.nees          ? neesJson(line)
                    : *commands.neesRelations ? neesRelationsJson(line)
                    : *commands.plan          ? planJson(line)
                                              : rpeJson(line);
  std::cout << run::jsonText(json) << std::flush;
  if (!std::cout)
    throw std::runtime_error("cannot write: standard output; expected free disk space or an open pipe");
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  return exitCodeOf([&] { return evaluate(argc, argv); });
}
