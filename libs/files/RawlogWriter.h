/// @file RawlogWriter.h
/// @brief Serialised objects on disk, whole or not at all: rawlogs, and MRPT's maps.
#pragma once

#include <memory>
#include <string>

#include "files/PartialFile.h"

struct gzFile_s;

namespace mrpt::serialization {
class CSerializable;
}

namespace hybrid_slam::files {

/// Writes objects one after another into a gzip stream, the form that mrpt::obs::CRawlog reads (and, for a
/// single object, that of MRPT's .gridmap.gz and .simplemap.gz). Only `finish` gives the file its name;
/// without it nothing is left.
class RawlogWriter {
 public:
  /// @throws InputError where the folder cannot be written to, or `path` is something else than a file
  explicit RawlogWriter(const std::string& path);

  /// @throws InputError where the disk takes no more
  void write(const mrpt::serialization::CSerializable& object);
  /// What was written so far is on disk after this, for a recording whose program may be killed.
  /// @throws InputError where the disk takes no more
  void flush();
  /// @throws InputError where the disk takes no more, or the file cannot be given its name
  void finish();
  /// Gives the file its name although the disk took no more: RawlogReader reads it up to where it is cut.
  void finishCut();

 private:
  PartialFile file_;
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> gzip_;
};

}  // namespace hybrid_slam::files
