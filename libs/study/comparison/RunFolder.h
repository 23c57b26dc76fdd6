/// @file RunFolder.h
/// @brief The folder of one run: its state, and whether it is the requested run.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hybrid_slam::comparison {

/// Identity of a run: the same settings on the same log give the same results.
struct RunIdentity {
  std::string configuration;  ///< as written to config.ini by hybrid-slam
  std::string otherSections;  ///< of the INI file, if the method reads them (`stock`: MRPT's)
  std::string log;            ///< the rawlog's path, absolute
  uintmax_t logSize = 0;      ///< bytes
  int64_t logTime = 0;        ///< last modification, ns
};

/// Sets a log's path, size and modification time.
/// @throws InputError if there is no such file
void noteLog(RunIdentity& identity, const std::string& log);

/// Expects that all finished runs in DIR/runs are of this log: one report compares runs of one log.
/// @throws InputError with the first run of another log
void expectLog(const std::filesystem::path& runs, const RunIdentity& identity);

/// DIR/runs/NAME. hybrid-slam writes to a temporary name, so that only complete runs have the final name.
class RunFolder {
 public:
  RunFolder(const std::filesystem::path& runs, const std::string& name)
      : folder_(runs / name), partial_(runs / ("." + name + ".partial")) {}

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& path() const { return folder_; }
  /// Output folder for hybrid-slam.
  const std::filesystem::path& partial() const { return partial_; }

  bool isFinished() const {
    std::error_code none;  // such as a loop of links
    return std::filesystem::exists(file("metrics.json"), none);
  }
  /// @throws InputError with the folder and the first difference if the finished run has another identity.
  ///         Log size and time are compared if recorded; runs not started by slam-compare lack them.
  void expect(const RunIdentity& identity) const;

  /// Where the messages of hybrid-slam go; without any, the file is removed in the end.
  std::filesystem::path messages() const;
  /// Recreates the partial folder and records the identity.
  void begin(const RunIdentity& identity) const;
  /// Records checksums of the partial folder's files, and renames it to its final name. The user's files in
  /// the final folder stay.
  /// @throws InputError if the partial folder has gone
  void finish() const;
  /// The first entry of the folder that is broken, has changed since, or is a pipe or the like; empty if
  /// there is none. A run without origin.json, not started by slam-compare, has no checksums.
  std::string damage() const;
  /// Removes the run's files. @throws InputError if that fails
  void discard() const;
  /// Removes the run's files except a record of the error.
  void fail(const std::string& error) const;
  /// Removes the partial folder.
  void abandon() const;
  /// The error of a failed run; empty for others.
  std::string error() const;

  /// Removes large files not needed by the report: map.simplemap.gz, map.pgm, map.yaml.
  void dropLargeFiles() const;

 private:
  std::filesystem::path folder_, partial_;
};

}  // namespace hybrid_slam::comparison
