#include "window/gui/MainFrame.h"

#include <wx/dirdlg.h>
#include <wx/filedlg.h>
#include <wx/menu.h>
#include <wx/numdlg.h>

#include <clocale>
#include <filesystem>
#include <functional>

#include "base/Errors.h"
#include "files/InstalledFiles.h"
#include "files/OutputFolder.h"
#include "files/PartialFile.h"
#include "window/gui/MapDialog.h"
#include "window/gui/Messages.h"
#include "window/gui/ParametersDialog.h"

namespace hybrid_slam::window {
namespace {

constexpr int kRefreshInterval = 40;  // ms

/// Runs a menu action; errors are shown in a dialog.
template <class Action>
void orTell(wxWindow* parent, const Action& action) {
  try {
    action();
  } catch (const std::exception& e) {
    showError(parent, messageOf(e));
  }
}

}  // namespace

MainFrame::MainFrame() : wxFrame(nullptr, wxID_ANY, "hybrid-slam"), timer_(this) {
  // GTK sets the user's locale, in which MRPT could read 0.5 as 0.
  std::setlocale(LC_NUMERIC, "C");
  SetSize(FromDIP(wxSize(1240, 760)));
  SetMinSize(FromDIP(wxSize(800, 560)));
  pages_ = new wxNotebook(this, wxID_ANY);
  replay_ = new ReplayPage(pages_);
  live_ = new LivePage(pages_);
  pages_->AddPage(replay_, "Replay");
  pages_->AddPage(live_, "Live");
  CreateStatusBar(2);
  makeMenus();
  bindFileMenu();
  bindReplayMenu();
  bindViewMenu();
  Bind(wxEVT_TIMER, [this](wxTimerEvent&) {
    replay_->refresh();
    live_->refresh();
    showState();
  });
  timer_.Start(kRefreshInterval);
}

void MainFrame::makeMenus() {
  auto* const file = new wxMenu;
  file->Append(kOpenIni, "Open &INI file...\tCtrl+O");
  file->Append(kOpenRawlog, "Open &rawlog...\tCtrl+R");
  file->Append(kOpenMap, "Open &map...\tCtrl+M", "Maps on, or localises, in the map of an earlier run");
  file->Append(kSaveIni, "&Save settings as INI...\tCtrl+S");
  file->AppendSeparator();
  file->Append(kSaveMap, "Save map &now...\tCtrl+Shift+S", "Saves map and session; the run goes on");
  file->Append(kExportPicture, "Export &picture...\tCtrl+P");
  file->Append(kExportResults, "&Export results...\tCtrl+E",
               "Writes them as hybrid-slam does; ends the replay");
  file->AppendSeparator();
  file->Append(wxID_EXIT, "&Quit\tCtrl+Q");

  auto* const replay = new wxMenu;
  replay->Append(kPlay, "&Play or pause\tF5");
  replay->Append(kStep, "&Step\tF6", "One scan forward");
  replay->Append(kRestart, "&Restart\tF7", "Back to before the first scan");
  replay->Append(kSeek, "&Go to scan...\tCtrl+G", "Going back restarts the replay");
  replay->Append(kFaster, "&Faster\tCtrl+Up");
  replay->Append(kSlower, "S&lower\tCtrl+Down");
  replay->AppendSeparator();
  replay->Append(kParameters, "P&arameters...\tF4");

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
                                                          {kEllipse, "&Uncertainty\tCtrl+6"}})
    view->AppendCheckItem(id, name)->Check();
  view->AppendSeparator();
  view->Append(kReplayPage, "&Replay\tAlt+1");
  view->Append(kLivePage, "Li&ve\tAlt+2");

  auto* const help = new wxMenu;
  help->Append(wxID_ABOUT);
  auto* const bar = new wxMenuBar;
  bar->Append(file, "&File");
  bar->Append(replay, "&Replay");
  bar->Append(view, "&View");
  bar->Append(help, "&Help");
  SetMenuBar(bar);
}

void MainFrame::bindFileMenu() {
  const auto bind = [this](int id, void (MainFrame::*action)()) {
    Bind(
        wxEVT_MENU, [this, action](wxCommandEvent&) { orTell(this, [&] { (this->*action)(); }); }, id);
  };
  bind(kOpenIni, &MainFrame::openIni);
  bind(kOpenRawlog, &MainFrame::openRawlog);
  bind(kSaveIni, &MainFrame::saveIni);
  bind(kExportPicture, &MainFrame::exportPicture);
  bind(kExportResults, &MainFrame::exportResults);
  bind(kOpenMap, &MainFrame::openMap);
  bind(kSaveMap, &MainFrame::saveMap);
  bind(kSeek, &MainFrame::askForScan);
  bind(kParameters, &MainFrame::editParameters);
  Bind(
      wxEVT_MENU, [this](wxCommandEvent&) { Close(); }, wxID_EXIT);
  Bind(
      wxEVT_MENU,
      [this](wxCommandEvent&) {
        showNotice(this, files::withInstalledPages(
                             "hybrid-slam-gui " HYBRID_SLAM_VERSION
                             ": grid maps with line directions, on MRPT. Keys are in the menus; more in "
                             "doc/gui.md."));
      },
      wxID_ABOUT);
}

