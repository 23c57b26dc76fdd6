/// @file CHybridLineMap.h
/// @brief The line database as a map of MRPT, for MRPT's own programs (doc/mrpt-plugin.md).
#pragma once

#include <mrpt/maps/CMetricMap.h>
#include <mrpt/maps/TMetricMapInitializer.h>
#include <mrpt/maps/TMetricMapTypesRegistry.h>

#include <optional>
#include <string>

#include "mrpt_plugin/HybridLineMapOptions.h"
#include "slam/lines/LineDatabase.h"

namespace hybrid_slam::mrpt_maps {

/// A LineDatabase that MRPT creates from an INI file (`hybridLineMap_count = 1`), weighs particles with,
/// draws and serialises. It uses horizontal 2D laser scans and ignores other observations.
///
/// MRPT's particle filters copy maps by serialising them, so the settings are a part of the bytes.
class CHybridLineMap : public mrpt::maps::CMetricMap {
  DEFINE_SERIALIZABLE(CHybridLineMap, hybrid_slam::mrpt_maps)

 public:
  HybridLineMapOptions options;

  CHybridLineMap() = default;
  explicit CHybridLineMap(const HybridLineMapOptions& settings) : options(settings) {}

  const LineDatabase& database() const { return database_; }

  bool isEmpty() const override { return database_.lines().empty(); }
  std::string asString() const override;
  /// Writes PREFIX.csv: the lines, as in lines.csv (doc/results.md).
  /// @throws std::runtime_error if the file cannot be written
  void saveMetricMapRepresentationToFile(const std::string& prefix) const override;
  /// Draws green lines in the plane z = 0, in the map frame.
  void getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const override;
  /// Returns 0, as maps without points do in MRPT's mean over several maps.
  float compute3DMatchingRatio(const CMetricMap*, const mrpt::poses::CPose3D&,
                               const mrpt::maps::TMatchingRatioParams&) const override {
    return 0;
  }

 private:
  void internal_clear() override { database_ = {}; }
  /// Performs one step of Sec. III-C: updates the database with the lines of a scan at a pose.
  bool internal_insertObservation(const mrpt::obs::CObservation& observation,
                                  const std::optional<const mrpt::poses::CPose3D>& robot) override;
  /// Returns exponent x log w_line (Sec. III-D); 0 for an observation that is not used.
  double internal_computeObservationLikelihood(const mrpt::obs::CObservation& observation,
                                               const mrpt::poses::CPose3D& robot) const override;
  bool internal_canComputeObservationLikelihood(const mrpt::obs::CObservation& observation) const override;

  template <class State>
  void visit(State& state);

  LineDatabase database_;

  MAP_DEFINITION_START(CHybridLineMap)
  HybridLineMapOptions options;
  MAP_DEFINITION_END(CHybridLineMap)
};

}  // namespace hybrid_slam::mrpt_maps
