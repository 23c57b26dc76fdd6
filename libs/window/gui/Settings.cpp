#include "window/gui/Settings.h"

#include "files/TemporaryFolder.h"

namespace hybrid_slam::window {

std::shared_ptr<Settings> Settings::fromFile(const std::string& file,
                                             const std::vector<std::string>& changes) {
  return std::shared_ptr<Settings>(new Settings(file, changes));
}

std::shared_ptr<Settings> Settings::copy(const std::vector<std::string>& changes) const {
  const files::TemporaryFolder folder;
  auto present = configuration;  // text() is not const
  return fromFile(folder.write("settings.ini", present.text()), changes);
}

}  // namespace hybrid_slam::window
