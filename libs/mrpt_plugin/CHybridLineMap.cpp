#include "mrpt_plugin/CHybridLineMap.h"

#include <mrpt/core/initializer.h>
#include <mrpt/obs/CObservation2DRangeScan.h>
#include <mrpt/opengl/CSetOfLines.h>
#include <mrpt/opengl/CSetOfObjects.h>
#include <mrpt/poses/CPose3D.h>
#include <mrpt/serialization/CArchive.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <locale>
#include <stdexcept>

#include "base/LaserScan.h"
#include "base/MrptVersion.h"
#include "base/State.h"
#include "slam/lines/LineTable.h"

using mrpt::obs::CObservation;
using mrpt::obs::CObservation2DRangeScan;
using mrpt::poses::CPose3D;

namespace hybrid_slam::mrpt_maps {
namespace {

constexpr uint8_t kVersion = 1;                     // since [line_weight] radius
constexpr uint32_t kMostBytes = uint32_t{1} << 26;  // half a million lines

/// A scan that has lines of the map's plane, or null.
const CObservation2DRangeScan* usable(const CObservation& observation) {
  const auto* scan = dynamic_cast<const CObservation2DRangeScan*>(&observation);
  return scan && isHorizontal(*scan) ? scan : nullptr;
}

std::vector<LineSegment> linesOf(const CObservation2DRangeScan& scan, const HybridLineMapOptions& options) {
  constexpr double kNoLimit = std::numeric_limits<double>::infinity();  // but that of the scan
  return extractLines(toLaserScan(scan, kNoLimit), options.extraction);
}

mrpt::math::TPose2D inPlane(const CPose3D& pose) { return {pose.x(), pose.y(), pose.yaw()}; }

}  // namespace

IMPLEMENTS_SERIALIZABLE(CHybridLineMap, CMetricMap, hybrid_slam::mrpt_maps)
MRPT_INITIALIZER(registerHybridLineMap) { mrpt::rtti::registerClass(CLASS_ID(CHybridLineMap)); }

CHybridLineMap::TMapDefinition::TMapDefinition() = default;

void CHybridLineMap::TMapDefinition::loadFromConfigFile_map_specific(
    const mrpt::config::CConfigFileBase& source, const std::string& prefix) {
  options.load(source, prefix);
}

void CHybridLineMap::TMapDefinition::dumpToTextStream_map_specific(std::ostream& out) const {
  HybridLineMapOptions all = options;
  for (const auto& [section, part] : all.sections()) {
    out << "[" << section << "]\n";
    for (const Option& option : part->table()) out << option.key << " = " << option.get() << "\n";
  }
}

CreatedMetricMap CHybridLineMap::internal_CreateFromMapDefinition(
    const mrpt::maps::TMetricMapInitializer& definition) {
  return CreatedMetricMap(new CHybridLineMap(dynamic_cast<const TMapDefinition&>(definition).options));
}

std::string CHybridLineMap::asString() const {
  return "line map with " + std::to_string(database_.lines().size()) + " lines";
}

void CHybridLineMap::saveMetricMapRepresentationToFile(const std::string& prefix) const {
  std::ofstream file(prefix + ".csv");
  file.imbue(std::locale::classic());
  writeLineTable(database_.lines(), file);
  file.close();
  if (!file) throw std::runtime_error("cannot write " + prefix + ".csv");
}

void CHybridLineMap::getVisualizationInto(mrpt::opengl::CSetOfObjects& objects) const {
  if (!genericMapParams.enableSaveAs3DObject) return;
  const auto lines = mrpt::opengl::CSetOfLines::Create();
  constexpr double kHeight = 0.05;  // m; in its plane, a grid's texture hides them
  lines->setColor_u8(0, 220, 0);
  lines->setLineWidth(3);
  for (const DatabaseLine& line : database_.lines())
    lines->appendLine(line.start.x, line.start.y, kHeight, line.end.x, line.end.y, kHeight);
  objects.insert(lines);
}

bool CHybridLineMap::internal_insertObservation(const CObservation& observation,
                                                const std::optional<const CPose3D>& robot) {
  const CObservation2DRangeScan* scan = usable(observation);
  if (!scan) return false;
  const mrpt::math::TPose2D pose = robot ? inPlane(*robot) : mrpt::math::TPose2D();
  database_.update(transformed(linesOf(*scan, options), pose), options.database, options.association);
  return true;
}

double CHybridLineMap::internal_computeObservationLikelihood(const CObservation& observation,
                                                             const CPose3D& robot) const {
  const CObservation2DRangeScan* scan = usable(observation);
  if (!scan) return 0;
  const auto compared = comparedLines(database_, {robot.x(), robot.y()}, options.weight);
  const LineWeight weight = lineWeight(linesOf(*scan, options), robot.yaw(), *compared, options.weight);
  return options.likelihood.exponent * std::log(weight.value);
}

bool CHybridLineMap::internal_canComputeObservationLikelihood(const CObservation& observation) const {
  return usable(observation);
}

template <class State>
void CHybridLineMap::visit(State& state) {
  state(genericMapParams.enableSaveAs3DObject, genericMapParams.enableObservationLikelihood,
        genericMapParams.enableObservationInsertion, options, database_);
}

uint8_t CHybridLineMap::serializeGetVersion() const { return kVersion; }

void CHybridLineMap::serializeTo(mrpt::serialization::CArchive& out) const {
  std::string bytes;
  StateWriter writer(bytes);
  const_cast<CHybridLineMap*>(this)->visit(writer);  // reads only
  if (bytes.size() > kMostBytes) throw std::runtime_error("a line map of more than 64 MiB");
  out << static_cast<uint32_t>(bytes.size());
  out.WriteBuffer(bytes.data(), bytes.size());
}

void CHybridLineMap::serializeFrom(mrpt::serialization::CArchive& in, uint8_t version) {
  if (version != kVersion) throw StateError("a line map of an unknown version");
  uint32_t size = 0;
  in >> size;
  if (size > kMostBytes) throw StateError("a line map of more than 64 MiB");
  // Memory grows with the bytes present.
  std::string bytes;
  while (bytes.size() < size) {
    constexpr size_t kPiece = 1 << 16;
    const size_t before = bytes.size();
    bytes.resize(std::min<size_t>(size, before + kPiece));
    bytes.resize(before + in.ReadBuffer(bytes.data() + before, bytes.size() - before));
  }
  StateReader reader(bytes);
  visit(reader);
  StateReader::check(reader.isAtEnd(), "bytes follow a line map");
}

}  // namespace hybrid_slam::mrpt_maps

MAP_DEFINITION_REGISTER("hybrid_slam::mrpt_maps::CHybridLineMap,hybridLineMap",
                        hybrid_slam::mrpt_maps::CHybridLineMap)
