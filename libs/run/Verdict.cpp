#include "run/Verdict.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "base/Degree.h"
#include "base/Numbers.h"

namespace hybrid_slam::run {

using mrpt::math::TPose2D;
using Level = Verdict::Level;

namespace {

constexpr double kGap = 2;            // m of path within one doubtful place
constexpr size_t kFewest = 4;         // contradicted scans of a place, and of a lost map
constexpr size_t kFewestInDoubt = 2;  // contradicted scans of a doubtful map; 1 if it is the only scan
constexpr size_t kMostPlaces = 10;

// Calibrated on seeds from 101 on: doc/verdict.md.
constexpr double kReturningDoubtful = 0.12, kReturningLost = 0.5;
constexpr double kRecentDoubtful = 0.12, kRecentLost = 0.25;
constexpr double kEarlierLost = 0.5;
constexpr double kJump = 0.5;      // share of a scan's beams that contradict the map
constexpr size_t kJumpScans = 3;   // in succession
constexpr double kLongPlace = 15;  // m of path
constexpr double kSpread = 0.5;    // m
constexpr double kSlips = 0.2;     // share of the updates
constexpr size_t kFewestSlips = 10;
constexpr double kTurn = 3 * kDegree;
constexpr size_t kFewestTurns = 10;  // against the odometry
constexpr double kFaults = 0.1;      // of the odometry, per scan
constexpr double kFewBeams = 30;     // wrong maps of fewer agree with themselves
constexpr double kFarApart = 1.25;   // m of path between scans: the same
constexpr double kLongGap = 3;       // m of odometry without scans
constexpr double kEarly = 0.1;       // of the scans of the log

using Stretch = std::vector<const Revisit*>;

/// Contradicted scans near each other.
std::vector<Stretch> stretchesOf(const std::vector<Revisit>& revisits) {
  std::vector<Stretch> stretches;
  for (const Revisit& revisit : revisits) {
    if (!revisit.isContradicted()) continue;
    if (stretches.empty() || revisit.distance - stretches.back().back()->distance > kGap)
      stretches.emplace_back();
    stretches.back().push_back(&revisit);
  }
  return stretches;
}

/// Successive compared scans with most of their beams contradicted.
std::vector<Stretch> jumpsOf(const std::vector<Revisit>& recent) {
  std::vector<Stretch> jumps(1);
  for (const Revisit& revisit : recent) {
    if (revisit.share() > kJump)
      jumps.back().push_back(&revisit);
    else if (!jumps.back().empty())
      jumps.emplace_back();
  }
  return jumps;
}

/// The stretches with at least `fewest` scans as places, the longest first.
std::vector<DoubtfulPlace> placesOf(const std::vector<Stretch>& stretches, size_t fewest) {
  std::vector<DoubtfulPlace> places;
  for (const Stretch& stretch : stretches) {
    if (stretch.size() < fewest) continue;
    const Revisit& middle = *stretch[stretch.size() / 2];
    places.push_back({{middle.pose.x, middle.pose.y},
                      middle.update,
                      stretch.back()->distance - stretch.front()->distance});
  }
  std::stable_sort(places.begin(), places.end(),
                   [](const DoubtfulPlace& a, const DoubtfulPlace& b) { return a.length > b.length; });
  return places;
}

std::string text(const mrpt::math::TPoint2D& at) {
  return "(" + fixedText(at.x, 1) + ", " + fixedText(at.y, 1) + ") m";
}

std::string share(size_t count, size_t all) {
  return fixedText(100.0 * static_cast<double>(count) / static_cast<double>(all), 0) + " % of " +
         std::to_string(all);
}

void add(Verdict& verdict, Level level, const std::string& reason) {
  verdict.level = std::max(verdict.level, level);
  verdict.reasons.push_back(reason);
}

/// Judges a path by its scans alone.
Verdict byScans(const std::vector<Revisit>& returning, const std::vector<Revisit>& recent) {
  Verdict verdict;
  const auto contradict = [&verdict](Level level, const std::string& reason) {
    verdict.isContradicted = true;
    add(verdict, level, reason);
  };
  const auto judge = [&](const std::vector<Revisit>& revisits, double doubtful, double lost,
                         const std::string& what) {
    if (revisits.empty()) return;
    const size_t contradicted = contradictedOf(revisits);
    const double part = static_cast<double>(contradicted) / static_cast<double>(revisits.size());
    verdict.contradiction += part;
    if (contradicted >= std::min(kFewestInDoubt, revisits.size()) && part > doubtful)
      contradict(part > lost && contradicted >= kFewest ? Level::lost : Level::doubtful,
                 share(contradicted, revisits.size()) + " " + what);
  };
  judge(returning, kReturningDoubtful, kReturningLost, "returning scans contradict what was mapped before");
  judge(recent, kRecentDoubtful, kRecentLost, "scans contradict what was mapped just before");
  verdict.places = placesOf(stretchesOf(returning), kFewest);
  if (!verdict.places.empty() && verdict.places[0].length > kLongPlace)
    contradict(Level::doubtful,
               "walls are doubled along " + fixedText(verdict.places[0].length, 0) + " m of path");
  const std::vector<DoubtfulPlace> jumps = placesOf(jumpsOf(recent), kJumpScans);
  if (!jumps.empty())
    contradict(Level::doubtful, "the path may have jumped at " + text(jumps[0].at) +
                                    ": successive scans contradict what was mapped just before");
  verdict.places.insert(verdict.places.end(), jumps.begin(), jumps.end());
  return verdict;
}

}  // namespace

std::string Verdict::name() const {
  const char* const names[] = {"consistent", "doubtful", "lost"};
  return names[static_cast<int>(level)];
}

bool Verdict::isWorseThan(const Verdict& other) const {
  return std::tie(level, isContradicted, contradiction) >
         std::tie(other.level, other.isContradicted, other.contradiction);
}

std::string Verdict::line() const {
  std::string line = "verdict: " + name();
  for (size_t i = 0; i < reasons.size(); ++i) line += (i == 0 ? ": " : "; ") + reasons[i];
  const auto longest =
      std::max_element(places.begin(), places.end(),
                       [](const DoubtfulPlace& a, const DoubtfulPlace& b) { return a.length < b.length; });
  if (level != Level::consistent && longest != places.end()) line += "; longest at " + text(longest->at);
  return line;
}

// A mirrored map agrees with itself.
Turns turnsOf(const std::vector<TPose2D>& odometry, const std::vector<TPose2D>& path) {
  Turns turns;
  for (size_t i = 1; i < std::min(odometry.size(), path.size()); ++i) {
    const double expected = odometry[i].phi, turn = (path[i] - path[i - 1]).phi;
    if (std::abs(expected) < kTurn) continue;
    ++turns.all;
    turns.against += turn * expected < -0.5 * expected * expected;
  }
  return turns;
}

Verdict verdictOf(const Evidence& evidence) {
  const Verdict strict = byScans(evidence.returning, evidence.recent);
  Verdict verdict = byScans(withoutNarrowThings(evidence.returning), withoutNarrowThings(evidence.recent));
  const auto find = [&verdict](Level level, const std::string& reason) { add(verdict, level, reason); };
  if (strict.isContradicted && !verdict.isContradicted)
    find(Level::consistent, "scans contradict the map, but only at narrow things, such as people");
  verdict.isContradicted = strict.isContradicted;
  verdict.contradiction = strict.contradiction;

  // Another run with more particles would find the same place, so this does not count as contradicted.
  const size_t against = contradictedOf(withoutNarrowThings(evidence.earlier));
  const double part = static_cast<double>(against) / static_cast<double>(evidence.earlier.size());
  if (against >= kFewest && part > kMostAgainstEarlierMap)
    find(part > kEarlierLost ? Level::lost : Level::doubtful,
         share(against, evidence.earlier.size()) + " scans contradict the map that the run continues");
  if (evidence.spread > kSpread)
    find(Level::doubtful,
         "hypotheses still disagree at the end: spread " + fixedText(evidence.spread, 1) + " m");
  if (static_cast<double>(evidence.odometryFaults) > kFaults * static_cast<double>(evidence.scans))
    find(Level::doubtful, std::to_string(evidence.odometryFaults) +
                              " odometry readings are impossible or jump, in " +
                              counted(evidence.scans, "scan(s)"));
  const Turns& turns = evidence.turns;
  if (turns.against >= kFewestTurns && 2 * turns.against > turns.all)
    find(Level::doubtful,
         "the scans turn against the odometry, " + std::to_string(turns.against) + " of " +
             std::to_string(turns.all) +
             " times: the map may be mirrored; input.laser_pose can say that the laser is upside down");
  if (evidence.beams < kFewBeams)
    find(Level::doubtful,
         "scans have too few beams to judge the map: " + fixedText(evidence.beams, 0) + " on average");
  if (evidence.spacing > kFarApart)
    find(Level::doubtful,
         "scans are too far apart to judge the map: " + fixedText(evidence.spacing, 1) + " m");
  for (const LaserOffset& laser : evidence.lasers)
    if (laser.isLarge())
      find(Level::doubtful, "laser `" + laser.laser + "` sees the walls turned by " +
                                fixedText(std::abs(laser.turn) / kDegree, 1) + " deg against laser `" +
                                laser.reference +
                                "`: the heading of one of them on the robot is wrong in the log; "
                                "input.sensor_label chooses a laser");
  if (evidence.gap.length > kLongGap)
    find(Level::doubtful, "no scans along " + fixedText(evidence.gap.length, 1) + " m of odometry from " +
                              text(evidence.gap.start) + " on");
  if (static_cast<double>(evidence.early) > kEarly * static_cast<double>(evidence.early + evidence.scans))
    find(Level::doubtful, share(evidence.early, evidence.early + evidence.scans) +
                              " scans are not used: they are older than all odometry");
  if (!evidence.notCompared.empty())
    find(Level::doubtful, "not all scans were compared with the map: " + evidence.notCompared);
  const bool isOdometryUseless =
      evidence.slips >= kFewestSlips &&
      static_cast<double>(evidence.slips) > kSlips * static_cast<double>(evidence.updates);
  if (isOdometryUseless || (verdict.level != Level::consistent && evidence.slips > 0))
    find(Level::doubtful,
         "odometry rejected in " + counted(evidence.slips, "update(s)") +
             (isOdometryUseless
                  ? ": the laser's pose on the robot (input.laser_pose) or the times of scans and "
                    "odometry may be wrong"
                  : ""));
  if (evidence.notCompared.empty() && evidence.returning.empty())
    find(Level::consistent, "no place was seen twice");
  if (verdict.places.size() > kMostPlaces) verdict.places.resize(kMostPlaces);
  return verdict;
}

}  // namespace hybrid_slam::run
