#include "study/simulation/SimulationOutput.h"

#include <mrpt/core/bits_math.h>
#include <mrpt/img/CImage.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CActionCollection.h>
#include <mrpt/obs/CActionRobotMovement2D.h>
#include <mrpt/obs/CSensoryFrame.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <stdexcept>

#include "base/Numbers.h"
#include "files/Gzip.h"
#include "readings/SweepTimes.h"
#include "study/simulation/BuildingPlan.h"
#include "study/simulation/MovableThings.h"

namespace hybrid_slam::simulation {

using mrpt::math::TPoint2D;

namespace {

/// Returns an action with the increment between two odometry poses.
mrpt::obs::CActionCollection actionBetween(const mrpt::math::TPose2D& before,
                                           const mrpt::math::TPose2D& after,
                                           mrpt::Clock::time_point timestamp) {
  // To 1 um and 1 urad: lower bits depend on the processor's sine.
  const auto rounded = [](double v) { return std::round(v * 1e6) / 1e6; };
  const mrpt::math::TPose2D step = after - before;
  mrpt::obs::CActionRobotMovement2D movement;
  movement.timestamp = timestamp;
  movement.computeFromOdometry(mrpt::poses::CPose2D(rounded(step.x), rounded(step.y), rounded(step.phi)), {});
  mrpt::obs::CActionCollection actions;
  actions.insert(movement);
  return actions;
}

/// Draws in plan coordinates, y upwards.
class Drawing {
 public:
  Drawing(const TPoint2D& low, const TPoint2D& high)
      : low_(low - TPoint2D(kMargin, kMargin)),
        scale_(std::min(kScale, kLargest / (std::max(high.x - low.x, high.y - low.y) + 2 * kMargin))),
        height_(pixels(high.y - low.y)),
        image_(static_cast<unsigned>(pixels(high.x - low.x)), height_) {
    image_.filledRectangle(0, 0, static_cast<int>(image_.getWidth()) - 1, height_ - 1, {255, 255, 255});
  }
  void line(const TPoint2D& a, const TPoint2D& b, const mrpt::img::TColor& color, unsigned width) {
    image_.line(column(a), row(a), column(b), row(b), color, width);
  }
  void disc(const TPoint2D& p, const mrpt::img::TColor& color) {
    for (int radius = 1; radius <= 6; ++radius) image_.drawCircle(column(p), row(p), radius, color, 2);
  }
  bool save(const std::string& file) const { return image_.saveToFile(file); }

 private:
  static constexpr double kScale = 20, kMargin = 1;  // pixels/m, m
  static constexpr double kLargest = 8000;           // pixels; larger plans are scaled down
  int pixels(double metres) const { return std::max(1, static_cast<int>((metres + 2 * kMargin) * scale_)); }
  int column(const TPoint2D& p) const { return static_cast<int>(std::lround((p.x - low_.x) * scale_)); }
  int row(const TPoint2D& p) const {
    return height_ - 1 - static_cast<int>(std::lround((p.y - low_.y) * scale_));
  }

  TPoint2D low_;
  double scale_;  ///< pixels/m
  int height_;
  mrpt::img::CImage image_;
};

}  // namespace

mrpt::obs::CRawlog toRawlog(const SimulatedLog& log, RawlogForm form) {
  mrpt::obs::CRawlog rawlog;
  if (log.scanTime > 0 && !log.scans.empty())
    rawlog.setCommentText(readings::commentOf({log.scans[0]->sensorLabel, log.scanTime}, {})->text);
  if (form == RawlogForm::observations) {
    auto odometry = log.odometry.begin();
    for (const auto& scan : log.scans) {
      for (; odometry != log.odometry.end() && (*odometry)->timestamp < scan->timestamp; ++odometry)
        rawlog.insert(*odometry);
      rawlog.insert(scan);
    }
    for (; odometry != log.odometry.end(); ++odometry) rawlog.insert(*odometry);
    return rawlog;
  }
  for (size_t i = 0; i < log.scans.size(); ++i) {
    auto actions = actionBetween(log.odometryAtScans[i > 0 ? i - 1 : 0], log.odometryAtScans[i],
                                 log.scans[i]->timestamp);
    rawlog.insert(actions);
    mrpt::obs::CSensoryFrame frame;
    frame.insert(log.scans[i]);
    rawlog.insert(frame);
  }
  return rawlog;
}

void writeRawlog(const mrpt::obs::CRawlog& rawlog, const std::string& file) {
  mrpt::io::CMemoryStream plain;
  auto archive = mrpt::serialization::archiveFrom(plain);
  mrpt::obs::CObservationComment comment;
  rawlog.getCommentText(comment.text);
  if (!comment.text.empty()) archive << comment;
  for (const auto& entry : rawlog) archive << *entry;
  // MRPT's compressor uses a temporary file that concurrent programs may share.
  std::ofstream out(file, std::ios::binary);
  out << files::gzipped({static_cast<const char*>(plain.getRawBufferData()), plain.getTotalBytesCount()}, 9);
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file);
}

