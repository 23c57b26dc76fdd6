#include "files/StagedFolder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "base/Errors.h"
#include "files/DatedName.h"
#include "testing/ErrorOf.h"
#include "testing/FullDisk.h"
#include "testing/StagedFolderTest.h"

namespace hybrid_slam::files {
namespace {

namespace fs = std::filesystem;
using test::contentOf;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::MatchesRegex;
using testing::StartsWith;
using testing::UnorderedElementsAre;

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

TEST_F(StagedFolderTest, ResultsThatAreCopiedThereMeanwhileAreNotReplaced) {
  StagedFolder staged(out, kNames, false);
  write(staged, "run");
  std::ofstream(out + "/map") << "copy";
  staged.publish();
  EXPECT_EQ(inOut("map"), "copy");
  EXPECT_EQ(contentOf(staged.finalPath("map")), "run");
  EXPECT_THAT(staged.note(), HasSubstr(out + "/20"));
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

TEST_F(StagedFolderTest, ResultsMoveWithAFolderAboveThem) {
  for (const bool isDated : {false, true}) {
    SCOPED_TRACE(isDated);
    out = root.path("above") + "/out";
    if (isDated) run("1");
    std::string folder;
    {
      StagedFolder staged(out, kNames, false);
      staged.files().write("extra", [](std::ostream& stream) { stream << "2"; });
      fs::rename(root.path("above"), root.path("moved"));
      staged.follow();
      EXPECT_EQ(staged.note(),
                out + " was moved or removed during the run; the results are in " + staged.folder());
      write(staged, "2");
      fs::rename(root.path("moved"), root.path("again"));
      staged.publish();
      folder = staged.folder();
    }
    EXPECT_THAT(folder, MatchesRegex(root.path("again/out") + (isDated ? "/" + std::string(kDate) : "")));
    EXPECT_THAT(namesIn(folder), UnorderedElementsAre("extra", "map", "metrics"));
    EXPECT_EQ(std::distance(fs::directory_iterator(root.path("again")), {}), 1);
    EXPECT_FALSE(fs::exists(root.path("above")));
    fs::remove_all(root.path("again"));
  }
}

TEST_F(StagedFolderTest, ARunThatFailsInAMovedFolderLeavesNothing) {
  out = root.path("above") + "/out";
  {
    const StagedFolder staged(out, kNames, false);
    write(staged, "1");
    fs::rename(root.path("above"), root.path("moved"));
  }
  EXPECT_THAT(namesIn(root.path("moved")), IsEmpty());
}

TEST_F(StagedFolderTest, AFolderThatIsRemovedDuringTheRunIsCreatedAgain) {
  for (const bool isDated : {false, true}) {
    SCOPED_TRACE(isDated);
    out = root.path("above") + "/out";
    if (isDated) run("1");
    StagedFolder staged(out, kNames, false);
    fs::remove_all(root.path("above"));
    staged.follow();
    write(staged, "2");
    staged.publish();
    EXPECT_EQ(contentOf(staged.folder() + "/map"), "2");
    EXPECT_THAT(staged.note(), HasSubstr("moved or removed"));
    fs::remove_all(root.path("above"));
  }
}

TEST_F(StagedFolderTest, ACheckpointThatAnotherHasReplacedIsNotOurs) {
  for (const bool isResumed : {false, true}) {
    fs::create_directory(out);
    const std::string checkpoint = out + "/extra";
    if (isResumed) std::ofstream(checkpoint) << "1";
    StagedFolder staged(out, kNames, false, isResumed ? "extra" : "");
    if (!isResumed) {
      std::ofstream(checkpoint) << "1";
      staged.setOwn("extra");
    }
    EXPECT_FALSE(staged.isOfAnother("extra"));
    std::ofstream(checkpoint) << "another";
    EXPECT_TRUE(staged.isOfAnother("extra"));
    write(staged, "2");
    staged.publish();
    EXPECT_EQ(contentOf(checkpoint), "another");
    EXPECT_THAT(staged.folder(), MatchesRegex(out + "/" + kDate));
    fs::remove_all(out);
  }
}

// A checkpoint is larger than the results of a run that failed early.
TEST_F(StagedFolderTest, TheOwnCheckpointIsKeptWholeOnAFullDisk) {
  const std::string checkpoint(100000, '1');
  fs::create_directory(out);
  root.write("out/extra", checkpoint);
  StagedFolder staged(out, kNames, false, "extra");
  {
    const test::FullDisk disk(1000);
    EXPECT_EQ(staged.keepOwn(), out + "/extra");
    write(staged, "2");
    staged.publish();
  }
  EXPECT_EQ(contentOf(out + "/map"), "2");
  EXPECT_EQ(contentOf(out + "/extra"), checkpoint);
}

TEST_F(StagedFolderTest, WhatKilledRunsLeftOfTheirResultsIsRemoved) {
  fs::create_directory(out);
  for (const char* name : {".partial.extra", ".partial-2.extra", ".partial-31.map"})
    root.write(std::string("out/") + name, "a part");
  const std::vector<std::string> others = {".partial.recording", ".partial-.extra", ".partial-2b.extra",
                                           "2.extra"};
  for (const std::string& name : others) root.write("out/" + name, "of the user");
  StagedFolder staged(out, kNames, true);
  write(staged, "1");
  staged.publish();
  for (const char* name : {".partial.extra", ".partial-2.extra", ".partial-31.map"})
    EXPECT_FALSE(fs::exists(out + "/" + name)) << name;
  for (const std::string& name : others) EXPECT_EQ(contentOf(out + "/" + name), "of the user") << name;
}

TEST_F(StagedFolderTest, AnotherRunMayTakeTheNameOfAMovedFolder) {
  StagedFolder first(out, kNames, false);
  fs::rename(out, root.path("moved"));
  StagedFolder second(out, kNames, false);
  for (StagedFolder* staged : {&first, &second}) {
    staged->follow();
    write(*staged, staged == &first ? "1" : "2");
    staged->publish();
  }
  EXPECT_EQ(contentOf(root.path("moved/map")), "1");
  EXPECT_EQ(inOut("map"), "2");
  EXPECT_THAT(namesIn(root.path("")), UnorderedElementsAre("out", "moved"));
}

TEST_F(StagedFolderTest, ResultsThatAreRemovedAreAnError) {
  StagedFolder staged(out, kNames, false);
  write(staged, "1");
  const std::string hidden = staged.files().path("");
  fs::remove_all(hidden);
  EXPECT_THAT(test::errorOf<InputError>([&] { staged.publish(); }), StartsWith("results removed: "));
  EXPECT_TRUE(fs::is_empty(out));
}

TEST_F(StagedFolderTest, AFolderInPlaceOfAResultIsAnError) {
  fs::create_directories(out + "/map");
  EXPECT_THROW(StagedFolder(out, kNames, true), InputError);
  run("1");
  EXPECT_THAT(namesIn(out + "/map"), IsEmpty());
}

TEST(DatedName, IsRecognisedAtTheEndOfAName) {
  EXPECT_TRUE(hasDate("out/recording-2026-11-26T10-00-00.rawlog"));
  EXPECT_TRUE(hasDate("robot-2026-11-26T10-00-00-12.rawlog"));
  for (const char* name :
       {"out-2026-11-26T10-00-00/out.rawlog", "recording.rawlog", "robot-2026-11-26.rawlog"})
    EXPECT_FALSE(hasDate(name)) << name;
  EXPECT_TRUE(hasDate("a-" + claimDatedName([](const std::string&) { return true; }) + ".rawlog"));
}

TEST(DatedName, IsTheFirstThatIsFree) {
  int calls = 0;
  EXPECT_THAT(claimDatedName([&](const std::string&) { return ++calls == 3; }),
              MatchesRegex(std::string(kDate) + "-3"));
}

}  // namespace
}  // namespace hybrid_slam::files
