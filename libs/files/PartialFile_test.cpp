#include "files/PartialFile.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <cerrno>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <vector>

#include "base/Errors.h"
#include "files/OutputFolder.h"
#include "files/RawlogWriter.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"
#include "testing/Restricted.h"
#include "testing/TestLogs.h"

namespace {

// NOLINTBEGIN(cppcoreguidelines-avoid-non-const-global-variables)
std::vector<ino_t> synced;
bool isBroken = false;
// NOLINTEND(cppcoreguidelines-avoid-non-const-global-variables)

}  // namespace

/// Notes the files that are synced, or fails, in place of the function of the C library.
extern "C" int fsync(int file) {
  if (isBroken) return errno = EIO, -1;
  struct stat status {};
  ::fstat(file, &status);
  synced.push_back(status.st_ino);
  return static_cast<int>(::syscall(SYS_fsync, file));
}

namespace hybrid_slam::files {
namespace {

void expectSynced(const std::string& path) {
  struct stat status {};
  ASSERT_EQ(::stat(path.c_str(), &status), 0) << path;
  EXPECT_EQ(synced, std::vector<ino_t>{status.st_ino}) << path;
}

TEST(PartialFile, IsOnDiskWhenItHasItsName) {
  const TemporaryFolder root;
  synced.clear();
  OutputFolder(root.path("")).write("x.csv", [](std::ostream& out) { out << "1,2\n"; });
  expectSynced(root.path("x.csv"));
  EXPECT_EQ(test::contentOf(root.path("x.csv")), "1,2\n");
}

TEST(PartialFile, OneThatDoesNotReachTheDiskIsAnError) {
  const TemporaryFolder root;
  root.write("x.csv", "0\n");
  isBroken = true;
  EXPECT_EQ(test::errorOf([&] {
              OutputFolder(root.path("")).write("x.csv", [](std::ostream& out) { out << "1,2\n"; });
            }),
            "cannot write: " + root.path("x.csv") +
                "; expected a writable folder with free disk space: Input/output error");
  isBroken = false;
  EXPECT_EQ(test::contentOf(root.path("x.csv")), "0\n");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(root.path("")), {}), 1) << "nothing is left";
}

TEST(PartialFile, ARecordingIsOnDiskWhenItHasItsName) {
  const TemporaryFolder root;
  synced.clear();
  RawlogWriter writer(root.path("x.rawlog"));
  writer.write(*test::scan(1));
  writer.finish();
  expectSynced(root.path("x.rawlog"));
}

TEST(PartialFile, MovesWithItsFolder) {
  TemporaryFolder root;
  std::filesystem::create_directory(root.path("out"));
  PartialFile file(root.path("out/map"));
  std::ofstream(file.path()) << "1";
  std::filesystem::rename(root.path("out"), root.path("moved"));
  {
    const PartialFile left(root.path("moved/other"));
    std::filesystem::rename(root.path("moved"), root.path("again"));
  }
  file.commit();
  EXPECT_EQ(file.finalPath(), root.path("again/map"));
  EXPECT_EQ(test::contentOf(root.path("again/map")), "1");
  EXPECT_EQ(std::distance(std::filesystem::directory_iterator(root.path("again")), {}), 1);
}

TEST(PartialFile, RemovedOrReplacedIsAnError) {
  for (const bool isReplaced : {false, true}) {
    TemporaryFolder root;
    std::filesystem::create_directory(root.path("out"));
    {
      PartialFile file(root.path("out/map"));
      std::filesystem::remove_all(root.path("out"));
      if (isReplaced) {
        std::filesystem::create_directory(root.path("out"));
        std::ofstream(file.path()) << "of another";
      }
      EXPECT_THAT(test::errorOf<InputError>([&] { file.commit(); }),
                  testing::StartsWith("removed while it was written: " + root.path("out/map")));
    }
    EXPECT_FALSE(std::filesystem::exists(root.path("out/map")));
    EXPECT_EQ(std::filesystem::exists(root.path("out/.partial.map")), isReplaced) << "it is not ours";
  }
}

TEST(PartialFile, ThatOfAnotherUserStays) {
  TemporaryFolder root;
  std::filesystem::permissions(root.path(""), std::filesystem::perms::all);
  std::ofstream(root.path(".partial.map")) << "of another";
  std::filesystem::permissions(root.path(".partial.map"), std::filesystem::perms::none);
  EXPECT_TRUE(test::holdsWithoutRoot(root.path(""), [&] {
    {
      PartialFile file(root.path("map"));
      std::ofstream(file.path()) << "ours";
      file.commit();
    }
    return test::contentOf(root.path("map")) == "ours" && std::filesystem::exists(root.path(".partial.map"));
  }));
}

TEST(PartialFile, AFolderThatCannotBeWrittenIsAnError) {
  TemporaryFolder root;
  EXPECT_THAT(test::errorOf([&] { PartialFile(root.path("none/map")); }),
              testing::StartsWith("cannot write: " + root.path("none/map")));
}

TEST(PartialFile, LinksAndPipesThatHaveItsNameStay) {
  TemporaryFolder root;
  std::ofstream(root.path("mine")) << "1";
  std::filesystem::create_symlink("mine", root.path(".partial.map"));
  ASSERT_EQ(::mkfifo(root.path(".partial-2.map").c_str(), 0600), 0);
  PartialFile file(root.path("map"));
  std::ofstream(file.path()) << "2";
  file.commit();
  EXPECT_EQ(test::contentOf(root.path("map")), "2");
  EXPECT_EQ(test::contentOf(root.path("mine")), "1");
  EXPECT_TRUE(std::filesystem::is_symlink(root.path(".partial.map")));
}

}  // namespace
}  // namespace hybrid_slam::files