void writeGroundTruth(const std::vector<TruePose>& poses, const std::string& file) {
  std::ofstream out(file);
  for (const TruePose& p : poses)
    out << fixedText(mrpt::Clock::toDouble(p.timestamp), 6) << ' ' << fixedText(p.pose.x, 6) << ' '
        << fixedText(p.pose.y, 6) << " 0 0 0 " << fixedText(std::sin(p.pose.phi / 2), 9) << ' '
        << fixedText(std::cos(p.pose.phi / 2), 9) << '\n';
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file);
}

namespace {

/// Formats a line of a floor plan file, to 1 um.
std::string planLine(const Wall& wall) {
  const auto line = [](std::string text, std::initializer_list<double> numbers) {
    for (const double number : numbers) text += ' ' + fixedText(number, 6);
    return text;
  };
  if (!wall.isArc()) return line("wall", {wall.start.x, wall.start.y, wall.end.x, wall.end.y});
  const double start = mrpt::RAD2DEG(wall.startAngle), sweep = mrpt::RAD2DEG(wall.sweep);
  if (sweep > 360 - 1e-6) return line("circle", {wall.centre.x, wall.centre.y, wall.radius});
  return line("arc", {wall.centre.x, wall.centre.y, wall.radius, start, start + sweep});
}

}  // namespace

void writeFloorPlan(const BuildingPlan& fixed, const std::vector<PlacedThing>& things,
                    const std::string& file) {
  std::ofstream out(file);
  for (const Wall& wall : fixed.walls()) out << planLine(wall) << '\n';
  for (const PlacedThing& thing : things)
    for (const Wall& wall : thing.walls) out << planLine(wall) << " # " << thing.name << '\n';
  out.close();
  if (!out) throw std::runtime_error("cannot write " + file);
}

void writePicture(const BuildingPlan& plan, const std::vector<TruePose>& poses, const std::string& file) {
  const TPoint2D &low = plan.lowerLeft(), &high = plan.upperRight();
  Drawing drawing(low, high);
  constexpr double kGrid = 5;  // m
  const auto lineNumber = [](double coordinate) { return static_cast<int>(std::ceil(coordinate / kGrid)); };
  for (int i = lineNumber(low.x); i * kGrid <= high.x; ++i)
    drawing.line({i * kGrid, low.y}, {i * kGrid, high.y}, {225, 225, 225}, 1);
  for (int i = lineNumber(low.y); i * kGrid <= high.y; ++i)
    drawing.line({low.x, i * kGrid}, {high.x, i * kGrid}, {225, 225, 225}, 1);
  for (const Wall& wall : plan.walls()) {
    const int chords = wall.isArc() ? static_cast<int>(std::ceil(wall.sweep / 0.05)) : 1;
    for (int i = 0; i < chords; ++i)
      drawing.line(wall.pointAt(static_cast<double>(i) / chords), wall.pointAt((i + 1.0) / chords), {0, 0, 0},
                   2);
  }
  const auto at = [&poses](size_t i) { return TPoint2D(poses[i].pose.x, poses[i].pose.y); };
  for (size_t i = 1; i < poses.size(); ++i) drawing.line(at(i - 1), at(i), {40, 90, 220}, 2);
  if (!poses.empty()) {
    drawing.disc(at(0), {0, 150, 0});
    drawing.disc(at(poses.size() - 1), {220, 0, 0});
  }
  if (!drawing.save(file)) throw std::runtime_error("cannot write " + file);
}

}  // namespace hybrid_slam::simulation
