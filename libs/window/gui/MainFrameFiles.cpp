// What the menus do with files.
#include <wx/dirdlg.h>
#include <wx/filedlg.h>
#include <wx/filefn.h>

#include <filesystem>

#include "bags/Bag.h"
#include "base/Errors.h"
#include "files/IniFile.h"
#include "files/OutputFolder.h"
#include "files/PartialFile.h"
#include "readings/LogFormats.h"
#include "readings/LogReader.h"
#include "run/SessionFile.h"
#include "window/gui/MainFrame.h"
#include "window/gui/MapDialog.h"
#include "window/gui/MessageDialogs.h"

namespace hybrid_slam::window {
namespace {

/// Returns the filter of a file dialog for logs.
std::string logFilter() {
  std::string names;
  for (const std::string& ending : readings::logEndings()) names += (names.empty() ? "*" : ";*") + ending;
  return "Logs|" + names + "|All files|*";
}

/// Rejects a file that is no log, before it replaces the open one. A bag, of which all would be read, is left
/// to the replay.
void expectLog(const std::string& file) {
  if (run::isSession(file))
    throw InputError("a session, not a log", file, "expected a log; Ctrl+M takes sessions");
  if (!bags::isBag(file)) readings::LogReader(file).next();
}

/// Returns where a dialog for folders begins. GTK would begin in its list of recent folders, which takes only
/// the first key of a path that is typed.
wxString firstFolder() { return wxGetCwd(); }

}  // namespace

void MainFrame::open(const std::string& ini, const std::string& rawlog, const MapChoice& map,
                     const std::vector<std::string>& changes) {
  orTell(this, [&] {
    std::vector<std::string> all = changes;
    if (!rawlog.empty()) all.push_back("run.rawlog=" + rawlog);
    use(Settings::fromFile(ini, all)->inMap(map));
    if (!ini.empty()) recent_->add(ini);
  });
}

void MainFrame::useMap(const MapChoice& map) { use(settings_->inMap(map)); }

void MainFrame::applyChanges(const std::vector<std::string>& changes,
                             const std::vector<std::string>& resets) {
  if (!changes.empty() || !resets.empty()) orTell(this, [&] { use(settings_->copy(changes, resets)); });
}

void MainFrame::use(const std::shared_ptr<Settings>& settings) {
  const std::string& rawlog = settings->configuration.run.rawlog;
  if (!rawlog.empty() && live_->isRunning())
    throw InputError("a live run is in progress", rawlog, "stop it first: Live, Stop");
  settings_ = settings;
  live_->setSettings(settings);
  SetTitle("hybrid-slam: " + (rawlog.empty() ? "no log" : std::filesystem::path(rawlog).filename().string()));
  if (rawlog.empty()) return replay_->showWarnings(settings_->configuration.warnings);
  replay_->open(settings->configuration);
  enableCommands();
  recent_->add(rawlog);
}

/// Applies the settings that follow from the log, once the replay's thread has read it.
void MainFrame::followLog() {
  const auto read = replay_->ofLog();
  if (!read || read == followed_) return;
  followed_ = read;
  orTell(this, [&] { settings_ = settings_->withLog(read); });
}

void MainFrame::openIni() {
  wxFileDialog dialog(this, "Open INI file", "", "", "INI files (*.ini)|*.ini|All files|*",
                      wxFD_OPEN | wxFD_FILE_MUST_EXIST);
  if (dialog.ShowModal() == wxID_OK) openIni(dialog.GetPath().utf8_string());
}

void MainFrame::openIni(const std::string& ini) {
  auto settings = Settings::fromFile(ini);
  const std::string& open = settings_->configuration.run.rawlog;
  if (settings->configuration.run.rawlog.empty() && !open.empty())
    settings = settings->copy({"run.rawlog=" + open});
  use(settings);
  recent_->add(ini);
}

void MainFrame::openRecent(int command) {
  const std::string file = recent_->file(command);
  if (!std::filesystem::exists(file)) {  // a recording may be a folder
    recent_->remove(file);
    throw InputError("no such file", file, "it is no longer among the recent files");
  }
  openFile(file);
}

void MainFrame::openFile(const std::string& file) { files::isIni(file) ? openIni(file) : openLog(file); }

bool MainFrame::FileDrop::OnDropFiles(wxCoord, wxCoord, const wxArrayString& names) {
  orTell(&frame_, [&] { frame_.openFile(names[0].utf8_string()); });
  return true;
}

void MainFrame::openLog(const std::string& log) {
  expectLog(log);
  use(settings_->copy({"run.rawlog=" + log}));
}

void MainFrame::openLog() {
  wxFileDialog dialog(this, "Open log", "", "", logFilter(), wxFD_OPEN | wxFD_FILE_MUST_EXIST);
  if (dialog.ShowModal() == wxID_OK) openLog(dialog.GetPath().utf8_string());
}

void MainFrame::openFolder() {
  wxDirDialog dialog(this, "Open recording folder", firstFolder(), wxDD_DEFAULT_STYLE | wxDD_DIR_MUST_EXIST);
  if (dialog.ShowModal() == wxID_OK) openLog(dialog.GetPath().utf8_string());
}

void MainFrame::saveIni() {
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
  const auto shown = canvas()->shown();
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
  const std::string format = std::filesystem::path(file).extension().string();
  const bool isScene = format == ".3Dscene";
  if (!isScene && format != ".png")
    throw InputError("no format for a picture", file, "expected the ending .png or .3Dscene");
  Layers layers;
  layers.legend = false;  // its place is that in a picture
  const bool isWritten = isScene ? filterScene(*filter, mapPlane(filter->map),
                                               wholeMap(filter->map, layers, kSize), layers, kSize)
                                       ->saveToFile(partial.path())
                                 : pictureOf(*filter, kSize, {}).saveToFile(partial.path());
  if (!isWritten) partial.fail(0);
  partial.commit();
}

void MainFrame::exportResults() {
  if (!replay_->session()) throw InputError("no results yet", "no log is open", "open a log and play it");
  wxDirDialog dialog(this, "Folder for the results (hybrid/ and general/ in it)", firstFolder());
  if (dialog.ShowModal() == wxID_OK) exportResultsTo(dialog.GetPath().utf8_string());
}

void MainFrame::exportResultsTo(const std::string& folder) { replay_->session()->exportResults(folder); }

void MainFrame::openMap() {
  MapDialog dialog(this, settings_->map());
  if (dialog.ShowModal() != wxID_OK) return;
  if (const MapChoice chosen = dialog.choice(); !(chosen == settings_->map())) useMap(chosen);
}

void MainFrame::saveMap() {
  if (!isReplayShown()) {
    if (!live_->isRunning()) throw InputError("no map yet", "the live view", "connect first");
    return live_->session()->saveMap();
  }
  if (!replay_->session()) throw InputError("no map yet", "no log is open", "open a log and play it");
  wxDirDialog dialog(this, "Folder for the maps (hybrid/ and general/ in it)", firstFolder());
  if (dialog.ShowModal() == wxID_OK) saveReplayMapTo(dialog.GetPath().utf8_string());
}

void MainFrame::saveReplayMapTo(const std::string& folder) { replay_->session()->saveMap(folder); }

}  // namespace hybrid_slam::window
