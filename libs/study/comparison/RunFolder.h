/// @file RunFolder.h
/// @brief The folder of one run: finished or not, and whether it is the run that is asked for.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace hybrid_slam::comparison {

/// What makes a run what it is: two runs of the same settings on the same log give the same results.
struct RunIdentity {
  std::string configuration;  ///< as hybrid-slam writes it to config.ini
  std::string otherSections;  ///< of the INI file, where the method reads them (`stock`: MRPT's)
  std::string log;            ///< the rawlog's path, absolute
  uintmax_t logSize = 0;      ///< bytes
  int64_t logTime = 0;        ///< of its last change, ns
};

/// Notes a log's path, size and time.
/// @throws InputError if it is not there
void noteLog(RunIdentity& identity, const std::string& log);

/// DIR/runs/NAME, which hybrid-slam fills under another name, so that only what is whole has the final one.
class RunFolder {
 public:
  RunFolder(const std::filesystem::path& runs, const std::string& name)
      : folder_(runs / name), partial_(runs / ("." + name + ".partial")) {}

  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
  const std::filesystem::path& path() const { return folder_; }
  /// Where hybrid-slam is to write.
  const std::filesystem::path& partial() const { return partial_; }

  bool isFinished() const { return std::filesystem::exists(file("metrics.json")); }
  /// @throws InputError naming the folder and the first difference if the finished run is not this one. The
  ///         log's size and time are compared where they were noted: runs that slam-compare did not start
  ///         itself have no note of them.
  void expect(const RunIdentity& identity) const;

  /// Makes the partial folder anew, with a note of the identity.
  void begin(const RunIdentity& identity) const;
  /// The partial folder becomes the run's.
  void finish() const;
  /// Nothing is left but a note of the error.
  void fail(const std::string& error) const;
  /// Nothing is left.
  void abandon() const;
  /// The note of a failed run; empty for others.
  std::string error() const;

  /// Removes what the report does not need and would make a sweep large: map.simplemap.gz, map.pgm, map.yaml.
  void dropLargeFiles() const;

 private:
  std::filesystem::path folder_, partial_;
};

}  // namespace hybrid_slam::comparison
