/// @file Options.h
/// @brief Checked options: one description per setting serves loading, range checks, saving and
/// documentation.
#pragma once

#include <mrpt/config/CLoadableOptions.h>

#include <functional>
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace hybrid_slam {

/// One setting of an INI section.
struct Option {
  std::string key;
  std::string unit;   ///< "m", "deg", ...; empty for counts, names and switches
  std::string range;  ///< accepted values: "0..10", "true or false", "a | b"
  std::string why;    ///< one line
  std::function<std::string()> get;
  /// Parses and stores a value; returns an empty text, or what was expected.
  std::function<std::string(const std::string&)> set;
};

/// The settings of an options struct, filled by its `describe`.
class OptionTable {
 public:
  /// A real number in [low, high].
  void add(const std::string& key, double& value, double low, double high, const std::string& unit,
           const std::string& why);
  /// A real number in [low, high], or the word `unset` for no value.
  void add(const std::string& key, std::optional<double>& value, const std::string& unset, double low,
           double high, const std::string& unit, const std::string& why);
  /// An angle: degrees in the file, radians in the member; the range is in degrees.
  void addAngle(const std::string& key, double& radians, double lowDeg, double highDeg,
                const std::string& why);
  /// A whole number in [low, high].
  void add(const std::string& key, int& value, int low, int high, const std::string& why);
  void add(const std::string& key, bool& value, const std::string& why);
  void add(const std::string& key, std::string& value, const std::string& why);
  /// An enumerator by its name.
  template <class Enum>
  void add(const std::string& key, Enum& value, const std::vector<std::pair<Enum, std::string>>& names,
           const std::string& why);

  const std::vector<Option>& options() const { return options_; }

 private:
  void addName(const std::string& key, const std::vector<std::string>& names, std::function<size_t()> get,
               std::function<void(size_t)> set, const std::string& why);
  std::vector<Option> options_;
};

/// Base of every options struct of the project.
struct Options : mrpt::config::CLoadableOptions {
  /// Describes every member: key, bounds, unit, meaning.
  virtual void describe(OptionTable& table) = 0;

  /// Reads the keys present in the section; the others keep their values.
  /// @throws InputError for an unknown key (naming the nearest), a wrong type, a value out of range.
  void loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) final;
  /// Writes every key with its current value.
  void saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& section) const final;

  /// The settings, bound to this object's members.
  std::vector<Option> table() const;
};

/// The closest name by edit distance, for "did you mean"; empty if there are no names.
std::string nearestName(const std::string& name, const std::vector<std::string>& names);
/// Damerau-Levenshtein distance without edits of swapped letters: a swap of neighbours counts as one edit.
size_t editDistance(const std::string& a, const std::string& b);

template <class Enum>
void OptionTable::add(const std::string& key, Enum& value,
                      const std::vector<std::pair<Enum, std::string>>& names, const std::string& why) {
  std::vector<std::string> texts;
  for (const auto& entry : names) texts.push_back(entry.second);
  addName(
      key, texts,
      [&value, names] {
        for (size_t i = 0; i < names.size(); ++i)
          if (names[i].first == value) return i;
        return names.size();
      },
      [&value, names](size_t i) { value = names[i].first; }, why);
}

}  // namespace hybrid_slam
