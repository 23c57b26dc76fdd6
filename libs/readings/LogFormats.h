/// @file LogFormats.h
/// @brief The text logs that can be converted. A new format is a file that defines its LogFormat, and its
/// name in the list below.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "readings/LogParser.h"

namespace hybrid_slam::readings {

struct LogFormat {
  const char* key;   ///< of option --format
  const char* name;  ///< for the user
  const char* rows;  ///< names of the rows that hold scans
  double maxRange;   ///< m; readings at or beyond it are no returns, unless the user says otherwise
  /// Whether a row of this name, with this many fields after it, is found in no other format.
  bool (*isRow)(std::string_view name, size_t fields);
  std::unique_ptr<LogParser> (*makeParser)(const LogParserOptions& options);
};

extern const LogFormat kCarmenLog, kGfsLog, kDpslamLog, kTinyslamLog;
/// All formats, in the order in which they are tried.
inline std::vector<const LogFormat*> logFormats() {
  return {&kCarmenLog, &kGfsLog, &kDpslamLog, &kTinyslamLog};
}

/// How the names of logs end: rawlogs, text logs and bags, also compressed. For a choice of files: the format
/// itself is detected from the content.
inline std::vector<std::string> logEndings() {
  return {".rawlog", ".clf", ".log", ".gfs",  ".dat", ".bag", ".db3",
          ".mcap",   ".gz",  ".bz2", ".zstd", ".zst", ".lz4"};
}

/// The format that a line implies; null if it could be in any.
const LogFormat* formatOf(std::string_view line);
/// The format of option --format; null if there is none.
const LogFormat* formatNamed(std::string_view key);

template <class Parser>
std::unique_ptr<LogParser> makeParser(const LogParserOptions& options) {
  return std::make_unique<Parser>(options);
}

}  // namespace hybrid_slam::readings
