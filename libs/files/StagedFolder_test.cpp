#include "files/StagedFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "base/Errors.h"
#include "files/DatedName.h"
#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"
#include "testing/Restricted.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::files {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::UnorderedElementsAre;

const std::vector<std::string> kNames{"map", "extra", "metrics"};
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
    for (const auto& entry : fs::directory_iterator(folder))
      names.push_back(entry.path().filename().string());
    return names;
  }
  std::string inOut(const std::string& name) const { return contentOf(out + "/" + name); }

  TemporaryFolder root;
  std::string out = root.path("out");
};

TEST_F(StagedFolderTest, ResultsAppearTogether) {
  {
    StagedFolder staged(out, kNames, false);
    write(staged, "1");
    EXPECT_THAT(namesIn(out), IsEmpty());
    staged.publish();
    EXPECT_EQ(staged.note(), "");
    EXPECT_EQ(staged.finalPath("map"), out + "/map");
  }
  EXPECT_THAT(namesIn(out), UnorderedElementsAre("map", "metrics"));
  EXPECT_THAT(namesIn(root.path("")), UnorderedElementsAre("out"));
}

TEST_F(StagedFolderTest, WithoutPublishNothingIsLeft) {
  {
    StagedFolder(out, kNames, false).files().write("map", [](std::ostream&) {});
  }
  EXPECT_THAT(namesIn(root.path("")), IsEmpty());
  run("1");
  {
    StagedFolder(out, kNames, false).files().write("map", [](std::ostream&) {});
  }
  {
    StagedFolder(out, kNames, true).files().write("map", [](std::ostream&) {});
  }
  EXPECT_THAT(namesIn(out), UnorderedElementsAre("map", "metrics"));
  EXPECT_EQ(inOut("map"), "1");
}

TEST_F(StagedFolderTest, AnEarlierRunIsNotTouched) {
  run("1");
  StagedFolder staged(out, kNames, false), twin(out, kNames, false);  // within a second
  EXPECT_THAT(staged.note(), MatchesRegex(out + " has results of an earlier run.* go to " + out + "/" +
                                          kDate + " \\(--overwrite.*\\)"));
  write(staged, "2");
  write(twin, "3");
  staged.publish();
  twin.publish();
  EXPECT_EQ(inOut("map"), "1");
  EXPECT_EQ(contentOf(staged.finalPath("map")), "2");
  EXPECT_EQ(contentOf(twin.finalPath("map")), "3");
  EXPECT_EQ(namesIn(out).size(), 4u);
}

TEST_F(StagedFolderTest, OverwriteReplacesTheEarlierResultsAndNothingElse) {
  run("1", false, true);
  std::ofstream(out + "/notes") << "mine";
  fs::create_directory(out + "/folder");
  std::ofstream(out + "/folder/map") << "mine too";
  fs::create_symlink("/nowhere", out + "/link");
  fs::permissions(out, fs::perms::owner_all);
  run("2", true);
  EXPECT_THAT(namesIn(out), UnorderedElementsAre("map", "metrics", "notes", "folder", "link"));
  EXPECT_EQ(inOut("map"), "2");
  EXPECT_EQ(inOut("notes"), "mine");
  EXPECT_EQ(inOut("folder/map"), "mine too");
  EXPECT_EQ(fs::status(out).permissions(), fs::perms::owner_all);
  EXPECT_THAT(namesIn(root.path("")), UnorderedElementsAre("out"));
}

TEST_F(StagedFolderTest, OtherFilesStayWithoutOverwrite) {
  fs::create_directory(out);
  std::ofstream(out + "/robot.rawlog") << "log";
  run("1");
  EXPECT_THAT(namesIn(out), UnorderedElementsAre("map", "metrics", "robot.rawlog"));
  EXPECT_EQ(inOut("robot.rawlog"), "log");
}

// Otherwise both would write their checkpoints to one file, and the last to end would replace the results of
// the other.
TEST_F(StagedFolderTest, AFolderBelongsToTheRunThatBeginsFirst) {
  fs::create_directory(out);
  for (const bool overwrite : {false, true}) {
    SCOPED_TRACE(overwrite);
    StagedFolder first(out, kNames, overwrite), second(out, kNames, overwrite), third(out, kNames, false);
    EXPECT_EQ(first.note(), "");
    EXPECT_THAT(second.note(),
                MatchesRegex(out + " is in use by another run; the results of this one go to " + out + "-" +
                             kDate + "(-[0-9])?"));
    EXPECT_NE(second.folder(), third.folder());
    write(first, "first");
    write(second, "second");
    second.publish();
    first.publish();
    EXPECT_EQ(inOut("map"), "first");
    EXPECT_EQ(contentOf(second.finalPath("map")), "second");
    EXPECT_THAT(StagedFolder(out, kNames, true).note(), HasSubstr("in use")) << "until the first is gone";
  }
  EXPECT_THAT(namesIn(out), UnorderedElementsAre("map", "metrics"));
  run("third", true);
  EXPECT_EQ(inOut("map"), "third");
}

