/// @file FilterOptions.h
/// @brief Settings of the particle filter and its parts.
#pragma once

#include <mrpt/bayes/CParticleFilter.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPose2D.h>

#include <cmath>

#include "base/Options.h"
#include "slam/features/FeatureOptions.h"
#include "slam/filter/LineMapWeight.h"
#include "slam/grid/GridWeight.h"
#include "slam/grid/ScanMatcher.h"
#include "slam/lines/LineAssociation.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/LineExtractor.h"
#include "slam/lines/LineWeight.h"
#include "slam/loops/LoopClosingOptions.h"
#include "slam/motion/MotionModel.h"

namespace hybrid_slam {

/// Section [particle_filter].
struct ParticleFilterOptions : Options {
  enum class Proposal { standard, improved, auxiliaryStandard, auxiliaryOptimal };

  int particles = 0;  ///< 0: adaptive
  int minParticles = 10, maxParticles = 40;
  Proposal proposal = Proposal::improved;
  mrpt::bayes::CParticleFilter::TParticleResamplingAlgorithm resampling =
      mrpt::bayes::CParticleFilter::prSystematic;
  double essThreshold = 0.5;
  double updateDistance = 0.3;               ///< m
  double updateAngle = mrpt::DEG2RAD(15.0);  ///< rad
  int seed = 1;
  int threads = 1;

  bool isAdaptive() const { return particles == 0; }
  bool isAuxiliary() const {
    return proposal == Proposal::auxiliaryStandard || proposal == Proposal::auxiliaryOptimal;
  }
  /// Returns the number of particles for filters that cannot adapt it.
  int fixedParticles() const { return isAdaptive() ? maxParticles : particles; }
  void describe(OptionTable& table) override;
};

/// Section [improved_proposal].
struct ImprovedProposalOptions : Options {
  double updateDistance = 0.1;              ///< m
  double updateAngle = mrpt::DEG2RAD(5.0);  ///< rad
  int samples = 12;
  double exponent = 0.02;
  double minFit = 0.02;
  double lineSigma = mrpt::DEG2RAD(0.1);   ///< rad
  double lineSigmaRho = 0.05;              ///< m
  double slipDistance = 0.5;               ///< m
  double slipAngle = mrpt::DEG2RAD(30.0);  ///< rad
  double slipProbability = 0.001;
  void describe(OptionTable& table) override;
};

/// Motion of the robot from one update to the next.
struct UpdateInterval {
  double distance, angle;  ///< m, rad
  bool isOver(const mrpt::math::TPose2D& odometry) const {
    return odometry.norm() >= distance || std::abs(odometry.phi) >= angle;
  }
};

/// The filter and its parts, one section each.
struct FilterConfiguration {
  bool useLines = true;  ///< false: the same filter without lines, `--method general`
  bool useGrid = true;   ///< false: particles without grids, weighed by their lines, `--method linemap`
  ParticleFilterOptions filter;
  MotionModelOptions motion;
  GridOptions grid;
  GridWeightOptions gridWeight;
  LineExtractionOptions lineExtraction;
  AssociationOptions association;
  LineDatabaseOptions database;
  LineWeightOptions lineWeight;
  FeatureOptions features;
  LineMapOptions lineMap;
  ImprovedProposalOptions improved;
  ScanMatcherOptions matcher;
  LoopClosingOptions loopClosing;

  UpdateInterval updateInterval() const {
    return usesMatches() ? UpdateInterval{improved.updateDistance, improved.updateAngle}
                         : UpdateInterval{filter.updateDistance, filter.updateAngle};
  }
  /// Returns whether scans are matched to grids, which the improved proposal and loop closing need.
  bool usesMatches() const { return useGrid && filter.proposal == ParticleFilterOptions::Proposal::improved; }
  bool closesLoops() const { return useGrid && loopClosing.enabled; }
  /// Returns whether scans are kept: to close loops, or to make a map of them where particles have no grids.
  bool keepsScans() const { return closesLoops() || !useGrid; }
  /// Settings of the particles' line databases.
  LineDatabaseOptions databaseOptions() const {
    LineDatabaseOptions options = database;
    if (!useGrid) options.minLength = lineMap.minLength;
    return options;
  }

  /// (section, options) of every part.
  std::vector<std::pair<std::string, Options*>> sections() {
    return {{"particle_filter", &filter},
            {"motion_model", &motion},
            {"grid", &grid},
            {"grid_weight", &gridWeight},
            {"line_extraction", &lineExtraction},
            {"segmentation", &lineExtraction.segmentation},
            {"line_fit", &lineExtraction.fit},
            {"hough", &lineExtraction.hough},
            {"line_association", &association},
            {"line_database", &database},
            {"line_weight", &lineWeight},
            {"features", &features},
            {"line_map", &lineMap},
            {"improved_proposal", &improved},
            {"scan_matcher", &matcher},
            {"loop_closing", &loopClosing}};
  }
};

/// @throws InputError for a range of more cells than fit into memory
void checkMemory(const GridOptions& grid, const GridWeightOptions& gridWeight);

}  // namespace hybrid_slam
