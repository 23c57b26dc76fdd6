#include "files/RawlogWriter.h"

#include <fcntl.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <unistd.h>
#include <zlib.h>

#include <cerrno>

namespace hybrid_slam::files {
namespace {

/// Output stream for CArchive. MRPT's own gzip stream does not report whether the bytes reached the disk.
struct GzipSink {
  gzFile_s* file;
  bool isWhole = true;

  size_t Write(const void* bytes, size_t count) {
    isWhole = isWhole && gzfwrite(bytes, 1, count, file) == count;
    return count;
  }
  size_t Read(void*, size_t) { return 0; }
  std::string getStreamDescription() const { return "gzip"; }
};

}  // namespace

RawlogWriter::RawlogWriter(const std::string& path)
    : file_(path),
      descriptor_(::open(file_.path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)),
      gzip_(nullptr, gzclose_w) {
  if (descriptor_ < 0) file_.fail(errno);
  gzip_.reset(gzdopen(descriptor_, "wb1"));
  if (gzip_) return;
  ::close(descriptor_);
  file_.fail(ENOMEM);
}

void RawlogWriter::write(const mrpt::serialization::CSerializable& object) {
  GzipSink sink{gzip_.get()};
  errno = 0;
  mrpt::serialization::archiveFrom(sink) << object;
  if (!sink.isWhole) file_.fail(errno);
}

void RawlogWriter::flush() {
  errno = 0;
  if (gzflush(gzip_.get(), Z_SYNC_FLUSH) != Z_OK || ::fdatasync(descriptor_) != 0) file_.fail(errno);
}

void RawlogWriter::finishCut() {
  gzip_.reset();
  file_.keep();
}

void RawlogWriter::finish() {
  errno = 0;
  if (gzclose_w(gzip_.release()) != Z_OK) file_.fail(errno);
  file_.commit();
}

}  // namespace hybrid_slam::files
