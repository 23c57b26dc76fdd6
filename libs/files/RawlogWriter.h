/// @file RawlogWriter.h
/// @brief Writes serialised objects, completely or not at all: rawlogs and MRPT's maps.
#pragma once

#include <memory>
#include <string>

#include "files/PartialFile.h"

struct gzFile_s;

namespace mrpt::serialization {
class CSerializable;
}

namespace hybrid_slam::files {

/// Writes objects into a gzip stream, the format of mrpt::obs::CRawlog (and, for a single object, of MRPT's
/// .gridmap.gz and .simplemap.gz). Only `finish` gives the file its name; without it no file is left.
class RawlogWriter {
 public:
  /// @throws InputError if the folder is not writable, or `path` is not a file
  explicit RawlogWriter(const std::string& path);

  /// @throws InputError if the disk is full
  void write(const mrpt::serialization::CSerializable& object);
  /// Syncs to disk, so that a recording survives a killed program.
  /// @throws InputError if the disk is full
  void flush();
  /// @throws InputError if the disk is full, or the file cannot be renamed
  void finish();
  /// Like `finish` on a full disk: keeps the truncated file, which RawlogReader can read up to the cut.
  void finishCut();
  /// Returns whether no other writer, running or killed, has a file for the same path.
  bool isOnly() const { return file_.path() == PartialFile::partialName(file_.finalPath()); }
  /// The final path; another one after `finish` if the folder was moved meanwhile.
  const std::string& path() const { return file_.finalPath(); }

 private:
  PartialFile file_;
  int descriptor_;  ///< owned by gzip_
  std::unique_ptr<gzFile_s, int (*)(gzFile_s*)> gzip_;
};

}  // namespace hybrid_slam::files
