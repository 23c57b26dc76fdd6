#include "study/comparison/RunFolder.h"

#include <sys/stat.h>

#include <algorithm>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <sstream>
#include <string>
#include <vector>

#include "base/Errors.h"
#include "files/Checksum.h"
#include "files/FolderReplacement.h"
#include "run/JsonFile.h"
#include "run/JsonText.h"
#include "run/ResultFiles.h"

namespace hybrid_slam::comparison {
namespace {

namespace fs = std::filesystem;
const char* const kOrigin = "origin.json";
const char* const kError = "error.txt";
const char* const kChecksums = "checksums.json";
const char* const kMessages = "messages.txt";
const char* const kOfReport[] = {"config.ini", "metrics.json", "steps.csv", "trajectory.tum"};
const char* const kLargeFiles[] = {"map.simplemap.gz", "map.pgm", "map.yaml"};

/// All files of a run, the one that marks a finished run last. Others in its folder are the user's.
std::vector<std::string> ownFiles() {
  std::vector<std::string> names = run::kResultFiles;
  names.insert(names.begin(), {kOrigin, kError, kChecksums, kMessages});
  return names;
}

bool isOwn(const std::string& name) {
  static const std::vector<std::string> names = ownFiles();
  return std::find(names.begin(), names.end(), name) != names.end();
}

/// "[section] key" -> value. A config.ini has no other lines.
std::map<std::string, std::string> settingsOf(std::istream& text) {
  std::map<std::string, std::string> settings;
  std::string section;
  for (std::string line; std::getline(text, line);) {
    const auto equals = line.find(" =");
    if (!line.empty() && line[0] == '[')
      section = line;
    else if (equals != std::string::npos)
      settings[section + " " + line.substr(0, equals)] =
          line.size() > equals + 3 ? line.substr(equals + 3) : std::string();
  }
  return settings;
}

[[noreturn]] void differs(const fs::path& folder, const std::string& what) {
  throw InputError("finished run of another comparison", "folder " + folder.string() + ", " + what,
                   "expected the same settings and log, or a different -o");
}

struct Origin {
  uintmax_t logSize;
  int64_t logTime;
  std::string otherSections;
};

/// Reads origin.json; empty if it is broken.
std::optional<Origin> originIn(const fs::path& file) {
  const auto json = run::readJson(file);
  if (!json.is_object()) return std::nullopt;
  const auto member = [&](const char* key) { return json.value(key, nlohmann::json()); };
  const auto size = member("log_size"), time = member("log_time_ns"), sections = member("other_sections");
  if (!size.is_number_unsigned() || !time.is_number_integer() || !sections.is_string()) return std::nullopt;
  return Origin{size.get<uintmax_t>(), time.get<int64_t>(), sections.get<std::string>()};
}

/// Returns the path as it is if it cannot be resolved: an empty one, a loop of links.
std::string canonical(const fs::path& file) {
  std::error_code error;
  const fs::path path = fs::weakly_canonical(fs::absolute(file, error), error);
  return (error ? file : path).string();
}

bool isThere(const fs::path& file) {
  std::error_code none;
  return fs::exists(file, none);
}

/// Opens a small file; opening a pipe would wait for its writer, and a line of gigabytes fill the memory.
std::ifstream opened(const fs::path& file) {
  constexpr uintmax_t kMostBytes = 10'000'000;
  std::error_code none;
  std::ifstream in;
  if (fs::is_regular_file(file, none) && fs::file_size(file, none) <= kMostBytes)
    in.open(file);
  else
    in.setstate(std::ios::failbit);
  return in;
}

/// Returns whether a file has the recorded size and checksum. The size is compared first: damage may make a
/// small file terabytes long, or name a device. In folders of earlier builds the record is the checksum
/// alone.
bool isIntact(const fs::path& file, const nlohmann::json& record) {
  std::error_code missing;
  const auto sum = record.is_object() ? record.value("crc32", nlohmann::json()) : record;
  if (!sum.is_number_unsigned() || !fs::is_regular_file(file, missing)) return false;
  if (record.is_object() && record.value("bytes", nlohmann::json()) != fs::file_size(file, missing))
    return false;
  return files::checksumOf(file.string()) == sum.get<uint32_t>();
}

}  // namespace

void noteLog(RunIdentity& identity, const std::string& log) {
  struct stat status {};
  if (stat(log.c_str(), &status) != 0) throw InputError("no such file", log, "expected a rawlog");
  identity.log = canonical(log);
  identity.logSize = static_cast<uintmax_t>(status.st_size);
  identity.logTime = static_cast<int64_t>(status.st_mtim.tv_sec) * 1000000000 + status.st_mtim.tv_nsec;
}

void expectLog(const fs::path& runs, const RunIdentity& identity) {
  std::error_code none;  // no runs yet
  for (const auto& entry : fs::directory_iterator(runs, none)) {
    const std::string name = entry.path().filename().string();
    std::ifstream config = opened(entry.path() / "config.ini");
    const bool isUsable = config && name[0] != '.' && RunFolder(runs, name).damage().empty();
    if (!isUsable) continue;  // failed, unfinished or damaged
    const std::string log = settingsOf(config)["[run] rawlog"];
    if (canonical(log) != identity.log) differs(entry.path(), "log " + log + ", now " + identity.log);
  }
}

void RunFolder::expect(const RunIdentity& identity) const {
  std::ifstream config = opened(file("config.ini"));
  std::istringstream expectedConfig(identity.configuration);
  auto found = settingsOf(config), expected = settingsOf(expectedConfig);
  if (canonical(found["[run] rawlog"]) != identity.log)
    differs(folder_, "log " + found["[run] rawlog"] + ", now " + identity.log);
  for (const char* place : {"[run] rawlog", "[run] output"}) found.erase(place), expected.erase(place);
  for (const auto& [key, value] : expected)
    if (found.count(key) == 0 || found[key] != value)
      differs(folder_, "config.ini: " + key + " = " + (found.count(key) ? found[key] : "(nothing)") +
                           ", now " + value);
  for (const auto& [key, value] : found)
    if (expected.count(key) == 0)
      differs(folder_, "config.ini: " + key + " = " + value + ", now no such key");

  if (!isThere(file(kOrigin))) return;
  const auto origin = originIn(file(kOrigin));
  if (!origin) differs(folder_, std::string(kOrigin) + " is broken");
  if (origin->otherSections != nlohmann::json::parse(run::jsonText(identity.otherSections)))
    differs(folder_, "MRPT's sections of the INI file have changed");
  if (origin->logSize != identity.logSize || origin->logTime != identity.logTime)
    differs(folder_, "the log " + identity.log + " has changed since");
}

fs::path RunFolder::messages() const { return partial_ / kMessages; }

void RunFolder::begin(const RunIdentity& identity) const {
  fs::remove_all(partial_);
  fs::create_directories(partial_);
  const nlohmann::ordered_json origin{{"log_size", identity.logSize},
                                      {"log_time_ns", identity.logTime},
                                      {"other_sections", identity.otherSections}};
  std::ofstream out(partial_ / kOrigin);
  out << run::jsonText(origin);
  if (!out.flush()) throw std::runtime_error("cannot write: " + partial_.string() + "; is the disk full?");
}

void RunFolder::finish() const {
  if (!isThere(partial_ / run::kResultFiles.back()))
    throw InputError("results moved or removed", partial_.string(),
                     "expected that the folder of the runs stays where it is");
  std::error_code error;
  if (fs::is_empty(partial_ / kMessages, error)) fs::remove(partial_ / kMessages, error);
  for (const char* name : kLargeFiles) fs::remove(partial_ / name);
  nlohmann::ordered_json checksums;
  for (const auto& entry : fs::directory_iterator(partial_))
    if (const auto sum = files::checksumOf(entry.path().string()))
      checksums[entry.path().filename().string()] = {{"bytes", entry.file_size()}, {"crc32", *sum}};
  std::ofstream out(partial_ / kChecksums);
  out << run::jsonText(checksums);
  out.close();
  if (!out) throw std::runtime_error("cannot write: " + partial_.string() + "; is the disk full?");
  std::error_code isTaken;
  fs::rename(partial_, folder_, isTaken);
  if (!isTaken) return;
  const std::vector<std::string> names = ownFiles();
  const files::FolderReplacement replacement(partial_, folder_, names);
  if (replacement.exchange())
    replacement.removeHidden();
  else
    replacement.moveOneByOne();
}

void RunFolder::discard() const {
  const std::vector<std::string> names = ownFiles();
  for (auto name = names.rbegin(); name != names.rend(); ++name) {
    std::error_code error;
    fs::remove(file(*name), error);
    if (error)
      throw InputError("cannot remove", file(*name).string(),
                       "expected a file in a writable folder: " + error.message());
  }
  std::error_code hasOthers;
  fs::remove(folder_, hasOthers);
}

std::string RunFolder::damage() const {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder_, none))
    if (const std::string name = entry.path().filename().string();
        isOwn(name) && !entry.is_regular_file(none) && !entry.is_directory(none))
      return name;
  if (isThere(file(kOrigin)) && !originIn(file(kOrigin))) return kOrigin;
  if (!isThere(file(kChecksums))) return isThere(file(kOrigin)) ? kChecksums : "";
  const auto checksums = run::readJson(file(kChecksums));
  if (!checksums.is_object()) return kChecksums;
  for (const char* name : kOfReport)
    if (isThere(file(name)) && !checksums.contains(name)) return kChecksums;
  for (const auto& [name, record] : checksums.items())
    if (!isIntact(file(name), record)) return name;
  return {};
}

void RunFolder::fail(const std::string& error) const {
  discard();
  abandon();
  fs::create_directories(folder_);
  std::ofstream(file(kError)) << error << '\n';
}

void RunFolder::abandon() const {
  std::error_code ignored;
  fs::remove_all(partial_, ignored);
  // Where a killed hybrid-slam staged its results.
  const std::string staged = "." + partial_.filename().string() + ".part-";
  for (const auto& entry : fs::directory_iterator(partial_.parent_path(), ignored))
    if (entry.path().filename().string().rfind(staged, 0) == 0) fs::remove_all(entry.path(), ignored);
}

std::string RunFolder::error() const {
  std::ifstream in = opened(file(kError));
  std::string line;
  std::getline(in, line);
  return line;
}

void RunFolder::dropLargeFiles() const {
  for (const char* name : kLargeFiles) fs::remove(file(name));
}

}  // namespace hybrid_slam::comparison
