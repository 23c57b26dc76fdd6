#include "files/GridMapReader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <sys/resource.h>

#include <cstring>
#include <limits>

#include "base/Errors.h"
#include "base/RandomStream.h"
#include "files/ObjectReader.h"
#include "files/ObjectWalk.h"
#include "files/TemporaryFolder.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::files {
namespace {

using mrpt::maps::COccupancyGridMap2D;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string bytesOf(const COccupancyGridMap2D& map) {
  std::vector<uint8_t> bytes;
  mrpt::serialization::ObjectToOctetVector(&map, bytes);
  return {bytes.begin(), bytes.end()};
}

COccupancyGridMap2D randomMap(RandomStream& random) {
  const auto number = [&random](double most) { return static_cast<float>(most * random.uniform()); };
  const float resolution = 0.01f + number(0.3), x = number(200) - 100, y = number(200) - 100;
  COccupancyGridMap2D map(x, x + resolution + number(10), y, y + resolution + number(10), resolution);
  for (int i = 0; i < 50; ++i)
    map.setCell(static_cast<int>(random.bits() % map.getSizeX()),
                static_cast<int>(random.bits() % map.getSizeY()), number(1));
  if (random.bits() % 2 == 0)
    map.resizeGrid(x - number(5), x + number(20), y - number(5), y + number(20), 0.5f);
  map.likelihoodOptions.OWA_weights.resize(random.bits() % 5);
  return map;
}

class GridMapReader : public testing::Test {
 protected:
  std::string errorOf(const std::string& content) {
    const std::string file = folder.write("map", content);
    try {
      readGridMap(file);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(), AllOf(HasSubstr(file), HasSubstr("; expected a grid map of MRPT"),
                                  testing::Not(HasSubstr("\n"))));
      return e.what();
    }
    return "";
  }
  TemporaryFolder folder;
  const COccupancyGridMap2D map{-1, 2, 1, 3, 0.5f};
  const std::string bytes = bytesOf(map);
};

TEST_F(GridMapReader, ReadsWhatMrptWrites) {
  RandomStream random(1, 0, 0);
  for (int i = 0; i < 300; ++i) {
    const COccupancyGridMap2D written = randomMap(random);
    const COccupancyGridMap2D read = readGridMap(folder.write("map", bytesOf(written)));
    ASSERT_EQ(read.getRawMap(), written.getRawMap());
    ASSERT_EQ(read.getResolution(), written.getResolution());
    const float halfCell = 0.501f * read.getResolution();  // MRPT aligns a grid while it reads
    ASSERT_NEAR(read.getXMin(), written.getXMin(), halfCell);
    ASSERT_NEAR(read.getYMax(), written.getYMax(), halfCell);
  }
}

TEST_F(GridMapReader, EveryCutIsOneLine) {
  for (size_t length = 0; length < bytes.size(); ++length)
    ASSERT_THAT(errorOf(bytes.substr(0, length)), StartsWith("grid map cut off: ")) << length;
}

TEST_F(GridMapReader, AGzippedMapThatIsCutOrDamaged) {
  const std::string gzipped =
      test::contentOf(test::writeGzipped(folder.path("gz"), {std::make_shared<COccupancyGridMap2D>(map)}));
  EXPECT_EQ(errorOf(gzipped), "");
  for (size_t length = 20; length < gzipped.size(); ++length)
    ASSERT_THAT(errorOf(gzipped.substr(0, length)), StartsWith("gzip file damaged or cut off: ")) << length;
  std::string damaged = gzipped;
  damaged[gzipped.size() - 6] ^= 1;  // of the checksum
  EXPECT_THAT(errorOf(damaged), StartsWith("gzip file damaged or cut off: "));
}

TEST_F(GridMapReader, OtherFiles) {
  EXPECT_THAT(errorOf(bytes + "more"), HasSubstr("bytes after the map"));
  EXPECT_THAT(errorOf("image: map.pgm\nresolution: 0.05\n"), StartsWith("not a readable grid map"));
  std::vector<uint8_t> scan;
  mrpt::serialization::ObjectToOctetVector(test::scan(0).get(), scan);
  EXPECT_THAT(errorOf({scan.begin(), scan.end()}),
              HasSubstr("CObservation2DRangeScan instead of a grid map"));
  EXPECT_THROW(readGridMap("/nowhere/map.gridmap.gz"), InputError);
  EXPECT_THROW(readGridMap(folder.path("")), InputError);
}

/// Places in the bytes of a grid map.
constexpr size_t kVersion = 1 + sizeof "mrpt::maps::COccupancyGridMap2D" - 1, kBits = kVersion + 1,
                 kSize = kBits + 1, kPlace = kSize + 2 * 4, kResolution = kPlace + 4 * 4;

void put(std::string& bytes, size_t at, float value) { std::memcpy(&bytes[at], &value, sizeof value); }

