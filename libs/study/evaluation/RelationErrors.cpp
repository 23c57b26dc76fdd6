#include "study/evaluation/RelationErrors.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>
#include <optional>
#include <tuple>

#include "base/Errors.h"
#include "files/NumberTable.h"
#include "study/evaluation/Association.h"
#include "study/evaluation/StampIndex.h"

namespace hybrid_slam::evaluation {
namespace {

using PoseAt = std::function<std::optional<TrajectoryPoint>(double)>;

std::vector<PlacedRelation> place(const std::vector<Relation>& relations, const PoseAt& poseAt) {
  std::vector<PlacedRelation> placed;
  for (const Relation& relation : relations) {
    const auto first = poseAt(relation.t1), second = poseAt(relation.t2);
    if (first && second) placed.push_back({relation.motion, *first, *second});
  }
  return placed;
}

std::vector<PlacedRelation> placeNearest(const files::Trajectory& trajectory,
                                         const std::vector<Relation>& relations, double tolerance) {
  std::vector<size_t> rows(trajectory.size());
  std::iota(rows.begin(), rows.end(), 0);
  std::sort(rows.begin(), rows.end(), [&trajectory](size_t i, size_t j) {
    const files::StampedPose &a = trajectory[i], &b = trajectory[j];
    return std::tie(a.timestamp, a.pose.x, a.pose.y, a.pose.phi) <
           std::tie(b.timestamp, b.pose.x, b.pose.y, b.pose.phi);
  });
  files::Trajectory sorted;
  for (const size_t row : rows) sorted.push_back(trajectory[row]);
  const StampIndex index(sorted);
  return place(relations, [&](double timestamp) -> std::optional<TrajectoryPoint> {
    const auto place = index.nearest(timestamp, tolerance);
    if (!place) return std::nullopt;
    return TrajectoryPoint{sorted[*place].pose, rows[*place]};
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

std::vector<PlacedRelation> placeRelations(const files::Trajectory& trajectory,
                                           const std::vector<Relation>& relations,
                                           const files::Trajectory* odometry, double tolerance) {
  std::vector<PlacedRelation> placed;
  if (odometry) {
    const OdometryBridge bridge(trajectory, *odometry, tolerance);
    placed = place(relations, [&](double timestamp) { return bridge.poseAt(timestamp); });
  } else {
    placed = placeNearest(trajectory, relations, tolerance);
  }
  if (!placed.empty()) return placed;

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

RelationErrors evaluateRelations(const files::Trajectory& trajectory, const std::vector<Relation>& relations,
                                 const files::Trajectory* odometry, double tolerance) {
  std::vector<double> translations, rotations;
  for (const PlacedRelation& relation : placeRelations(trajectory, relations, odometry, tolerance)) {
    const mrpt::math::TPose2D error = (relation.second.pose - relation.first.pose) - relation.motion;
    translations.push_back(std::hypot(error.x, error.y));
    rotations.push_back(std::abs(error.phi));
  }
  RelationErrors result;
  result.relations = relations.size();
  result.used = translations.size();
  result.translation = errorStatistics(std::move(translations));
  result.rotation = errorStatistics(std::move(rotations));
  return result;
}

}  // namespace hybrid_slam::evaluation
