/// @file HybridLineMapOptions.h
/// @brief Settings of the line map for MRPT's programs.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "base/Options.h"
#include "slam/lines/LineAssociation.h"
#include "slam/lines/LineDatabase.h"
#include "slam/lines/LineExtractor.h"
#include "slam/lines/LineWeight.h"

namespace hybrid_slam::mrpt_maps {

/// Section PREFIX_likelihoodOpts.
struct LikelihoodOptions : Options {
  double exponent = 1;

  void describe(OptionTable& table) override;
};

/// The keys of doc/configuration.md, in sections whose names begin with the map's: PREFIX_line_weight, ...
struct HybridLineMapOptions {
  LineExtractionOptions extraction;
  AssociationOptions association;
  LineDatabaseOptions database;
  LineWeightOptions weight;
  LikelihoodOptions likelihood;

  /// Returns (end of the section's name, options) of every part.
  std::vector<std::pair<std::string, Options*>> sections();

  /// @param prefix  prefix of the sections, "MappingApplication_hybridLineMap_00"
  /// @throws InputError for a section of this prefix that is not one of ours, and as
  ///         Options::loadFromConfigFile
  void load(const mrpt::config::CConfigFileBase& source, const std::string& prefix);

  /// Reads or writes the values of all settings as text. Reading checks them like those of an INI file.
  template <class State>
  void visit(State& state) {
    for (const auto& [section, options] : sections())
      for (const Option& option : options->table()) {
        std::string value = option.get();
        state(value);
        if constexpr (State::kIsReading) state.check(option.set(value).empty(), "a setting is impossible");
      }
  }
};

}  // namespace hybrid_slam::mrpt_maps
