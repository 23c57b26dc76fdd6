#include "window/gui/MenuBar.h"

#include <utility>

#include "window/gui/HelpPages.h"

namespace hybrid_slam::window {
namespace {

wxMenu* fileMenu() {
  auto* const file = new wxMenu;
  file->Append(kOpenLog, "Open &log...\tCtrl+R", "Replays a log, from which settings are derived");
  file->Append(kOpenFolder, "Open recording f&older...\tCtrl+Shift+R",
               "Replays a ROS 2 bag, which is a folder of .db3 or .mcap files");
  file->Append(kOpenIni, "Open &INI file...\tCtrl+O", "Settings, and the log they name");
  file->Append(kOpenMap, "Open &map, session or plan...\tCtrl+M",
               "Continues or localises in the map of an earlier run, or begins with a floor plan");
  file->Append(kRecentFiles, "Recent &files", new wxMenu, "Logs and INI files opened last");
  file->Append(kSaveIni, "&Save settings as INI...\tCtrl+S", "Every key with its value");
  file->AppendSeparator();
  file->Append(kSaveMap, "Save map &now...\tCtrl+Shift+S", "Saves map and session; the run continues");
  file->Append(kExportPicture, "Export &picture...\tCtrl+P", "The left pane's map as PNG or scene");
  file->Append(kExportResults, "&Export results...\tCtrl+E",
               "Writes them as hybrid-slam does; ends the replay");
  file->AppendSeparator();
  file->Append(wxID_EXIT, "&Quit\tCtrl+Q");
  return file;
}

wxMenu* replayMenu() {
  auto* const replay = new wxMenu;
  replay->Append(kPlay, "&Play or pause\tF5", "Also the space bar");
  replay->Append(kStep, "&Step\tF6", "One scan forward; also the right arrow");
  replay->Append(kStepBack, "Step &back\tShift+F6", "One scan back; also the left arrow");
  replay->Append(kRestart, "&Restart\tF7", "Back to before the first scan");
  replay->Append(kSeek, "&Go to scan...\tCtrl+G", "Forward or back, at full speed");
  replay->Append(kFaster, "&Faster\tCtrl+Up");
  replay->Append(kSlower, "S&lower\tCtrl+Down");
  replay->AppendSeparator();
  replay->Append(kParameters, "P&arameters...\tF4", "All settings, with their meaning");
  return replay;
}

wxMenu* viewMenu() {
  auto* const view = new wxMenu;
  view->Append(kZoomIn, "Zoom &in\tCtrl++");
  view->Append(kZoomOut, "Zoom &out\tCtrl+-");
  view->Append(kFit, "&Whole map\tCtrl+0");
  view->AppendSeparator();
  for (const auto& [id, name] :
       std::initializer_list<std::pair<int, const char*>>{{kGeneral, "Show &second filter\tCtrl+1"},
                                                          {kParticles, "&Particles\tCtrl+2"},
                                                          {kPath, "P&ath\tCtrl+3"},
                                                          {kLines, "&Lines and direction\tCtrl+4"},
                                                          {kScanLines, "Lines of the &scan\tCtrl+5"},
                                                          {kEllipse, "&Uncertainty\tCtrl+6"},
                                                          {kLegend, "Le&gend and scale bar\tCtrl+7"}})
    view->AppendCheckItem(id, name)->Check();
  view->AppendSeparator();
  view->Append(kReplayPage, "&Replay\tAlt+1");
  view->Append(kLivePage, "Li&ve\tAlt+2");
  return view;
}

wxMenu* helpMenu() {
  auto* const help = new wxMenu;
  help->Append(kWhatIsThis, "&What is this?\tShift+F1", "Then click on a part of the window");
  help->AppendSeparator();
  int command = kFirstPage;
  for (const HelpPage& page : helpPages()) help->Append(command++, page.entry, page.page);
  help->AppendSeparator();
  help->Append(wxID_ABOUT);
  return help;
}

}  // namespace

wxMenuBar* makeMenuBar() {
  auto* const bar = new wxMenuBar;
  bar->Append(fileMenu(), "&File");
  bar->Append(replayMenu(), "&Replay");
  bar->Append(viewMenu(), "&View");
  bar->Append(helpMenu(), "&Help");
  return bar;
}

}  // namespace hybrid_slam::window
