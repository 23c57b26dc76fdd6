#include "readings/BagLog.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "bags/ByteCursor.h"
#include "base/Errors.h"

namespace hybrid_slam::readings {
namespace {

constexpr double kWindow = 1;                                 // s
constexpr size_t kMostHeld = 5000, kMostHeldBeams = 1 << 22;  // objects and beams
constexpr double kLongRange = 100;                            // m, where a scan does not state its own

mrpt::math::TPose2D seenFromAbove(const bags::FramePose& pose) {
  const mrpt::poses::CPose3D p = poseOf(pose);
  return {p.x(), p.y(), p.yaw()};
}

}  // namespace

BagLog::BagLog(const std::string& file, BagPlan plan, const LogConversionOptions& options,
               BrokenLineReport report)
    : file_(file),
      bag_(bags::openBag(file)),
      plan_(std::move(plan)),
      options_(options),
      report_(std::move(report)),
      objects_(options.maxRange.value_or(LogObjects::kAnyRange), options.actionObservation, options.sweep) {
  objects_.summary.format = bag_->format();
  objects_.summary.unit = "message";
}

mrpt::serialization::CSerializable::Ptr BagLog::next() {
  auto object = objects_.take();
  while (!object) {
    const auto message = bag_->next();
    if (message) {
      ++number_;
      read(*message);
    }
    release(!message);
    objects_.summary.areAt(number_);
    object = objects_.take();
    if (!message) break;
  }
  return object;
}

void BagLog::read(const bags::StoredMessage& message) {
  const bags::Topic& topic = bag_->topics()[message.topic];
  if (!topic.messageType) return;
  const auto laser = std::find_if(plan_.lasers.begin(), plan_.lasers.end(),
                                  [&](const BagPlan::Laser& one) { return one.topic == topic.name; });
  const bool isTransforms = *topic.messageType == bags::MessageType::transforms;
  const bool isOdometry = *topic.messageType == bags::MessageType::odometry;
  const bool isUsed = isTransforms ? !plan_.odomFrame.empty()
                      : isOdometry ? topic.name == plan_.odometryTopic
                                   : laser != plan_.lasers.end();
  if (!isUsed) return;
  topic_ = message.topic;
  try {
    const bags::Message content = bags::decodeMessage(*topic.messageType, topic.encoding, message.bytes);
    if (const auto* scan = std::get_if<bags::ScanMessage>(&content))
      hold(*scan, message.time, *laser);
    else if (const auto* odometry = std::get_if<bags::OdometryMessage>(&content))
      hold(*odometry, message.time);
    else
      hold(std::get<std::vector<bags::TransformMessage>>(content), message.time);
  } catch (const bags::BrokenBytes& broken) {
    const std::string why = topic.name + ": " + broken.what();
    if (options_.strict)
      throw InputError("broken message", file_ + ", message " + std::to_string(number_), why);
    ++objects_.summary.brokenLines;
    report_(number_, why);
  }
}

void BagLog::hold(const bags::ScanMessage& scan, double recorded, const BagPlan::Laser& laser) {
  if (scan.ranges.empty()) throw bags::BrokenBytes("a scan without beams");
  LaserRecord record;
  record.label = laser.topic;
  record.ranges = scan.ranges;
  record.angles = {scan.angleMin, scan.angleStep};
  record.sweep = scan.timeStep * static_cast<double>(scan.ranges.size() - 1);
  record.mounting = laser.pose;
  if (!laser.isMountingKnown) record.mounting->x = options_.laserX.value_or(0);
  record.minRange = std::isfinite(scan.rangeMin) ? scan.rangeMin : 0;
  record.maxRange = std::isfinite(scan.rangeMax) && scan.rangeMax > 0 ? scan.rangeMax : kLongRange;
  hold(scan.header.time, recorded, record, scan.ranges.size());
}

void BagLog::hold(const bags::OdometryMessage& odometry, double recorded) {
  hold(odometry.header.time, recorded, OdometryRecord{0, seenFromAbove(odometry.pose)}, 0);
}

void BagLog::hold(const std::vector<bags::TransformMessage>& transforms, double recorded) {
  for (const bags::TransformMessage& one : transforms)
    if (one.childFrame == plan_.baseFrame && one.header.frame == plan_.odomFrame)
      hold(one.header.time, recorded, OdometryRecord{0, seenFromAbove(one.pose)}, 0);
}

void BagLog::hold(double time, double recorded, Record record, size_t beams) {
  if (time == 0) time = recorded;
  if (!(time >= 0 && time <= kLatestTime)) throw bags::BrokenBytes("its time is impossible");
  std::visit([&](auto& one) { one.time = time; }, record);
  double& latest = latest_.try_emplace(topic_, time).first->second;
  if (time < latest - kWindow) release(true);  // the clock was set back: the future ends here
  latest = time;
  heldBeams_ += beams;
  const bool isFirst = beams == 0 && time != odometryTime_;
  if (beams == 0) odometryTime_ = time;
  held_.emplace(std::make_tuple(time, !isFirst, number_), std::move(record));
}

void BagLog::release(bool isAtEnd) {
  const auto mustGo = [&] {
    const double span = std::get<double>(held_.rbegin()->first) - std::get<double>(held_.begin()->first);
    return isAtEnd || span > kWindow || held_.size() > kMostHeld || heldBeams_ > kMostHeldBeams;
  };
  while (!held_.empty() && mustGo()) {
    Record record = std::move(held_.extract(held_.begin()).mapped());
    if (const auto* scan = std::get_if<LaserRecord>(&record)) heldBeams_ -= scan->ranges.size();
    std::visit(objects_, std::move(record));
  }
}

}  // namespace hybrid_slam::readings
