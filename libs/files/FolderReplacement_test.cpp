/// Faults while results replace earlier ones: kills, full disks, folders and file systems that cannot do all.
#include "files/FolderReplacement.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>

#include "base/Errors.h"
#include "testing/ErrorOf.h"
#include "testing/Restricted.h"
#include "testing/StagedFolderTest.h"

namespace hybrid_slam::files {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using testing::HasSubstr;
using testing::MatchesRegex;
using testing::UnorderedElementsAre;

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
    const bool isKept = fs::exists(out + "/own/file") && !fs::is_symlink(out + "/own");
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

#ifdef SYS_link
TEST_F(StagedFolderTest, WithoutHardLinksFilesAreMovedAfterTheExchange) {
  EXPECT_TRUE(test::holdsWithout(SYS_link, EPERM, [&] {
    run("1");
    std::ofstream(out + "/notes") << "mine";
    run("2", true);
    return inOut("map") == "2" && inOut("notes") == "mine" &&
           namesIn(root.path("")) == std::vector<std::string>{"out"};
  }));
}
#endif

TEST_F(StagedFolderTest, WithoutLocksResultsAppearAsWell) {
  EXPECT_TRUE(test::holdsWithout(SYS_flock, ENOLCK, [&] {
    run("1");
    run("2", true);
    run("3");  // to a dated subfolder
    return inOut("map") == "2" && namesIn(out).size() == 3 &&
           namesIn(root.path("")) == std::vector<std::string>{"out"};
  }));
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

// So that a kill right after the exchange hides nothing.
TEST_F(StagedFolderTest, OtherFilesAreLinkedBeforeTheExchange) {
  run("1");
  fs::create_directories(out + "/folder/file");
  std::ofstream(out + "/notes") << "mine";
  EXPECT_FALSE(test::holdsInChild([] { return test::restrictCall(SYS_renameat2, SECCOMP_RET_KILL_PROCESS); },
                                  [&] {
                                    run("2", true);
                                    return true;
                                  }));
  EXPECT_EQ(inOut("map"), "1");
  std::string hidden;
  for (const std::string& name : namesIn(root.path("")))
    if (name != "out") hidden = root.path(name);
  ASSERT_NE(hidden, "") << "the child was not killed in the exchange";
  EXPECT_TRUE(fs::equivalent(hidden + "/notes", out + "/notes"));
  EXPECT_EQ(fs::read_symlink(hidden + "/folder"), fs::path("..") / fs::path(hidden).filename() / "folder");
}

TEST_F(StagedFolderTest, CompleteResultsThatCouldNotBeRenamedStay) {
  run("1");
  const std::string hidden = root.path(".out.part-left");
  fs::create_directory(hidden);
  for (const char* name : {"/map", "/metrics"}) std::ofstream(hidden + name) << "2";
  run("3", true);
  EXPECT_EQ(contentOf(hidden + "/map"), "2");
  EXPECT_EQ(contentOf(hidden + "/metrics"), "2");
}

// A folder in the way of a result interrupts the renaming as a kill would.
TEST_F(StagedFolderTest, OneByOneTheLastResultComesLast) {
  EXPECT_TRUE(test::holdsWithout(SYS_renameat2, EINVAL, [&] {
    for (int i = 0; i < 16; ++i) {  // the order of the entries of a folder varies
      const std::string name = "map" + std::to_string(i), last = "metrics" + std::to_string(15 - i);
      const std::string folder = root.path("out" + std::to_string(i));
      fs::create_directory(folder);
      std::ofstream(folder + "/" + last) << "of an earlier run";
      std::ofstream(folder + "/notes") << "mine";
      StagedFolder staged(folder, {name, last}, true);
      for (const std::string& result : {name, last})
        staged.files().write(result, [](std::ostream& stream) { stream << "2"; });
      fs::create_directories(folder + "/" + name + "/file");
      if (test::errorOf<InputError>([&] { staged.publish(); }) == "no error") return false;
      if (fs::exists(folder + "/" + last)) return false;
    }
    return true;
  }));
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

// Finished results stay, and the error says where.
TEST_F(StagedFolderTest, AFinalFolderThatCannotBeReplaced) {
  for (const std::string fault : {"protected", "hidden"}) {
    SCOPED_TRACE(fault);
    EXPECT_TRUE(test::holdsWithoutRoot(root.path(""), [&] {
      const std::string folder = root.path(fault);
      const auto mode = [&](fs::perms perms) { fs::permissions(folder, perms); };
      std::string error, hidden;
      {
        StagedFolder staged(folder, kNames, false);
        hidden = staged.files().path("");
        write(staged, "1");
        if (fault == "protected") {
          std::ofstream(folder + "/map") << "copy";
          mode(fs::perms::owner_read | fs::perms::owner_exec);
        } else {
          mode(fs::perms::none);
        }
        error = test::errorOf<InputError>([&] { staged.publish(); });
      }
      if (fs::exists(folder)) mode(fs::perms::owner_all);
      if (error.find("results cannot be renamed: " + folder) != 0 || contentOf(hidden + "map") != "1") {
        std::cerr << error << std::endl;
        return false;
      }
      return error.find("they are in " + hidden.substr(0, hidden.size() - 1)) != std::string::npos;
    }));
  }
}

TEST_F(StagedFolderTest, ALinkInPlaceOfTheFinalFolderIsNotFollowed) {
  const std::string other = root.path("other");
  fs::create_directories(other + "/sub");
  for (const char* name : {"/map", "/notes"}) std::ofstream(other + name) << "other";
  for (const bool hasResults : {false, true})
    for (const bool isMoved : {false, true}) {
      if (hasResults) run("1", true);
      const std::string moved = root.path("moved");
      std::string folder;
      {
        StagedFolder staged(out, kNames, true);
        write(staged, "2");
        if (isMoved)
          fs::rename(out, moved);
        else
          fs::remove_all(out);
        fs::create_directory_symlink("other", out);
        staged.publish();
        folder = staged.folder();
        EXPECT_THAT(staged.note(),
                    HasSubstr("moved or removed during the run; the results are in " + folder));
      }
      EXPECT_THAT(folder, MatchesRegex(isMoved ? moved : out + "-" + kDate));
      EXPECT_EQ(contentOf(folder + "/map"), "2");
      EXPECT_THAT(namesIn(folder), UnorderedElementsAre("map", "metrics"));
      EXPECT_THAT(namesIn(other), UnorderedElementsAre("sub", "map", "notes"));
      EXPECT_EQ(contentOf(other + "/map"), "other");
      EXPECT_THAT(namesIn(root.path("")),
                  UnorderedElementsAre("out", "other", fs::path(folder).filename().string()));
      fs::remove_all(folder);
      fs::remove(out);
    }
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

}  // namespace
}  // namespace hybrid_slam::files
