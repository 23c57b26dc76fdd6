#include "readings/LogReader.h"

#include "base/Errors.h"
#include "files/LineReader.h"
#include "files/RawlogReader.h"
#include "readings/TextLog.h"

namespace hybrid_slam::readings {

LogReader::LogReader(const std::string& file)
    : file_(file), rawlog_(std::make_unique<files::RawlogReader>(file)) {
  if (!files::isText(file)) return;
  rawlog_.reset();
  text_ = std::make_unique<TextLog>(file, LogConversionOptions(), [this](size_t line, const std::string&) {
    if (brokenLines_++ == 0) firstBroken_ = line;
  });
}

LogReader::~LogReader() = default;

mrpt::serialization::CSerializable::Ptr LogReader::next() {
  if (rawlog_) return rawlog_->next();
  if (!textDefect_.empty()) return nullptr;
  try {
    return text_->next();
  } catch (const InputError& error) {
    if (text_->summary().scans == 0) throw;
    textDefect_ = messageOf(error).substr(0, messageOf(error).find(':'));
    return nullptr;
  }
}

size_t LogReader::entry() const { return rawlog_ ? rawlog_->entry() : text_->line(); }
const char* LogReader::unit() const { return rawlog_ ? "entry" : "line"; }
const std::string& LogReader::defect() const { return rawlog_ ? rawlog_->defect() : textDefect_; }

}  // namespace hybrid_slam::readings
