#include "files/OutputFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <stdexcept>

#include "files/TemporaryFolder.h"
#include "testing/CommaLocale.h"
#include "testing/ErrorOf.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::files {
namespace {

namespace fs = std::filesystem;
using test::errorOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::UnorderedElementsAre;

std::vector<std::string> namesIn(const std::string& folder) {
  std::vector<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder)) names.push_back(entry.path().filename().string());
  return names;
}

TEST(OutputFolder, IsCreatedEmptyWithItsParents) {
  const TemporaryFolder root;
  const OutputFolder folder(root.path("a/b/c"));
  EXPECT_THAT(namesIn(root.path("a/b/c")), IsEmpty());
  folder.write("x.csv", [](std::ostream& out) { out << "1,2\n"; });
  EXPECT_EQ(test::contentOf(root.path("a/b/c/x.csv")), "1,2\n");
  EXPECT_THAT(namesIn(root.path("a/b/c")), UnorderedElementsAre("x.csv"));
}

TEST(OutputFolder, AnExceptionLeavesTheOldFileAndNothingElse) {
  const TemporaryFolder root;
  const OutputFolder folder(root.path("out"));
  folder.write("x", [](std::ostream& out) { out << "old"; });
  EXPECT_THROW(folder.write("x",
                            [](std::ostream& out) {
                              out << "half of it";
                              throw std::runtime_error("stop");
                            }),
               std::runtime_error);
  EXPECT_EQ(test::contentOf(folder.path("x")), "old");
  EXPECT_THAT(namesIn(root.path("out")), UnorderedElementsAre("x"));
}

TEST(OutputFolder, AStreamThatFailedIsAnError) {
  const TemporaryFolder root;
  const OutputFolder folder(root.path("out"));
  EXPECT_THAT(errorOf([&] { folder.write("x", [](std::ostream& out) { out.setstate(std::ios::badbit); }); }),
              HasSubstr("cannot write: " + folder.path("x") + "; expected"));
  EXPECT_THAT(namesIn(root.path("out")), IsEmpty());
}

TEST(OutputFolder, AFileOrDeviceOfThatNameIsAnError) {
  const TemporaryFolder root;
  const std::string file = root.write("file", "content");
  EXPECT_THAT(errorOf([&] { OutputFolder{file}; }), HasSubstr(file));
  EXPECT_THAT(errorOf([&] { OutputFolder{file + "/below"}; }), HasSubstr("cannot be created"));
  EXPECT_THAT(errorOf([&] { OutputFolder{"/dev/null"}; }), HasSubstr("/dev/null"));
  EXPECT_EQ(test::contentOf(file), "content");
}

TEST(OutputFolder, AFolderWithTheNameOfAResultIsAnError) {
  const TemporaryFolder root;
  const OutputFolder folder(root.path("out"));
  fs::create_directory(folder.path("x"));
  EXPECT_THAT(errorOf([&] { folder.write("x", [](std::ostream&) {}); }), HasSubstr("expected a file name"));
  EXPECT_THAT(namesIn(root.path("out")), UnorderedElementsAre("x"));
}

TEST(OutputFolder, AFolderInItMayHaveAnyName) {
  const TemporaryFolder root;
  for (const char* name : {"probe", ".partial.probe"}) fs::create_directories(root.path("out") + "/" + name);
  EXPECT_NO_THROW(OutputFolder{root.path("out")});
  EXPECT_THAT(namesIn(root.path("out")), UnorderedElementsAre("probe", ".partial.probe"));
}

TEST(OutputFolderAsUser, NotWritable) {
  const TemporaryFolder root;
  fs::create_directory(root.path("out"));
  fs::permissions(root.path("out"), fs::perms::owner_read | fs::perms::owner_exec);
  if (access(root.path("out").c_str(), W_OK) == 0) GTEST_SKIP() << "run as root, who can write everywhere";
  EXPECT_THAT(errorOf([&] { OutputFolder{root.path("out")}; }), HasSubstr("not writable"));
}

TEST(GrowingFile, WritesNumbersTheSameInEveryLocale) {
  const test::CommaLocale german;
  const TemporaryFolder root;
  GrowingFile file(root.path("steps.csv"));
  file.stream() << 1234 << ' ' << 0.5;
  file.finish();
  EXPECT_EQ(test::contentOf(root.path("steps.csv")), "1234 0.5");
}

TEST(GrowingFile, GetsItsNameWhenFinished) {
  const TemporaryFolder root;
  {
    GrowingFile file(root.path("steps.csv"));
    file.stream() << "row\n";
  }
  EXPECT_FALSE(fs::exists(root.path("steps.csv")));
  EXPECT_FALSE(fs::exists(root.path(".partial.steps.csv")));
  GrowingFile file(root.path("steps.csv"));
  file.stream() << "row\n";
  EXPECT_TRUE(fs::exists(root.path(".partial.steps.csv")));
  file.finish();
  EXPECT_FALSE(fs::exists(root.path(".partial.steps.csv")));
  EXPECT_EQ(test::contentOf(root.path("steps.csv")), "row\n");
}

TEST(GrowingFile, TwoWritersOfOneNameDoNotMixTheirRows) {
  const TemporaryFolder root;
  const std::string path = root.path("steps.csv");
  {
    GrowingFile first(path), second(path), unfinished(path);
    first.stream() << "first\n" << std::flush;
    second.stream() << "2\n" << std::flush;
    second.finish();
    EXPECT_EQ(test::contentOf(path), "2\n");
    GrowingFile third(path);  // its name is free again
    third.stream() << "third" << std::flush;
    first.stream() << "end\n";
    first.finish();
    EXPECT_EQ(test::contentOf(path), "first\nend\n");
    third.finish();
    EXPECT_EQ(test::contentOf(path), "third");
  }
  EXPECT_THAT(namesIn(root.path("")), UnorderedElementsAre("steps.csv"));
}

TEST(GrowingFile, WhatAKilledWriterHasLeftStays) {
  const TemporaryFolder root;
  root.write(".partial.steps.csv", "rows of a killed run\n");
  GrowingFile file(root.path("steps.csv"));
  file.stream() << "row\n";
  file.finish();
  EXPECT_EQ(test::contentOf(root.path("steps.csv")), "row\n");
  EXPECT_THAT(namesIn(root.path("")), UnorderedElementsAre("steps.csv", ".partial.steps.csv"));
  EXPECT_EQ(test::contentOf(root.path(".partial.steps.csv")), "rows of a killed run\n");
  {
    const PartialFile running(root.path("map"));
    PartialFile::removeLeft(root.path("map"));
    EXPECT_TRUE(fs::exists(root.path(".partial.map")));
  }
  root.write(".partial-2.steps.csv", "rows of another\n");
  PartialFile::removeLeft(root.path("steps.csv"));
  EXPECT_THAT(namesIn(root.path("")), UnorderedElementsAre("steps.csv"));
}

}  // namespace
}  // namespace hybrid_slam::files
