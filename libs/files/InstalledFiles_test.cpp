#include "files/InstalledFiles.h"

#include <gtest/gtest.h>

#include "files/TemporaryFolder.h"

namespace hybrid_slam::files {
namespace {

namespace fs = std::filesystem;

/// A prefix with one INI file and one page.
class InstalledFiles : public ::testing::Test {
 protected:
  InstalledFiles() {
    for (const char* folder : {"bin", "share/hybrid_slam/config-ini", "share/doc/hybrid-slam/doc"})
      fs::create_directories(prefix.path(folder));
    ini = prefix.write("share/hybrid_slam/config-ini/robot.ini", "[run]\n");
    page = prefix.write("share/doc/hybrid-slam/doc/results.md", "# Results\n");
  }
  TemporaryFolder prefix;
  fs::path bin = prefix.path("bin");
  std::string ini, page;
};

TEST_F(InstalledFiles, AFileOfTheWorkingFolderComesFirst) {
  const fs::path before = fs::current_path();
  const TemporaryFolder working;
  fs::create_directories(working.path("config-ini"));
  fs::current_path(working.path(""));
  EXPECT_EQ(inputFile("config-ini/robot.ini", bin), ini);
  working.write("config-ini/robot.ini", "[run]\n");
  EXPECT_EQ(inputFile("config-ini/robot.ini", bin), "config-ini/robot.ini");
  fs::current_path(before);
}

TEST_F(InstalledFiles, AFileThatIsNowhereKeepsItsName) {
  EXPECT_EQ(inputFile("config-ini/none.ini", bin), "config-ini/none.ini");
  EXPECT_EQ(inputFile("/config-ini/robot.ini", bin), "/config-ini/robot.ini");
  EXPECT_EQ(inputFile("", bin), "");
}

TEST_F(InstalledFiles, SeveralNamesAtOnce) {
  std::string found = "config-ini/robot.ini", unknown = "config-ini/none.ini", none;
  findInputFiles({&found, &unknown, &none}, bin);
  EXPECT_EQ(found, ini);
  EXPECT_EQ(unknown, "config-ini/none.ini");
  EXPECT_EQ(none, "");
}

TEST_F(InstalledFiles, MessagesNameInstalledPages) {
  EXPECT_EQ(withInstalledPages("see doc/results.md, (doc/results.md).", bin),
            "see " + page + ", (" + page + ").");
}

TEST_F(InstalledFiles, MessagesKeepPagesThatAreNotInstalledAndOtherPaths) {
  const std::string longWord = "doc/" + std::string(1000000, 'a') + ".md";
  for (const std::string& text :
       {std::string("see doc/none.md"), std::string("my-doc/results.md"),
        std::string("/home/me/doc/results.md"), std::string("doc/"), std::string(), longWord})
    EXPECT_EQ(withInstalledPages(text, bin), text);
}

TEST(ProgramFolder, IsThatOfTheTest) { EXPECT_TRUE(fs::is_directory(programFolder())); }

}  // namespace
}  // namespace hybrid_slam::files
