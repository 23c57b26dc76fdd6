#include "slam/filter/StockMapBuilder.h"

#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/obs/CObservation2DRangeScan.h>

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "base/Errors.h"
#include "base/Numbers.h"
#include "slam/grid/GridConversion.h"

namespace hybrid_slam {

using mrpt::maps::COccupancyGridMap2D;
using mrpt::math::TPose2D;

namespace {

/// Memory of a cell of MRPT's grid: one byte for its value, eight for its cached likelihood.
constexpr double kBytesPerCell = 9;

/// Exchanges two generators until its end, also if MRPT throws.
class SwappedGenerators {
 public:
  SwappedGenerators(mrpt::random::CRandomGenerator& a, mrpt::random::CRandomGenerator& b) : a_(a), b_(b) {
    std::swap(a_, b_);
  }
  ~SwappedGenerators() { std::swap(a_, b_); }
  SwappedGenerators(const SwappedGenerators&) = delete;
  SwappedGenerators& operator=(const SwappedGenerators&) = delete;

 private:
  mrpt::random::CRandomGenerator &a_, &b_;
};

/// MRPT checks no setting: a wrong number ends in a crash or takes all memory. @throws InputError
void expectWithin(const mrpt::config::CConfigFileBase& source, const std::string& section,
                  const std::string& key, double least, double most) {
  if (!source.keyExists(section, key)) return;
  const double value = source.read_double(section, key, least);
  if (!(least <= value && value <= most))
    throw InputError("wrong number", "section [" + section + "], key `" + key + "`",
                     "expected " + numberText(least) + ".." + numberText(most));
}

size_t cellsOf(const COccupancyGridMap2D& grid) { return size_t{grid.getSizeX()} * grid.getSizeY(); }

}  // namespace

StockMapBuilder::StockMapBuilder(const TConstructionOptions& construction, const MotionModelOptions& motion,
                                 uint32_t seed, double mostBytes)
    : CMetricMapBuilderRBPF(construction), motion_(motion), mostBytes_(mostBytes), random_(seed) {}

void StockMapBuilder::process(const TPose2D& odometry, const Scans& scans) {
  expectFinite(odometry);
  mrpt::obs::CActionCollection action;
  action.insert(toAction(odometry, motion_));
  mrpt::obs::CSensoryFrame observations;
  for (const auto& scan : scans)
    if (scan->getScanSize() >= 2) observations.insert(scan);  // MRPT fails on a scan of one beam
  processActionObservation(action, observations);
}

void StockMapBuilder::processActionObservation(mrpt::obs::CActionCollection& action,
                                               mrpt::obs::CSensoryFrame& observations) {
  checkSize();
  const size_t before = mapPDF.m_particles.front().d->robotPath.size();
  oneThread_.execute([&] {
    // MRPT draws from its thread's generator.
    const SwappedGenerators own(mrpt::random::getRandomGenerator(), random_);
    CMetricMapBuilderRBPF::processActionObservation(action, observations);
  });
  if (mapPDF.m_particles.front().d->robotPath.size() == before) return;
  ++updates_;
  step_ = FilterStep();
  step_.particles = mapPDF.m_particles.size();
  step_.ess = mapPDF.ESS();
  setSpread(step_, particlePoses(), bestPath().back().phi);
}

void StockMapBuilder::checkSize() const {
  double cells = 0;
  for (const auto& particle : mapPDF.m_particles)
    if (const auto grid = particle.d->mapTillNow.mapByClass<COccupancyGridMap2D>()) {
      const size_t own = cellsOf(*grid);
      if (own > kMostCells) throw std::runtime_error("map too large for MRPT's filter: over 2^28 cells");
      cells += static_cast<double>(own);
    }
  if (kBytesPerCell * cells > mostBytes_)
    throw std::runtime_error("maps of " + std::to_string(mapPDF.m_particles.size()) +
                             " particles too large for MRPT's filter: over " +
                             fixedText(mostBytes_ / 1e9, 1) + " GB, half of the memory");
}

size_t StockMapBuilder::bestParticle() const {
  size_t best = 0;
  for (size_t i = 1; i < mapPDF.particlesCount(); ++i)
    if (mapPDF.getW(i) > mapPDF.getW(best)) best = i;
  return best;
}

std::vector<TPose2D> StockMapBuilder::bestPath() const {
  std::vector<TPose2D> path;
  for (const auto& pose : mapPDF.m_particles[bestParticle()].d->robotPath) path.emplace_back(pose);
  // The path starts with the pose before the first scan.
  path.erase(path.begin(), path.end() - static_cast<std::ptrdiff_t>(std::min(updates_, path.size())));
  return path;
}

COccupancyGridMap2D StockMapBuilder::bestGrid() const {
  const auto& map = mapPDF.m_particles[bestParticle()].d->mapTillNow;
  if (const auto grid = map.mapByClass<COccupancyGridMap2D>())
    return cellsOf(*grid) > kMostCells ? toMrpt(fromMrpt(*grid)) : *grid;
  // A point map only (MRPT's ICP set-ups): insert its scans into a grid along the best path.
  COccupancyGridMap2D grid(-1, 1, -1, 1, static_cast<float>(cellSize()));
  mrpt::maps::CSimpleMap scans;
  getCurrentlyBuiltMap(scans);
  grid.loadFromSimpleMap(scans);
  return grid;
}

double StockMapBuilder::cellSize() const {
  const auto grid = mapPDF.m_particles[0].d->mapTillNow.mapByClass<COccupancyGridMap2D>();
  return grid ? grid->getResolution() : 0.05;
}

std::vector<WeightedPose> StockMapBuilder::particlePoses() const {
  std::vector<WeightedPose> all;
  for (const auto& particle : mapPDF.m_particles)
    all.push_back({TPose2D(particle.d->robotPath.back()), particle.log_w});
  return all;
}

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockOptions(
    const mrpt::config::CConfigFileBase& source) {
  const std::string application = "MappingApplication";
  expectWithin(source, application, "sampleSize", 1, 100000);
  expectWithin(source, application, "KLD_minSampleSize", 1, 100000);
  expectWithin(source, application, "KLD_maxSampleSize", 1, 100000);
  std::vector<std::string> sections;
  source.getAllSections(sections);
  for (const std::string& section : sections) {
    if (section.rfind(application, 0) != 0) continue;
    expectWithin(source, section, "resolution", 0.005, 10);
    for (const char* key : {"min_x", "max_x", "min_y", "max_y"})
      expectWithin(source, section, key, -1000, 1000);
  }
  std::vector<std::string> keys;
  if (source.sectionExists(application)) source.getAllKeys(application, keys);
  for (const std::string& key : keys)
    if (key.size() > 6 && key.compare(key.size() - 6, 6, "_count") == 0)
      expectWithin(source, application, key, 0, 10);
  mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions options;
  options.loadFromConfigFile(source, application);
  options.verbosity_level = mrpt::system::LVL_ERROR;
  return options;
}

mrpt::slam::CMetricMapBuilderRBPF::TConstructionOptions stockOptions(const ParticleFilterOptions& filter,
                                                                     const GridOptions& grid) {
  mrpt::config::CConfigFileMemory ini;
  const std::string s = "MappingApplication", map = s + "_occupancyGrid_00";
  ini.write(s, "PF_algorithm", 0);
  ini.write(s, "resamplingMethod", static_cast<int>(filter.resampling));
  ini.write(s, "adaptiveSampleSize", false);
  ini.write(s, "sampleSize", filter.fixedParticles());
  ini.write(s, "pfOptimalProposal_mapSelection", 0);  // unused by the standard proposal, but required
  ini.write(s, "BETA", filter.essThreshold);
  ini.write(s, "insertionLinDistance", filter.updateDistance);
  ini.write(s, "insertionAngDistance_deg", mrpt::RAD2DEG(filter.updateAngle));
  ini.write(s, "localizeLinDistance", filter.updateDistance);
  ini.write(s, "localizeAngDistance_deg", mrpt::RAD2DEG(filter.updateAngle));
  ini.write(s, "occupancyGrid_count", 1);
  ini.write(map + "_creationOpts", "resolution", grid.resolution);
  ini.write(map + "_insertOpts", "maxDistanceInsertion", grid.maxRange);
  ini.write(map + "_likelihoodOpts", "likelihoodMethod", 4);  // likelihood field, as in its own INI files
  ini.write(map + "_likelihoodOpts", "LF_maxRange", grid.maxRange);
  return stockOptions(ini);
}

}  // namespace hybrid_slam
