// What the menus do with files.
#include <wx/dirdlg.h>
#include <wx/filedlg.h>

#include <filesystem>

#include "base/Errors.h"
#include "files/IniFile.h"
#include "files/OutputFolder.h"
#include "files/PartialFile.h"
#include "window/gui/MainFrame.h"
#include "window/gui/MapDialog.h"
#include "window/gui/Messages.h"

namespace hybrid_slam::window {

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
  settings_ = settings;
  live_->setSettings(settings);
  const std::string& rawlog = settings->configuration.run.rawlog;
  SetTitle("hybrid-slam: " + (rawlog.empty() ? "no log" : std::filesystem::path(rawlog).filename().string()));
  if (rawlog.empty()) return;
  if (live_->isRunning()) throw InputError("a live run is in progress", rawlog, "stop it first: Live, Stop");
  replay_->open(settings->configuration);
  recent_->add(rawlog);
}

void MainFrame::openIni() {
  wxFileDialog dialog(this, "Open INI file", "", "", "INI files (*.ini)|*.ini|All files|*",
                      wxFD_OPEN | wxFD_FILE_MUST_EXIST);
  if (dialog.ShowModal() == wxID_OK) openIni(dialog.GetPath().utf8_string());
}

void MainFrame::openIni(const std::string& ini) {
  use(Settings::fromFile(ini));
  recent_->add(ini);
}

void MainFrame::openRecent(int command) {
  const std::string file = recent_->file(command);
  if (!std::filesystem::is_regular_file(file)) {
    recent_->remove(file);
    throw InputError("no such file", file, "it is no longer among the recent files");
  }
  files::isIni(file) ? openIni(file) : openLog(file);
}

bool MainFrame::LogDrop::OnDropFiles(wxCoord, wxCoord, const wxArrayString& names) {
  orTell(&frame_, [&] { frame_.openLog(names[0].utf8_string()); });
  return true;
}

void MainFrame::openLog(const std::string& log) { use(settings_->copy({"run.rawlog=" + log})); }

void MainFrame::openLog() {
  wxFileDialog dialog(
      this, "Open log", "", "",
      "Logs (*.rawlog, *.clf, *.gfs, *.log, *.gz)|*.rawlog;*.clf;*.gfs;*.log;*.gz|All files|*",
      wxFD_OPEN | wxFD_FILE_MUST_EXIST);
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
  const bool isScene = std::filesystem::path(file).extension() == ".3Dscene";
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
  wxDirDialog dialog(this, "Folder for the results (hybrid/ and general/ in it)");
  if (dialog.ShowModal() == wxID_OK) exportResultsTo(dialog.GetPath().utf8_string());
}

void MainFrame::exportResultsTo(const std::string& folder) { replay_->session()->exportResults(folder); }

void MainFrame::openMap() {
  MapDialog dialog(this, settings_->map());
  if (dialog.ShowModal() == wxID_OK) useMap(dialog.choice());
}

void MainFrame::saveMap() {
  if (!isReplayShown()) {
    if (!live_->isRunning()) throw InputError("no map yet", "the live view", "connect first");
    return live_->session()->saveMap();
  }
  if (!replay_->session()) throw InputError("no map yet", "no log is open", "open a log and play it");
  wxDirDialog dialog(this, "Folder for the maps (hybrid/ and general/ in it)");
  if (dialog.ShowModal() == wxID_OK) saveReplayMapTo(dialog.GetPath().utf8_string());
}

void MainFrame::saveReplayMapTo(const std::string& folder) { replay_->session()->saveMap(folder); }

}  // namespace hybrid_slam::window
