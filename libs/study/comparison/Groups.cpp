#include "study/comparison/Groups.h"

#include <algorithm>
#include <charconv>
#include <set>
#include <sstream>

#include "base/Errors.h"
#include "base/Options.h"

namespace hybrid_slam::comparison {
namespace {

const std::vector<std::string> kMethods{"hybrid", "general", "linemap", "ortho", "stock"};

void checkMethod(const std::string& method, const std::string& where) {
  if (std::find(kMethods.begin(), kMethods.end(), method) == kMethods.end())
    throw InputError("unknown method `" + method + "`", where,
                     "expected hybrid, general, linemap, ortho or stock");
}

std::string lower(std::string text) {
  for (char& c : text)
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  return text;
}

}  // namespace

void checkSetting(const std::string& setting, const std::string& where) {
  const auto equals = setting.find('='), dot = setting.find('.');
  if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals)
    throw InputError("wrong setting `" + setting + "`", where, "expected SECTION.KEY=VALUE");
  const std::string section = lower(setting.substr(0, dot)), key = lower(setting.substr(0, equals));
  const bool isOfTheRunItself = section == "run" && key != "run.particles_every" && key != "run.refine";
  if (isOfTheRunItself || key == "particle_filter.particles" || key == "particle_filter.seed" ||
      key == "particle_filter.threads")
    throw InputError("setting of `" + setting.substr(0, equals) + "`", where,
                     "expected a key that --methods, --particles and --seeds do not set");
}

Variant parseVariant(const std::string& text) {
  const std::string where = "option --variant";
  const auto wrong = [&] {
    return InputError("wrong variant `" + text + "`", where,
                      "expected [METHOD/]NAME:SECTION.KEY=VALUE[,SECTION.KEY=VALUE...]");
  };
  const auto colon = text.find(':');
  if (colon == std::string::npos) throw wrong();
  Variant variant;
  variant.name = text.substr(0, colon);
  const auto slash = variant.name.find('/');
  if (slash != std::string::npos) {
    variant.method = variant.name.substr(0, slash);
    variant.name.erase(0, slash + 1);
    checkMethod(variant.method, where + " `" + text + "`");
  }
  const auto isWordCharacter = [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == '.' || c == '+';
  };
  constexpr size_t kLongest = 100;  // it is part of a folder's name
  if (variant.name.empty() || variant.name[0] == '.' || variant.name.size() > kLongest ||
      !std::all_of(variant.name.begin(), variant.name.end(), isWordCharacter))
    throw InputError("wrong variant name `" + variant.name + "`", where,
                     "expected at most 100 letters, digits, `_`, `.`, `+`");

  std::istringstream items(text.substr(colon + 1));
  for (std::string item; std::getline(items, item, ',');) {
    if (item.size() > 1 && item[0] == '@' && variant.iniFile.empty()) {
      variant.iniFile = item.substr(1);
      continue;
    }
    checkSetting(item, where + " `" + variant.name + "`");
    variant.settings.push_back(item);
  }
  if (variant.settings.empty() && variant.iniFile.empty()) throw wrong();
  return variant;
}

ParticleCount parseParticleCount(const std::string& text) {
  const std::string where = "option --particles `" + text + "`";
  const auto colon = text.find(':');
  ParticleCount count;
  if (colon != std::string::npos) {
    count.method = text.substr(0, colon);
    checkMethod(count.method, where);
  }
  const char* const number = text.c_str() + (colon == std::string::npos ? 0 : colon + 1);
  const auto [end, error] = std::from_chars(number, text.c_str() + text.size(), count.particles);
  if (error != std::errc() || *end != '\0' || count.particles < 1)
    throw InputError("wrong particle count", where, "expected [METHOD:]N, N 1 or more");
  return count;
}

std::vector<Group> makeGroups(const std::vector<std::string>& methods, const std::vector<Variant>& variants,
                              const std::vector<ParticleCount>& particles) {
  if (methods.empty())
    throw InputError("no method", "option --methods",
                     "expected one or more of hybrid, general, linemap, ortho, stock");
  for (const std::string& method : methods) checkMethod(method, "option --methods");
  const auto isCompared = [&](const std::string& method) {
    return method.empty() || std::find(methods.begin(), methods.end(), method) != methods.end();
  };
  for (const ParticleCount& count : particles)
    if (!isCompared(count.method))
      throw InputError("particle count of the method `" + count.method + "`", "option --particles",
                       "expected one of the compared methods");
  for (const Variant& variant : variants)
    if (!isCompared(variant.method))
      throw InputError("variant `" + variant.name + "` of the method `" + variant.method + "`",
                       "option --variant", "expected one of the compared methods");

  std::vector<Group> groups;
  std::set<std::string> names;
  for (const std::string& method : methods) {
    std::vector<Variant> applying{Variant()};
    for (const Variant& variant : variants)
      if (variant.method.empty() || variant.method == method) applying.push_back(variant);
    std::vector<int> counts;
    for (const ParticleCount& count : particles)
      if (count.method.empty() || count.method == method) counts.push_back(count.particles);
    if (counts.empty())
      throw InputError("no particle count for the method `" + method + "`", "option --particles",
                       "expected N for all methods or " + method + ":N");
    for (const Variant& variant : applying)
      for (const int n : counts) {
        groups.push_back({method, variant, n});
        if (!names.insert(groups.back().name()).second)
          throw InputError("`" + groups.back().name() + "` twice", "command line",
                           "expected different methods, variants and particle counts");
      }
  }
  return groups;
}

std::string runName(const Group& group, int seed) { return group.name() + "-" + std::to_string(seed); }

std::vector<Run> makeRuns(size_t groups, int firstSeed, int seeds) {
  std::vector<Run> runs;
  for (size_t group = 0; group < groups; ++group)
    for (int i = 0; i < seeds; ++i) runs.push_back({group, firstSeed + i});
  return runs;
}

}  // namespace hybrid_slam::comparison
