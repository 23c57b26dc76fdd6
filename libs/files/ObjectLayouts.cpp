#include "files/ObjectLayouts.h"

#include <mrpt/obs/CObservationIMU.h>

#include <cmath>
#include <string>

namespace hybrid_slam::files {
namespace {

using Kind = ObjectKind;
using Walk = ObjectWalk;

constexpr size_t kTime = 8;
constexpr size_t kMostBeams = 1 << 20;  // of a scan, hundreds of times those of a laser: 9 MB in memory
constexpr size_t kMostThrunParticles = 10000;  // MRPT draws them while it reads
constexpr float kFarthestCell = 1 << 20;       // from the origin: floats are exact to a cell far beyond

/// Reads an enumerator, 0 or 1: any other value would be undefined behaviour.
uint32_t zeroOrOne(Walk& in, const char* what) {
  const uint32_t value = in.number();
  if (value > 1) throw ObjectError(std::string("unknown ") + what);
  return value;
}

void matrix(Walk& in, size_t cell) {
  constexpr size_t kMostSide = 1000;
  const size_t rows = in.number(), columns = in.number();
  if (rows > kMostSide || columns > kMostSide)
    throw ObjectError("a matrix of more than 1000 rows or columns");
  in.skip(rows * columns * cell);
}
void matrixF(Walk& in, int) { matrix(in, 4); }
void matrixD(Walk& in, int) { matrix(in, 8); }

void pose2D(Walk& in, int v) { in.skip(v == 0 ? 3 * 4 : 3 * 8); }

void pose3D(Walk& in, int v) {
  if (v < 2)
    in.object(v == 0 ? Kind::matrixF : Kind::matrixD);
  else
    in.skip(v == 2 ? 7 * 8 : 12 * 8);
}

void gaussian2D(Walk& in, int v) {
  in.object(Kind::pose2D);
  if (v == 0)
    in.object(Kind::matrixF);
  else
    in.skip(v == 1 ? 6 * 4 : 6 * 8);
}

void gaussianInf2D(Walk& in, int) { in.skip(9 * 8); }

/// @param least  smallest size of an element, bytes
size_t someElements(Walk& in, size_t least) {
  const size_t n = in.count(least);
  if (n == 0) throw ObjectError("a pose distribution without elements");
  return n;
}

void particles2D(Walk& in, int v) {
  if (v == 1) return in.skip(4 * 8 * someElements(in, 4 * 8));
  for (size_t n = someElements(in, 8); n > 0; --n) {
    in.skip(8);
    in.object(Kind::pose2D);
  }
}

void sumOfGaussians2D(Walk& in, int v) {
  for (size_t n = someElements(in, 8); n > 0; --n) {
    in.skip(8);
    in.object(Kind::pose2D);
    in.skip(v == 1 ? 6 * 4 : 6 * 8);
  }
}

void gaussian3D(Walk& in, int v) {
  if (v == 0) throw ObjectError("CPose3DPDFGaussian of version 0");  // MRPT does not read it
  in.object(Kind::pose3D);
  in.skip(21 * 8);
}

void odometryModel(Walk& in, int v) {
  in.object(Kind::pose2D);
  if (v == 2) return in.skip(44);
  zeroOrOne(in, "motion model");
  in.skip(v == 3 ? 3 * 4 + 2 * 8 : 6 * 4);
  if (in.number() > kMostThrunParticles) throw ObjectError("a motion model of more than 10000 particles");
  in.skip(v >= 5 ? 6 * 4 : 4 * 4);
}

void movement2D(Walk& in, int v) {
  if (v < 2) {
    in.object(Kind::pdf2D);
    zeroOrOne(in, "estimation method");
    if (v == 0) return;
  } else {
    const bool isScanMatching = zeroOrOne(in, "estimation method") == 1;
    if (isScanMatching)
      in.object(Kind::pdf2D);
    else
      odometryModel(in, v);
  }
  const bool hasVelocities = in.flag();
  if (v < 7)
    in.skip(2 * 4);
  else if (hasVelocities)
    in.skip(3 * 8);
  const bool hasTicks = in.flag();
  if (v < 7 || hasTicks) in.skip(2 * 4);
  if (v >= 6) in.skip(kTime);
}

void movement3D(Walk& in, int v) {
  zeroOrOne(in, "estimation method");
  in.object(Kind::pdf3D);
  in.flags();
  in.array(4);
  if (v >= 1) in.skip(kTime);
}

void scan(Walk& in, int v) {
  in.skip(4);  // aperture
  in.flag();   // rightToLeft
  in.skip(4);  // maxRange
  in.object(Kind::pose3D);
  if (v < 6) in.object(Kind::matrixF);
  const size_t beam = v == 0 ? 4 : 5;  // range, validity
  const size_t beams = in.count(beam);
  if (beams > kMostBeams) throw ObjectError("a scan of more than 2^20 beams");
  in.skip(beams * beam);
  if (v >= 2) in.skip(4);  // stdError
  if (v >= 3) in.skip(kTime);
  if (v >= 4) in.skip(4);  // beamAperture
  if (v >= 5) {
    in.label();
    in.skip(8);  // deltaPitch
  }
  if (v >= 7 && in.flag()) in.skip(beams * 4);  // intensities
  if (v >= 8) in.skip(8);                       // sweepDuration
}

void odometry(Walk& in, int v) {
  in.object(Kind::pose2D);
  in.label();
  in.skip(kTime);
  if (v == 0) return;
  const bool hasTicks = in.flag();
  if (hasTicks || v < 2) in.skip(2 * 4);
  const bool hasVelocities = in.flag();
  if (v < 2)
    in.skip(2 * 4);
  else if (hasVelocities)
    in.skip(3 * 8);
}

void imu(Walk& in, int v) {
  constexpr size_t kValues = mrpt::obs::COUNT_IMU_DATA_FIELDS;
  in.object(Kind::pose3D);
  if (v >= 4)
    for (size_t i = 0; i < kValues; ++i) in.flag();
  else
    in.flags();
  in.skip(kTime);
  if (v >= 4)
    in.skip(kValues * 8);
  else
    in.array(v == 0 ? 4 : 8);
  in.label();
}

void comment(Walk& in, int v) {
  in.text();
  in.skip(kTime);
  if (v >= 1) in.label();
}

void battery(Walk& in, int v) {
  in.skip(2 * 8);
  in.flag(), in.flag();
  in.array(8);
  in.flags();
  if (v >= 1) in.label();
  if (v >= 2) in.skip(kTime);
}

void range(Walk& in, int v) {
  in.skip(3 * 4);
  for (size_t n = in.count(8); n > 0; --n) {
    if (v >= 3) in.skip(2);
    in.object(Kind::pose3D);
    in.skip(v >= 4 ? 2 * 4 : 4);
  }
  if (v >= 1) in.label();
  if (v >= 2) in.skip(kTime);
}

void robotPose(Walk& in, int v) {
  in.object(Kind::pdf3D);
  in.label();
  in.skip(kTime);
  if (v >= 1) in.object(Kind::pose3D);
}

void actions(Walk& in, int) {
  constexpr size_t kLeast = 16;  // an object's header and end
  for (size_t n = in.count(kLeast); n > 0; --n) in.object(Kind::action);
}

void frame(Walk& in, int v) {
  if (v < 2) in.skip(4);  // an id
  if (v == 0) in.skip(kTime);
  in.observations();
}

void mapParameters(Walk& in, int) { in.flag(), in.flag(), in.flag(); }

/// Number of cells from `min` to `max` (m), as COccupancyGridMap2D::setSize computes it.
size_t cellsAcross(float min, float max, float resolution) {
  const auto inCells = [resolution](float at) {
    const float cells = std::round(at / resolution);
    if (!(std::abs(cells) <= kFarthestCell)) throw ObjectError("a grid map with an impossible place");
    return cells;
  };
  const float first = resolution * inCells(min), last = resolution * inCells(max);
  return last > first ? static_cast<size_t>(std::lround((last - first) / resolution)) : 0;
}

size_t cellSize(uint8_t bits) {
  if (bits != 8 && bits != 16)
    throw ObjectError("a grid map with cells of " + std::to_string(bits) + " bits");
  return bits / 8;
}

void gridMapOptions(Walk& in, int v) {
  constexpr uint32_t kLikelihoodMethods = 7;
  in.skip(4);
  in.flag();
  in.skip(2 * 4);
  in.flag();
  in.skip(2 + 4);
  if (in.number() >= kLikelihoodMethods) throw ObjectError("unknown likelihood method");
  in.skip(6 * 4);
  in.flag();
  in.skip(3 * 4);
  in.flag();
  in.skip(4 * 4);
  in.array(4);  // OWA_weights
  in.flag();
  if (v >= 6)
    in.object(Kind::mapParameters);
  else
    in.flag();
  if (v >= 4) in.skip(2 * 4);
  if (v >= 5) in.flag();
}

void gridMap(Walk& in, int v) {
  const size_t cell = v >= 2 ? cellSize(in.byte()) : 1;
  const size_t columns = in.number(), rows = in.number();
  const float xMin = in.real(), xMax = in.real(), yMin = in.real(), yMax = in.real(), resolution = in.real();
  if (!(resolution > 0) || !std::isfinite(resolution))
    throw ObjectError("a grid map with an impossible cell size");
  // MRPT takes the number of cells from the place.
  if (columns == 0 || rows == 0 || columns != cellsAcross(xMin, xMax, resolution) ||
      rows != cellsAcross(yMin, yMax, resolution))
    throw ObjectError("a grid map whose size and place disagree");
  if (columns * rows > kMostGridMapCells) throw ObjectError("a grid map of more than 2^28 cells");
  in.skip(columns * rows * cell);
  if (v >= 1) gridMapOptions(in, v);
}

constexpr ObjectLayout kLayouts[] = {
    {"CObservation2DRangeScan", Kind::observation, 9, scan},
    {"CObservationOdometry", Kind::observation, 3, odometry},
    {"CSensoryFrame", Kind::frame, 3, frame},
    {"CActionCollection", Kind::actions, 1, actions},
    {"CActionRobotMovement2D", Kind::action, 8, movement2D},
    {"CActionRobotMovement3D", Kind::action, 2, movement3D},
    {"CPosePDFGaussian", Kind::pdf2D, 3, gaussian2D},
    {"CPosePDFGaussianInf", Kind::pdf2D, 1, gaussianInf2D},
    {"CPosePDFParticles", Kind::pdf2D, 2, particles2D},
    {"CPosePDFSOG", Kind::pdf2D, 3, sumOfGaussians2D},
    {"CPose3DPDFGaussian", Kind::pdf3D, 2, gaussian3D},
    {"CPose2D", Kind::pose2D, 2, pose2D},
    {"CPose3D", Kind::pose3D, 4, pose3D},
    {"CMatrixF", Kind::matrixF, 1, matrixF},
    {"CMatrixD", Kind::matrixD, 1, matrixD},
    {"CObservationIMU", Kind::observation, 5, imu},
    {"CObservationComment", Kind::observation, 2, comment},
    {"CObservationBatteryState", Kind::observation, 3, battery},
    {"CObservationRange", Kind::observation, 5, range},
    {"CObservationRobotPose", Kind::observation, 2, robotPose},
    {"COccupancyGridMap2D", Kind::gridMap, 7, gridMap},
    {"TMapGenericParams", Kind::mapParameters, 1, mapParameters},
};

}  // namespace

std::string_view baseName(std::string_view name) { return name.substr(name.rfind(':') + 1); }

const ObjectLayout* layoutOf(std::string_view name) {
  const std::string_view base = baseName(name);
  for (const ObjectLayout& layout : kLayouts)
    if (layout.name == base) return &layout;
  return nullptr;
}

}  // namespace hybrid_slam::files
