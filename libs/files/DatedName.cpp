#include "files/DatedName.h"

#include <ctime>
#include <filesystem>
#include <regex>

namespace hybrid_slam::files {

namespace {

std::string dateStamp() {
  const std::time_t now = std::time(nullptr);
  std::tm local{};
  localtime_r(&now, &local);
  char text[32];
  return {text, std::strftime(text, sizeof text, "%Y-%m-%dT%H-%M-%S", &local)};
}

}  // namespace

std::string claimDatedName(const std::function<bool(const std::string& name)>& claim) {
  const std::string stamp = dateStamp();
  std::string name = stamp;
  for (int number = 2; !claim(name); ++number) name = stamp + "-" + std::to_string(number);
  return name;
}

bool hasDate(const std::string& path) {
  static const std::regex date(R"(.*-\d{4}-\d\d-\d\dT\d\d-\d\d-\d\d(-\d+)?)");
  return std::regex_match(std::filesystem::path(path).stem().string(), date);
}

}  // namespace hybrid_slam::files
