/// @file LogConversion.h
/// @brief Converts a robot's text log or bag, or a rawlog of either form, into a rawlog.
#pragma once

#include <string>

#include "readings/BagPlan.h"
#include "readings/TextLog.h"

namespace hybrid_slam::readings {

/// Converts `logPath` (plain or compressed) into the rawlog `rawlogPath`, whose objects are those of TextLog,
/// BagLog or RawlogLog. A truncated or damaged bag or rawlog is converted up to its defect
/// (LogSummary::defect), unless `strict`.
///
/// @throws InputError for an input that is missing, unreadable, truncated, not a log, or without scans, for
///         an output that cannot be written, is the input, or is a file other than a rawlog, and for a broken
///         line if `strict`; std::runtime_error if stopped. No file is left at `rawlogPath` then
LogSummary convertLog(const std::string& logPath, const std::string& rawlogPath,
                      const LogConversionOptions& options, const BrokenLineReport& report,
                      const BagOptions& bag = {});

}  // namespace hybrid_slam::readings
