#include "run/SessionFile.h"

#include <fcntl.h>
#include <unistd.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <filesystem>
#include <memory>

#include "base/Errors.h"
#include "files/Gzip.h"
#include "files/InputFile.h"
#include "files/PartialFile.h"

namespace hybrid_slam::run {
namespace {

constexpr uint64_t kMagic = 0x6d616c532d627948;  // "Hyb-Slam"
constexpr uint32_t kFormat = 1;
const char* const kWhat = "session file (session.hslam) of hybrid-slam";

/// Writes all bytes.
bool writeAll(int file, const std::string& bytes) {
  for (size_t done = 0; done < bytes.size();) {
    const ssize_t count = ::write(file, bytes.data() + done, bytes.size() - done);
    if (count < 0 && errno != EINTR) return false;
    done += static_cast<size_t>(std::max<ssize_t>(count, 0));
  }
  return true;
}

}  // namespace

void writeHeader(StateWriter& out, SessionHeader& header) {
  auto magic = kMagic;
  auto format = kFormat;
  out(magic, format, header);
}

void saveSession(const std::string& path, const std::string& bytes) {
  const std::string compressed = files::gzipped(bytes);  // before anything is open
  files::PartialFile partial(path);
  const int file = ::open(partial.path().c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0) partial.fail(errno);
  errno = 0;
  const bool isWritten = writeAll(file, compressed);
  const int error = errno;
  ::close(file);
  if (!isWritten) partial.fail(error);
  partial.commit();
}

std::string sessionIn(const std::string& name) {
  std::error_code ignored;
  const std::filesystem::path session = std::filesystem::path(name) / kSessionName;
  // An option that is not given has no name; it is not that of the working folder.
  return !name.empty() && std::filesystem::exists(session, ignored) ? session.string() : name;
}

bool isSession(const std::string& file) {
  std::error_code ignored;
  if (!std::filesystem::is_regular_file(file, ignored)) return false;  // a pipe would wait
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
  uint64_t magic = 0;
  return in && gzread(in.get(), &magic, sizeof magic) == sizeof magic && magic == kMagic;
}

namespace {

/// Returns the file; rejects another gzip file before all of it is unpacked.
const std::string& notOfAnotherKind(const std::string& file) {
  files::expectFile(file, std::string("expected a ") + kWhat);
  const std::unique_ptr<gzFile_s, int (*)(gzFile)> in(gzopen(file.c_str(), "rb"), gzclose);
  uint64_t magic = 0;
  if (in && gzread(in.get(), &magic, sizeof magic) == sizeof magic && gzdirect(in.get()) == 0 &&
      magic != kMagic)
    throw InputError("not a session file", file, std::string("expected a ") + kWhat);
  return file;
}

}  // namespace

SessionReader::SessionReader(const std::string& file)
    : file_(file), bytes_(files::readGzip(notOfAnotherKind(file), kWhat, kMostSessionBytes)), in_(bytes_) {
  uint64_t magic = 0;
  uint32_t format = 0;
  guarded([&] { in_(magic); });
  if (magic != kMagic) throw InputError("not a session file", file_, std::string("expected a ") + kWhat);
  guarded([&] { in_(format); });
  if (format != kFormat)
    throw InputError(
        "session of format " + std::to_string(format), file_,
        "expected format " + std::to_string(kFormat) + ", which this version of hybrid-slam writes");
  guarded([&] { in_(header_); });
}

void SessionReader::readRest(const std::function<void(StateReader&)>& read) {
  guarded([&] {
    read(in_);
    StateReader::check(in_.isAtEnd(), "it has more bytes than it should");
  });
  std::string().swap(bytes_);  // up to 8 GB, of which the run that goes on needs nothing
  header_.map = ScanMap();
}

void SessionReader::guarded(const std::function<void()>& read) {
  try {
    read();
  } catch (const StateError& error) {
    throw InputError(std::string("damaged session, ") + error.what(), file_,
                     std::string("expected a ") + kWhat);
  }
}

}  // namespace hybrid_slam::run
