/// The window on a virtual screen, driven by menu events and checked pixel by pixel.
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <wx/app.h>
#include <wx/evtloop.h>
#include <wx/image.h>
#include <wx/modalhook.h>
#include <wx/msgdlg.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <functional>

#include "Screen.h"
#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "live/ObservationServer.h"
#include "run/Replay.h"
#include "testing/TestEvents.h"
#include "testing/TestLogs.h"
#include "window/gui/MainFrame.h"
#include "window/gui/MapDialog.h"
#include "window/gui/ParametersDialog.h"

namespace hybrid_slam {
namespace {

using State = window::ReplaySnapshot::State;
using testing::HasSubstr;

/// Answers dialogs instead of the user.
class Dialogs : public wxModalDialogHook {
 public:
  std::vector<std::string> messages;  ///< of message boxes
 protected:
  int Enter(wxDialog* dialog) override {
    if (auto* const message = dynamic_cast<wxMessageDialogBase*>(dialog)) {
      messages.push_back(message->GetMessage().utf8_string());
      return wxID_OK;
    }
    return wxID_CANCEL;
  }
};

class GuiTest : public testing::Test {
 protected:
  void SetUp() override {
    dialogs.Register();
    frame = new window::MainFrame;
    frame->Move(0, 0);
    frame->Show();
    ini = folder.write("run.ini",
                       "[particle_filter]\nparticles = 8\nproposal = standard\nupdate_distance = "
                       "0.2\n[grid]\nresolution = 0.05\n");
    log = test::writeGzipped(folder.path("laps.rawlog"), test::laps(60));
  }
  void TearDown() override {
    delete frame;
    dialogs.Unregister();
  }
  /// Runs the window until a condition holds. @return whether it did within a minute
  bool happens(const std::function<bool()>& condition) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::minutes(1);
    while (!condition()) {
      if (std::chrono::steady_clock::now() > end) return false;
      wxYield();
      wxMilliSleep(2);
    }
    return true;
  }
  void settle(double seconds) {
    const auto end = std::chrono::steady_clock::now() + std::chrono::duration<double>(seconds);
    happens([&] { return std::chrono::steady_clock::now() > end; });
  }
  void menu(int command) {
    wxCommandEvent event(wxEVT_MENU, command);
    event.SetEventObject(frame);
    frame->ProcessWindowEvent(event);
  }
  window::ReplaySnapshot now() { return *frame->replay()->session()->snapshot(); }
  bool stands(State state, size_t scans) {
    return happens([&] { return now().state == state && now().scans == scans; });
  }
  /// The screen; also a PNG in the folder that HYBRID_SLAM_SCREENSHOTS names.
  wxImage screenshot(const std::string& name) {
    settle(0.4);
    const test::Screen screen = test::grabScreen();
    wxImage image(screen.width, screen.height);
    std::copy(screen.rgb.begin(), screen.rgb.end(), image.GetData());
    if (const char* const to = std::getenv("HYBRID_SLAM_SCREENSHOTS")) {
      const wxRect all = onScreen(frame->GetScreenRect()).Intersect(wxRect(image.GetSize()));
      image.GetSubImage(all).SaveFile(std::string(to) + "/" + name + ".png", wxBITMAP_TYPE_PNG);
    }
    return image;
  }
  /// Screen pixels, which are smaller than window units on a high-DPI screen.
  wxRect onScreen(const wxRect& r) const {
    const int scale = wxRound(frame->GetContentScaleFactor());
    return {scale * r.x, scale * r.y, scale * r.width, scale * r.height};
  }
  /// Number of pixels of a window with a colour.
  size_t count(const wxImage& screen, const wxWindow& window, int red, int green, int blue) const {
    const wxRect area = onScreen({window.ClientToScreen(wxPoint(0, 0)), window.GetClientSize()});
    size_t found = 0;
    for (int y = area.GetTop(); y <= area.GetBottom(); ++y)
      for (int x = area.GetLeft(); x <= area.GetRight(); ++x)
        found += std::abs(screen.GetRed(x, y) - red) < 40 && std::abs(screen.GetGreen(x, y) - green) < 40 &&
                         std::abs(screen.GetBlue(x, y) - blue) < 40
                     ? 1
                     : 0;
    return found;
  }
  /// The grey of the screen at a place of the map.
  int greyAt(const wxImage& screen, const window::MapCanvas& canvas, double x, double y) const {
    const auto at = canvas.view().toPicture(x, y, canvas.size());
    const wxPoint p =
        onScreen({canvas.ClientToScreen(wxPoint(wxRound(at.x), wxRound(at.y))), wxSize(1, 1)}).GetTopLeft();
    return screen.GetRed(p.x, p.y);
  }

