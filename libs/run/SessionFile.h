/// @file SessionFile.h
/// @brief `session.hslam`: a run with its map, to resume, continue, localise in or merge.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <functional>
#include <string>
#include <vector>

#include "base/State.h"
#include "slam/filter/MapMaker.h"

namespace hybrid_slam::run {

inline const char* const kSessionName = "session.hslam";
/// Name of the checkpoint of a run that will replace the results in its folder.
inline const char* const kCheckpointName = "checkpoint.hslam";

/// The part of a session that every use needs. The state of the run follows in the file (FilterRun), unless
/// the map was merged from others.
struct SessionHeader {
  std::string version;                    ///< of the program that wrote it
  std::string configuration;              ///< Configuration::text()
  ScanMap map;                            ///< the best so far; of a finished run, the refined one
  std::vector<mrpt::math::TPose2D> path;  ///< a pose for each update (m, rad), in this map
  std::vector<double> times;              ///< s, of each update

  template <class State>
  void visit(State& state) {
    state(version, configuration, map, path, times);
    state.check(times.size() == path.size(), "its times do not belong to its path");
  }
};

/// Writes the header of a session file.
void writeHeader(StateWriter& out, SessionHeader& header);

/// Largest session that is read, before compression.
constexpr size_t kMostSessionBytes = size_t{1} << 33;

/// Writes the compressed bytes and syncs them before the file gets its name, so that a reader finds the old
/// file or the new one.
/// @throws InputError if the file cannot be written
void saveSession(const std::string& path, const std::string& bytes);

/// Returns the session in a folder of results, or the name if it is not that of such a folder.
std::string sessionIn(const std::string& name);

/// Returns whether a file begins like a session.
bool isSession(const std::string& file);

/// Reads a session file.
class SessionReader {
 public:
  /// @throws InputError for a file that is missing, foreign, cut, damaged or of another format
  explicit SessionReader(const std::string& file);
  SessionReader(const SessionReader&) = delete;
  SessionReader& operator=(const SessionReader&) = delete;

  const std::string& file() const { return file_; }
  const SessionHeader& header() const { return header_; }
  /// Returns whether the state of a run follows the header; not in a merged map (slam-merge).
  bool hasRun() const { return !in_.isAtEnd(); }
  /// Reads the first part after the header, the filter's state.
  /// @throws InputError if it is damaged or cut
  void read(const std::function<void(StateReader&)>& read) {
    guarded([&] { read(in_); });
  }
  /// Reads the second part, from there to the end of the file. @throws InputError if it is damaged or cut
  void readRest(const std::function<void(StateReader&)>& read);

 private:
  void guarded(const std::function<void()>& read);

  std::string file_, bytes_;
  StateReader in_;
  SessionHeader header_;
};

}  // namespace hybrid_slam::run
