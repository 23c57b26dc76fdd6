/// @file ScanGrouper.h
/// @brief Decides which scans of a log are used, and which of them form one reading.
#pragma once

#include <mrpt/obs/CObservation2DRangeScan.h>

#include <map>
#include <optional>
#include <set>
#include <string>
#include <vector>

namespace hybrid_slam::readings {

/// A reading has at most one scan of each laser. It ends when all lasers seen so far have scanned, when one
/// of them scans again, or before a scan that is more than `maxGap`, or most of its laser's cycle, later than
/// its first. With one laser every scan is a reading.
class ScanGrouper {
 public:
  /// @param lasers  labels of the lasers to use; none: the first kMaxLasers that are mounted horizontally
  /// @param maxGap  s
  /// @param isPlaced  whether the user states the laser's pose: one laser is used, its logged pose ignored
  ScanGrouper(const std::vector<std::string>& lasers, double maxGap, bool isPlaced = false);

  enum class Use { taken, empty, misplaced, tilted, unwanted, tooMany, second };
  /// Returns whether a scan is used: it has beams, and its laser is wanted, on the robot and mounted
  /// horizontally.
  Use useOf(const mrpt::obs::CObservation2DRangeScan& scan) const;

  /// Announces a laser before its first scan is added; the lasers of a sensory frame are announced together.
  void expect(const std::string& label) { known_.insert(label); }
  /// Adds a scan, in the order of the log. Returns the number of its reading, from 1.
  size_t add(const mrpt::obs::CObservation2DRangeScan& scan);
  /// Returns whether the reading of the last scan has a scan of every known laser.
  bool isComplete() const { return isComplete_; }
  size_t readings() const { return readings_; }
  const std::set<std::string>& lasers() const { return known_; }

 private:
  std::vector<std::string> wanted_;
  double maxGap_;
  bool isPlaced_;
  std::set<std::string> known_, present_;  ///< in the log so far, in the current reading
  size_t readings_ = 0;
  bool isComplete_ = true;
  double firstTime_ = 0;                 ///< s, of the current reading
  std::map<std::string, double> times_;  ///< s, of each laser's last scan
};

/// Returns the reason why a laser is not used, for the user.
std::string reasonOf(ScanGrouper::Use use);

/// Splits a list of labels such as `FRONT, REAR`; ignores blanks around them.
std::vector<std::string> labelsOf(const std::string& list);

}  // namespace hybrid_slam::readings
