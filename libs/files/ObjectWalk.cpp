#include "files/ObjectWalk.h"

#include <algorithm>
#include <cctype>
#include <cstring>

#include "files/ObjectLayouts.h"

namespace hybrid_slam::files {
namespace {

constexpr uint8_t kEndFlag = 0x88;
constexpr size_t kLongestName = 120;
constexpr std::string_view kNull = "nullptr";

bool startsWith(std::string_view text, std::string_view prefix) {
  return text.substr(0, prefix.size()) == prefix;
}

/// Returns whether logs, or their frames, consist of objects of this class.
bool isOfLogs(std::string_view name, bool isInFrame) {
  const std::string_view base = baseName(name);
  return startsWith(base, "CObservation") ||
         (!isInFrame && (startsWith(base, "CAction") || startsWith(base, "CSensoryFrame")));
}

bool isClassName(std::string_view name) {
  return !name.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
    return std::isalnum(c) || c == '_' || c == ':';
  });
}

const char* textOf(ObjectKind kind) {
  switch (kind) {
    case ObjectKind::frame:
      return "CSensoryFrame";
    case ObjectKind::observation:
      return "an observation";
    case ObjectKind::action:
      return "an action";
    case ObjectKind::gridMap:
      return "a grid map";
    default:
      return "a pose, a matrix or parameters";
  }
}

}  // namespace

void ObjectWalk::need(size_t count) {
  if (count > mostBytes_ - std::min(at_, mostBytes_))
    throw ObjectError("an object of more than " + std::to_string(mostBytes_ >> 20) + " MiB");
  if (!bytes_.has(at_ + count)) throw ObjectCut("cut off in the middle of an object");
}

void ObjectWalk::skip(size_t count) {
  need(count);
  at_ += count;
}

uint8_t ObjectWalk::byte() {
  need(1);
  return bytes_[at_++];
}

uint32_t ObjectWalk::number() {
  need(4);
  uint32_t value = 0;
  for (size_t i = 4; i-- > 0;) value = value << 8 | bytes_[at_ + i];
  at_ += 4;
  return value;
}

float ObjectWalk::real() {
  const uint32_t bits = number();
  float value;
  std::memcpy(&value, &bits, sizeof value);
  return value;
}

bool ObjectWalk::flag() {
  const uint8_t value = byte();
  if (value > 1) bytes_.at(at_ - 1) = 1;
  return value != 0;
}

size_t ObjectWalk::count(size_t size) {
  const size_t n = number();
  need(n * size);
  return n;
}

void ObjectWalk::flags() {
  for (size_t n = count(1); n > 0; --n) flag();
}

void ObjectWalk::label() {
  const size_t n = count(1);
  if (n > kLongestLabel)
    throw ObjectError("a label of more than " + std::to_string(kLongestLabel) + " characters");
  skip(n);
}

ObjectWalk::Header ObjectWalk::header() {
  Header header;
  const uint8_t first = byte();
  header.hasEndFlag = (first & 0x80) != 0;
  const size_t length = first & 0x7f;
  if (!header.hasEndFlag)  // before MRPT 0.5.5: a length of four bytes, no end flag
    for (int i = 0; i < 3; ++i)
      if (byte() != 0) throw ObjectError("no object");
  if (length > kLongestName) throw ObjectError("a class name of more than 120 characters");
  need(length);
  const bool isNull = bytes_.view(at_, length) == kNull;
  const size_t versionSize = isNull ? 0 : header.hasEndFlag ? 1 : 4;
  need(length + versionSize);
  header.name = bytes_.view(at_, length);
  at_ += length;
  header.layout = layoutOf(header.name);
  if (!header.layout && !isClassName(header.name)) throw ObjectError("no class name");
  const uint32_t version = versionSize == 0 ? 0 : versionSize == 1 ? byte() : number();
  header.version = static_cast<int>(std::min<uint32_t>(version, 255));
  return header;
}

void ObjectWalk::contents(const Header& head, std::initializer_list<ObjectKind> kinds) {
  const ObjectLayout* const layout = head.layout;
  if (!layout || std::find(kinds.begin(), kinds.end(), layout->kind) == kinds.end())
    throw ObjectError("an object of class " + std::string(head.name) + " instead of " +
                      textOf(*kinds.begin()));
  if (head.version >= layout->versions)
    throw ObjectError(std::string(head.name) + " of unknown version " + std::to_string(head.version));
  layout->fields(*this, head.version);
  if (head.hasEndFlag && byte() != kEndFlag)
    throw ObjectError(std::string(layout->name) + " without its end");
}

void ObjectWalk::object(ObjectKind kind) { contents(header(), {kind}); }

void ObjectWalk::entry() {
  const Header head = header();
  if (head.name == kNull) return skip(head.hasEndFlag ? 1 : 0);
  if (!mayPassOver(head, false))
    return contents(head, {ObjectKind::observation, ObjectKind::frame, ObjectKind::actions});
  passOver(head, [this](size_t at) { return isEnd(at) || isStart(at, false); });
  cuts_.push_back({0, at_});
}

void ObjectWalk::observations() {
  constexpr size_t kLeast = 16;  // bytes of an observation
  countAt_ = at_;
  for (size_t n = count(kLeast); n > 0; --n) {
    const size_t start = at_;
    const Header head = header();
    if (!mayPassOver(head, true)) {
      contents(head, {ObjectKind::observation});
      continue;
    }
    // After the last one, the frame ends as well.
    passOver(head, [this, isLast = n == 1](size_t at) {
      if (!isLast) return isStart(at, true);
      return !isEnd(at) && bytes_[at] == kEndFlag && (isEnd(at + 1) || isStart(at + 1, false));
    });
    cuts_.push_back({start, at_});
  }
}

bool ObjectWalk::mayPassOver(const Header& head, bool isInFrame) const {
  return passesOver_ && head.hasEndFlag && !head.layout && isOfLogs(head.name, isInFrame);
}

// The length of an object is not stored: it ends at the first end flag with something behind it that may
// follow.
template <class MayFollow>
void ObjectWalk::passOver(const Header& head, MayFollow mayFollow) {
  passedOver_.emplace_back(head.name);
  for (;;)
    if (byte() == kEndFlag && mayFollow(at_)) return;
}

/// Returns whether an object that may be an entry of a log, or of a frame, starts here.
bool ObjectWalk::isStart(size_t at, bool isInFrame) {
  if (isEnd(at) || (bytes_[at] & 0x80) == 0) return false;
  const size_t length = bytes_[at] & 0x7f;
  if (length > kLongestName || !bytes_.has(at + 1 + length)) return false;
  const std::string_view name = bytes_.view(at + 1, length);
  return isClassName(name) && isOfLogs(name, isInFrame);
}

std::string_view ObjectWalk::rest() {
  if (cuts_.empty()) return bytes_.view(0, at_);
  rest_.clear();
  size_t from = 0;
  for (const auto& [first, end] : cuts_) {
    rest_ += bytes_.view(from, first - from);
    from = end;
  }
  rest_ += bytes_.view(from, at_ - from);
  if (rest_.empty()) return rest_;
  uint32_t count = 0;  // of the observations; little-endian
  for (size_t i = 4; i-- > 0;) count = count << 8 | static_cast<uint8_t>(rest_[countAt_ + i]);
  count -= static_cast<uint32_t>(cuts_.size());
  for (size_t i = 0; i < 4; ++i) rest_[countAt_ + i] = static_cast<char>(count >> (8 * i) & 0xff);
  return rest_;
}

}  // namespace hybrid_slam::files
