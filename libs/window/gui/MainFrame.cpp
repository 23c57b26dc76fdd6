#include "window/gui/MainFrame.h"

#include <wx/cshelp.h>
#include <wx/display.h>
#include <wx/numdlg.h>

#include <clocale>
#include <functional>

#include "base/Errors.h"
#include "window/gui/HelpPages.h"
#include "window/gui/MessageDialogs.h"
#include "window/gui/ParametersDialog.h"
#include "window/gui/PlayerKeys.h"

namespace hybrid_slam::window {
namespace {

constexpr int kRefreshInterval = 40;  // ms

/// Returns 1240 x 720, or less if the screen has no room for this and title bar, menus and status bar.
wxSize startSize() {
  wxSize size = wxWindow::FromDIP(wxSize(1240, 720), nullptr);
  const wxSize border = wxWindow::FromDIP(wxSize(20, 120), nullptr);
  size.DecTo(wxDisplay(0u).GetClientArea().GetSize() - border);
  return size;
}

}  // namespace

MainFrame::MainFrame()
    : wxFrame(nullptr, wxID_ANY, "hybrid-slam"), settings_(Settings::fromFile("")), timer_(this) {
  // GTK sets the user's locale, in which MRPT could read 0.5 as 0.
  std::setlocale(LC_NUMERIC, "C");
  const wxSize size = startSize();
  SetClientSize(size);  // else GTK lays the pages out in one pixel first, and complains
  wxSize least = FromDIP(wxSize(800, 560));
  least.DecTo(size);  // a least size above the window's makes GTK complain, too
  SetMinSize(least);
  pages_ = new wxNotebook(this, wxID_ANY);
  replay_ = new ReplayPage(pages_);
  live_ = new LivePage(pages_);
  pages_->AddPage(replay_, "Replay");
  pages_->AddPage(live_, "Live");
  CreateStatusBar(3);
  const int widths[] = {-3, -2, FromDIP(260)};
  SetStatusWidths(3, widths);
  SetMenuBar(makeMenuBar());
  recent_ = std::make_unique<RecentFiles>(GetMenuBar()->FindItem(kRecentFiles)->GetSubMenu());
  bindFileMenu();
  bindReplayMenu();
  bindViewMenu();
  bindHelpMenu();
  bindKeys();
  SetDropTarget(new FileDrop(*this));
  live_->setSettings(settings_);
  live_->setOnRecording([this](const std::string& recording) {
    if (replay_->session()) return;  // it has its own log
    orTell(this, [&] { openLog(recording); });
  });
  Centre();
  Bind(wxEVT_TIMER, [this](wxTimerEvent&) {
    replay_->refresh();
    followLog();
    live_->refresh();
    showState();
    enableCommands();
  });
  enableCommands();
  timer_.Start(kRefreshInterval);
  replay_->canvas(0)->SetFocus();
}

void MainFrame::bindFileMenu() {
  const auto bind = [this](int id, void (MainFrame::*action)()) {
    Bind(
        wxEVT_MENU, [this, action](wxCommandEvent&) { orTell(this, [&] { (this->*action)(); }); }, id);
  };
  bind(kOpenIni, &MainFrame::openIni);
  bind(kOpenLog, &MainFrame::openLog);
  bind(kOpenFolder, &MainFrame::openFolder);
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
      wxEVT_MENU, [this](wxCommandEvent& event) { orTell(this, [&] { openRecent(event.GetId()); }); },
      wxID_FILE1, wxID_FILE9);
}

void MainFrame::bindHelpMenu() {
  Bind(
      wxEVT_MENU, [this](wxCommandEvent&) { const wxContextHelp untilClick(this); }, kWhatIsThis);
  const auto& pages = helpPages();
  Bind(
      wxEVT_MENU,
      [this, &pages](wxCommandEvent& event) {
        const auto i = static_cast<size_t>(event.GetId() - kFirstPage);
        orTell(this, [&] { openPage(pages.at(i).page); });
      },
      kFirstPage, kFirstPage + static_cast<int>(pages.size()) - 1);
  Bind(
      wxEVT_MENU,
      [this](wxCommandEvent&) {
        showNotice(this, "hybrid-slam-gui " HYBRID_SLAM_VERSION
                         ": grid maps with line directions, on MRPT. Keys are in the menus; more in "
                         "doc/gui.md.");
      },
      wxID_ABOUT);
}

