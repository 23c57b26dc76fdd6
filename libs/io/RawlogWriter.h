/// @file RawlogWriter.h
/// @brief A rawlog on disk, whole or not at all.
#pragma once

#include <memory>
#include <string>

struct gzFile_s;

namespace mrpt::serialization {
class CSerializable;
}

namespace hybrid_slam {

/// Writes objects one after another into a gzip stream, the form that mrpt::obs::CRawlog reads. The entries
/// go into `PATH.part` beside; only `finish` gives the file its name. Without it the part is removed.
class RawlogWriter {
 public:
  /// @throws InputError where the folder cannot be written to, or `path` is something else than a file
  explicit RawlogWriter(const std::string& path);
  ~RawlogWriter();
  RawlogWriter(const RawlogWriter&) = delete;
  RawlogWriter& operator=(const RawlogWriter&) = delete;

  /// @throws InputError where the disk takes no more
  void write(const mrpt::serialization::CSerializable& object);
  /// @throws InputError where the disk takes no more, or the file cannot be given its name
  void finish();

 private:
  std::string path_, partPath_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> file_;
};

}  // namespace hybrid_slam
