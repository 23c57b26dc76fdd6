#include "files/RawlogReader.h"

#include <new>

#include "base/Errors.h"
#include "files/ObjectFile.h"
#include "files/ObjectLayouts.h"
#include "files/ObjectReader.h"
#include "files/ObjectWalk.h"

namespace hybrid_slam::files {
namespace {

constexpr size_t kMostClasses = 100;  // that a warning may name
constexpr const char* kExpected = "expected a rawlog, a bag or a text log";

}  // namespace

RawlogReader::RawlogReader(const std::string& file)
    : file_(file),
      stream_(std::make_unique<ObjectFile>(file, "expected a log, or the folder of a ROS 2 recording")) {}

RawlogReader::~RawlogReader() = default;

mrpt::serialization::CSerializable::Ptr RawlogReader::next() {
  while (!isAtEnd_ && defect_.empty()) {
    isAtEnd_ = !stream_->bytes().has(1) && stream_->damage().empty();
    if (isAtEnd_ && entry_ == 0) throw InputError("empty file", file_, kExpected);
    if (isAtEnd_) break;
    bool isKnown = false;
    try {
      ObjectWalk walk(stream_->bytes(), true);
      walk.entry();
      isKnown = true;
      const std::string_view bytes = walk.rest();
      const auto object = bytes.empty() ? nullptr : buildObject(bytes);
      stream_->bytes().drop(walk.at());
      ++entry_;
      note(walk.passedOver());
      if (object) return object;  // otherwise an empty entry, or one that is passed over
    } catch (const std::exception& e) {
      if (isOutOfMemory(e)) throw std::bad_alloc();
      if (entry_ == 0 && isKnown)  // as a comment of MRPT 2.14, for MRPT 2.5
        throw InputError("unreadable object (" + messageOf(e) + ")", file_,
                         "expected a rawlog of this version of MRPT or an earlier one");
      if (entry_ == 0) throw InputError("not a log", file_, kExpected);
      const bool isCut = dynamic_cast<const ObjectCut*>(&e) != nullptr;
      defect_ = !isCut                       ? "unreadable object (" + messageOf(e) + ")"
                : !stream_->damage().empty() ? stream_->damage()
                                             : "cut off in the middle of an object";
    }
  }
  return nullptr;
}

void RawlogReader::note(const std::vector<std::string>& classes) {
  for (const std::string& name : classes) {
    if (passedOver_++ == 0) firstPassedOver_ = entry_;
    if (passedOverClasses_.size() < kMostClasses) passedOverClasses_.emplace(baseName(name));
  }
}

}  // namespace hybrid_slam::files
