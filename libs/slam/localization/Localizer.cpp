#include "slam/localization/Localizer.h"

#include <mrpt/core/bits_math.h>

#include <cmath>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "slam/filter/Threads.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;

namespace {

constexpr SearchWindow kStartWindow{0.5, mrpt::DEG2RAD(15.0)};  // around a given start
constexpr double kStdXY = 0.05, kStdPhi = mrpt::DEG2RAD(1.0);   // of the particles where tracking begins
constexpr size_t kLost = 4;  // successive scans, at least 0.5 m or 20 deg apart, that do not fit
constexpr double kContradicted = 0.3, kExplained = 0.4;  // share of the beams of a scan that does not fit

FilterConfiguration checked(FilterConfiguration configuration, const OccupancyGrid& grid) {
  configuration.grid.resolution = grid.resolution();
  if (configuration.filter.isAuxiliary())
    throw InputError("MRPT's auxiliary filters do not localise", "section [particle_filter], key `proposal`",
                     "expected improved or standard");
  return configuration;
}

}  // namespace

Localizer::Localizer(const FilterConfiguration& configuration, OccupancyGrid grid, LineDatabase lines,
                     std::optional<TPose2D> start)
    : configuration_(checked(configuration, grid)),
      grid_(std::move(grid)),
      lines_(std::move(lines)),
      start_(start),
      prepare_(configuration_),
      particles_(configuration_, &profiler()),
      global_(configuration_, grid_, lines_),
      recent_(configuration_),
      arena_(arenaThreads(configuration_.filter.threads)) {}

void Localizer::process(const TPose2D& odometry, const Scans& scans) {
  odometry_ = odometry_ + odometry;
  const bool isDue = path_.empty() || odometry_.norm() >= configuration_.updateDistance() ||
                     std::abs(odometry_.phi) >= configuration_.updateAngle();
  if (!scans.empty() && isDue) update(scans);
}

void Localizer::update(const Scans& scans) {
  const PreparedScan scan = prepare_(scans);
  const bool isRemembered = recent_.add(odometry_, scan);
  if (path_.empty() && start_)
    startTracking(global_.near(*start_, kStartWindow, recent_).pose);
  else if (isTracking_)
    track(scan, isRemembered);
  else
    search(isRemembered);
  path_.push_back(pose_);
  odometry_ = TPose2D();
}

void Localizer::startTracking(const TPose2D& pose) {
  std::vector<TPose2D> poses;
  for (int i = 0; i < configuration_.filter.fixedParticles(); ++i) {
    RandomStream random(static_cast<uint64_t>(configuration_.filter.seed), path_.size(),
                        static_cast<uint64_t>(i));
    const double x = random.gaussian(), y = random.gaussian(), phi = random.gaussian();
    poses.push_back({pose.x + kStdXY * x, pose.y + kStdXY * y, pose.phi + kStdPhi * phi});
  }
  particles_.place(poses, grid_, lines_);
  isTracking_ = true;
  unsupported_ = 0;
  summarise(pose);
}

void Localizer::track(const PreparedScan& scan, bool isRemembered) {
  particles_.beginStep();
  particles_.sampleAndWeigh(odometry_, scan);
  particles_.resampleIfDue();
  step_ = particles_.lastStep();
  pose_ = particles_.best().path.back();
  if (!isRemembered) return;
  const BeamShares shares = beamShares(scan.matchedBeams, pose_, grid_);
  const bool isSupported = shares.contradicted < kContradicted && shares.explained > kExplained;
  unsupported_ = isSupported ? 0 : unsupported_ + 1;
  if (unsupported_ < kLost) return;
  isTracking_ = false;
  recent_.keep(kLost);
  global_.clear();
  search(true);
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
  step_.odometry = odometry_;
  step_.motions.assign(step_.poses.size(), odometry_);
}

TPose2D Localizer::firstPose() const {
  const TPose2D sinceFirst = recent_.scans().back().pose + recent_.since();
  return pose_ + (TPose2D() - sinceFirst);
}

mrpt::maps::COccupancyGridMap2D Localizer::bestGrid() const { return toMrpt(grid_); }

std::vector<WeightedPose> Localizer::particlePoses() const {
  return isTracking_ ? particles_.poses() : global_.poses(recent_.since());
}

}  // namespace hybrid_slam
