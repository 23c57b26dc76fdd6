/// @file Groups.h
/// @brief What is compared: methods x variants x particle counts, each over the same seeds.
#pragma once

#include <string>
#include <vector>

namespace hybrid_slam::comparison {

/// A named set of settings on top of the INI file.
struct Variant {
  std::string name;
  std::string method;                 ///< the only one it is run with; empty: all
  std::string iniFile;                ///< instead of the comparison's own; empty: that one
  std::vector<std::string> settings;  ///< SECTION.KEY=VALUE
};

/// Reads `[METHOD/]NAME:ITEM[,ITEM...]`, an item being SECTION.KEY=VALUE or `@FILE` for another INI file.
/// @throws InputError for another form, a name that no folder can have, and settings of what the comparison
///         itself varies: [run] (but for particles_every), and the particles, seed and threads of
///         [particle_filter]
Variant parseVariant(const std::string& text);
/// The same check for a setting of all runs.
void checkSetting(const std::string& setting, const std::string& where);

/// Runs that differ by nothing but their seed.
struct Group {
  std::string method;
  Variant variant;  ///< without a name: the INI file as it is
  int particles = 0;

  /// "hybrid-eq9": method and variant.
  std::string label() const { return variant.name.empty() ? method : method + "-" + variant.name; }
  /// "hybrid-eq9-20"
  std::string name() const { return label() + "-" + std::to_string(particles); }
};

/// How many particles a method is run with.
struct ParticleCount {
  std::string method;  ///< empty: all
  int particles = 0;
};

/// Reads `[METHOD:]N`. @throws InputError for another form, an unknown method, and a number below 1
ParticleCount parseParticleCount(const std::string& text);

/// Method by method, each plain and then with every variant that applies, each with every particle count that
/// is its.
/// @throws InputError for an unknown or repeated method, a variant of a method that is not compared, two
///         groups of the same name, a particle count of a method that is not compared, and a method without
///         one
std::vector<Group> makeGroups(const std::vector<std::string>& methods, const std::vector<Variant>& variants,
                              const std::vector<ParticleCount>& particles);

struct Run {
  size_t group = 0;
  int seed = 0;
};

/// Every group with every seed, group by group: the order of the tables.
std::vector<Run> makeRuns(size_t groups, int firstSeed, int seeds);

}  // namespace hybrid_slam::comparison
