#include "io/RawlogWriter.h"

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/serialization/CArchive.h>
#include <mrpt/serialization/CSerializable.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <filesystem>

#include "base/Errors.h"

namespace hybrid_slam {
namespace {

InputError cannotWrite(const std::string& path, int error) {
  return InputError("cannot write", path,
                    std::string("expected a writable folder with room on its disk") +
                        (error ? std::string(": ") + std::strerror(error) : std::string()));
}

gzFile_s* openPart(const std::string& path, const std::string& partPath) {
  std::error_code ignored;
  // A device or a folder must not be replaced by the renaming at the end.
  if (std::filesystem::exists(path, ignored) && !std::filesystem::is_regular_file(path, ignored))
    throw InputError("cannot write", path, "expected the name of a file");
  errno = 0;
  gzFile_s* file = gzopen(partPath.c_str(), "wb1");
  if (!file) throw cannotWrite(path, errno);
  return file;
}

}  // namespace

// MRPT's own gzip stream would not do: it does not say whether the last bytes reached the disk.
RawlogWriter::RawlogWriter(const std::string& path)
    : path_(path), partPath_(path + ".part"), file_(openPart(path, partPath_), gzclose_w) {}

RawlogWriter::~RawlogWriter() {
  file_.reset();
  std::error_code ignored;
  std::filesystem::remove(partPath_, ignored);
}

void RawlogWriter::write(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream bytes;
  mrpt::serialization::archiveFrom(bytes) << object;
  const auto size = static_cast<unsigned>(bytes.getTotalBytesCount());
  errno = 0;
  if (gzwrite(file_.get(), bytes.getRawBufferData(), size) != static_cast<int>(size))
    throw cannotWrite(path_, errno);
}

void RawlogWriter::finish() {
  errno = 0;
  if (gzclose_w(file_.release()) != Z_OK) throw cannotWrite(path_, errno);
  std::error_code error;
  std::filesystem::rename(partPath_, path_, error);
  if (error) throw cannotWrite(path_, error.value());
}

}  // namespace hybrid_slam
