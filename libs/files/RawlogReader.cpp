#include "files/RawlogReader.h"

#include <mrpt/serialization/CArchive.h>
#include <zlib.h>

#include <filesystem>
#include <stdexcept>

#include "base/Errors.h"

namespace hybrid_slam::files {
namespace {

/// Input stream for CArchive. Returns all requested bytes or throws: MRPT ignores short reads, even within a
/// string length. MRPT's own gzip stream does not distinguish a damaged or truncated file from its end.
struct GzipStream {
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file;
  bool isAtStart = true;  ///< nothing of the current object has been read
  bool isAtEnd = false;   ///< the file ended between two objects
  std::string problem{};  ///< other reason for the end of reading

  size_t Read(void* buffer, size_t count) {
    const size_t n = gzfread(buffer, 1, count, file.get());
    if (n == count) {
      isAtStart = false;
      return n;
    }
    int error = Z_OK;
    gzerror(file.get(), &error);
    isAtEnd = isAtStart && n == 0 && error == Z_OK;
    if (!isAtEnd)
      problem = error == Z_OK ? "cut off in the middle of an object" : "gzip file damaged or cut off";
    throw std::runtime_error("end of file");
  }
  size_t Write(const void*, size_t) { return 0; }
  std::string getStreamDescription() const { return "rawlog"; }
};

}  // namespace

struct RawlogReader::Stream {
  GzipStream in;
  mrpt::serialization::CArchiveStreamBase<GzipStream> archive{in};
};

RawlogReader::RawlogReader(const std::string& file) : file_(file) {
  const std::string expected = "expected a readable log";
  if (!std::filesystem::exists(file)) throw InputError("no such file", file, expected);
  if (!std::filesystem::is_regular_file(file)) throw InputError("not a file", file, expected);
  stream_.reset(new Stream{{{gzopen(file.c_str(), "rb"), gzclose_r}}});
  if (!stream_->in.file) throw InputError("cannot open", file, expected);
}

RawlogReader::~RawlogReader() = default;

mrpt::serialization::CSerializable::Ptr RawlogReader::next() {
  GzipStream& in = stream_->in;
  while (!in.isAtEnd && defect_.empty()) {
    in.isAtStart = true;
    try {
      const auto object = stream_->archive.ReadObject();
      ++entry_;
      if (object) return object;  // otherwise an empty entry
    } catch (const std::exception& e) {
      if (entry_ == 0)
        throw InputError(in.isAtEnd ? "empty file" : "not a rawlog", file_,
                         "expected serialised MRPT objects (log2rawlog converts text logs)");
      if (!in.isAtEnd) defect_ = in.problem.empty() ? "unreadable object (" + messageOf(e) + ")" : in.problem;
    }
  }
  return nullptr;
}

}  // namespace hybrid_slam::files
