#include "run/MapPartFile.h"

#include <memory>

#include "run/KnownMap.h"
#include "run/SessionFile.h"
#include "slam/filter/HybridFilter.h"

namespace hybrid_slam::run {

MapPartFile readMapPart(const std::string& name) {
  const std::string file = sessionIn(name);
  if (!isSession(file)) return {{readKnownMap(file), {}, {}}, {}, {}};
  SessionReader session(file);
  MapPartFile read;
  read.configuration.emplace().load(session.header().configuration, file);
  read.part.map = session.header().map;
  read.part.path = session.header().path;
  read.times = session.header().times;
  if (!session.hasRun()) return read;
  const auto filter = std::make_unique<HybridFilter>(read.configuration->filter);  // large for a stack
  session.read([&](StateReader& in) {
    filter->load(in);
    in.check(filter->updates() == read.part.path.size(), "its filter does not belong to its path");
  });
  if (!filter->isMapOfUpdates()) return read;
  read.part.scans = filter->updateScans();
  // Beams without a return may have the session's limit as their range: walls, with a longer limit.
  const auto limit = static_cast<float>(read.configuration->filter.grid.maxRange);
  for (const Scans& scans : read.part.scans)
    for (const auto& scan : scans)
      if (scan->maxRange <= 0 || scan->maxRange > limit) scan->maxRange = limit;
  return read;
}

}  // namespace hybrid_slam::run
