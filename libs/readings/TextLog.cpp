#include "readings/TextLog.h"

#include <mrpt/core/Clock.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/obs/CSensoryFrame.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/Errors.h"
#include "readings/LogFields.h"
#include "readings/ReadingAssembler.h"

namespace hybrid_slam::readings {
namespace {

using mrpt::obs::CObservation2DRangeScan;

CObservation2DRangeScan::Ptr observationOf(const LaserRecord& record, double maxRange) {
  auto observation = CObservation2DRangeScan::Create();
  observation->timestamp = mrpt::Clock::fromDouble(record.time);
  observation->sensorLabel = record.label;
  observation->maxRange = static_cast<float>(std::min(maxRange, record.maxRange.value_or(maxRange)));
  observation->rightToLeft = true;
  const size_t beams = record.ranges.size();
  const double aperture = static_cast<double>(beams - 1) * record.angles.step;
  observation->aperture = static_cast<float>(aperture);
  observation->sensorPose =
      mrpt::poses::CPose3D(record.laserPose.x, record.laserPose.y, 0,
                           record.laserPose.phi + record.angles.first + aperture / 2, 0, 0);
  observation->resizeScan(beams);
  for (size_t i = 0; i < beams; ++i) {
    const float range = record.ranges[i];
    // NaN in a rawlog would reach programs that ignore the validity flags.
    observation->setScanRange(i, std::isfinite(range) ? range : 0);
    observation->setScanRangeValidity(i, range > 0 && range < observation->maxRange);
  }
  return observation;
}

/// `CARMEN: FLASER, RLASER, ROBOTLASER1; DP-SLAM: Laser`.
std::string formatList() {
  std::string all;
  for (const LogFormat* format : logFormats())
    all += (all.empty() ? "" : "; ") + std::string(format->name) + ": " + format->rows;
  return all;
}

/// Shows the parser how the log begins.
void preview(files::LineReader& lines, LogParser& parser) {
  std::string line;
  for (size_t i = 0; i < LogParser::kPreviewLines && lines.next(line); ++i) parser.preview(line);
  lines.rewind();
}

const LogFormat* recogniseFormat(files::LineReader& lines) {
  std::string line;
  while (lines.next(line)) {
    if (const LogFormat* format = formatOf(line)) {
      lines.rewind();
      return format;
    }
  }
  throw InputError("not a robot log", lines.path(), "expected rows of scans (" + formatList() + ")");
}

}  // namespace

/// Turns records into rawlog objects, in either format, and gathers the summary.
class TextLog::Conversion {
 public:
  using Objects = std::deque<mrpt::serialization::CSerializable::Ptr>;
  Conversion(Objects& objects, double maxRange, bool actionObservation)
      : objects_(objects), maxRange_(maxRange), actionObservation_(actionObservation) {}

  void operator()(std::monostate) {}

  void operator()(const OtherRecord& record) { ++summary.otherRecords[record.name]; }

  void operator()(const OdometryRecord& record) {
    if (last_ && isJump(last_->pose, record.pose))
      ++summary.odometryJumps;
    else if (last_)
      summary.pathLength += std::hypot(record.pose.x - last_->pose.x, record.pose.y - last_->pose.y);
    last_ = record;
    ++summary.odometryReadings;
    seenAt(record.time);
    if (actionObservation_) return;
    auto observation = mrpt::obs::CObservationOdometry::Create();
    observation->timestamp = mrpt::Clock::fromDouble(record.time);
    observation->sensorLabel = "ODOMETRY";
    observation->odometry = mrpt::poses::CPose2D(record.pose);
    objects_.push_back(observation);
  }

  void operator()(const LaserRecord& record) {
    if (record.odometry && !(last_ && last_->time == record.time && last_->pose == *record.odometry))
      (*this)(OdometryRecord{record.time, *record.odometry});
    ++summary.scans;
    seenAt(record.time);
    const auto observation = observationOf(record, maxRange_);
    for (size_t i = 0; i < observation->getScanSize(); ++i)
      if (observation->getScanRangeValidity(i))
        summary.longestRange = std::max(summary.longestRange, observation->getScanRange(i));
    if (actionObservation_) {
      writeActionUpTo(record.time);
      auto frame = mrpt::obs::CSensoryFrame::Create();
      frame->insert(observation);
      objects_.push_back(frame);
    } else {
      objects_.push_back(observation);
    }
  }

  LogSummary summary;

 private:
  /// The odometry increment since the previous scan; an empty action if there is none.
  void writeActionUpTo(double time) {
    auto actions = mrpt::obs::CActionCollection::Create();
    if (last_) {
      mrpt::obs::CActionRobotMovement2D movement;
      movement.timestamp = mrpt::Clock::fromDouble(time);
      const mrpt::poses::CPose2D now(last_->pose);
      movement.computeFromOdometry(now - atLastScan_.value_or(now), movement.motionModelConfiguration);
      actions->insert(movement);
      atLastScan_ = now;
    }
    objects_.push_back(actions);
  }

  void seenAt(double time) {
    const bool first = summary.scans + summary.odometryReadings == 1;
    constexpr double kDay = 86400;  // s
    if (!first && std::abs(time - lastTime_) > kDay) ++summary.timeJumps;
    lastTime_ = time;
    summary.earliest = first ? time : std::min(summary.earliest, time);
    summary.latest = first ? time : std::max(summary.latest, time);
  }

  Objects& objects_;
  double maxRange_;
  bool actionObservation_;
  std::optional<OdometryRecord> last_;
  double lastTime_ = 0;  ///< s, of the row before
  std::optional<mrpt::poses::CPose2D> atLastScan_;
};

TextLog::TextLog(const std::string& file, const LogConversionOptions& options, BrokenLineReport report)
    : lines_(file), strict_(options.strict), report_(std::move(report)) {
  const LogFormat* const format = options.format ? options.format : recogniseFormat(lines_);
  parser_ = format->makeParser(options);
  preview(lines_, *parser_);
  conversion_ = std::make_unique<Conversion>(ready_, options.maxRange.value_or(format->maxRange),
                                             options.actionObservation);
  conversion_->summary.format = format;
}

TextLog::~TextLog() = default;

const LogSummary& TextLog::summary() const { return conversion_->summary; }

mrpt::serialization::CSerializable::Ptr TextLog::next() {
  std::string line;
  while (ready_.empty() && lines_.next(line)) convert(line);
  if (ready_.empty()) {
    if (summary().scans == 0)
      throw InputError("no laser scan", lines_.path(), "expected whole rows of scans (" + formatList() + ")");
    return nullptr;
  }
  auto object = ready_.front();
  ready_.pop_front();
  return object;
}

void TextLog::convert(const std::string& line) {
  try {
    std::visit(*conversion_, parser_->parse(line));
    LogSummary& summary = conversion_->summary;
    if (summary.odometryJumps > 0 && summary.firstOdometryJump == 0)
      summary.firstOdometryJump = lines_.number();
    if (summary.timeJumps > 0 && summary.firstTimeJump == 0) summary.firstTimeJump = lines_.number();
  } catch (const BrokenLine& broken) {
    if (strict_)
      throw InputError("broken line", lines_.path() + ", line " + std::to_string(lines_.number()),
                       broken.what());
    ++conversion_->summary.brokenLines;
    report_(lines_.number(), broken.what());
  }
}

}  // namespace hybrid_slam::readings
