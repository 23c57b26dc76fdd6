#include "files/ObjectReader.h"

#include <mrpt/serialization/CArchive.h>

#include <cstring>

#include "base/Memory.h"
#include "files/ObjectLayouts.h"

namespace hybrid_slam::files {
namespace {

/// Returns all requested bytes or throws: MRPT ignores short reads.
struct StringSource {
  std::string_view bytes;
  size_t at = 0;
  size_t Read(void* data, size_t count) {
    if (count > bytes.size() - at) throw ObjectCut("a truncated object");
    std::memcpy(data, bytes.data() + at, count);
    at += count;
    return count;
  }
  size_t Write(const void*, size_t) { return 0; }
  std::string getStreamDescription() const { return "object"; }
};

}  // namespace

mrpt::serialization::CSerializable::Ptr buildObject(std::string_view bytes) {
  constexpr size_t kInMemory = 3;  // ranges, intensities and flags of a scan, and a copy while they are read
  expectMemory(kInMemory * bytes.size());
  StringSource source{bytes};
  auto object = mrpt::serialization::archiveFrom(source).ReadObject();
  if (source.at != bytes.size()) throw ObjectError("bytes after the object");
  return object;
}

bool isReadable(const mrpt::serialization::CSerializable& object) {
  return layoutOf(object.GetRuntimeClass()->className) != nullptr;
}

}  // namespace hybrid_slam::files
