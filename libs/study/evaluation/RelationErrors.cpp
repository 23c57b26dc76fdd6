#include "study/evaluation/RelationErrors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <optional>
#include <tuple>

#include "base/Errors.h"
#include "files/NumberTable.h"
#include "study/evaluation/Association.h"
#include "study/evaluation/OdometryBridge.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::evaluation {
namespace {

using PoseAt = std::function<std::optional<mrpt::math::TPose2D>(double)>;

RelationErrors evaluate(const std::vector<Relation>& relations, const PoseAt& poseAt) {
  std::vector<double> translations, rotations;
  for (const Relation& relation : relations) {
    const auto p1 = poseAt(relation.t1), p2 = poseAt(relation.t2);
    if (!p1 || !p2) continue;
    const mrpt::math::TPose2D error = (*p2 - *p1) - relation.motion;
    translations.push_back(std::hypot(error.x, error.y));
    rotations.push_back(std::abs(error.phi));
  }
  RelationErrors result;
  result.relations = relations.size();
  result.used = translations.size();
  if (result.used == 0) return result;
  result.translation = errorStatistics(std::move(translations));
  result.rotation = errorStatistics(std::move(rotations));
  return result;
}

RelationErrors evaluateNearest(files::Trajectory trajectory, const std::vector<Relation>& relations,
                               double tolerance) {
  std::sort(trajectory.begin(), trajectory.end(),
            [](const files::StampedPose& a, const files::StampedPose& b) {
              return std::tie(a.timestamp, a.pose.x, a.pose.y, a.pose.phi) <
                     std::tie(b.timestamp, b.pose.x, b.pose.y, b.pose.phi);
            });
  const StampIndex index(trajectory);
  return evaluate(relations, [&](double timestamp) -> std::optional<mrpt::math::TPose2D> {
    const auto row = index.nearest(timestamp, tolerance);
    if (!row) return std::nullopt;
    return trajectory[*row].pose;
  });
}

}  // namespace

std::vector<Relation> loadRelations(const std::string& file) {
  std::vector<Relation> relations;
  for (const files::NumberRow& row : files::readNumberTable(file, "t1 t2 x y z roll pitch yaw")) {
    files::checkPose(row, file, {2, 3, 4}, {5, 6, 7});
    relations.push_back({row.values[0], row.values[1], {row.values[2], row.values[3], row.values[7]}});
  }
  return relations;
}

RelationErrors evaluateRelations(const files::Trajectory& trajectory, const std::vector<Relation>& relations,
                                 const files::Trajectory* odometry, double tolerance) {
  RelationErrors result;
  if (odometry) {
    const OdometryBridge bridge(trajectory, *odometry, tolerance);
    result = evaluate(relations, [&](double timestamp) { return bridge.poseAt(timestamp); });
  } else {
    result = evaluateNearest(trajectory, relations, tolerance);
  }
  if (result.used > 0) return result;

  files::Trajectory ends;
  for (const Relation& relation : relations) {
    ends.push_back({relation.t1, {}});
    ends.push_back({relation.t2, {}});
  }
  throw InputError("no usable relation",
                   "trajectory " + timeSpan(trajectory) + ", relations " + timeSpan(ends),
                   odometry ? "expected odometry rows at both times of a relation, after the first pose"
                            : "expected poses at both times of a relation; try a larger tolerance or "
                              "odometry between the poses");
}

}  // namespace hybrid_slam::evaluation
