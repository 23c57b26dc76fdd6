#include "live/EventLog.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <vector>

namespace hybrid_slam::live {
namespace {

TEST(EventLog, ReportsAStateOnceUntilItChanges) {
  std::vector<std::string> lines;
  EventLog log("program", [&lines](const std::string& line) { lines.push_back(line); });
  for (int i = 0; i < 3; ++i) log.report("server", "refused");
  log.report("laser", "refused");
  log.report("server", "connected");
  log.report("server", "refused");
  EXPECT_THAT(lines, testing::ElementsAre("program: server: refused", "program: laser: refused",
                                          "program: server: connected", "program: server: refused"));
}

}  // namespace
}  // namespace hybrid_slam::live