void MainFrame::bindReplayMenu() {
  const auto bind = [this](int id, const std::function<void()>& action) {
    Bind(
        wxEVT_MENU, [action](wxCommandEvent&) { action(); }, id);
  };
  bind(kPlay, [this] { replay_->playOrPause(); });
  bind(kStep, [this] { replay_->step(); });
  bind(kRestart, [this] { replay_->restart(); });
  bind(kFaster, [this] { replay_->faster(1); });
  bind(kSlower, [this] { replay_->faster(-1); });
}

void MainFrame::bindViewMenu() {
  const auto bind = [this](int id, const std::function<void()>& action) {
    Bind(
        wxEVT_MENU, [action](wxCommandEvent&) { action(); }, id);
  };
  const auto canvas = [this] { return pages_->GetSelection() == 0 ? replay_->canvas(0) : live_->canvas(); };
  bind(kZoomIn, [canvas] { canvas()->zoom(1.25); });
  bind(kZoomOut, [canvas] { canvas()->zoom(0.8); });
  bind(kFit, [this] { pages_->GetSelection() == 0 ? replay_->fit() : live_->fit(); });
  for (const auto& [id, layer] :
       std::initializer_list<std::pair<int, bool Layers::*>>{{kParticles, &Layers::particles},
                                                             {kPath, &Layers::path},
                                                             {kLines, &Layers::lines},
                                                             {kScanLines, &Layers::scanLines},
                                                             {kEllipse, &Layers::ellipse}})
    bind(id, [this, layer = layer] {
      replay_->toggle(layer);
      live_->toggle(layer);
    });
  bind(kReplayPage, [this] { pages_->SetSelection(0); });
  bind(kLivePage, [this] { pages_->SetSelection(1); });
  Bind(
      wxEVT_MENU, [this](wxCommandEvent& event) { replay_->showGeneral(event.IsChecked()); }, kGeneral);
}

void MainFrame::open(const std::string& ini, const std::string& rawlog, const MapChoice& map,
                     const std::vector<std::string>& changes) {
  orTell(this, [&] {
    std::vector<std::string> all = changes;
    if (!rawlog.empty()) all.push_back("run.rawlog=" + rawlog);
    use(Settings::fromFile(ini, all)->inMap(map));
  });
}

void MainFrame::useMap(const MapChoice& map) {
  use((settings_ ? settings_ : Settings::fromFile(""))->inMap(map));
}

void MainFrame::applyChanges(const std::vector<std::string>& changes) {
  if (settings_ && !changes.empty()) orTell(this, [&] { use(settings_->copy(changes)); });
}

void MainFrame::use(const std::shared_ptr<Settings>& settings) {
  settings_ = settings;
  live_->setSettings(settings);
  const std::string& rawlog = settings->configuration.run.rawlog;
  SetTitle("hybrid-slam: " +
           (rawlog.empty() ? "no rawlog" : std::filesystem::path(rawlog).filename().string()));
  if (rawlog.empty()) return;
  if (live_->isRunning()) throw InputError("a live run is in progress", rawlog, "stop it first: Live, Stop");
  replay_->open(settings->configuration);
}

void MainFrame::openIni() {
  wxFileDialog dialog(this, "Open INI file", "", "", "INI files (*.ini)|*.ini|All files|*",
                      wxFD_OPEN | wxFD_FILE_MUST_EXIST);
  if (dialog.ShowModal() == wxID_OK) use(Settings::fromFile(dialog.GetPath().utf8_string()));
}

void MainFrame::openRawlog() {
  wxFileDialog dialog(
      this, "Open log", "", "",
      "Logs (*.rawlog, *.clf, *.gfs, *.log, *.gz)|*.rawlog;*.clf;*.gfs;*.log;*.gz|All files|*",
      wxFD_OPEN | wxFD_FILE_MUST_EXIST);
  if (dialog.ShowModal() != wxID_OK) return;
  const std::vector<std::string> changes{"run.rawlog=" + dialog.GetPath().utf8_string()};
  use(settings_ ? settings_->copy(changes) : Settings::fromFile("", changes));
}

