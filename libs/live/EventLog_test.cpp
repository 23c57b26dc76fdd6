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

TEST(EventLog, SubjectsAndEventsFromTheNetworkCannotActOnTheTerminal) {
  std::string written;
  EventLog("program", [&](const std::string& line) {
    written = line;
  }).report("laser `\x1b[2J`", "used\nprogram: filter: forged");
  EXPECT_EQ(written, R"(program: laser `\x1b[2J`: used program: filter: forged)");
}

TEST(EventLog, ForgetsTheEventsOfManySubjects) {
  size_t lines = 0;
  EventLog log("program", [&](const std::string&) { ++lines; });
  for (int i = 0; i < 999; ++i) log.report("client " + std::to_string(i), "connected");
  log.report("client 0", "connected");
  EXPECT_EQ(lines, 999u);
  log.report("client 999", "connected");
  log.report("client 1000", "connected");
  log.report("client 0", "connected");
  EXPECT_EQ(lines, 1002u) << "memory is bounded";
}

}  // namespace
}  // namespace hybrid_slam::live
