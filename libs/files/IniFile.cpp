#include "files/IniFile.h"

#include <mrpt/config/config_parser.h>
#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <optional>
#include <set>
#include <sstream>

#include "base/Errors.h"
#include "files/InputFile.h"
#include "files/LineReader.h"

namespace hybrid_slam::files {
namespace {

/// Compares section names as MRPT does, ignoring case.
bool isSame(const std::string& a, const std::string& b) {
  return mrpt::system::lowerCase(a) == mrpt::system::lowerCase(b);
}

bool contains(const std::vector<std::string>& sections, const std::string& name) {
  return std::any_of(sections.begin(), sections.end(),
                     [&name](const auto& known) { return isSame(known, name); });
}

constexpr size_t kLongestIniLine = 10000,
                 kLargestIniFile = 1000000;  // bytes: MRPT's parser is slow on longer ones

void checkLengths(const std::string& text, const std::string& file) {
  if (text.size() > kLargestIniFile)
    throw InputError("too large for an INI file", file,
                     "expected at most " + std::to_string(kLargestIniFile) + " bytes");
  size_t number = 1;
  for (size_t begin = 0, end = 0; end < text.size(); ++number) {
    end = std::min(text.find('\n', end), text.size());
    if (end - begin > kLongestIniLine)
      throw InputError("line too long", file + ", line " + std::to_string(number),
                       "expected at most " + std::to_string(kLongestIniLine) + " characters");
    const bool isContinued = end > begin && text[end - 1] == '\\';  // MRPT joins these lines
    ++end;
    if (!isContinued) begin = end;
  }
}

std::string readText(const std::string& file) {
  const std::string expected = "expected a readable INI file";
  expectFile(file, expected);
  std::ifstream in(file, std::ios::binary);
  std::string text(kLargestIniFile + 1, '\0');
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad() || !in.is_open()) throw InputError("cannot read", file, expected);
  text.resize(static_cast<size_t>(in.gcount()));
  if (text.find('\0') != std::string::npos) throw InputError("not a text file", file, expected);
  checkLengths(text, file);
  return text;
}

/// Rejects macros, also in comments, that MRPT's parser would evaluate without a limit of time or memory.
void checkMacros(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  size_t number = 1, longestDefinition = 0, uses = 0;
  const auto where = [&] { return file + ", line " + std::to_string(number); };
  for (std::string line; std::getline(in, line); ++number) {
    for (const std::string macro : {"$eval{", "$env{"})
      if (line.find(macro) != std::string::npos)
        throw InputError("macro " + macro + "...}", where(),
                         "expected its value; of MRPT's macros, only @define is expanded");
    const size_t definition = line.find("@define");
    if (line.find('$', definition) != std::string::npos && definition != std::string::npos)
      throw InputError("`$` in a definition", where(), "expected its value");
    if (definition != std::string::npos) longestDefinition = std::max(longestDefinition, line.size());
    for (size_t at = line.find("${"); at != std::string::npos; at = line.find("${", at + 1)) ++uses;
    if (uses * longestDefinition > kLargestIniFile)
      throw InputError(
          "definitions too long", where(),
          "expected at most " + std::to_string(kLargestIniFile) + " bytes once they are expanded");
  }
}

bool isComment(const std::string& line) { return line.find_first_of("#;") == 0 || line.rfind("//", 0) == 0; }

/// The text with `\` at the end of comments removed, as in `# C:\logs\`: MRPT's parser would join the next
/// line.
std::string withoutContinuedComments(const std::string& text) {
  std::istringstream in(text);
  std::string result;
  for (std::string line; std::getline(in, line); result += line + '\n')
    if (isComment(mrpt::system::trim(line))) line.erase(line.find_last_not_of("\\\r") + 1);
  return result;
}

/// The text after MRPT's parser has expanded @define and ${...}.
std::string parsed(const std::string& text, const std::string& file) {
  checkMacros(text, file);
  try {
    return mrpt::config::config_parser(withoutContinuedComments(text));
  } catch (const std::exception& e) {
    throw InputError("cannot parse", file, messageOf(e));
  }
}

/// Rejects malformed lines and keys before the first section, which the parser ignores.
/// @return a line for each key that a section has twice. A second section of the same name overrides the
///         first: an INI file may be joined from two.
std::vector<std::string> checkLines(const std::string& text, const std::string& file,
                                    const std::vector<std::string>& sections) {
  std::istringstream in(text);
  std::optional<std::string> section;
  std::set<std::string> keys;  // of the section
  std::vector<std::string> warnings;
  size_t number = 0;
  for (std::string line; std::getline(in, line);) {
    const std::string where = file + ", line " + std::to_string(++number);
    line = mrpt::system::trim(line.substr(0, line.find('\r')));
    removeByteOrderMark(line);
    if (line.empty() || isComment(line)) continue;
    const auto end = line.find(']'), equals = line.find('=');
    if (line.front() == '[' && end != std::string::npos) {
      section = line.substr(1, end - 1);
      keys.clear();
      const std::string rest = mrpt::system::trim(line.substr(end + 1));
      if (contains(sections, *section) && !rest.empty() && rest.find_first_of("#;/") != 0)
        throw InputError("wrong line `" + line + "`", where,
                         "expected nothing but a comment after [section]");
      continue;
    }
    const bool isOurs = section && contains(sections, *section);
    if (!section || (isOurs && (equals == std::string::npos || equals == 0)))
      throw InputError("wrong line `" + line + "`", where, "expected [section], key = value, or # comment");
    if (!isOurs) continue;
    const std::string key = mrpt::system::trim(line.substr(0, equals));
    if (!keys.insert(mrpt::system::lowerCase(key)).second)
      warnings.push_back("repeated key `" + key + "`: " + where + ", section [" + *section +
                         "]; its last value is used");
  }
  return warnings;
}

/// Returns whether another of our programs, a sensor driver or MRPT's rbpf-slam uses a section.
bool isOfOthers(const mrpt::config::CConfigFileBase& source, const std::string& section) {
  for (const char* name : {"live", "server", "PIONEER", "global"})
    if (section == name) return true;
  return source.keyExists(section, "driver") || section.rfind("MappingApplication", 0) == 0;
}

/// Rethrows an error about a section with its origin.
[[noreturn]] void rethrowIn(const std::string& where, const InputError& error) {
  const std::string text = error.what();
  const auto section = text.find(": section ["), end = text.rfind("; ");
  if (section == std::string::npos) throw error;
  throw InputError(text.substr(0, section), where + ", " + text.substr(section + 2, end - section - 2),
                   text.substr(end + 2));
}

void load(const Sections& sections, const mrpt::config::CConfigFileBase& source, const std::string& where) {
  try {
    for (const auto& [name, options] : sections) options->loadFromConfigFile(source, name);
  } catch (const InputError& error) {
    rethrowIn(where, error);
  }
}

}  // namespace

