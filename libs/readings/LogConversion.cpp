#include "readings/LogConversion.h"

#include <filesystem>

#include "base/Errors.h"
#include "files/RawlogWriter.h"

namespace hybrid_slam::readings {

LogSummary convertLog(const std::string& logPath, const std::string& rawlogPath,
                      const LogConversionOptions& options, const BrokenLineReport& report) {
  std::error_code ignored;
  if (std::filesystem::equivalent(logPath, rawlogPath, ignored))
    throw InputError("the output is the input", rawlogPath, "expected two different files");
  TextLog log(logPath, options, report);
  files::RawlogWriter writer(rawlogPath);
  while (const auto object = log.next()) writer.write(*object);
  writer.finish();
  return log.summary();
}

}  // namespace hybrid_slam::readings
