#include "run/MapPartFile.h"

#include <filesystem>

#include "run/FilterRun.h"
#include "run/KnownMap.h"

namespace hybrid_slam::run {

MapPartFile readMapPart(const std::string& name) {
  const bool isFolder = std::filesystem::is_directory(name);
  const std::string file = isFolder ? name + "/" + kSessionName : name;
  if (!isSession(file)) return {{readKnownMap(file), {}, {}}, {}, {}};
  SessionReader session(file);
  MapPartFile read;
  read.configuration.emplace().load(session.header().configuration, file);
  read.part.map = session.header().map;
  read.part.path = session.header().path;
  if (!session.hasRun()) return read;
  FilterRun::Drive drive = FilterRun::driveOf(session);
  read.part.scans = std::move(drive.scans);
  read.times = std::move(drive.times);
  return read;
}

}  // namespace hybrid_slam::run
