#include "files/GridMapReader.h"

#include <new>

#include "base/Errors.h"
#include "files/ObjectFile.h"
#include "files/ObjectLayouts.h"
#include "files/ObjectReader.h"
#include "files/ObjectWalk.h"

namespace hybrid_slam::files {
namespace {

constexpr size_t kMostGridMapBytes =
    kMostGridMapCells + (size_t{1} << 20);  // one byte a cell, and the options
constexpr const char* kGridMapExpected =
    "expected a grid map of MRPT (COccupancyGridMap2D, plain or gzipped)";

}  // namespace

mrpt::maps::COccupancyGridMap2D readGridMap(const std::string& file) {
  ObjectFile in(file, kGridMapExpected);
  try {
    ObjectWalk walk(in.bytes(), false, kMostGridMapBytes);
    walk.object(ObjectKind::gridMap);
    const bool hasMore = in.bytes().has(walk.at() + 1);  // to the checksum of gzip
    if (!in.damage().empty()) throw ObjectCut("");
    if (hasMore) throw ObjectError("bytes after the map");
    const auto object = buildObject(walk.rest());
    return std::move(dynamic_cast<mrpt::maps::COccupancyGridMap2D&>(*object));
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const ObjectCut&) {
    throw InputError(in.damage().empty() ? "grid map cut off" : in.damage(), file, kGridMapExpected);
  } catch (const std::exception& e) {
    throw InputError("not a readable grid map (" + messageOf(e) + ")", file, kGridMapExpected);
  }
}

}  // namespace hybrid_slam::files
