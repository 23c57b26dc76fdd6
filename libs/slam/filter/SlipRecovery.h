/// @file SlipRecovery.h
/// @brief Detects that the odometry is wrong, and finds where the robot may be.
#pragma once

#include <deque>
#include <vector>

#include "slam/filter/FilterOptions.h"
#include "slam/filter/Particle.h"
#include "slam/filter/PreparedScan.h"
#include "slam/filter/RecentMap.h"
#include "slam/grid/CorrelativeSearch.h"
#include "slam/grid/ScanMatcher.h"

namespace hybrid_slam {

/// A hypothesis of a step's motion: where scan matches start.
struct StepMotion {
  mrpt::math::TPose2D odometry;  ///< m, rad; in the robot frame at the start of the step
  mrpt::math::TPose2D start;     ///< motion of the best particle's match: start of the other matches
  bool hasSlipped = false;       ///< odometry rejected
};

/// Once per step, the scan is matched to the best particle's map from the odometry; the result starts the
/// other particles' matches. If it fits much worse than earlier scans, a window around it is searched, then
/// one around no motion and one around the opposite of the odometry; and if the scan contradicts the map at
/// the best pose there, the first window at all headings. After several such scans in succession, the robot
/// was carried: the whole map is searched for a place that all of them fit, with lines first at the four
/// headings that align their walls with the map's, and then at all headings.
///
/// A robot that returns to a place from which its path has drifted contradicts the map, too, and may fit
/// better at another place that looks the same; loop closing corrects the drift. So a scan is also compared
/// with a map of the newest scans alone: if it agrees with them where the odometry says, a pose where it
/// contradicts them is no slip, and only a scan that contradicts them is searched for at all headings and in
/// the whole map. Unless they refute the odometry for most beams, a heading at which the map contradicts the
/// scan is not taken. Where they know less than a fifth of the beams at the odometry's pose, as with a short
/// range, they exclude nothing; if they know more there, a pose where they know less counts as contradicted.
///
/// Beams at people are left out, as seen from where the odometry says the robot is; but not where the whole
/// map is searched, since a robot that was carried is elsewhere.
///
/// The motion is a mixture of the motion model and, with slip_probability, a uniform distribution over the
/// window; no motion and the opposite one are 1e-4 times as probable as such a slip. A pose far from the
/// motion model is accepted if its posterior under this mixture is higher; poses of similar posterior are
/// hypotheses, which are distributed among the particles until later scans decide.
class SlipRecovery {
 public:
  explicit SlipRecovery(const FilterConfiguration& configuration);
  /// Disables the search of the whole map for a robot that was carried.
  void searchOnlyNearby() { searchesMap_ = false; }
  /// Returns at least one hypothesis, the most likely first.
  /// @param whole  the scan, beams at people included
  std::vector<StepMotion> motionsOf(const Particle& best, const mrpt::math::TPose2D& odometry,
                                    const PreparedScan& whole);

  template <class State>
  void visit(State& state) {
    state(contradicting_, recent_, usualFit_);
  }

 private:
  struct Hypothesis {
    ScanMatch match;
    double logPosterior;
    bool hasSlipped;
    bool isElsewhere = false;  ///< found in the whole map
  };
  std::vector<Hypothesis> search(const mrpt::math::TPose2D& odometry, const Particle& best,
                                 const MotionDistribution& expected, const Hypothesis& usual,
                                 const PreparedScan& scan, const PreparedScan& whole);
  std::vector<Hypothesis> searchNearby(const mrpt::math::TPose2D& odometry, const Particle& best,
                                       const MotionDistribution& expected, const Hypothesis& usual,
                                       const PreparedScan& scan) const;
  std::vector<Hypothesis> searchWindow(const mrpt::math::TPose2D& centre, const SearchWindow& window,
                                       const Particle& best, const MotionDistribution& expected,
                                       const Hypothesis& usual, const PreparedScan& scan) const;
  std::vector<Hypothesis> searchMap(const Particle& best, const PreparedScan& scan) const;
  /// Returns whether the contradicting scans fit the map if the newest was taken at `pose`.
  bool fitsAll(mrpt::math::TPose2D pose, const Particle& best) const;
  double logWeight(const mrpt::math::TPose2D& pose, const Particle& best, const PreparedScan& scan) const;

  ImprovedProposalOptions options_;
  MotionModelOptions motion_;
  double exponent_;  ///< of w_grid
  bool searchesMap_ = true;
  ScanPreparation prepare_;
  ScanMatcher matcher_;
  GridWeight gridWeight_;
  struct TakenScan {
    mrpt::math::TPose2D odometry;  ///< since the one before
    ScanBeams beams;

    template <class State>
    void visit(State& state) {
      state(odometry, beams);
    }
  };
  std::deque<TakenScan> contradicting_;  ///< the newest successive scans that contradict the map
  RecentMap recent_;                     ///< what the robot has just seen
  double usualFit_ = 0;                  ///< running mean of the fit, recent scans weighted most
};

/// The motion model's distribution of the pose after a step; after a slip, as wide as the search window
/// around the pose that was found.
MotionDistribution motionAfter(const Particle& before, const StepMotion& motion,
                               const MotionModelOptions& model, const ImprovedProposalOptions& options);

}  // namespace hybrid_slam