std::vector<std::string> loadIni(mrpt::config::CConfigFileMemory& source, const std::string& file,
                                 const std::vector<std::string>& settings, const Sections& sections,
                                 const std::string& otherwise, const std::string& expected) {
  const std::string text = file.empty() ? "" : parsed(readText(file), file);
  return loadIniText(source, text, file, settings, sections, otherwise, expected);
}

std::vector<std::string> loadIniText(mrpt::config::CConfigFileMemory& source, const std::string& text,
                                     const std::string& file, const std::vector<std::string>& settings,
                                     const Sections& sections, const std::string& otherwise,
                                     const std::string& expected) {
  std::vector<std::string> present, ours;
  for (const auto& [name, options] : sections) ours.push_back(name);
  std::vector<std::string> warnings = checkLines(text, file, ours);
  checkMacros(text, file);
  source.setContent(text);  // expands macros once more
  source.getAllSections(present);

  const auto isOurs = [&ours](const std::string& section) { return contains(ours, section); };
  for (const std::string& section : present) {
    const std::string nearest = nearestName(section, ours);
    if (isOurs(section)) continue;
    const std::string known = "the nearest known section is [" + nearest + "]";
    if (3 * editDistance(section, nearest) <= nearest.size())
      throw InputError("unknown section [" + section + "]", file, known);
    if (!isOfOthers(source, section))
      warnings.push_back("unknown section [" + section + "]: " + file + "; ignored, " + known);
  }
  if (!file.empty() && std::none_of(present.begin(), present.end(), isOurs) &&
      (otherwise.empty() || !source.sectionExists(otherwise)))
    throw InputError("missing section", file, expected);
  load(sections, source, file);
  for (const std::string& setting : settings) {
    if (setting.find_first_of("\r\n") != std::string::npos)  // which config.ini could not hold
      throw InputError("line break in a setting", "command line, setting `" + setting + "`",
                       "expected names and values on one line");
    const auto equals = setting.find('='), dot = setting.find('.');
    if (equals == std::string::npos || dot == std::string::npos || dot == 0 || dot + 1 >= equals)
      throw InputError("wrong setting `" + setting + "`", "command line", "expected SECTION.KEY=VALUE");
    const std::string section = setting.substr(0, dot);
    if (!isOurs(section) && !contains(present, section))
      throw InputError("unknown section [" + section + "]", "command line, setting `" + setting + "`",
                       "the nearest known section is [" + nearestName(section, ours) + "]");
    source.write(section, setting.substr(dot + 1, equals - dot - 1), setting.substr(equals + 1));
    load(sections, source, "command line");
  }
  return warnings;
}

bool isIni(const std::string& path) {
  if (mrpt::system::lowerCase(std::filesystem::path(path).extension().string()) == ".ini") return true;
  if (!isText(path)) return false;
  std::string beginning(1 << 16, '\0');  // a log may be one long line
  std::ifstream file(path, std::ios::binary);
  file.read(beginning.data(), static_cast<std::streamsize>(beginning.size()));
  beginning.resize(static_cast<size_t>(file.gcount()));
  std::istringstream in(beginning);
  for (std::string line; std::getline(in, line);) {
    line = mrpt::system::trim(line.substr(0, line.find('\r')));
    if (line.empty() || line.find_first_of("#;") == 0 || line.rfind("//", 0) == 0) continue;
    return line.front() == '[' && line.find(']') != std::string::npos;
  }
  return false;
}

}  // namespace hybrid_slam::files
