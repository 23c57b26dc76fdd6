#include "run/Resume.h"

#include "base/Errors.h"

namespace hybrid_slam::run {
namespace {

bool mayDiffer(const std::string& section, const std::string& key) {
  return (section == "run" && (key == "output" || key == "rawlog")) ||
         (section == "particle_filter" && key == "threads");
}

}  // namespace

void adopt(Configuration& configuration, const SessionReader& session) {
  if (!session.hasRun())
    throw InputError("a merged map, which has no run to resume", session.file(),
                     "expected the session of a run; --continue continues its map");
  if (session.header().version != HYBRID_SLAM_VERSION)
    throw InputError("session of version " + session.header().version, session.file(),
                     "expected version " HYBRID_SLAM_VERSION " to resume; --continue continues its map");
  Configuration earlier;
  earlier.load(session.header().configuration, session.file());
  const files::Sections given = configuration.sections();
  for (const auto& [section, options] : earlier.sections()) {
    const auto ours = std::find_if(given.begin(), given.end(),
                                   [&name = section](const auto& s) { return s.first == name; });
    const std::vector<Option> now = ours->second->table(), then = options->table();
    for (size_t i = 0; i < then.size(); ++i) {
      const std::string& key = then[i].key;
      if (!configuration.source.keyExists(section, key) || now[i].get() == then[i].get()) continue;
      if (mayDiffer(section, key))
        then[i].set(now[i].get());
      else
        throw InputError("another configuration than the session's",
                         "section [" + section + "], key `" + key + "` = " + now[i].get(),
                         "expected " + then[i].get() + " as in " + session.file());
    }
  }
  configuration.load(earlier.text(), session.file());
}

}  // namespace hybrid_slam::run
