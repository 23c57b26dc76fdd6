#include "run/JsonFile.h"

#include <fstream>

namespace hybrid_slam::run {
namespace {

constexpr int kMostLevels = 10;  // deeper ones overflow the stack where they are copied
constexpr uintmax_t kMostBytes = 1'000'000;

struct TooDeep : std::exception {};

}  // namespace

nlohmann::json readJson(const std::filesystem::path& file) {
  std::error_code unreadable;
  const uintmax_t size = std::filesystem::file_size(file, unreadable);  // an error for all but regular files
  if (unreadable || size > kMostBytes) return nlohmann::json::value_t::discarded;
  const auto expectFewLevels = [](int depth, nlohmann::json::parse_event_t, nlohmann::json&) {
    if (depth > kMostLevels) throw TooDeep();
    return true;
  };
  std::ifstream in(file);
  try {
    return nlohmann::json::parse(in, expectFewLevels, false);
  } catch (const TooDeep&) {
    return nlohmann::json::value_t::discarded;
  }
}

}  // namespace hybrid_slam::run
