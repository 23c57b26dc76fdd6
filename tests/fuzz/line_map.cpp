/// @file line_map.cpp
/// @brief The bytes of CHybridLineMap in a file of MRPT, from settings and lines to a map that is used.

#include <mrpt/io/CMemoryStream.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <exception>
#include <string>

#include "mrpt_plugin/CHybridLineMap.h"

using hybrid_slam::mrpt_maps::CHybridLineMap;

namespace {

/// The object around its content: MRPT's frame, and the size.
std::string framed(const std::string& content) {
  const std::string name = CLASS_ID(CHybridLineMap)->className;
  mrpt::io::CMemoryStream stream;
  auto out = mrpt::serialization::archiveFrom(stream);
  out << static_cast<uint8_t>(name.size() | 0x80);
  out.WriteBuffer(name.data(), name.size());
  out << uint8_t{1} << static_cast<uint32_t>(content.size());
  out.WriteBuffer(content.data(), content.size());
  out << uint8_t{0x88};
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

mrpt::obs::CObservation2DRangeScan wallAhead() {
  mrpt::obs::CObservation2DRangeScan scan;
  scan.aperture = 1;
  scan.maxRange = 5;
  scan.resizeScan(21);
  for (size_t i = 0; i < 21; ++i) {
    scan.setScanRange(i, 1);
    scan.setScanRangeValidity(i, true);
  }
  return scan;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
  const std::string bytes = framed({data, data + size});
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(bytes.data(), bytes.size());
  try {
    CHybridLineMap map;
    mrpt::serialization::archiveFrom(stream).ReadObject(&map);
    const mrpt::obs::CObservation2DRangeScan scan = wallAhead();
    map.computeObservationLikelihood(scan, mrpt::poses::CPose3D());
    map.insertObservation(scan);
    map.asString();
  } catch (const std::exception&) {
  }
  return 0;
}
