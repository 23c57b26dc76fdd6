#include "slam/localization/Localizer.h"

#include <algorithm>
#include <cmath>

#include "base/Errors.h"
#include "slam/filter/Threads.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr double kTrackedStdXY = 0.05, kTrackedStdPhi = kDegree;  // of the particles where tracking begins
// These thresholds hold for scans at least 0.5 m or 20 deg apart:
constexpr size_t kLost = 4;  // in succession that do not fit: the place is unknown
constexpr double kTrackedContradicted = 0.3, kTrackedExplained = 0.4;  // share of the beams of such a scan
constexpr size_t kTrackedWindow = 8;                                   // remembered while the place is known
constexpr long kDoubtful = 2;  // of these that are not explained: other places may fit

/// Completes the settings with those of the map.
const FilterConfiguration& checked(FilterConfiguration& configuration, const OccupancyGrid& grid) {
  configuration.grid.resolution = grid.resolution();
  if (configuration.filter.isAuxiliary())
    throw InputError("MRPT's auxiliary filters do not localise", "section [particle_filter], key `proposal`",
                     "expected improved or standard");
  checkMemory(configuration.grid, configuration.gridWeight);
  return configuration;
}

}  // namespace

Localizer::Localizer(FilterConfiguration configuration, OccupancyGrid grid, LineDatabase lines,
                     std::optional<TPose2D> start)
    : interval_(checked(configuration, grid).updateInterval()),
      particleCount_(configuration.filter.fixedParticles()),
      seed_(static_cast<uint64_t>(configuration.filter.seed)),
      grid_(std::move(grid)),
      lines_(std::move(lines)),
      start_(start),
      prepare_(configuration),
      particles_(configuration, &profiler()),
      global_(configuration.gridWeight, configuration.matcher, grid_, lines_),
      recent_(configuration),
      arena_(arenaThreads(configuration.filter.threads)) {}

void Localizer::process(const TPose2D& odometry, const Scans& scans) {
  expectFinite(odometry);
  odometry_ = odometry_ + odometry;
  if (start_) start_ = *start_ + odometry;
  if (!scans.empty() && (path_.empty() || interval_.isOver(odometry_))) update(scans);
}

void Localizer::update(const Scans& scans) {
  const PreparedScan scan = prepare_(scans);
  const bool isRemembered = recent_.add(odometry_, scan);
  if (start_)
    trackFromStart(isRemembered);
  else if (isTracking_)
    track(scan, isRemembered);
  else
    search(isRemembered);
  path_.push_back(pose_);
  odometry_ = TPose2D();
}

// The first scans may have no returns.
void Localizer::trackFromStart(bool isRemembered) {
  if (!isRemembered || recent_.scans().back().scan.matchedBeams.rays.empty()) return summarise(*start_);
  startTracking(global_.near(*start_, kStartWindow, recent_).pose);
  start_.reset();
}

void Localizer::startTracking(const TPose2D& pose) {
  std::vector<TPose2D> poses;
  for (int i = 0; i < particleCount_; ++i) {
    RandomStream random(seed_, path_.size(), static_cast<uint64_t>(i));
    const double x = random.gaussian(), y = random.gaussian(), phi = random.gaussian();
    poses.push_back(
        {pose.x + kTrackedStdXY * x, pose.y + kTrackedStdXY * y, pose.phi + kTrackedStdPhi * phi});
  }
  particles_.place(poses, grid_, lines_);
  isTracking_ = hasTracked_ = true;
  unsupported_ = 0;
  explained_.clear();
  summarise(pose);
}

void Localizer::track(const PreparedScan& scan, bool isRemembered) {
  particles_.beginStep();
  particles_.sampleAndWeigh(odometry_, scan);
  particles_.resampleIfDue();
  step_ = particles_.lastStep();
  pose_ = particles_.best().path.back();
  if (isRemembered) check(beamShares(recent_.scans().back().scan.matchedBeams, pose_, grid_));
}

// Comparing the places detects a robot that was carried to a similar one.
void Localizer::check(const BeamShares& shares) {
  const bool isSupported = shares.contradicted < kTrackedContradicted && shares.explained > kTrackedExplained;
  unsupported_ = isSupported ? 0 : unsupported_ + 1;
  explained_.push_back(isExplained(shares));
  if (explained_.size() > kTrackedWindow) explained_.pop_front();
  recent_.keep(kTrackedWindow);
  const bool isLost = unsupported_ >= kLost;
  if (isLost) {
    recent_.keep(kLost);
    global_.clear();
  } else {
    if (std::count(explained_.begin(), explained_.end(), false) < kDoubtful) return global_.clear();
    global_.update(recent_, arena_);
    if (!global_.refutes(pose_, recent_)) return;
  }
  isTracking_ = false;
  ++losses_;
  search(isLost);
}

void Localizer::search(bool isRemembered) {
  if (isRemembered) global_.update(recent_, arena_);
  const auto& hypotheses = global_.hypotheses();
  if (global_.isFound())
    startTracking(hypotheses[0].pose + recent_.since());
  else
    summarise(hypotheses.empty() ? pose_ + odometry_ : hypotheses[0].pose + recent_.since());
}

void Localizer::summarise(const TPose2D& best) {
  pose_ = best;
  step_ = FilterStep();
  step_.resampled = false;
  setSpread(step_, particlePoses(), best.phi);
  step_.particles = step_.poses.size();
}

mrpt::maps::COccupancyGridMap2D Localizer::bestGrid() const { return toMrpt(grid_); }

std::optional<Place> Localizer::place() const {
  return Place{isTracking_, hasTracked_, isTracking_ ? 0 : global_.hypotheses().size()};
}

std::vector<WeightedPose> Localizer::particlePoses() const {
  return isTracking_ ? particles_.poses() : global_.poses(recent_.since());
}

}  // namespace hybrid_slam
