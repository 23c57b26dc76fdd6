#include "slam/filter/HybridMapBuilder.h"

#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3DPDFGaussian.h>
#include <mrpt/poses/CPose3DPDFParticles.h>

#include "base/OdometryIncrement.h"

namespace hybrid_slam {

using mrpt::math::TPose2D;
using mrpt::obs::CObservation2DRangeScan;

Scans scansOf(const mrpt::obs::CSensoryFrame& observations) {
  Scans scans;
  for (const auto& observation : observations)
    if (const auto scan = std::dynamic_pointer_cast<CObservation2DRangeScan>(observation))
      scans.push_back(scan);
  return scans;
}

HybridMapBuilder::HybridMapBuilder(const FilterConfiguration& configuration) : HybridFilter(configuration) {}

void HybridMapBuilder::processActionObservation(mrpt::obs::CActionCollection& action,
                                                mrpt::obs::CSensoryFrame& observations) {
  const size_t before = updates();
  const Scans scans = scansOf(observations);
  process(odometryIncrement(action), scans);
  if (updates() == before || !remembersScans_) return;
  auto frame = mrpt::obs::CSensoryFrame::Create();
  for (const auto& scan : scans) frame->insert(scan);
  scans_.emplace_back(before, frame);
}

void HybridMapBuilder::initialize(const mrpt::maps::CSimpleMap& initialMap, const mrpt::poses::CPosePDF* x0) {
  reset();
  scans_.clear();
  initialMap_ = initialMap;
  TPose2D start;
  for (const auto& keyframe : initialMap) {
    const Scans scans = scansOf(*keyframe.sf);
    if (scans.empty()) continue;
    start = TPose2D(keyframe.pose->getMeanVal().asTPose());
    insertAt(start, scans);
  }
  startPathAt(x0 ? x0->getMeanVal().asTPose() : start);
}

mrpt::poses::CPose3DPDF::Ptr HybridMapBuilder::getCurrentPoseEstimation() const {
  auto pdf = std::make_shared<mrpt::poses::CPose3DPDFParticles>();
  pdf->m_particles.clear();
  for (const auto& [pose, logWeight] : particlePoses()) {
    pdf->m_particles.emplace_back();
    pdf->m_particles.back().d = mrpt::math::TPose3D(pose + odometry());
    pdf->m_particles.back().log_w = logWeight;
  }
  return pdf;
}

void HybridMapBuilder::getCurrentlyBuiltMap(mrpt::maps::CSimpleMap& map) const {
  map = initialMap_;
  const std::vector<TPose2D> path = bestPath();
  for (const auto& [update, scans] : scans_)
    map.insert(mrpt::poses::CPose3DPDFGaussian::Create(mrpt::poses::CPose3D(path[update])), scans);
}

BuiltMetricMap HybridMapBuilder::getCurrentlyBuiltMetricMap() const {
  metricMap_.maps.clear();
  metricMap_.maps.push_back(mrpt::maps::COccupancyGridMap2D::Create(bestGrid()));
  return builtMetricMap(metricMap_);
}

void HybridMapBuilder::saveCurrentEstimationToImage(const std::string& file, bool /*formatEmfBmp*/) {
  bestGrid().saveAsBitmapFile(file);
}

void HybridMapBuilder::getCurrentMostLikelyPath(std::deque<mrpt::math::TPose3D>& path) const {
  path.clear();
  for (const TPose2D& pose : bestPath()) path.emplace_back(pose);
}

}  // namespace hybrid_slam
