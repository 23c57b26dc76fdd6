#include "readings/LogConversion.h"

#include <filesystem>

#include "base/Errors.h"
#include "files/LineReader.h"
#include "files/RawlogReader.h"
#include "files/RawlogWriter.h"
#include "readings/BagLog.h"

namespace hybrid_slam::readings {

namespace {

LogSummary convertBag(const std::string& file, files::RawlogWriter& writer,
                      const LogConversionOptions& options, const BrokenLineReport& report,
                      const BagOptions& bag) {
  BagLog log(file, planOf(contentsOf(file), bag, file), options, report);
  while (const auto object = log.next()) writer.write(*object);
  LogSummary summary = log.summary();
  summary.notes = log.plan().notes;
  summary.defect = log.defect();
  if (options.strict && !summary.defect.empty())
    throw InputError(summary.format + " " + summary.defect, file, "expected a whole file");
  return summary;
}

bool isRawlog(const std::string& file) {
  if (files::isText(file)) return false;
  try {
    return files::RawlogReader(file).next() != nullptr;
  } catch (const InputError&) {
    return false;
  }
}

}  // namespace

LogSummary convertLog(const std::string& logPath, const std::string& rawlogPath,
                      const LogConversionOptions& options, const BrokenLineReport& report,
                      const BagOptions& bag) {
  std::error_code ignored;
  if (std::filesystem::equivalent(logPath, rawlogPath, ignored))
    throw InputError("the output is the input", rawlogPath, "expected two different files");
  if (bags::isBag(logPath)) {
    files::RawlogWriter writer(rawlogPath);
    const LogSummary summary = convertBag(logPath, writer, options, report, bag);
    writer.finish();
    return summary;
  }
  if (isRawlog(logPath))
    throw InputError("already a rawlog", logPath,
                     "expected a bag or a text log; the other programs read a rawlog as it is");
  TextLog log(logPath, options, report);
  files::RawlogWriter writer(rawlogPath);
  while (const auto object = log.next()) writer.write(*object);
  writer.finish();
  LogSummary summary = log.summary();
  summary.notes = log.ignoredLasers();
  return summary;
}

}  // namespace hybrid_slam::readings
