#include "readings/LogReader.h"

#include "base/Errors.h"
#include "files/LineReader.h"
#include "files/RawlogReader.h"
#include "readings/BagLog.h"
#include "readings/TextLog.h"

namespace hybrid_slam::readings {

LogReader::LogReader(const std::string& file, const std::shared_ptr<const BagPlan>& plan) : file_(file) {
  const auto report = [this](size_t number, const std::string&) {
    if (brokenLines_++ == 0) firstBroken_ = number;
  };
  if (bags::isBag(file))
    bag_ = std::make_unique<BagLog>(file, plan ? *plan : planOf(contentsOf(file), {}, file),
                                    LogConversionOptions(), report);
  else if (files::isText(file))
    text_ = std::make_unique<TextLog>(file, LogConversionOptions(), report);
  else
    rawlog_ = std::make_unique<files::RawlogReader>(file);
}

LogReader::~LogReader() = default;

mrpt::serialization::CSerializable::Ptr LogReader::next() {
  if (rawlog_) return rawlog_->next();
  if (bag_) return bag_->next();
  if (!textDefect_.empty()) return nullptr;
  try {
    return text_->next();
  } catch (const InputError& error) {
    if (text_->summary().scans == 0) throw;
    textDefect_ = messageOf(error).substr(0, messageOf(error).find(':'));
    return nullptr;
  }
}

size_t LogReader::entry() const {
  return rawlog_ ? rawlog_->entry() : bag_ ? bag_->message() : text_->line();
}
const char* LogReader::unit() const { return rawlog_ ? "entry" : bag_ ? "message" : "line"; }
const std::string& LogReader::defect() const {
  return rawlog_ ? rawlog_->defect() : bag_ ? bag_->defect() : textDefect_;
}
std::vector<std::string> LogReader::ignoredLasers() const {
  return text_ ? text_->ignoredLasers() : std::vector<std::string>();
}

}  // namespace hybrid_slam::readings
