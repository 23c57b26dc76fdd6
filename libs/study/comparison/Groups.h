/// @file Groups.h
/// @brief The compared groups: methods x variants x particle counts, each over the same seeds.
#pragma once

#include <string>
#include <vector>

namespace hybrid_slam::comparison {

/// A named set of settings on top of the INI file.
struct Variant {
  std::string name;
  std::string method;                 ///< only for this method; empty: all
  std::string iniFile;                ///< replaces the comparison's INI file; empty: no change
  std::vector<std::string> settings;  ///< SECTION.KEY=VALUE
};

/// Parses `[METHOD/]NAME:ITEM[,ITEM...]`, an item being SECTION.KEY=VALUE or `@FILE` for another INI file.
/// @throws InputError for a wrong format, a name unusable for a folder, and settings controlled by the
///         comparison: [run] (except particles_every and refine), and particles, seed and threads of
///         [particle_filter]
Variant parseVariant(const std::string& text);
/// The same check for a setting common to all runs.
void checkSetting(const std::string& setting, const std::string& where);

/// Runs that differ only in their seed.
struct Group {
  std::string method;
  Variant variant;  ///< without a name: the plain INI file
  int particles = 0;

  /// Returns method and variant: "hybrid-eq9".
  std::string label() const { return variant.name.empty() ? method : method + "-" + variant.name; }
  /// Returns "hybrid-eq9-20".
  std::string name() const { return label() + "-" + std::to_string(particles); }
};

/// Number of particles for a method.
struct ParticleCount {
  std::string method;  ///< empty: all
  int particles = 0;
};

/// Parses `[METHOD:]N`. @throws InputError for a wrong format, an unknown method, and a number below 1
ParticleCount parseParticleCount(const std::string& text);

/// Method by method: plain, then with each applicable variant, each with every particle count of the method.
/// @throws InputError for an unknown or repeated method, a variant or particle count of a method not
///         compared, two groups with the same name, and a method without a particle count
std::vector<Group> makeGroups(const std::vector<std::string>& methods, const std::vector<Variant>& variants,
                              const std::vector<ParticleCount>& particles);

/// One run of a group.
struct Run {
  size_t group = 0;
  int seed = 0;
};

/// The name of a run's folder: "hybrid-eq9-20-3".
std::string runName(const Group& group, int seed);

/// Every group with every seed, group by group (table order).
std::vector<Run> makeRuns(size_t groups, int firstSeed, int seeds);

}  // namespace hybrid_slam::comparison