  /// 60 scans of laps.
  void publishLaps(
      live::ObservationServer& server, const std::function<void(size_t)>& after = [](size_t) {}) {
    const test::Log all = test::laps(60);
    for (size_t i = 0; i + 1 < all.size(); i += 2) {
      mrpt::obs::CSensoryFrame cycle;
      for (const size_t j : {i, i + 1})
        cycle.insert(std::dynamic_pointer_cast<mrpt::obs::CObservation>(all[j]));
      server.publish(cycle);
      settle(0.03);
      after(i);
    }
  }
  std::string status(int field) { return frame->GetStatusBar()->GetStatusText(field).utf8_string(); }

  files::TemporaryFolder folder;
  Dialogs dialogs;
  window::MainFrame* frame = nullptr;
  std::string ini, log;
};

TEST_F(GuiTest, ReplayShowsBothMapsWhereTheyAre) {
  frame->open(ini, log);
  ASSERT_TRUE(stands(State::paused, 0));
  menu(window::kStep);
  ASSERT_TRUE(stands(State::paused, 1));
  frame->replay()->seek(60);
  ASSERT_TRUE(stands(State::ended, 60));
  ASSERT_TRUE(happens([&] { return frame->replay()->canvas(1)->shown() == now().filters.at(1); }));
  const wxImage screen = screenshot("room");
  for (size_t i : {0, 1}) {
    const window::MapCanvas& canvas = *frame->replay()->canvas(i);
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
    EXPECT_GT(wall, 100u);
    EXPECT_GT(free, 1000u);
    EXPECT_GT(wallSeen, wall * 8 / 10);  // lines, path and caption cover some
    EXPECT_GT(freeSeen, free * 8 / 10);
    EXPECT_GT(count(screen, canvas, 220, 0, 0), 50u) << "path and particles";
    EXPECT_GT(count(screen, canvas, 80, 180, 255), 30u) << "robot";
  }
  EXPECT_GT(count(screen, *frame->replay()->canvas(0), 0, 70, 230), 200u) << "matched lines of the scan";
  EXPECT_EQ(count(screen, *frame->replay()->canvas(1), 0, 70, 230), 0u) << "the general filter has none";

  menu(window::kScanLines);
  EXPECT_EQ(count(screenshot("room-without-scan-lines"), *frame->replay()->canvas(0), 0, 70, 230), 0u);
}

TEST_F(GuiTest, ReplayOfTheSimulatedBuilding) {
  frame->open(SOURCE_DIR "/config-ini/csie-lms100.ini", SOURCE_DIR "/datasets/csie/csie-loop.rawlog");
  ASSERT_TRUE(stands(State::paused, 0));
  const size_t target = now().total * 6 / 10;
  frame->replay()->seek(target);
  ASSERT_TRUE(stands(State::paused, target));
  ASSERT_TRUE(happens([&] { return frame->replay()->canvas(1)->shown() == now().filters.at(1); }));
  const wxImage screen = screenshot("replay");
  EXPECT_GT(count(screen, *frame->replay()->canvas(0), 0, 150, 0), 300u) << "the line database";
  EXPECT_GT(count(screen, *frame->replay()->canvas(1), 255, 255, 255), 3000u) << "free space";
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
  for (const char* const name : {"/proc/nowhere/map.png", "/proc/nowhere/map.3Dscene"})
    EXPECT_THROW(frame->exportPictureTo(name), InputError) << name;
  menu(window::kExportPicture);  // cancelled
  EXPECT_EQ(dialogs.messages.size(), 1u);

  frame->exportResultsTo(folder.path("out"));
  ASSERT_TRUE(happens([&] { return dialogs.messages.size() == 2; }));
  EXPECT_THAT(dialogs.messages.back(), HasSubstr("Results of 40 scans"));
  for (const char* name : {"hybrid/trajectory.tum", "general/trajectory.tum", "hybrid/lines.csv"})
    EXPECT_FALSE(test::contentOf(folder.path(std::string("out/") + name)).empty()) << name;
}

TEST_F(GuiTest, SavesTheMapAndTheReplayGoesOn) {
  menu(window::kSaveMap);
  ASSERT_EQ(dialogs.messages.size(), 1u);
  EXPECT_THAT(dialogs.messages.back(), HasSubstr("no log is open"));
  frame->open(ini, log);
  frame->replay()->seek(40);
  ASSERT_TRUE(stands(State::paused, 40));
  frame->saveReplayMapTo(folder.path("maps"));
  ASSERT_TRUE(happens([&] { return status(0) == "map saved: " + folder.path("maps"); })) << status(0);
  EXPECT_TRUE(std::filesystem::exists(folder.path("maps/hybrid/session.hslam")));
  frame->replay()->seek(60);
  ASSERT_TRUE(stands(State::ended, 60));
  EXPECT_EQ(now().run, 1u);

  frame->useMap({window::MapChoice::Use::localise, folder.path("maps/hybrid/session.hslam"),
                 mrpt::math::TPose2D(0, 0, 0)});
  frame->replay()->seek(60);
  ASSERT_TRUE(stands(State::ended, 60));
  ASSERT_TRUE(happens([&] { return status(1) == "localised"; })) << status(1);
  frame->applyChanges({"particle_filter.particles=9"});
  EXPECT_EQ(frame->settings()->map().use, window::MapChoice::Use::localise) << "in the same map";
  frame->useMap({});
  ASSERT_TRUE(stands(State::paused, 0));
  frame->replay()->seek(2);
  ASSERT_TRUE(happens([&] { return status(1).empty(); })) << "a new map";
  EXPECT_EQ(dialogs.messages.size(), 1u);
}

TEST_F(GuiTest, ShowsTheSearchForTheStartInTheMapOfAnEarlierRun) {
  const std::string building = SOURCE_DIR "/config-ini/csie-lms100.ini";
  run::Configuration earlier(building, {"run.rawlog=" SOURCE_DIR "/datasets/csie/csie-loop.rawlog",
                                        "run.output=" + folder.path("earlier")});
  const std::atomic<bool> stop{false};
  run::replay(earlier, true, stop);
  const std::string session = folder.path("earlier/session.hslam");
  frame->open(building, SOURCE_DIR "/datasets/csie/csie-corridor.rawlog",
              {window::MapChoice::Use::localise, session, {}});
  ASSERT_TRUE(stands(State::paused, 0));
  const window::MapCanvas& canvas = *frame->replay()->canvas(0);
  const auto shows = [&](size_t scan) {
    frame->replay()->seek(scan);
    return stands(State::paused, scan) &&
           happens([&] { return canvas.shown() && canvas.shown() == now().filters.at(0); });
  };
  ASSERT_TRUE(shows(1));
  EXPECT_THAT(status(1), testing::MatchesRegex("searching the start: [0-9]+ hypotheses"));
  const wxImage searching = screenshot("searching");
  EXPECT_EQ(count(searching, canvas, 80, 180, 255), 0u) << "no robot yet";
  EXPECT_GT(count(searching, canvas, 220, 0, 0), 300u) << "hypotheses";
  size_t scan = 1;
  while (!canvas.shown()->place->isKnown && scan + 10 < now().total) ASSERT_TRUE(shows(scan += 10));
  ASSERT_TRUE(canvas.shown()->place->isKnown);
  ASSERT_TRUE(shows(scan += 100));
  const wxImage found = screenshot("localised");
  EXPECT_EQ(status(1), "localised");
  EXPECT_GT(count(found, canvas, 80, 180, 255), 20u) << "robot";
}

TEST_F(GuiTest, AsksForTheMapOfAnEarlierRun) {
  using window::MapChoice;
  window::MapDialog dialog(frame, {});
  EXPECT_EQ(dialog.choice().use, MapChoice::Use::none);
  const std::string map = folder.write("map.yaml", "image: map.pgm\n");
  for (wxWindow* child : dialog.GetChildren())
    if (auto* const picker = dynamic_cast<wxFilePickerCtrl*>(child)) {
      picker->SetPath(wxString::FromUTF8(map));
      wxFileDirPickerEvent chosen(wxEVT_FILEPICKER_CHANGED, picker, picker->GetId(), picker->GetPath());
      picker->ProcessWindowEvent(chosen);
    }
  EXPECT_EQ(dialog.choice().use, MapChoice::Use::mapOn) << "a map that is opened is used";
  dialog.set({MapChoice::Use::mapOn, map, mrpt::math::TPose2D(1.5, -2, M_PI / 2)});
  dialog.Show();
  screenshot("map");
  EXPECT_EQ(dialog.choice().use, MapChoice::Use::mapOn);
  EXPECT_EQ(dialog.choice().file, map);
  EXPECT_NEAR(dialog.choice().start->x, 1.5, 1e-9);
  EXPECT_NEAR(dialog.choice().start->phi, M_PI / 2, 1e-9);
  dialog.set({MapChoice::Use::localise, map, {}});
  EXPECT_FALSE(dialog.choice().start) << "searched for";
  dialog.set({MapChoice::Use::localise, folder.path("missing.hslam"), {}});
  EXPECT_THROW(dialog.choice(), InputError);
  EXPECT_NEAR(window::MapDialog::startOf("1,-2, 30")->y, -2, 1e-9);
  for (const char* wrong : {"1, 2", "1 2 3", "a, b, c", "1, 2, 3, 4", "1e9, 0, 0", "nan, 0, 0"})
    EXPECT_THROW(window::MapDialog::startOf(wrong), InputError) << wrong;
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
  auto* const grid = dynamic_cast<wxPropertyGrid*>(dialog.GetChildren().front());
  ASSERT_NE(grid, nullptr);
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
  frame->live()->connectOrStop();
  ASSERT_EQ(dialogs.messages.size(), 1u);
  EXPECT_THAT(dialogs.messages[0], HasSubstr("open an INI file first"));
  frame->open(ini, log);
  ASSERT_TRUE(stands(State::paused, 0));
  test::Events events;
  live::ObservationServer server("127.0.0.1", 0, {}, events.log());
  frame->live()->setServer("127.0.0.1");
  frame->live()->connectOrStop();
  ASSERT_EQ(dialogs.messages.size(), 2u);
  EXPECT_THAT(dialogs.messages[1], HasSubstr("HOST:PORT"));

  frame->live()->setServer("127.0.0.1:" + std::to_string(server.port()));
  frame->live()->setOutput(folder.path("live"));
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([&] { return server.clients() == 1; }));
  ASSERT_NE(frame->replay()->session(), nullptr) << "a replay goes on beside it";
  frame->replay()->seek(60);
  publishLaps(server, [&](size_t i) {
    if (i == 60) menu(window::kSaveMap);
  });
  ASSERT_TRUE(happens([&] { return status(0).find("map saved: ") != std::string::npos; })) << status(0);
  EXPECT_THAT(status(0), HasSubstr(folder.path("live/saved-20")));
  ASSERT_TRUE(happens([&] { return frame->live()->canvas()->shown() != nullptr; }));
  const wxImage screen = screenshot("live");
  EXPECT_GT(count(screen, *frame->live()->canvas(), 255, 255, 255), 10000u);
  EXPECT_GT(count(screen, *frame->live()->canvas(), 80, 180, 255), 30u) << "robot";
  EXPECT_GT(count(screen, *frame->live()->canvas(), 220, 0, 0), 30u) << "path and particles";
  menu(window::kPath);
  menu(window::kParticles);
  EXPECT_EQ(count(screenshot("live-without-path"), *frame->live()->canvas(), 220, 0, 0), 0u);
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([&] { return dialogs.messages.size() == 3; }));
  EXPECT_THAT(dialogs.messages[2], HasSubstr("recording-20"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("live/map.png")));
  EXPECT_TRUE(stands(State::ended, 60));
}