TEST_F(GridMapReader, ASizeThatTheFileDoesNotHaveTakesNoMemory) {
  const auto peakKilobytes = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return used.ru_maxrss;
  };
  const auto before = peakKilobytes();
  std::string huge = bytes;
  huge[kSize] = huge[kSize + 4] = 0, huge[kSize + 1] = huge[kSize + 5] = 0x40;  // 2^14 x 2^14
  EXPECT_THAT(errorOf(huge), HasSubstr("size and place disagree"));
  put(huge, kPlace, 0), put(huge, kPlace + 4, 8192), put(huge, kPlace + 8, 0), put(huge, kPlace + 12, 8192);
  EXPECT_THAT(errorOf(huge), StartsWith("grid map cut off"));
  huge[kSize + 1] = huge[kSize + 5] = 0, huge[kSize + 2] = huge[kSize + 6] = 1;  // 2^16 x 2^16
  put(huge, kPlace + 4, 32768), put(huge, kPlace + 12, 32768);
  EXPECT_THAT(errorOf(huge), HasSubstr("more than 2^28 cells"));
  EXPECT_LT(peakKilobytes() - before, 4000);
}

TEST_F(GridMapReader, NumbersThatCannotBeTrue) {
  constexpr float kNan = std::numeric_limits<float>::quiet_NaN(),
                  kInf = std::numeric_limits<float>::infinity();
  for (const float value : {kNan, kInf, -kInf, -0.5f, 0.f, 1e-30f}) {
    SCOPED_TRACE(value);
    std::string changed = bytes;
    put(changed, kResolution, value);
    EXPECT_THAT(errorOf(changed), StartsWith("not a readable grid map"));
  }
  for (const float value : {kNan, kInf, -kInf, 1e30f, 17.f}) {
    SCOPED_TRACE(value);
    std::string changed = bytes;
    put(changed, kPlace + 4, value);
    EXPECT_THAT(errorOf(changed), StartsWith("not a readable grid map"));
  }
  std::string changed = bytes;
  changed[kBits] = 7;
  EXPECT_THAT(errorOf(changed), HasSubstr("cells of 7 bits"));
  changed = bytes, changed[kVersion] = 7;
  EXPECT_THAT(errorOf(changed), HasSubstr("of unknown version 7"));
}

TEST_F(GridMapReader, ALikelihoodMethodThatMrptDoesNotKnowIsAnError) {
  COccupancyGridMap2D unknown = map;
  unknown.likelihoodOptions.likelihoodMethod = COccupancyGridMap2D::lmConsensusOWA;
  EXPECT_EQ(errorOf(bytesOf(unknown)), "");
  unknown.likelihoodOptions.likelihoodMethod = static_cast<COccupancyGridMap2D::TLikelihoodMethod>(7);
  EXPECT_THAT(errorOf(bytesOf(unknown)), HasSubstr("unknown likelihood method"));
}

TEST_F(GridMapReader, OldVersions) {
  const std::string name = bytes.substr(0, kVersion), place = bytes.substr(kSize, kResolution + 4 - kSize);
  const std::string cells(6 * 4, '\x80'), end = "\x88";  // occupancy 0.5 before version 3
  const COccupancyGridMap2D first = readGridMap(folder.write("map", name + '\0' + place + cells + end));
  EXPECT_EQ(first.getSizeX(), 6u);
  EXPECT_NEAR(first.getCell(3, 3), 0.5, 0.02);
  // Up to version 5, a flag instead of the object with the general parameters.
  const size_t options = kResolution + 4 + cells.size(),
               parameters = bytes.find("mrpt::maps::TMapGenericParams") - 1;
  ASSERT_LT(parameters, bytes.size());
  const std::string fields = bytes.substr(options, parameters - options) + '\0';
  const size_t last = bytes.size() - 1 - 4 - 4 - 1;
  for (char version = 1; version < 6; ++version) {
    const std::string known = name + version + (version < 2 ? "" : "\x08") + place + cells + fields +
                              bytes.substr(last, version < 4   ? 0
                                                 : version < 5 ? 8
                                                               : 9) +
                              end;
    EXPECT_EQ(errorOf(known), "") << static_cast<int>(version);
    EXPECT_NE(errorOf(known.substr(0, known.size() - 1)), "");
  }
  const std::string wide = name + "\2\x10" + place + cells + cells + fields + end;
  EXPECT_EQ(errorOf(wide), "");
}

TEST_F(GridMapReader, MrptReadsWhatIsAcceptedOrThrows) {
  RandomStream random(2, 0, 0);
  size_t accepted = 0;
  for (int i = 0; i < 20000; ++i) {
    std::string changed = bytes;
    for (uint64_t changes = 1 + random.bits() % 2; changes > 0; --changes)
      changed[random.bits() % changed.size()] = static_cast<char>(random.bits());
    ObjectBytes in(changed);
    ObjectWalk walk(in, false);
    try {
      walk.object(ObjectKind::gridMap);
    } catch (const ObjectError&) {
      continue;
    }
    ++accepted;
    try {
      buildObject(walk.rest());
    } catch (const ObjectError& e) {
      ADD_FAILURE() << "MRPT reads other fields: " << e.what();
    } catch (const std::exception&) {
    }
  }
  EXPECT_GT(accepted, 5000u);
}

}  // namespace
}  // namespace hybrid_slam::files
