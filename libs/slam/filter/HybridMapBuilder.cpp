#include "slam/filter/HybridMapBuilder.h"

#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPose3DPDFParticles.h>

#include <cmath>
#include <limits>

#include "base/Errors.h"
#include "slam/grid/GridConversion.h"
#include "slam/motion/OdometryIncrement.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::system::CTimeLoggerEntry;

namespace {

mrpt::bayes::CParticleFilter::TParticleFilterOptions mrptOptions(const ParticleFilterOptions& options) {
  using mrpt::bayes::CParticleFilter;
  using Proposal = ParticleFilterOptions::Proposal;
  if (options.proposal != Proposal::standard && options.resampling == CParticleFilter::prResidual)
    throw InputError("residual resampling is biased in MRPT's auxiliary filters",
                     "section [particle_filter], keys `proposal`, `resampling`",
                     "expected another scheme or the standard proposal");
  CParticleFilter::TParticleFilterOptions out;
  switch (options.proposal) {
    case Proposal::standard:
      out.PF_algorithm = CParticleFilter::pfStandardProposal;
      break;
    case Proposal::improved:
      out.PF_algorithm = CParticleFilter::pfOptimalProposal;
      break;
    case Proposal::auxiliaryStandard:
      out.PF_algorithm = CParticleFilter::pfAuxiliaryPFStandard;
      break;
    case Proposal::auxiliaryOptimal:
      out.PF_algorithm = CParticleFilter::pfAuxiliaryPFOptimal;
      break;
  }
  out.resamplingMethod = options.resampling;
  out.sampleSize = static_cast<unsigned int>(options.particles);
  out.BETA = options.essThreshold;
  out.adaptiveSampleSize = false;
  // MRPT would give a particle of less likelihood than this the pose of another, but leave it its own map.
  out.max_loglikelihood_dyn_range = std::numeric_limits<double>::infinity();
  return out;
}

}  // namespace

HybridMapBuilder::HybridMapBuilder(const FilterConfiguration& configuration)
    : configuration_(configuration), prepare_(configuration), particles_(configuration, &profiler()) {
  particleFilter_.m_options = mrptOptions(configuration.filter);
  initialize();
}

void HybridMapBuilder::processActionObservation(mrpt::obs::CActionCollection& action,
                                                mrpt::obs::CSensoryFrame& observations) {
  odometry_ = odometry_ + odometryIncrement(action);
  const auto scan = observations.getObservationByClass<CObservation2DRangeScan>();
  const bool isDue = !hasMap_ || odometry_.norm() >= configuration_.updateDistance() ||
                     std::abs(odometry_.phi) >= configuration_.updateAngle();
  if (scan && isDue) update(*scan, observations);
}

// Fig. 1 from top to bottom.
void HybridMapBuilder::update(const CObservation2DRangeScan& observation,
                              mrpt::obs::CSensoryFrame& observations) {
  CTimeLoggerEntry preparing(profiler(), "2 prepare scan, extract lines");
  const PreparedScan scan = prepare_(observation);  // line detection, Sec. III-B
  preparing.stop();
  particles_.beginStep(scan);
  if (hasMap_) {
    mrpt::obs::CActionCollection motion;
    motion.insert(toAction(odometry_, configuration_.motion));
    particleFilter_.executeOn(particles_, &motion, &observations);  // sample, weigh, resample
  } else {
    particles_.appendPose(odometry_);
  }
  CTimeLoggerEntry mapping(profiler(), "5 update maps");
  particles_.updateMaps();  // map estimation: grids and line databases, Sec. III-C
  mapping.stop();

  odometry_ = TPose2D();
  hasMap_ = true;
  if (remembersScans_) {
    auto frame = mrpt::obs::CSensoryFrame::Create();
    frame->insert(observations.getObservationByClass<CObservation2DRangeScan>());
    scans_.emplace_back(updates_, frame);
  }
  ++updates_;
}

void HybridMapBuilder::initialize(const mrpt::maps::CSimpleMap& initialMap, const mrpt::poses::CPosePDF* x0) {
  odometry_ = TPose2D();
  updates_ = 0;
  hasMap_ = false;
  scans_.clear();
  initialMap_ = initialMap;
  particles_.reset(TPose2D());
  for (size_t i = 0; i < initialMap.size(); ++i) {
    const auto [posePdf, frame] = initialMap.getAsPair(i);
    const auto scan = frame->getObservationByClass<CObservation2DRangeScan>();
    if (!scan) continue;
    particles_.appendPose(TPose2D(posePdf->getMeanVal().asTPose()) - particles_.best().path.back());
    const PreparedScan prepared = prepare_(*scan);
    particles_.beginStep(prepared);
    particles_.updateMaps();
    hasMap_ = true;
  }
  const TPose2D start = x0 ? x0->getMeanVal().asTPose() : particles_.best().path.back();
  particles_.startPathAt(start);
}

mrpt::poses::CPose3DPDF::Ptr HybridMapBuilder::getCurrentPoseEstimation() const {
  auto pdf = std::make_shared<mrpt::poses::CPose3DPDFParticles>();
  pdf->m_particles.clear();
  for (const auto& [pose, logWeight] : particles_.poses()) {
    pdf->m_particles.emplace_back();
    pdf->m_particles.back().d = mrpt::math::TPose3D(pose + odometry_);
    pdf->m_particles.back().log_w = logWeight;
  }
  return pdf;
}

void HybridMapBuilder::getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& map) const {
  map = initialMap_;
  const std::vector<TPose2D> path = bestPath();
  for (const auto& [update, scan] : scans_)
    map.insert(mrpt::poses::CPose3DPDFGaussian(mrpt::poses::CPose3D(path[update])), *scan);
}

const mrpt::maps::CMultiMetricMap* HybridMapBuilder::getCurrentlyBuiltMetricMap() const {
  metricMap_.maps.clear();
  metricMap_.maps.push_back(mrpt::maps::COccupancyGridMap2D::Create(bestGrid()));
  return &metricMap_;
}

void HybridMapBuilder::saveCurrentEstimationToImage(const std::string& file, bool /*formatEmfBmp*/) {
  bestGrid().saveAsBitmapFile(file);
}

void HybridMapBuilder::getCurrentMostLikelyPath(std::deque<mrpt::math::TPose3D>& path) const {
  path.clear();
  for (const TPose2D& pose : bestPath()) path.emplace_back(pose);
}

std::vector<TPose2D> HybridMapBuilder::bestPath() const {
  std::vector<TPose2D> poses = particles_.best().path.poses();
  poses.erase(poses.begin());  // where the robot was before its first scan
  return poses;
}

mrpt::maps::COccupancyGridMap2D HybridMapBuilder::bestGrid() const { return toMrpt(particles_.best().grid); }

std::vector<DatabaseLine> HybridMapBuilder::bestLines() const {
  const auto& lines = particles_.best().lines->lines();
  return {lines.begin(), lines.end()};
}

}  // namespace hybrid_slam
