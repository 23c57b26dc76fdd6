/// @file LogFormats.h
/// @brief The text logs that can be read. A new format needs a file that defines its LogFormat, and an entry
/// in the list below; help texts and file dialogs are made from them.
#pragma once

#include <memory>
#include <string>
#include <string_view>
#include <vector>

#include "readings/LogParser.h"

namespace hybrid_slam::readings {

/// A format of text logs.
struct LogFormat {
  const char* key;      ///< of option --format
  const char* name;     ///< for the user
  const char* rows;     ///< names of the rows that hold scans
  const char* endings;  ///< usual endings of file names, separated by blanks
  double maxRange;      ///< m; readings at or beyond it are no returns by default
  /// Returns whether a row of this name, with this many fields after it, occurs in this format only.
  bool (*isRow)(std::string_view name, size_t fields);
  std::unique_ptr<LogParser> (*makeParser)(const LogParserOptions& options);
};

extern const LogFormat kCarmenLog, kGfsLog, kDpslamLog, kTinyslamLog;
/// All formats, in the order in which they are tried.
inline std::vector<const LogFormat*> logFormats() {
  return {&kCarmenLog, &kGfsLog, &kDpslamLog, &kTinyslamLog};
}

/// Returns the file name endings of rawlogs, text logs and bags, also compressed, for file dialogs. The
/// format itself is detected from the content.
std::vector<std::string> logEndings();
/// Says for --help what a robot's log may be: a bag, or a text log of any format.
std::string robotLogs();
/// Lists the formats' default maximum ranges (m) for --help: `CARMEN, GMapping .gfs: 80; DP-SLAM: 8.18`.
std::string defaultMaxRanges();

/// Returns the format that a line implies; null if it could be in any.
const LogFormat* formatOf(std::string_view line);
/// Returns the format with this key (--format); null if there is none.
const LogFormat* formatNamed(std::string_view key);

/// Makes a parser of one format, for LogFormat::makeParser.
template <class Parser>
std::unique_ptr<LogParser> makeParser(const LogParserOptions& options) {
  return std::make_unique<Parser>(options);
}

}  // namespace hybrid_slam::readings
