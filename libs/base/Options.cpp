#include "base/Options.h"

#include <mrpt/config/CConfigFileBase.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/Degree.h"
#include "base/Errors.h"
#include "base/Numbers.h"

namespace hybrid_slam {
namespace {

std::string rangeText(double low, double high) { return numberText(low) + ".." + numberText(high); }

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t\r\"");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r\"") - first + 1);
}

}  // namespace

void OptionTable::add(const std::string& key, double& value, double low, double high, const std::string& unit,
                      const std::string& why) {
  const std::string expected =
      "expected a number in " + rangeText(low, high) + (unit.empty() ? "" : " ") + unit;
  options_.push_back({key, unit, rangeText(low, high), why, [&value] { return numberText(value); },
                      [&value, low, high, expected](const std::string& text) -> std::string {
                        const auto number = parseFinite(text);
                        if (!number || *number < low || *number > high) return expected;
                        value = *number;
                        return {};
                      }});
}

void OptionTable::add(const std::string& key, std::optional<double>& value, const std::string& unset,
                      double low, double high, const std::string& unit, const std::string& why) {
  const std::string expected = "expected " + unset + " or a number in " + rangeText(low, high) + " " + unit;
  options_.push_back({key, unit, unset + " or " + rangeText(low, high), why,
                      [&value, unset] { return value ? numberText(*value) : unset; },
                      [&value, unset, low, high, expected](const std::string& text) -> std::string {
                        const auto number = parseFinite(text);
                        if (text != unset && (!number || *number < low || *number > high)) return expected;
                        value = text == unset ? std::nullopt : number;
                        return {};
                      }});
}

void OptionTable::addAngle(const std::string& key, double& radians, double lowDeg, double highDeg,
                           const std::string& why) {
  const std::string expected = "expected a number in " + rangeText(lowDeg, highDeg) + " deg";
  options_.push_back({key, "deg", rangeText(lowDeg, highDeg), why,
                      // Rounded to 1e-9 deg, so that 0.5 deg reads back as 0.5.
                      [&radians] { return numberText(std::round(radians / kDegree * 1e9) / 1e9); },
                      [&radians, lowDeg, highDeg, expected](const std::string& text) -> std::string {
                        const auto number = parseFinite(text);
                        if (!number || *number < lowDeg || *number > highDeg) return expected;
                        radians = *number * kDegree;
                        return {};
                      }});
}

void OptionTable::add(const std::string& key, int& value, int low, int high, const std::string& why) {
  const std::string expected = "expected a whole number in " + rangeText(low, high);
  options_.push_back({key, "", rangeText(low, high), why, [&value] { return std::to_string(value); },
                      [&value, low, high, expected](const std::string& text) -> std::string {
                        const auto number = parseFinite(text);
                        if (!number || *number != std::floor(*number) || *number < low || *number > high)
                          return expected;
                        value = static_cast<int>(*number);
                        return {};
                      }});
}

void OptionTable::add(const std::string& key, bool& value, const std::string& why) {
  options_.push_back({key, "", "true or false", why, [&value] { return value ? "true" : "false"; },
                      [&value](const std::string& text) -> std::string {
                        if (text != "true" && text != "false") return "expected true or false";
                        value = text == "true";
                        return {};
                      }});
}

void OptionTable::add(const std::string& key, std::string& value, const std::string& why) {
  options_.push_back({key, "", "text", why, [&value] { return value; },
                      [&value](const std::string& text) -> std::string {
                        value = text;
                        return {};
                      }});
}

void OptionTable::addName(const std::string& key, const std::vector<std::string>& names,
                          std::function<size_t()> get, std::function<void(size_t)> set,
                          const std::string& why) {
  const std::string list =
      std::accumulate(names.begin() + 1, names.end(), names.front(),
                      [](const std::string& all, const std::string& name) { return all + " | " + name; });
  options_.push_back({key, "", list, why, [names, get = std::move(get)] { return names.at(get()); },
                      [names, set = std::move(set), list](const std::string& text) -> std::string {
                        const auto found = std::find(names.begin(), names.end(), text);
                        if (found == names.end()) return "expected one of " + list;
                        set(static_cast<size_t>(found - names.begin()));
                        return {};
                      }});
}

std::vector<Option> Options::table() const {
  OptionTable table;
  const_cast<Options*>(this)->describe(table);  // binds the members, reads only
  return table.options();
}

void Options::loadFromConfigFile(const mrpt::config::CConfigFileBase& source, const std::string& section) {
  const std::vector<Option> known = table();
  std::vector<std::string> names;
  for (const Option& option : known) names.push_back(option.key);

  std::vector<std::string> keys;
  source.getAllKeys(section, keys);
  for (const std::string& key : keys) {
    const std::string where = "section [" + section + "], key `" + key + "`";
    const auto option =
        std::find_if(known.begin(), known.end(), [&key](const Option& o) { return o.key == key; });
    if (option == known.end())
      throw InputError("unknown key", where, "the nearest known key is `" + nearestName(key, names) + "`");
    const std::string text = trimmed(source.read_string(section, key, ""));
    const std::string expected = option->set(text);
    if (!expected.empty()) throw InputError("wrong value `" + text + "`", where, expected);
  }
}

void Options::saveToConfigFile(mrpt::config::CConfigFileBase& target, const std::string& section) const {
  for (const Option& option : table()) target.write(section, option.key, option.get());
}

size_t editDistance(const std::string& a, const std::string& b) {
  std::vector<size_t> beforeLast, last(b.size() + 1), row(b.size() + 1);
  std::iota(row.begin(), row.end(), size_t{0});
  for (size_t i = 1; i <= a.size(); ++i) {
    beforeLast = std::exchange(last, row);
    row[0] = i;
    for (size_t j = 1; j <= b.size(); ++j) {
      const size_t substituted = last[j - 1] + (a[i - 1] == b[j - 1] ? 0 : 1);
      row[j] = std::min({last[j] + 1, row[j - 1] + 1, substituted});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1])
        row[j] = std::min(row[j], beforeLast[j - 2] + 1);
    }
  }
  return row.back();
}

std::string nearestName(const std::string& name, const std::vector<std::string>& names) {
  // The share is that of the longer length, so that a name is nearer to one that it begins than to another
  // short one.
  const auto share = [&name](const std::string& other) {
    return static_cast<double>(editDistance(name, other)) /
           static_cast<double>(std::max({name.size(), other.size(), size_t{1}}));
  };
  const auto nearest =
      std::min_element(names.begin(), names.end(),
                       [&](const std::string& a, const std::string& b) { return share(a) < share(b); });
  return nearest == names.end() ? std::string() : *nearest;
}

}  // namespace hybrid_slam
