#include "mrpt_plugin/CHybridLineMap.h"

#include <gtest/gtest.h>
#include <mrpt/config/CConfigFileMemory.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/io/CMemoryStream.h>
#include <mrpt/maps/CMultiMetricMap.h>
#include <mrpt/maps/CSimplePointsMap.h>
#include <mrpt/obs/CObservationOdometry.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <cmath>
#include <fstream>

#include "base/Errors.h"
#include "base/LaserScan.h"
#include "base/State.h"
#include "files/TemporaryFolder.h"
#include "testing/CommaLocale.h"
#include "testing/TestRoom.h"

namespace hybrid_slam::mrpt_maps {
namespace {

using mrpt::maps::CMultiMetricMap;
using mrpt::poses::CPose3D;
using test::roomScan;
using test::TPose2D;

const std::string kPrefix = "MappingApplication_hybridLineMap_00_";

RandomStream randomStream() { return RandomStream(1, 2, 3); }

CPose3D pose3D(const TPose2D& pose) { return CPose3D(pose.x, pose.y, 0, pose.phi, 0, 0); }

/// Settings that differ from the defaults, and a map of a few scans.
CHybridLineMap someMap() {
  HybridLineMapOptions options;
  options.database.minLength = 1.5;
  options.weight.sigma = 0.6 * mrpt::DEG2RAD(1.0);
  options.likelihood.exponent = 3;
  CHybridLineMap map(options);
  RandomStream random = randomStream();
  for (int step = 0; step < 5; ++step) {
    const TPose2D pose(0.3 * step, 0.1 * step, 0.05 * step);
    map.insertObservation(roomScan(pose, random), pose3D(pose));
  }
  return map;
}

std::string bytesOf(const mrpt::serialization::CSerializable& object) {
  mrpt::io::CMemoryStream stream;
  mrpt::serialization::archiveFrom(stream) << object;
  return {static_cast<const char*>(stream.getRawBufferData()), stream.getTotalBytesCount()};
}

mrpt::serialization::CSerializable::Ptr objectOf(const std::string& bytes) {
  mrpt::io::CMemoryStream stream;
  stream.assignMemoryNotOwn(bytes.data(), bytes.size());
  return mrpt::serialization::archiveFrom(stream).ReadObject();
}

/// @param tolerance  m, rad
void expectEqual(const std::vector<DatabaseLine>& a, const std::vector<DatabaseLine>& b, double tolerance) {
  ASSERT_EQ(a.size(), b.size());
  for (size_t i = 0; i < a.size(); ++i) {
    EXPECT_NEAR(a[i].rho, b[i].rho, tolerance);
    EXPECT_NEAR(a[i].theta, b[i].theta, tolerance);
    EXPECT_NEAR((a[i].start - b[i].start).norm(), 0, tolerance);
    EXPECT_NEAR((a[i].end - b[i].end).norm(), 0, tolerance);
    EXPECT_EQ(a[i].count, b[i].count);
  }
}

CMultiMetricMap mapsOf(const std::string& ini) {
  mrpt::config::CConfigFileMemory source;
  source.setContent("[MappingApplication]\nhybridLineMap_count = 1\npointsMap_count = 1\n" + ini);
  mrpt::maps::TSetOfMetricMapInitializers definitions;
  definitions.loadFromConfigFile(source, "MappingApplication");
  return CMultiMetricMap(definitions);
}

TEST(CHybridLineMap, InsertionIsTheUpdateOfTheDatabase) {
  const CHybridLineMap map = someMap();
  LineDatabase expected;
  RandomStream random = randomStream();
  for (int step = 0; step < 5; ++step) {
    const TPose2D pose(0.3 * step, 0.1 * step, 0.05 * step);
    const auto lines = extractLines(toLaserScan(roomScan(pose, random), 80), map.options.extraction);
    expected.update(transformed(lines, pose), map.options.database, map.options.association);
  }
  EXPECT_GE(expected.lines().size(), 4u);
  expectEqual(map.database().lines(), expected.lines(), 1e-12);  // MRPT's poses are matrices
}

TEST(CHybridLineMap, LikelihoodIsTheLogarithmOfTheLineWeight) {
  const CHybridLineMap map = someMap();
  RandomStream random = randomStream();
  const auto scan = roomScan({}, random);
  const auto lines = extractLines(toLaserScan(scan, 80), map.options.extraction);
  for (const double heading : {0.0, 0.01, -0.03, 0.5}) {
    const double weight = lineWeight(lines, heading, map.database(), map.options.weight).value;
    EXPECT_NEAR(map.computeObservationLikelihood(scan, CPose3D(1, 2, 0, heading, 0, 0)), 3 * std::log(weight),
                1e-9);
  }
  EXPECT_LT(map.computeObservationLikelihood(scan, CPose3D(0, 0, 0, 0.5, 0, 0)),
            map.computeObservationLikelihood(scan, CPose3D()) - 1);
  EXPECT_EQ(CHybridLineMap().computeObservationLikelihood(scan, CPose3D()), 0);
}

TEST(CHybridLineMap, OtherObservationsAndTiltedScansAreIgnored) {
  CHybridLineMap map;
  mrpt::obs::CObservationOdometry odometry;
  RandomStream random = randomStream();
  auto tilted = roomScan({}, random);
  EXPECT_TRUE(map.canComputeObservationLikelihood(tilted));
  tilted.sensorPose = CPose3D(0, 0, 0, 0, 0.3, 0);
  for (const mrpt::obs::CObservation* observation :
       {static_cast<mrpt::obs::CObservation*>(&odometry), static_cast<mrpt::obs::CObservation*>(&tilted)}) {
    EXPECT_FALSE(map.insertObservation(*observation));
    EXPECT_FALSE(map.canComputeObservationLikelihood(*observation));
    EXPECT_EQ(map.computeObservationLikelihood(*observation, CPose3D()), 0);
  }
  EXPECT_TRUE(map.isEmpty());
}

TEST(CHybridLineMap, IsTheSameAfterSerialisation) {
  CHybridLineMap map = someMap();
  map.genericMapParams.enableObservationInsertion = false;
  const auto copy = std::dynamic_pointer_cast<CHybridLineMap>(objectOf(bytesOf(map)));
  ASSERT_TRUE(copy);
  expectEqual(copy->database().lines(), map.database().lines(), 0);
  EXPECT_EQ(bytesOf(*copy), bytesOf(map));
  EXPECT_FALSE(copy->genericMapParams.enableObservationInsertion);
  RandomStream random = randomStream();
  const auto scan = roomScan({}, random);
  const CPose3D turned(0, 0, 0, 0.02, 0, 0);
  EXPECT_EQ(copy->computeObservationLikelihood(scan, turned), map.computeObservationLikelihood(scan, turned));
}

TEST(CHybridLineMap, EveryCutAndMostWrongBytesAreErrors) {
  const std::string bytes = bytesOf(someMap());
  for (size_t size = 0; size < bytes.size(); ++size)
    EXPECT_ANY_THROW(objectOf(bytes.substr(0, size))) << size;

  // The length follows the class's name and the version; MRPT must not trust it.
  const std::string name = "hybrid_slam::mrpt_maps::CHybridLineMap";
  const size_t length = bytes.find(name) + name.size() + 1;
  for (const uint32_t wrong : {0u, 7u, uint32_t{1} << 25, 0xffffffffu}) {
    std::string damaged = bytes;
    damaged.replace(length, sizeof wrong, reinterpret_cast<const char*>(&wrong), sizeof wrong);
    EXPECT_ANY_THROW(objectOf(damaged)) << wrong;
  }
  for (size_t at = length; at < bytes.size(); ++at) {
    std::string damaged = bytes;
    damaged[at] = static_cast<char>(damaged[at] ^ 0xff);
    try {
      objectOf(damaged);
    } catch (const std::exception&) {
    }
  }
}

TEST(CHybridLineMap, IsCreatedFromAnIniText) {
  const CMultiMetricMap maps =
      mapsOf("[" + kPrefix + "line_database]\nmin_length = 2.5\n[" + kPrefix +
             "line_weight]\nmethod = paper\n[" + kPrefix + "likelihoodOpts]\nexponent = 100\n[" + kPrefix +
             "creationOpts]\nenableObservationLikelihood = false\n");
  const auto map = maps.mapByClass<CHybridLineMap>();
  ASSERT_TRUE(map);
  EXPECT_EQ(map->options.database.minLength, 2.5);
  EXPECT_EQ(map->options.weight.method, LineWeightOptions::Method::paper);
  EXPECT_EQ(map->options.likelihood.exponent, 100);
  EXPECT_EQ(map->options.association.maxRho, AssociationOptions().maxRho);
  EXPECT_FALSE(map->genericMapParams.enableObservationLikelihood);
}

TEST(HybridLineMapOptions, MisspeltSectionsAndKeysAreErrors) {
  for (const std::string text :
       {"line_wieght]\n", "line_weight]\nsigma = 1\n", "likelihoodOpts]\nexponent = -1\n"}) {
    mrpt::config::CConfigFileMemory source;
    source.setContent("[" + kPrefix + text);
    EXPECT_THROW(HybridLineMapOptions().load(source, "MappingApplication_hybridLineMap_00"), InputError)
        << text;
    HybridLineMapOptions().load(source, "MappingApplication_hybridLineMap_01");  // another map's
  }
}

/// As in a particle of MRPT's filter, several maps add their likelihoods, and a copied particle keeps them.
TEST(CHybridLineMap, AddsToTheLikelihoodOfSeveralMapsAndTheirCopies) {
  CMultiMetricMap maps = mapsOf("[" + kPrefix + "line_database]\nmin_length = 1.5\n");
  RandomStream random = randomStream();
  const auto scan = roomScan({}, random);
  maps.insertObservation(scan);
  const CMultiMetricMap copy = maps;
  const CPose3D turned(0, 0, 0, 0.02, 0, 0);
  const double lines = maps.mapByClass<CHybridLineMap>()->computeObservationLikelihood(scan, turned);
  const double points =
      maps.mapByClass<mrpt::maps::CSimplePointsMap>()->computeObservationLikelihood(scan, turned);
  EXPECT_LT(lines, -0.1);
  EXPECT_DOUBLE_EQ(maps.computeObservationLikelihood(scan, turned), lines + points);
  EXPECT_DOUBLE_EQ(copy.computeObservationLikelihood(scan, turned), lines + points);
}

TEST(CHybridLineMap, IsSavedAndSerialisedAlikeInAnyLocale) {
  const files::TemporaryFolder folder;
  const CHybridLineMap map = someMap();
  const std::string bytes = bytesOf(map);
  map.saveMetricMapRepresentationToFile(folder.path("plain"));
  {
    const test::CommaLocale comma;  // of the program that loads the plugin
    map.saveMetricMapRepresentationToFile(folder.path("comma"));
    EXPECT_TRUE(bytesOf(map) == bytes);
  }
  const auto contentOf = [&](const std::string& name) {
    std::ifstream file(folder.path(name));
    return std::string(std::istreambuf_iterator<char>(file), {});
  };
  EXPECT_EQ(contentOf("comma.csv"), contentOf("plain.csv"));
}

TEST(CHybridLineMap, IsDrawnUnlessSwitchedOff) {
  CHybridLineMap map = someMap();
  const auto drawn = map.getVisualization()->getByClass<mrpt::opengl::CSetOfLines>();
  ASSERT_TRUE(drawn);
  EXPECT_EQ(drawn->getLineCount(), map.database().lines().size());
  map.genericMapParams.enableSaveAs3DObject = false;
  EXPECT_FALSE(map.getVisualization()->getByClass<mrpt::opengl::CSetOfLines>());
  map.clear();
  EXPECT_TRUE(map.isEmpty());
}

/// As in a .3Dscene file of rbpf-slam, which a viewer without the plugin reads.
TEST(CHybridLineMap, IsDrawnTheSameInAScene) {
  const CHybridLineMap map = someMap();
  mrpt::opengl::COpenGLScene scene;
  scene.insert(map.getVisualization());
  const auto read = std::dynamic_pointer_cast<mrpt::opengl::COpenGLScene>(objectOf(bytesOf(scene)));
  ASSERT_TRUE(read);
  const auto drawn = read->getByClass<mrpt::opengl::CSetOfLines>();
  ASSERT_TRUE(drawn);
  const mrpt::img::TColor color = drawn->getColor_u8();
  EXPECT_TRUE(color.G > color.R + 100 && color.G > color.B + 100);  // green
  const std::vector<DatabaseLine>& lines = map.database().lines();
  ASSERT_GE(lines.size(), 4u);
  ASSERT_EQ(drawn->getLineCount(), lines.size());
  for (size_t i = 0; i < lines.size(); ++i) {
    double x0 = 0, y0 = 0, z0 = 1, x1 = 0, y1 = 0, z1 = 1;
    drawn->getLineByIndex(i, x0, y0, z0, x1, y1, z1);
    EXPECT_NEAR(x0, lines[i].start.x, 1e-4);
    EXPECT_NEAR(y0, lines[i].start.y, 1e-4);
    EXPECT_NEAR(x1, lines[i].end.x, 1e-4);
    EXPECT_NEAR(y1, lines[i].end.y, 1e-4);
    EXPECT_GT(z0, 0.01) << "above the plane of a grid";
    EXPECT_EQ(z1, z0);
  }
}

}  // namespace
}  // namespace hybrid_slam::mrpt_maps
