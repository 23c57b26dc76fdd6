#include "readings/LogConversion.h"

#include <filesystem>
#include <stdexcept>

#include "base/Errors.h"
#include "files/DatedName.h"
#include "files/InputFile.h"
#include "files/LineReader.h"
#include "files/RawlogReader.h"
#include "files/RawlogWriter.h"
#include "readings/BagLog.h"
#include "readings/RawlogLog.h"

namespace hybrid_slam::readings {

namespace {

/// The file of a log, and its state before anything was read.
struct Source {
  explicit Source(const std::string& path) : file(path), state(files::stateOf(path)) {}
  std::string file, state;
};

/// Writes the objects of a log. @throws std::runtime_error if stopped, or if the log has changed
template <class Log>
void write(Log& log, const Source& source, files::RawlogWriter& writer, const LogConversionOptions& options) {
  while (const auto object = log.next()) {
    if (options.isStopped())
      throw std::runtime_error("interrupted: " + source.file + "; nothing was written");
    writer.write(*object);
  }
  if (files::stateOf(source.file) != source.state)
    throw std::runtime_error("log has changed while it was read: " + source.file + "; nothing was written");
}

/// Converts a bag or rawlog.
template <class Log>
LogSummary convert(Log& log, const Source& source, const std::string& rawlog,
                   const LogConversionOptions& options) {
  files::RawlogWriter writer(rawlog);
  write(log, source, writer, options);
  LogSummary summary = log.summary();
  summary.defect = log.defect();
  if (options.strict && !summary.defect.empty())
    throw InputError(summary.format + " " + summary.defect, source.file, "expected a whole file");
  writer.finish();
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

/// A conversion can be repeated, a recording cannot. A link to one would be followed.
void expectNoRecording(const std::string& rawlog) {
  std::error_code ignored;
  const std::string target = std::filesystem::weakly_canonical(rawlog, ignored).string();
  if ((files::hasDate(rawlog) || files::hasDate(target)) && std::filesystem::file_size(rawlog, ignored) > 0 &&
      !ignored)
    throw InputError("the output would replace a recording", rawlog, "expected the name of a new file");
}

}  // namespace

LogSummary convertLog(const std::string& logPath, const std::string& rawlogPath,
                      const LogConversionOptions& options, const BrokenLineReport& report,
                      const BagOptions& bag) {
  std::error_code ignored;
  if (std::filesystem::equivalent(logPath, rawlogPath, ignored))
    throw InputError("the output is the input", rawlogPath, "expected two different files");
  files::expectReplaceable(rawlogPath, "rawlog", isRawlog);
  expectNoRecording(rawlogPath);
  const Source source(logPath);
  if (bags::isBag(logPath)) {
    BagLog log(logPath, planOf(contentsOf(logPath, options.isStopped), bag, logPath), options, report);
    LogSummary summary = convert(log, source, rawlogPath, options);
    summary.notes = log.plan().notes;
    return summary;
  }
  if (!bag.topics.empty() || !bag.odometryTopic.empty())
    throw InputError(
        bag.topics.empty() ? "--odometry-topic for a log without topics" : "--topic for a log without topics",
        logPath, "expected a bag; hybrid-slam chooses among the sensors of other logs");
  if (isRawlog(logPath)) {
    RawlogLog log(logPath, options);
    LogSummary summary = convert(log, source, rawlogPath, options);
    summary.notes = log.notes();
    return summary;
  }
  TextLog log(logPath, options, report);
  files::RawlogWriter writer(rawlogPath);
  write(log, source, writer, options);
  writer.finish();
  LogSummary summary = log.summary();
  summary.notes = log.ignoredLasers();
  return summary;
}

}  // namespace hybrid_slam::readings
