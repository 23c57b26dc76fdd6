#include "readings/LogConversion.h"

#include <filesystem>

#include "base/Errors.h"
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
  TextLog log(logPath, options, report);
  files::RawlogWriter writer(rawlogPath);
  while (const auto object = log.next()) writer.write(*object);
  writer.finish();
  return log.summary();
}

}  // namespace hybrid_slam::readings
