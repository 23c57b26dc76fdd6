#include "bags/RecordingFolder.h"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <exception>
#include <filesystem>
#include <utility>

#include "bags/ByteCursor.h"
#include "base/Errors.h"

namespace hybrid_slam::bags {
namespace {

namespace fs = std::filesystem;

bool isOfRecording(fs::path path) {
  if (path.extension() == ".zstd") path.replace_extension();
  return path.extension() == ".db3" || path.extension() == ".mcap";
}

std::string plainName(const fs::path& file) {
  return (file.extension() == ".zstd" ? file.stem() : file.filename()).string();
}

/// Splits the name of a file at its last number: `drive_`, `2` for `drive_2.db3`. Without a number, all of it
/// is the first part.
std::pair<std::string, std::string> splitAtNumber(const std::string& file) {
  const std::string name = fs::path(plainName(file)).stem().string();
  const size_t end = name.find_last_of("0123456789");
  if (end == std::string::npos) return {name, ""};
  const size_t begin = name.find_last_not_of("0123456789", end) + 1;
  return {name.substr(0, begin), name.substr(begin, end + 1 - begin)};
}

/// Compares names by their last numbers: `drive_2.db3` comes before `drive_10.db3`.
bool comesBefore(const std::string& a, const std::string& b) {
  const auto numberAt = [](const std::string& file) {
    const std::string digits = splitAtNumber(file).second;
    return std::string(20 - std::min<size_t>(digits.size(), 20), '0') + digits;
  };
  const std::string nameA = fs::path(a).filename().string(), nameB = fs::path(b).filename().string();
  return std::make_pair(numberAt(nameA), nameA) < std::make_pair(numberAt(nameB), nameB);
}

/// Returns the names of the files that metadata.yaml lists, without .zstd; none without metadata.
std::vector<std::string> listedFiles(const std::string& folder) try {
  std::vector<std::string> names;
  constexpr uintmax_t kMostBytes = 1'000'000;
  const fs::path metadata = fs::path(folder) / "metadata.yaml";
  if (!fs::is_regular_file(metadata) || fs::file_size(metadata) > kMostBytes) return {};
  for (const YAML::Node& listed :
       YAML::LoadFile(metadata.string())["rosbag2_bagfile_information"]["relative_file_paths"])
    names.push_back(plainName(listed.as<std::string>()));
  return names;
} catch (const std::exception&) {  // metadata are not needed to read a recording
  return {};
}

}  // namespace

std::vector<std::string> filesOfRecording(const std::string& folder) {
  std::vector<std::string> found;
  std::error_code ignored;
  for (const auto& entry : fs::directory_iterator(folder, ignored))
    if (isOfRecording(entry.path()) && entry.is_regular_file(ignored)) found.push_back(entry.path().string());
  std::sort(found.begin(), found.end(), comesBefore);
  // A file may be there twice, compressed and decompressed: `a.db3` and then `a.db3.zstd`.
  found.erase(std::unique(found.begin(), found.end(),
                          [](const auto& a, const auto& b) { return plainName(a) == plainName(b); }),
              found.end());
  const std::vector<std::string> listed = listedFiles(folder);
  const auto isOther = [&](const auto& file) {
    return std::find(listed.begin(), listed.end(), plainName(file)) == listed.end();
  };
  if (!std::all_of(found.begin(), found.end(), isOther))
    found.erase(std::remove_if(found.begin(), found.end(), isOther), found.end());
  return found;
}

RecordingFolder::RecordingFolder(const std::string& path) : files_(filesOfRecording(path)) {
  if (files_.empty()) throw InputError("not a recording", path, "expected a folder with files .db3 or .mcap");
  const std::vector<std::string> listed = listedFiles(path);
  const std::string first = fs::path(files_.front()).filename().string();
  for (const std::string& file : files_)
    if (listed.empty() && splitAtNumber(file).first != splitAtNumber(files_.front()).first)
      throw InputError("several recordings in one folder", path,
                       "expected the files of one; it has `" + printable(first) + "` and `" +
                           printable(fs::path(file).filename().string()) + "`");
  for (const std::string& name : listed)
    if (missing_.empty() &&
        std::none_of(files_.begin(), files_.end(), [&](const auto& file) { return plainName(file) == name; }))
      missing_ = name;
  std::reverse(files_.begin(), files_.end());
}

std::optional<StoredMessage> RecordingFolder::next() {
  try {
    while (defect_.empty() && (current_ || !files_.empty())) {
      if (!current_) {
        current_ = openBag(files_.back());
        files_.pop_back();
      }
      if (auto message = current_->next()) {
        message->topic = indexOf(current_->topics()[message->topic]);
        return message;
      }
      for (const Topic& topic : current_->topics()) indexOf(topic);
      defect_ = current_->defect();
      current_.reset();
    }
  } catch (const BrokenBytes& broken) {
    defect_ = broken.what();
  } catch (const InputError&) {  // the last file of a recording that was killed may be empty
    if (topics_.empty()) throw;
    const std::string name = fs::path(files_.back()).filename().string();
    defect_ = "ends before " + printable(name) + ", which cannot be read";
  }
  if (defect_.empty() && !missing_.empty())
    defect_ = "lacks " + printable(missing_) + ", which its metadata.yaml lists";
  return std::nullopt;
}

size_t RecordingFolder::indexOf(const Topic& topic) {
  return topicOf(topic.name, topic.type, topic.encoding);
}

}  // namespace hybrid_slam::bags
