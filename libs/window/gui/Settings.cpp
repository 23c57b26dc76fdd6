#include "window/gui/Settings.h"

#include <algorithm>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"

namespace hybrid_slam::window {
namespace {

/// Returns the settings without these keys. @param names  SECTION.KEY each
std::string textWithout(const mrpt::config::CConfigFileBase& settings,
                        const std::vector<std::string>& names) {
  mrpt::config::CConfigFileMemory left;
  std::vector<std::string> sections, keys;
  settings.getAllSections(sections);
  for (const std::string& section : sections) {
    settings.getAllKeys(section, keys);
    for (const std::string& key : keys)
      if (std::find(names.begin(), names.end(), section + "." + key) == names.end())
        left.write(section, key, settings.read_string(section, key, ""));
  }
  return left.getContent();
}

}  // namespace

MapChoice MapChoice::of(const run::RunOptions& run) {
  if (!run.continueFrom.empty()) return {Use::mapOn, run.continueFrom, run.start};
  if (!run.localizeIn.empty()) return {Use::localise, run.localizeIn, run.start};
  if (!run.priorPlan.empty()) return {Use::plan, run.priorPlan, run.start};
  return {};
}

std::shared_ptr<Settings> Settings::fromFile(const std::string& file,
                                             const std::vector<std::string>& changes) {
  return std::shared_ptr<Settings>(new Settings(file, changes, nullptr));
}

Settings::Settings(const std::string& file, const std::vector<std::string>& changes, const Settings* before)
    : configuration(file, changes, {{"live", &live}}) {
  if (!before) return;
  const run::RunOptions& of = before->configuration.run;
  configuration.run.continueFrom = of.continueFrom;
  configuration.run.localizeIn = of.localizeIn;
  configuration.run.priorPlan = of.priorPlan;
  configuration.run.start = of.start;
  const readings::InputOptions &input = configuration.input, &inputBefore = before->configuration.input;
  if (of.rawlog == configuration.run.rawlog && inputBefore.sensorLabel == input.sensorLabel &&
      inputBefore.odometryTopic == input.odometryTopic)
    follow(before->ofLog_);
}

void Settings::follow(const std::shared_ptr<const run::LogSettings>& log) {
  ofLog_ = log;
  if (!log) return;
  try {
    applyLogSettings(*log, configuration);
  } catch (const InputError&) {  // the replay reports it
  }
}

std::shared_ptr<Settings> Settings::withLog(const std::shared_ptr<const run::LogSettings>& log) const {
  Settings other(*this);
  other.ofLog_ = log;
  return other.copy();
}

std::shared_ptr<Settings> Settings::inMap(const MapChoice& map) const {
  auto changed = copy();
  run::RunOptions& run = changed->configuration.run;
  run.continueFrom = map.use == MapChoice::Use::mapOn ? map.file : "";
  run.localizeIn = map.use == MapChoice::Use::localise ? map.file : "";
  run.priorPlan = map.use == MapChoice::Use::plan ? map.file : "";
  run.start = map.start;
  return changed;
}

std::shared_ptr<Settings> Settings::defaults() const {
  const std::string& log = configuration.run.rawlog;
  const std::shared_ptr<Settings> standard(
      new Settings("", log.empty() ? std::vector<std::string>{} : std::vector{"run.rawlog=" + log}, this));
  if (!standard->ofLog_) standard->follow(ofLog_);  // with the lasers that were chosen
  return standard;
}

std::shared_ptr<Settings> Settings::copy(const std::vector<std::string>& changes,
                                         const std::vector<std::string>& resets) const {
  // Keep only what the user set; the other settings follow from the log, which may change.
  const std::string text =
      resets.empty() ? configuration.source.getContent() : textWithout(configuration.source, resets);
  const files::TemporaryFolder folder;
  const std::string file = text.empty() ? text : folder.write("settings.ini", text);
  std::shared_ptr<Settings> copied(new Settings(file, changes, this));
  copied->configuration.warnings = configuration.warnings;  // with the name of the user's file
  return copied;
}

}  // namespace hybrid_slam::window
