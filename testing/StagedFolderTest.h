/// @file StagedFolderTest.h
/// @brief For the tests: runs that write three results to a folder.
#pragma once

#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <vector>

#include "files/StagedFolder.h"
#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::files {

inline const std::vector<std::string> kNames{"map", "extra", "metrics"};
constexpr const char* kDate = "[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}-[0-9]{2}-[0-9]{2}";

class StagedFolderTest : public testing::Test {
 protected:
  void write(const StagedFolder& staged, const std::string& content, bool withExtra = false) {
    for (const std::string& name : kNames)
      if (withExtra || name != "extra")
        staged.files().write(name, [&](std::ostream& stream) { stream << content; });
  }
  void run(const std::string& content, bool overwrite = false, bool withExtra = false) {
    StagedFolder staged(out, kNames, overwrite);
    write(staged, content, withExtra);
    staged.publish();
  }
  static std::vector<std::string> namesIn(const std::string& folder) {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
      names.push_back(entry.path().filename().string());
    return names;
  }
  std::string inOut(const std::string& name) const { return test::contentOf(out + "/" + name); }

  TemporaryFolder root;
  std::string out = root.path("out");
};

}  // namespace hybrid_slam::files