void MainFrame::saveIni() {
  if (!settings_)
    throw InputError("no settings", "nothing to save", "open an INI file first: File, Open INI file");
  wxFileDialog dialog(this, "Save settings", "", "settings.ini", "INI files (*.ini)|*.ini",
                      wxFD_SAVE | wxFD_OVERWRITE_PROMPT);
  if (dialog.ShowModal() == wxID_OK) saveIniTo(dialog.GetPath().utf8_string());
}

void MainFrame::saveIniTo(const std::string& file) const {
  const std::filesystem::path path = file;
  const std::string text = settings_->copy()->configuration.text();
  files::OutputFolder(path.has_parent_path() ? path.parent_path().string() : ".")
      .write(path.filename().string(), [&](std::ostream& out) { out << text; });
}

std::shared_ptr<const FilterSnapshot> MainFrame::shownFilter() const {
  const auto shown = pages_->GetSelection() == 0 ? replay_->canvas(0)->shown() : live_->canvas()->shown();
  if (!shown) throw InputError("no picture yet", "before the first scan", "play or step the log first");
  return shown;
}

void MainFrame::exportPicture() {
  shownFilter();
  wxFileDialog dialog(this, "Export picture", "", "map.png",
                      "PNG (*.png)|*.png|Scene for SceneViewer3D (*.3Dscene)|*.3Dscene",
                      wxFD_SAVE | wxFD_OVERWRITE_PROMPT);
  if (dialog.ShowModal() == wxID_OK) exportPictureTo(dialog.GetPath().utf8_string());
}

void MainFrame::exportPictureTo(const std::string& file) const {
  constexpr PictureSize kSize{1600, 1200};
  const auto filter = shownFilter();
  files::PartialFile partial(file);
  const bool isScene = std::filesystem::path(file).extension() == ".3Dscene";
  const bool isWritten =
      isScene ? filterScene(*filter, mapPlane(filter->map), wholeMap(filter->map, kSize), {}, kSize)
                    ->saveToFile(partial.path())
              : pictureOf(*filter, kSize, {}).saveToFile(partial.path());
  if (!isWritten) partial.fail(0);
  partial.commit();
}

void MainFrame::exportResults() {
  if (!replay_->session()) throw InputError("no results yet", "no log is open", "open a rawlog and play it");
  wxDirDialog dialog(this, "Folder for the results (hybrid/ and general/ in it)");
  if (dialog.ShowModal() == wxID_OK) exportResultsTo(dialog.GetPath().utf8_string());
}

void MainFrame::exportResultsTo(const std::string& folder) { replay_->session()->exportResults(folder); }

void MainFrame::openMap() {
  MapDialog dialog(this, settings_ ? settings_->map() : MapChoice());
  if (dialog.ShowModal() == wxID_OK) useMap(dialog.choice());
}

void MainFrame::saveMap() {
  if (pages_->GetSelection() == 1) {
    if (!live_->isRunning()) throw InputError("no map yet", "the live view", "connect first");
    return live_->session()->saveMap();
  }
  if (!replay_->session()) throw InputError("no map yet", "no log is open", "open a rawlog and play it");
  wxDirDialog dialog(this, "Folder for the maps (hybrid/ and general/ in it)");
  if (dialog.ShowModal() == wxID_OK) saveReplayMapTo(dialog.GetPath().utf8_string());
}

void MainFrame::saveReplayMapTo(const std::string& folder) { replay_->session()->saveMap(folder); }

/// The newest event on the left, the place in the map of an earlier run on the right.
void MainFrame::showState() {
  const bool isReplay = pages_->GetSelection() == 0;
  const auto note = wxString::FromUTF8(isReplay ? replay_->note() : live_->note());
  if (note != note_) SetStatusText(note_ = note);
  const auto& shown = isReplay ? replay_->canvas(0)->shown() : live_->canvas()->shown();
  const auto place = wxString::FromUTF8(shown && shown->place ? describe(*shown->place) : "");
  if (place != GetStatusBar()->GetStatusText(1)) SetStatusText(place, 1);
}

void MainFrame::askForScan() {
  if (!replay_->session()) throw InputError("no log", "the replay", "open a rawlog first: File, Open rawlog");
  const auto now = replay_->session()->snapshot();
  const long scan = wxGetNumberFromUser("", "Scan", "Go to scan", static_cast<long>(now->scans), 0,
                                        static_cast<long>(now->total), this);
  if (scan >= 0) replay_->seek(static_cast<size_t>(scan));
}

void MainFrame::editParameters() {
  if (!settings_)
    throw InputError("no settings", "the replay", "open an INI file first: File, Open INI file");
  ParametersDialog dialog(this, *settings_);
  if (dialog.ShowModal() == wxID_OK) applyChanges(dialog.changes());
}

}  // namespace hybrid_slam::window
