#include "window/gui/RecentFiles.h"

#include <wx/filename.h>
#include <wx/log.h>
#include <wx/stdpaths.h>

#include <filesystem>

namespace hybrid_slam::window {
namespace {

wxString configurationFile() {
  wxStandardPaths& paths = wxStandardPaths::Get();
  paths.SetFileLayout(wxStandardPaths::FileLayout_XDG);
  return wxFileName(paths.GetUserConfigDir(), "hybrid-slam-gui.conf").GetFullPath();
}

}  // namespace

RecentFiles::RecentFiles(wxMenu* menu)
    : config_("hybrid-slam-gui", "", configurationFile(), "", wxCONFIG_USE_LOCAL_FILE) {
  history_.UseMenu(menu);
  history_.SetMenuPathStyle(wxFH_PATH_SHOW_ALWAYS);
  history_.Load(config_);
}

void RecentFiles::add(const std::string& file) {
  std::error_code failed;
  const auto path = std::filesystem::absolute(file, failed).lexically_normal();
  if (failed || !std::filesystem::exists(path, failed)) return;
  const wxString name = wxString::FromUTF8(path.string());
  if (!isEmpty() && history_.GetHistoryFile(0) == name) return;
  history_.AddFileToHistory(name);
  save();
}

void RecentFiles::remove(const std::string& file) {
  for (size_t i = history_.GetCount(); i-- > 0;)
    if (history_.GetHistoryFile(i).utf8_string() == file) history_.RemoveFileFromHistory(i);
  save();
}

std::string RecentFiles::file(int command) const {
  const auto i = static_cast<size_t>(command - wxID_FILE1);
  return i < history_.GetCount() ? history_.GetHistoryFile(i).utf8_string() : "";
}

/// Saves the list; ignores a folder that cannot be written.
void RecentFiles::save() {
  const wxLogNull quiet;
  wxFileName::Mkdir(wxFileName(configurationFile()).GetPath(), wxS_DIR_DEFAULT, wxPATH_MKDIR_FULL);
  history_.Save(config_);
  config_.Flush();
}

}  // namespace hybrid_slam::window
