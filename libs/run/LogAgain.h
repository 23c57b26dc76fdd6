/// @file LogAgain.h
/// @brief Reads a log again whose path has been filtered: it may be gone by then.
#pragma once

#include <optional>
#include <stdexcept>
#include <string>

#include "readings/RawlogSource.h"

namespace hybrid_slam::run {

/// The log was moved, removed, unmounted or shortened since it was filtered.
class UnreadableLog : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Returns whether the log was written to or replaced since it was summarised.
bool hasChanged(const std::string& file, const readings::RawlogSummary& log);

/// The readings of a log from its start. Its errors have a separate type, so that they cost only the results
/// that need the log.
class LogAgain {
 public:
  /// @throws UnreadableLog if the log cannot be opened
  LogAgain(const std::string& file, const readings::InputOptions& options,
           const readings::RawlogSummary& summary);

  /// @throws UnreadableLog at the end of the log, and if it cannot be read
  readings::Reading next();

 private:
  std::string file_;
  std::optional<readings::RawlogSource> source_;
};

}  // namespace hybrid_slam::run
