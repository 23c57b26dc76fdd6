/// The window: maps saved while it runs, and maps of earlier runs.
#include "GuiTest.h"

namespace hybrid_slam {
namespace {

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
  EXPECT_THAT(status(1), testing::MatchesRegex("start unknown: [0-9]+ hypotheses"));
  wxImage searching;
  EXPECT_TRUE(screenShows("searching", [&](const wxImage& screen) {
    searching = screen;
    return count(screen, canvas, 220, 0, 0) > 300;
  })) << "hypotheses";
  EXPECT_EQ(count(searching, canvas, 80, 180, 255), 0u) << "no robot yet";
  size_t scan = 1;
  while (!canvas.shown()->place->isKnown && scan + 10 < now().total) ASSERT_TRUE(shows(scan += 10));
  ASSERT_TRUE(canvas.shown()->place->isKnown);
  ASSERT_TRUE(shows(scan += 100));
  EXPECT_TRUE(happens([&] { return status(1) == "localised"; })) << status(1);
  EXPECT_TRUE(screenShows("localised", [&](const wxImage& screen) {
    return count(screen, canvas, 80, 180, 255) > 20;
  })) << "robot";
}

/// The window begins with a floor plan, like `--prior-plan`.
TEST_F(GuiTest, BeginsWithAFloorPlan) {
  using window::MapChoice;
  run::RunOptions options;
  options.priorPlan = folder.write(
      "room.geojson",
      R"({"features":[{"geometry":{"type":"LineString","coordinates":[[-5,-3],[5,-3],[5,3],[-5,3],[-5,-3]]}}]})");
  options.start = test::poseOnLap(0, 80);
  frame->open(ini, log, MapChoice::of(options));
  frame->applyChanges({"particle_filter.particles=9"});
  EXPECT_EQ(frame->settings()->map().use, MapChoice::Use::plan);
  EXPECT_EQ(frame->settings()->map().file, options.priorPlan);
  frame->replay()->seek(60);
  ASSERT_TRUE(stands(State::ended, 60));
  ASSERT_TRUE(happens([&] { return frame->replay()->canvas(0)->shown() != nullptr; }));
  EXPECT_THAT(now().events,
              testing::Contains(testing::AllOf(HasSubstr("place found"), HasSubstr(options.priorPlan))));
  const auto end = frame->replay()->canvas(0)->shown()->path.back(), truth = test::poseOnLap(59, 80);
  EXPECT_LT((end - truth).norm(), 0.5) << "in the frame of the plan";
  EXPECT_TRUE(dialogs.messages.empty()) << "the general filter maps without it";
  frame->useMap({});
  EXPECT_EQ(frame->settings()->map().use, MapChoice::Use::none);
}

TEST_F(GuiTest, AsksForTheMapOfAnEarlierRun) {
  using window::MapChoice;
  window::MapDialog dialog(frame, {});
  EXPECT_EQ(dialog.choice().use, MapChoice::Use::none);
  const std::string map = folder.write("map.yaml", "image: map.pgm\n");
  const std::string plan = folder.write("plan.dxf", "");
  const auto pick = [&](const std::string& file) {
    for (wxWindow* child : dialog.GetChildren())
      if (auto* const picker = dynamic_cast<wxFilePickerCtrl*>(child)) {
        picker->SetPath(wxString::FromUTF8(file));
        wxFileDirPickerEvent chosen(wxEVT_FILEPICKER_CHANGED, picker, picker->GetId(), picker->GetPath());
        picker->ProcessWindowEvent(chosen);
      }
  };
  pick(plan);
  EXPECT_EQ(dialog.choice().use, MapChoice::Use::plan);
  EXPECT_EQ(dialog.choice().file, plan);
  pick(map);
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
  connectTo(server);
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
