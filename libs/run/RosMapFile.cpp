#include "run/RosMapFile.h"

#include <yaml-cpp/yaml.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <optional>

#include "base/Errors.h"
#include "base/Numbers.h"

namespace hybrid_slam::run {
namespace {

constexpr const char* kYamlExpected = "expected the map.yaml of ROS's map_server or a grid map of MRPT";

std::string textOf(const std::string& file) {
  constexpr size_t kMost = 1 << 16;
  std::string text(kMost, '\0');
  std::ifstream in(file, std::ios::binary);
  in.read(text.data(), kMost);
  if (in) throw InputError("not a map", file, kYamlExpected);
  text.resize(static_cast<size_t>(in.gcount()));
  return text;
}

/// Reads the keys of a map.yaml.
class MapKeys {
 public:
  explicit MapKeys(const std::string& file) : file_(file) {
    try {
      root_ = YAML::Load(textOf(file));
    } catch (const YAML::Exception& e) {
      const std::string line = e.mark.is_null() ? "" : ", line " + std::to_string(e.mark.line + 1);
      throw InputError("not a map (" + e.msg + ")", file + line, kYamlExpected);
    }
    if (!root_.IsMap() || !root_["image"]) throw InputError("not a map", file, kYamlExpected);
  }

  std::string text(const char* key, const char* expected) const {
    const YAML::Node node = root_[key];
    if (!node) throw InputError("missing key `" + std::string(key) + "`", file_, expected);
    if (!node.IsScalar() || node.Scalar().empty()) refuse(key, expected);
    return node.Scalar();
  }
  double number(const char* key, double least, double most, const char* expected) const {
    return inRange(key, text(key, expected), least, most, expected);
  }
  bool flag(const char* key) const {
    constexpr const char* kFlag = "expected 0 or 1";
    const std::string value = text(key, kFlag);
    if (value == "0" || value == "false") return false;
    if (value != "1" && value != "true") refuse(key, kFlag);
    return true;
  }
  std::array<double, 3> pose(const char* key, double farthest) const {
    constexpr const char* kPose = "expected [x, y, yaw], m and rad, within 2^20 cells of (0, 0)";
    const YAML::Node node = root_[key];
    if (!node) throw InputError("missing key `" + std::string(key) + "`", file_, kPose);
    if (!node.IsSequence() || node.size() != 3) refuse(key, kPose);
    std::array<double, 3> pose{};
    for (size_t i = 0; i < 3; ++i) {
      if (!node[i].IsScalar()) refuse(key, kPose);
      pose[i] = inRange(key, node[i].Scalar(), -farthest, farthest, kPose);
    }
    return pose;
  }
  bool has(const char* key) const { return root_[key].IsDefined(); }
  [[noreturn]] void refuse(const char* key, const char* expected) const {
    throw InputError("wrong value of `" + std::string(key) + "`", file_, expected);
  }

 private:
  double inRange(const char* key, const std::string& value, double least, double most,
                 const char* expected) const {
    const std::optional<double> number = parseFinite(value);
    if (!number || *number < least || *number > most) refuse(key, expected);
    return *number;
  }

  std::string file_;
  YAML::Node root_;
};

RosMapMode modeOf(const MapKeys& keys) {
  constexpr const char* kModes = "expected trinary, scale or raw";
  if (!keys.has("mode")) return RosMapMode::trinary;
  const std::string mode = keys.text("mode", kModes);
  if (mode == "trinary") return RosMapMode::trinary;
  if (mode == "scale") return RosMapMode::scale;
  if (mode != "raw") keys.refuse("mode", kModes);
  return RosMapMode::raw;
}

}  // namespace

RosMapFile readRosMapFile(const std::string& file) {
  constexpr double kFarthestCell = 1 << 20;
  constexpr const char* kThreshold = "expected 0 <= free_thresh <= occupied_thresh <= 1";
  const MapKeys keys(file);
  RosMapFile map{};
  const std::filesystem::path picture = keys.text("image", "expected the name of a PGM or PNG file");
  map.picture = (std::filesystem::path(file).parent_path() / picture).string();
  map.resolution = keys.number("resolution", 0.001, 10, "expected 0.001 .. 10 m per cell");
  const auto [x, y, yaw] = keys.pose("origin", kFarthestCell * map.resolution);
  if (yaw != 0) throw InputError("rotated map", file + ", key `origin`", "expected a yaw of 0");
  map.x = x, map.y = y;
  map.isNegated = keys.flag("negate");
  map.occupiedAbove = keys.number("occupied_thresh", 0, 1, kThreshold);
  map.freeBelow = keys.number("free_thresh", 0, map.occupiedAbove, kThreshold);
  map.mode = modeOf(keys);
  return map;
}

}  // namespace hybrid_slam::run
