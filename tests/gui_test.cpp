/// The window on a virtual screen, driven by menu events and checked pixel by pixel.
#include <nlohmann/json.hpp>

#include "GuiTest.h"

namespace hybrid_slam {
namespace {

TEST_F(GuiTest, ReplayShowsBothMapsWhereTheyAre) {
  frame->open(ini, log);
  ASSERT_TRUE(stands(State::paused, 0));
  menu(window::kStep);
  ASSERT_TRUE(stands(State::paused, 1));
  frame->replay()->seek(60);
  ASSERT_TRUE(stands(State::ended, 60));
  ASSERT_TRUE(happens([&] { return frame->replay()->canvas(1)->shown() == now().filters.at(1); }));
  wxImage screen;
  const auto isSeen = [&](const window::MapCanvas& canvas) {
    const window::MapImage& map = canvas.shown()->map;
    size_t wall = 0, wallSeen = 0, free = 0, freeSeen = 0;
    for (int y = 0; y < map.height; ++y)
      for (int x = 0; x < map.width; ++x) {
        const int grey = map.grey[static_cast<size_t>(y * map.width + x)];
        const int seen = greyAt(screen, canvas, map.left + (x + 0.5) * map.resolution,
                                map.top() - (y + 0.5) * map.resolution);
        if (grey < 40) ++wall, wallSeen += seen < 110 ? 1 : 0;
        if (grey > 230) ++free, freeSeen += seen > 190 ? 1 : 0;
      }
    // Lines, path and caption cover some.
    const bool isMapSeen = wall > 100 && wallSeen > wall * 8 / 10 && free > 1000 && freeSeen > free * 8 / 10;
    return isMapSeen && count(screen, canvas, 220, 0, 0) > 50 &&  // path and particles
           count(screen, canvas, 80, 180, 255) > 30;              // robot
  };
  const auto scanLines = [this](const wxImage& on, size_t pane) {
    return count(on, *frame->replay()->canvas(pane), 0, 70, 230);
  };
  EXPECT_TRUE(screenShows("room", [&](const wxImage& taken) {
    screen = taken;
    return isSeen(*frame->replay()->canvas(0)) && isSeen(*frame->replay()->canvas(1)) &&
           scanLines(screen, 0) > 200;
  }));
  EXPECT_EQ(scanLines(screen, 1), 0u) << "the general filter has none";

  menu(window::kScanLines);
  EXPECT_TRUE(
      screenShows("room-without-scan-lines", [&](const wxImage& taken) { return scanLines(taken, 0) == 0; }));
}

/// The settings from the log arrive with a later event of the window.
TEST_F(GuiTest, OpeningALogReturnsBeforeItIsRead) {
  const std::string sparse = test::writeGzipped(folder.path("sparse.rawlog"), test::laps(30, 12));
  const auto step = [this] { return frame->settings()->configuration.filter.improved.updateDistance; };
  const auto isEnabled = [this](int command) { return frame->GetMenuBar()->IsEnabled(command); };
  frame->open("", sparse);
  EXPECT_EQ(step(), 0.1) << "the default";
  EXPECT_THAT(frame->replay()->canvas(0)->title(), HasSubstr("reading the log"));
  for (const int command : {window::kParameters, window::kSaveIni, window::kPlay})
    EXPECT_FALSE(isEnabled(command));
  EXPECT_TRUE(isEnabled(window::kOpenLog));
  ASSERT_TRUE(happens([&] { return isEnabled(window::kParameters); }));
  EXPECT_EQ(step(), 0.02) << "of scans far apart";
  frame->applyChanges({"particle_filter.seed=7"});
  EXPECT_EQ(step(), 0.02) << "the same log";
}

TEST_F(GuiTest, ShowsTheLasersAndTheWarningsOnTheLog) {
  test::Log two = test::laps(20);
  const auto rear = test::scan(1000, {}, 91, "REAR");
  rear->sensorPose.setYawPitchRoll(0, 0.5, 0);
  two.push_back(rear);
  frame->open(ini, test::writeGzipped(folder.path("two.rawlog"), two));
  ASSERT_TRUE(happens([&] { return status(0).find("warning: laser `REAR` is not used") == 0; })) << status(0);
  std::vector<std::string> lines;
  for (const wxString& line : frame->replay()->events()->GetStrings()) lines.push_back(line.utf8_string());
  EXPECT_THAT(lines, testing::Contains(HasSubstr("laser LASER: 181 beams")));
  EXPECT_EQ(lines.back(), status(0));
  EXPECT_TRUE(dialogs.messages.empty());
}

/// The window shows the warnings that the other programs print.
TEST_F(GuiTest, ShowsTheWarningsOnTheSettings) {
  const std::string other = folder.write("other.ini", "[particle_filter]\nparticles = 8\n[motion_by_hand]\n");
  const std::string warning = "warning: unknown section [motion_by_hand]: " + other +
                              "; ignored, the nearest known section is [motion_model]";
  const auto lines = [this] {
    std::vector<std::string> shown;
    for (const wxString& line : frame->replay()->events()->GetStrings()) shown.push_back(line.utf8_string());
    return shown;
  };
  frame->open(other, "");
  EXPECT_THAT(lines(), testing::ElementsAre(warning));
  frame->open("", "", {}, {"particle_filter.particles=8"});
  EXPECT_THAT(lines(), testing::IsEmpty());

  frame->open(other, log);
  ASSERT_TRUE(stands(State::paused, 0));
  EXPECT_TRUE(happens([&] { return status(0) == warning; })) << status(0);
  EXPECT_THAT(lines(), testing::Contains(warning));
  frame->applyChanges({"particle_filter.seed=7"});
  EXPECT_TRUE(happens([&] { return frame->settings()->configuration.filter.filter.seed == 7; }));
  ASSERT_TRUE(stands(State::paused, 0));
  EXPECT_THAT(now().events, testing::Contains(warning)) << "the same settings, the same warning";

  frame->live()->setServer("127.0.0.1:1");
  frame->live()->setOutput(folder.path("live"));
  frame->live()->connectOrStop();
  EXPECT_TRUE(happens([&] {
    const auto events = frame->live()->session()->snapshot()->events;
    return !events.empty() && events[0] == "live: " + warning;
  }));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(GuiTest, ReplayOfTheSimulatedBuilding) {
  frame->open(SOURCE_DIR "/config-ini/csie-lms100.ini", SOURCE_DIR "/datasets/csie/csie-loop.rawlog");
  ASSERT_TRUE(stands(State::paused, 0));
  const size_t target = now().total * 6 / 10;
  frame->replay()->seek(target);
  ASSERT_TRUE(stands(State::paused, target));
  ASSERT_TRUE(happens([&] { return frame->replay()->canvas(1)->shown() == now().filters.at(1); }));
  EXPECT_TRUE(screenShows("replay", [this](const wxImage& screen) {
    return count(screen, *frame->replay()->canvas(0), 0, 150, 0) > 300 &&     // the line database
           count(screen, *frame->replay()->canvas(1), 255, 255, 255) > 3000;  // free space
  }));
}

TEST_F(GuiTest, PlaysPausesAndGoesBackWhileTheWindowAnswers) {
  frame->open(ini, log);
  ASSERT_TRUE(stands(State::paused, 0));
  menu(window::kPlay);
  ASSERT_TRUE(happens([&] { return now().state == State::playing && now().scans > 3; }));
  ASSERT_TRUE(happens([&] { return frame->replay()->canvas(0)->shown() != nullptr; }));
  settle(0.1);
  menu(window::kPlay);
  ASSERT_TRUE(happens([&] { return now().state == State::paused; }));
  const size_t there = now().scans;
  EXPECT_LT(there, 60u);
  menu(window::kRestart);
  ASSERT_TRUE(stands(State::paused, 0));
  frame->replay()->seek(there);
  ASSERT_TRUE(stands(State::paused, there));
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(GuiTest, ExportsThePictureAndTheResults) {
  menu(window::kExportPicture);
  ASSERT_EQ(dialogs.messages.size(), 1u);
  EXPECT_THAT(dialogs.messages.back(), HasSubstr("play or step the log first"));
  frame->open(ini, log);
  frame->replay()->seek(40);
  ASSERT_TRUE(stands(State::paused, 40));
  ASSERT_TRUE(happens([&] { return frame->replay()->canvas(0)->shown() != nullptr; }));
  frame->exportPictureTo(folder.path("map.png"));
  const wxImage picture(folder.path("map.png"), wxBITMAP_TYPE_PNG);
  ASSERT_TRUE(picture.IsOk());
  if (const char* const to = std::getenv("HYBRID_SLAM_SCREENSHOTS"))
    picture.SaveFile(std::string(to) + "/exported.png", wxBITMAP_TYPE_PNG);
  EXPECT_EQ(picture.GetSize(), wxSize(1600, 1200));
  frame->exportPictureTo(folder.path("map.3Dscene"));
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder.path("map.3Dscene")));
  EXPECT_TRUE(scene.getByName("grid"));
  for (const char* const name : {"/proc/nowhere/map.png", "/proc/nowhere/map.3Dscene", "map", "map.jpg"})
    EXPECT_THROW(frame->exportPictureTo(name), InputError) << name;
  menu(window::kExportPicture);  // cancelled
  EXPECT_EQ(dialogs.messages.size(), 1u);

  frame->exportResultsTo(folder.path("out"));
  ASSERT_TRUE(happens([&] { return dialogs.messages.size() == 2; }));
  EXPECT_THAT(dialogs.messages.back(), HasSubstr("Results of 40 scans"));
  for (const char* name : {"hybrid/trajectory.tum", "general/trajectory.tum", "hybrid/lines.csv"})
    EXPECT_FALSE(test::contentOf(folder.path(std::string("out/") + name)).empty()) << name;
}

TEST_F(GuiTest, ReportsErrorsInTheFiles) {
  frame->open(folder.path("missing.ini"), "");
  frame->open(folder.write("typo.ini", "[particle_filter]\nparticle = 3\n"), "");
  ASSERT_EQ(dialogs.messages.size(), 2u);
  EXPECT_THAT(dialogs.messages[0], HasSubstr("missing.ini"));
  EXPECT_THAT(dialogs.messages[1], HasSubstr("`particles`"));
  frame->open(ini, folder.write("no.rawlog", "this is none"));
  ASSERT_TRUE(happens([&] { return dialogs.messages.size() == 3; }));
  EXPECT_THAT(dialogs.messages[2], HasSubstr("no.rawlog"));
}

TEST_F(GuiTest, ParametersAreCheckedAndSaved) {
  frame->open(ini, log);
  EXPECT_EQ(window::ParametersDialog::fault(*frame->settings(), "particle_filter", "particles", "12"), "");
  EXPECT_THAT(window::ParametersDialog::fault(*frame->settings(), "particle_filter", "particles", "-1"),
              HasSubstr("expected a whole number"));
  window::ParametersDialog dialog(frame, *frame->settings());
  dialog.Show();
  screenshot("parameters");
  wxPropertyGrid* const grid = dialog.grid();
  EXPECT_TRUE(grid->ChangePropertyValue("particle_filter.particles", "12"));
  EXPECT_TRUE(grid->ChangePropertyValue("run.method", "general"));
  EXPECT_THAT(dialog.changes(), testing::ElementsAre("particle_filter.particles=12", "run.method=general"));
  frame->applyChanges(dialog.changes());
  EXPECT_EQ(frame->settings()->configuration.filter.filter.particles, 12);
  frame->saveIniTo(folder.path("saved.ini"));
  const auto saved = window::Settings::fromFile(folder.path("saved.ini"));
  EXPECT_EQ(saved->configuration.filter.filter.particles, 12);
  EXPECT_EQ(saved->configuration.run.method, run::RunOptions::Method::general);
  EXPECT_EQ(saved->configuration.run.rawlog, log);
  EXPECT_TRUE(dialogs.messages.empty());
}

TEST_F(GuiTest, LivePageFollowsAServerAndWritesItsResults) {
  menu(window::kLivePage);
  frame->open(ini, test::writeGzipped(folder.path("sparse.rawlog"), test::laps(60, 12)));
  ASSERT_TRUE(stands(State::paused, 0));
  test::Events events;
  live::ObservationServer server("127.0.0.1", 0, {}, events.log());
  frame->live()->setServer("127.0.0.1");
  frame->live()->connectOrStop();
  ASSERT_EQ(dialogs.messages.size(), 1u);
  EXPECT_THAT(dialogs.messages[0], HasSubstr("HOST:PORT"));

  connectTo(server);
  ASSERT_NE(frame->replay()->session(), nullptr) << "the replay continues meanwhile";
  frame->replay()->seek(60);
  publishLaps(server, [&](size_t i) {
    if (i == 60) menu(window::kSaveMap);
  });
  ASSERT_TRUE(happens([&] { return status(0).find("map saved: ") != std::string::npos; })) << status(0);
  EXPECT_THAT(status(0), HasSubstr(folder.path("live/saved-20")));
  ASSERT_TRUE(happens([&] { return frame->live()->canvas()->shown() != nullptr; }));
  const window::MapCanvas& canvas = *frame->live()->canvas();
  EXPECT_TRUE(screenShows("live", [&](const wxImage& screen) {
    const double metre = canvas.view().scale, crossed = 0.2 * test::kRoomArea * metre * metre;
    return static_cast<double>(count(screen, canvas, 255, 255, 255)) > crossed &&  // by many beams
           count(screen, canvas, 80, 180, 255) > 30 &&                             // robot
           count(screen, canvas, 220, 0, 0) > 30;                                  // path and particles
  }));
  menu(window::kPath);
  menu(window::kParticles);
  EXPECT_TRUE(screenShows("live-without-path",
                          [&](const wxImage& screen) { return count(screen, canvas, 220, 0, 0) == 0; }));
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([&] { return dialogs.messages.size() == 2; }));
  EXPECT_THAT(dialogs.messages[1], HasSubstr("recording-20"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("live/map.png")));
  EXPECT_EQ(run::Configuration(folder.path("live/config.ini"), {}).filter.improved.updateDistance, 0.1)
      << "as hybrid-slam-live, not what follows from the other log";
  EXPECT_TRUE(stands(State::ended, 60));
}

TEST_F(GuiTest, ALiveRunThatEndsWithTheProgramHasItsResults) {
  EXPECT_EQ(frame->live()->end(), "") << "there is none";
  test::Events events;
  live::ObservationServer server("127.0.0.1", 0, {}, events.log());
  connectTo(server);
  publishLaps(server);
  ASSERT_TRUE(happens([&] { return frame->live()->session()->snapshot()->scans == 60; }));
  EXPECT_EQ(frame->live()->end(), "");
  const auto metrics = nlohmann::json::parse(test::contentOf(folder.path("live/metrics.json")));
  const auto last = frame->live()->session()->snapshot()->filter;
  ASSERT_NE(last, nullptr);
  EXPECT_EQ(last->updates, metrics["updates"].get<size_t>()) << "the caption is that of the end";

  frame->live()->setOutput(folder.path("empty"));
  frame->live()->connectOrStop();
  EXPECT_THAT(frame->live()->end(), HasSubstr("no scan"));
}

}  // namespace
}  // namespace hybrid_slam

/// wxWidgets without its main loop: the tests run it.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  const hybrid_slam::files::TemporaryFolder own;
  setenv("XDG_DATA_HOME", own.path("").c_str(), 1);  // GTK's list of recent files is not that of the tester
  wxApp::SetInstance(new wxApp);
  if (!wxEntryStart(argc, argv)) return 1;
  wxInitAllImageHandlers();
  wxGUIEventLoop loop;
  const wxEventLoopActivator active(&loop);
  return RUN_ALL_TESTS();
}
