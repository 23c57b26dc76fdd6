#include "study/comparison/Sweep.h"

#include <map>

#include "base/Options.h"

namespace hybrid_slam::comparison {
namespace {

/// The sections for MRPT, which config.ini does not hold.
std::string otherSections(run::Configuration& configuration) {
  std::vector<std::string> sections, keys;
  configuration.source.getAllSections(sections);
  std::string text;
  for (const std::string& section : sections) {
    if (section.rfind(run::kStockSection, 0) != 0) continue;
    text += "[" + section + "]\n";
    configuration.source.getAllKeys(section, keys);
    for (const std::string& key : keys)
      text += key + " = " + configuration.source.read_string(section, key, "") + "\n";
  }
  return text;
}

std::vector<std::string> commandOf(const std::string& program, const RunSetup& setup) {
  std::vector<std::string> command{program, "-q"};
  if (!setup.config.empty()) command.push_back(setup.config);
  for (const std::string& setting : setup.settings) command.insert(command.end(), {"--set", setting});
  return command;
}

}  // namespace

std::vector<ComparisonRun> makeSweep(const CommonSetup& common, const std::vector<Group>& groups,
                                     const std::vector<Run>& runs, const std::filesystem::path& folder,
                                     const std::string& program, const std::atomic<bool>& stop,
                                     const LogReport& report) {
  RunIdentity log;
  noteLog(log, common.log);
  std::map<std::string, run::LogSettings> byInput;
  const auto ofLog = [&](const Group& group, const readings::InputOptions& input) -> const run::LogSettings& {
    std::string values;
    for (const Option& option : input.table()) values += option.get() + "\n";
    const auto [found, isNew] = byInput.try_emplace(values);
    if (isNew) {
      const auto summary = readings::summarise(common.log, input, [&] { return stop.load(); });
      found->second = run::readLogSettings(common.log, input, summary);
      if (report) report(group, summary, found->second);
    }
    return found->second;
  };
  std::vector<ComparisonRun> sweep;
  for (const Run& r : runs) {
    const Group& group = groups[r.group];
    const RunSetup setup = setupOf(common, group, r.seed);
    run::Configuration configuration = setup.configuration();
    run::applyLogSettings(ofLog(group, configuration.input), configuration);
    RunIdentity identity = log;
    identity.configuration = configuration.text();
    if (group.method == "stock") identity.otherSections = otherSections(configuration);
    sweep.push_back({r, {folder, runName(group, r.seed)}, identity, commandOf(program, setup)});
  }
  return sweep;
}

}  // namespace hybrid_slam::comparison
