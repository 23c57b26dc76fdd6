#include "io/RawlogReader.h"

#include <mrpt/io/CFileGZInputStream.h>
#include <mrpt/serialization/CArchive.h>

#include <filesystem>

#include "base/Errors.h"

namespace hybrid_slam {
namespace {

/// What CArchive reads from: counts the bytes, so that an end between two objects can be told from a cut.
struct CountingStream {
  mrpt::io::CFileGZInputStream file;
  size_t bytes = 0;

  size_t Read(void* buffer, size_t count) {
    const size_t n = file.Read(buffer, count);
    bytes += n;
    return n;
  }
  size_t Write(const void*, size_t) { return 0; }
  std::string getStreamDescription() const { return file.filePathAtUse(); }
};

}  // namespace

struct RawlogReader::Stream {
  CountingStream in;
  mrpt::serialization::CArchiveStreamBase<CountingStream> archive{in};
};

RawlogReader::RawlogReader(const std::string& file) : file_(file), stream_(std::make_unique<Stream>()) {
  const std::string expected = "expected a readable rawlog file";
  if (!std::filesystem::exists(file)) throw InputError("no such file", file, expected);
  if (!std::filesystem::is_regular_file(file)) throw InputError("not a file", file, expected);
  if (!stream_->in.file.open(file)) throw InputError("cannot open", file, expected);
}

RawlogReader::~RawlogReader() = default;

mrpt::serialization::CSerializable::Ptr RawlogReader::next() {
  if (!defect_.empty()) return nullptr;
  const size_t before = stream_->in.bytes;
  try {
    auto object = stream_->archive.ReadObject();
    ++entry_;
    return object;
  } catch (const std::exception& e) {
    if (stream_->in.bytes == before && entry_ > 0) return nullptr;  // the end, between two objects
    if (entry_ == 0)
      throw InputError(stream_->in.bytes == 0 ? "empty or not a rawlog" : "not a rawlog", file_,
                       "expected serialised MRPT objects (log2rawlog converts text logs)");
    defect_ = "ends in the middle of an object or holds an unreadable one (" + messageOf(e) + ")";
    return nullptr;
  }
}

}  // namespace hybrid_slam