// Replacing the folder would move the subfolder away under the other run.
TEST_F(StagedFolderTest, AFolderIsNotReplacedWhileARunUsesItsSubfolder) {
  run("1");
  StagedFolder beneath(out, kNames, false);
  EXPECT_THAT(beneath.folder(), MatchesRegex(out + "/" + kDate));
  StagedFolder above(out, kNames, true);
  EXPECT_THAT(above.folder(), MatchesRegex(out + "-" + kDate));
  const StagedFolder another(out, kNames, false);
  EXPECT_THAT(another.folder(), MatchesRegex(out + "/" + kDate + "(-[0-9])?"));
  EXPECT_THROW(StagedFolder(beneath.folder() + "/own", kNames, false), InputError) << "it would move";
  EXPECT_FALSE(fs::exists(beneath.folder() + "/own"));
  write(beneath, "2");
  write(above, "3");
  above.publish();
  beneath.publish();
  EXPECT_EQ(inOut("map"), "1");
  EXPECT_EQ(contentOf(beneath.finalPath("map")), "2");
  EXPECT_EQ(contentOf(above.finalPath("map")), "3");
}

// A mount point, or a folder of another user, cannot be moved into the new one.
TEST_F(StagedFolderTest, AFolderThatCannotBeMovedKeepsItsFiles) {
  run("1");
  fs::create_directories(out + "/own/file");
  fs::create_directory(root.path(".out.part-left"));
  fs::create_directories(root.path(".out.part-left/folder/file"));  // as if it could not be moved back
  fs::create_directory_symlink("../.out.part-left/folder", out + "/folder");
  run("2", true);
  EXPECT_EQ(inOut("map"), "2");
  EXPECT_TRUE(fs::exists(out + "/folder/file"));
  EXPECT_TRUE(fs::exists(out + "/own/file"));
}

TEST_F(StagedFolderTest, AWriteProtectedFolderKeepsItsFiles) {
  EXPECT_TRUE(test::holdsWithoutRoot(root.path(""), [&] {
    run("1");
    fs::create_directories(out + "/own/file");
    fs::permissions(out + "/own", fs::perms::owner_read | fs::perms::owner_exec);
    run("2", true);
    const bool isKept = fs::exists(out + "/own/file");
    fs::permissions(out + "/own", fs::perms::owner_all);
    return isKept && inOut("map") == "2" && inOut("metrics") == "2";
  }));
}

TEST_F(StagedFolderTest, AFolderThatCannotBeListedIsRefusedBeforeTheRun) {
  EXPECT_TRUE(test::holdsWithoutRoot(root.path(""), [&] {
    fs::create_directory(out);
    fs::permissions(out, fs::perms::owner_write | fs::perms::owner_exec);
    const std::string error =
        test::errorOf<InputError>([&] { const StagedFolder staged(out, kNames, false); });
    fs::permissions(out, fs::perms::owner_all);
    return error == "output folder not readable: " + out + "; expected a folder whose files can be listed";
  }));
}

// Some file systems, such as those of networks, lack one of these calls.
TEST_F(StagedFolderTest, WithoutAnExchangeFilesAreRenamedOneByOne) {
  EXPECT_TRUE(test::holdsWithout(SYS_renameat2, EINVAL, [&] {
    run("1", false, true);
    fs::create_directories(out + "/own/file");
    std::ofstream(out + "/notes") << "mine";
    run("2", true);
    return inOut("map") == "2" && inOut("metrics") == "2" && !fs::exists(out + "/extra") &&
           inOut("notes") == "mine" && !fs::is_symlink(out + "/own") && fs::exists(out + "/own/file") &&
           namesIn(root.path("")) == std::vector<std::string>{"out"};
  }));
}

TEST_F(StagedFolderTest, WithoutLocksResultsAppearAsWell) {
  EXPECT_TRUE(test::holdsWithout(SYS_flock, ENOLCK, [&] {
    run("1");
    run("2", true);
    run("3");  // to a dated subfolder
    return inOut("map") == "2" && namesIn(out).size() == 3 &&
           namesIn(root.path("")) == std::vector<std::string>{"out"};
  }));
}

TEST_F(StagedFolderTest, AFolderInUseByAnyOfItsNames) {
  fs::create_directory(out);
  fs::create_directory(root.path("other"));
  fs::create_directory_symlink(out, root.path("other/link"));
  const StagedFolder first(out, kNames, false);
  for (const std::string name : {"/other/link", "/out/", "/other/../out", "/out/."})
    EXPECT_THAT(StagedFolder(root.path("") + name, kNames, false).folder(),
                MatchesRegex(out + "-" + kDate + "(-[0-9])?"))
        << name;
}