TEST_F(GuiTest, LivePageLocalisesInTheMapOfAnEarlierRun) {
  frame->open(ini, log);
  frame->replay()->seek(60);
  ASSERT_TRUE(stands(State::ended, 60));
  frame->saveReplayMapTo(folder.path("maps"));
  ASSERT_TRUE(happens([&] { return status(0) == "map saved: " + folder.path("maps"); })) << status(0);
  frame->useMap({window::MapChoice::Use::localise, folder.path("maps/hybrid/session.hslam"),
                 mrpt::math::TPose2D(0, 0, 0)});

  menu(window::kLivePage);
  test::Events events;
  live::ObservationServer server("127.0.0.1", 0, {}, events.log());
  frame->live()->setServer("127.0.0.1:" + std::to_string(server.port()));
  frame->live()->setOutput(folder.path("live"));
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([&] { return server.clients() == 1; }));
  publishLaps(server);
  EXPECT_TRUE(happens([&] { return status(1) == "localised"; })) << status(1);
  frame->live()->connectOrStop();
  ASSERT_TRUE(happens([&] { return dialogs.messages.size() == 1; }));
  EXPECT_THAT(dialogs.messages[0], HasSubstr("recording-20"));
  EXPECT_TRUE(std::filesystem::exists(folder.path("live/trajectory.tum")));
  EXPECT_FALSE(std::filesystem::exists(folder.path("live/map.pgm"))) << "the map is not this run's";
}

}  // namespace
}  // namespace hybrid_slam

/// wxWidgets without its main loop: the tests run it.
int main(int argc, char** argv) {
  testing::InitGoogleTest(&argc, argv);
  wxApp::SetInstance(new wxApp);
  if (!wxEntryStart(argc, argv)) return 1;
  wxInitAllImageHandlers();
  wxGUIEventLoop loop;
  const wxEventLoopActivator active(&loop);
  return RUN_ALL_TESTS();
}