void MainFrame::bindKeys() {
  Bind(wxEVT_CHAR_HOOK, [this](wxKeyEvent& key) {
    const auto command = pages_->GetSelection() == 0 ? playerCommand(key) : std::nullopt;
    if (!command) return key.Skip();
    if (!GetMenuBar()->IsEnabled(*command)) return;
    wxCommandEvent event(wxEVT_MENU, *command);
    ProcessWindowEvent(event);
  });
}

/// Enables the commands that are possible, at once and not when a menu is opened: keys use the entries as
/// well.
void MainFrame::enableCommands() {
  const bool isPlayable = replay_->hasLog();
  const auto enable = [this](int command, bool isEnabled) {
    if (GetMenuBar()->IsEnabled(command) != isEnabled) GetMenuBar()->Enable(command, isEnabled);
  };
  for (const int command : {kPlay, kStep, kStepBack, kRestart, kSeek, kExportResults})
    enable(command, isPlayable);
  // Until the log has been read, it is not known which settings follow from it.
  for (const int command : {kParameters, kSaveIni}) enable(command, isPlayable || !replay_->session());
  enable(kSaveMap, isReplayShown() ? isPlayable : live_->isRunning());
  enable(kExportPicture, canvas()->shown() != nullptr);
  enable(kRecentFiles, !recent_->isEmpty());
}

void MainFrame::bindReplayMenu() {
  const auto bind = [this](int id, const std::function<void()>& action) {
    Bind(
        wxEVT_MENU, [action](wxCommandEvent&) { action(); }, id);
  };
  bind(kPlay, [this] { replay_->playOrPause(); });
  bind(kStep, [this] { replay_->step(); });
  bind(kStepBack, [this] { replay_->stepBack(); });
  bind(kRestart, [this] { replay_->restart(); });
  bind(kFaster, [this] { replay_->faster(1); });
  bind(kSlower, [this] { replay_->faster(-1); });
}

void MainFrame::bindViewMenu() {
  const auto bind = [this](int id, const std::function<void()>& action) {
    Bind(
        wxEVT_MENU, [action](wxCommandEvent&) { action(); }, id);
  };
  bind(kZoomIn, [this] { canvas()->zoom(1.25); });
  bind(kZoomOut, [this] { canvas()->zoom(0.8); });
  bind(kFit, [this] { isReplayShown() ? replay_->fit() : live_->fit(); });
  for (const auto& [id, layer] :
       std::initializer_list<std::pair<int, bool Layers::*>>{{kParticles, &Layers::particles},
                                                             {kPath, &Layers::path},
                                                             {kLines, &Layers::lines},
                                                             {kScanLines, &Layers::scanLines},
                                                             {kEllipse, &Layers::ellipse},
                                                             {kLegend, &Layers::legend}})
    bind(id, [this, layer = layer] {
      replay_->toggle(layer);
      live_->toggle(layer);
    });
  bind(kReplayPage, [this] { pages_->SetSelection(0); });
  bind(kLivePage, [this] { pages_->SetSelection(1); });
  Bind(
      wxEVT_MENU, [this](wxCommandEvent& event) { replay_->showGeneral(event.IsChecked()); }, kGeneral);
}

/// Shows the newest event, the place in an earlier map, and the cell under the mouse pointer.
void MainFrame::showState() {
  const auto note = wxString::FromUTF8(isReplayShown() ? replay_->note() : live_->note());
  if (note != note_) SetStatusText(note_ = note);
  const auto& shown = canvas()->shown();
  const auto place = wxString::FromUTF8(shown && shown->place ? describe(*shown->place) : "");
  if (place != GetStatusBar()->GetStatusText(1)) SetStatusText(place, 1);
  const auto cursor = wxString::FromUTF8(cursorText());
  if (cursor != GetStatusBar()->GetStatusText(2)) SetStatusText(cursor, 2);
}

std::string MainFrame::cursorText() const {
  if (!isReplayShown()) return live_->canvas()->cursorText();
  const std::string left = replay_->canvas(0)->cursorText();
  return left.empty() ? replay_->canvas(1)->cursorText() : left;
}

void MainFrame::askForScan() {
  if (!replay_->session()) throw InputError("no log", "the replay", "open a log first: File, Open log");
  const auto now = replay_->session()->snapshot();
  const long scan = wxGetNumberFromUser("", "Scan", "Go to scan", static_cast<long>(now->scans), 0,
                                        static_cast<long>(now->total), this);
  if (scan >= 0) replay_->seek(static_cast<size_t>(scan));
}

void MainFrame::editParameters() {
  ParametersDialog dialog(this, *settings_);
  if (dialog.ShowModal() == wxID_OK) applyChanges(dialog.changes(), dialog.resets());
}

}  // namespace hybrid_slam::window