TEST_F(StagedFolderTest, ARunThatIsKilledInTheExchangeHidesNothing) {
  run("1");
  fs::create_directory(out + "/folder");
  std::ofstream(out + "/folder/file") << "other";
  std::ofstream(out + "/notes") << "mine";
  for (const char* const moment : {"links", "exchange"}) {  // after which it is killed
    SCOPED_TRACE(moment);
    const std::string hidden = root.path(".out.part-killed");
    fs::create_directory(hidden);
    std::ofstream(hidden + "/map") << "2";
    std::ofstream(hidden + (moment == std::string("links") ? "/.partial.metrics" : "/metrics")) << "2";
    fs::create_directory_symlink("../.out.part-killed/folder", hidden + "/folder");
    fs::create_hard_link(out + "/notes", hidden + "/notes");
    if (moment == std::string("exchange")) {
      fs::rename(out, root.path("old"));
      fs::rename(hidden, out);
      fs::rename(root.path("old"), hidden);
      EXPECT_EQ(inOut("folder/file"), "other") << "through a link";
    }
    const std::string before = inOut("map");
    { const StagedFolder next(out, kNames, false); }
    EXPECT_TRUE(fs::is_directory(fs::symlink_status(out + "/folder")));
    EXPECT_EQ(inOut("folder/file"), "other");
    EXPECT_EQ(inOut("notes"), "mine");
    EXPECT_EQ(inOut("map"), before);
    EXPECT_THAT(namesIn(out), UnorderedElementsAre("map", "metrics", "notes", "folder"));
    fs::remove_all(hidden);
  }
}

TEST_F(StagedFolderTest, ResultsThatAreCopiedThereMeanwhileAreNotReplaced) {
  StagedFolder staged(out, kNames, false);
  write(staged, "run");
  std::ofstream(out + "/map") << "copy";
  staged.publish();
  EXPECT_EQ(inOut("map"), "copy");
  EXPECT_EQ(contentOf(staged.finalPath("map")), "run");
  EXPECT_THAT(staged.note(), HasSubstr(out + "/20"));
}

TEST_F(StagedFolderTest, AResultThatDoesNotReachTheDiskIsAnError) {
  run("1");
  {
    StagedFolder staged(out, kNames, true);
    write(staged, "2");
    fs::create_symlink("/dev/null", staged.files().path("extra"));  // which cannot be synced
    EXPECT_THROW(staged.publish(), InputError);
  }
  EXPECT_EQ(inOut("map"), "1");
  EXPECT_THAT(namesIn(root.path("")), UnorderedElementsAre("out"));
}

TEST_F(StagedFolderTest, ASymbolicLinkToAFolderStays) {
  fs::create_directory(root.path("target"));
  fs::create_directory_symlink("target", out);
  run("1");
  run("2", true);
  EXPECT_TRUE(fs::is_symlink(out));
  EXPECT_EQ(contentOf(root.path("target/map")), "2");
}

TEST_F(StagedFolderTest, TheWorkingFolderIsNotReplaced) {
  const fs::path before = fs::current_path();
  fs::create_directory(out);
  fs::current_path(out);
  out = ".";
  run("1", false, true);
  std::ofstream("notes") << "mine";
  run("2", true);
  const auto names = namesIn(".");
  const std::string map = contentOf("map");
  fs::current_path(before);
  EXPECT_THAT(names, UnorderedElementsAre("map", "metrics", "notes"));
  EXPECT_EQ(map, "2");
}

TEST_F(StagedFolderTest, AFolderInPlaceOfAResultIsAnError) {
  fs::create_directories(out + "/map");
  EXPECT_THROW(StagedFolder(out, kNames, true), InputError);
  run("1");
  EXPECT_THAT(namesIn(out + "/map"), IsEmpty());
}

TEST_F(StagedFolderTest, AKilledRunIsClearedAwayAndARunningOneIsNot) {
  const pid_t child = fork();
  if (child == 0) {
    StagedFolder killed(out, kNames, false);
    killed.files().write("map", [](std::ostream&) {});
    std::raise(SIGKILL);
  }
  waitpid(child, nullptr, 0);
  EXPECT_EQ(namesIn(root.path("")).size(), 2u) << "out and the hidden folder";
  StagedFolder running(out, kNames, false);
  write(running, "1");
  const StagedFolder next(out, kNames, false);
  EXPECT_EQ(namesIn(root.path("")).size(), 4u) << "two folders, and a hidden one each";
  running.publish();
  EXPECT_EQ(inOut("map"), "1");
}

TEST_F(StagedFolderTest, LinksThatAKilledRunHasLeftAreClearedAwayAndOtherFilesAreNot) {
  run("one");
  std::ofstream(out + "/notes") << "mine";
  const std::string linked = root.path(".out.part-linked"), moved = root.path(".out.part-moved");
  fs::create_directory(linked);
  fs::create_hard_link(out + "/notes", linked + "/notes");
  fs::create_directory(moved);
  std::ofstream(moved + "/notes") << "other";
  run("two", true);
  EXPECT_FALSE(fs::exists(linked));
  EXPECT_EQ(contentOf(moved + "/notes"), "other");
  EXPECT_EQ(contentOf(out + "/notes"), "mine");
}

TEST(DatedName, IsTheFirstThatIsFree) {
  int calls = 0;
  EXPECT_THAT(claimDatedName([&](const std::string&) { return ++calls == 3; }),
              MatchesRegex(std::string(kDate) + "-3"));
}

}  // namespace
}  // namespace hybrid_slam::files
