// The DXF of a floor plan.
#include <dxflib/dl_dxf.h>

#include <cerrno>
#include <fstream>
#include <string>

#include "files/PartialFile.h"
#include "run/PlanFiles.h"

namespace hybrid_slam::run {
namespace {

/// Returns whether a file was written completely: dxflib does not report a full disk.
bool isComplete(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in || in.tellg() < 4) return false;
  in.seekg(-4, std::ios::end);
  std::string last(4, ' ');
  in.read(last.data(), 4);
  return last == "EOF\n";
}

constexpr char kApplication[] = "HYBRID_SLAM";  // of the extended data

/// Writes the extended data of the wall whose LINE was written last.
void writeCovariance(const PlanWall& wall, const DL_WriterA& out) {
  const Eigen::Matrix2d c = wall.covariance();
  out.dxfString(1001, kApplication);
  out.dxfString(1000, "covariance of offset and angle: m^2, m rad, rad^2");
  for (const double value : {c(0, 0), c(0, 1), c(1, 1)}) out.dxfReal(1040, value);
}

void write(const FloorPlan& plan, DL_Dxf& dxf, DL_WriterA& out) {
  out.comment("floor plan of hybrid-slam; metres in the map frame");
  out.sectionHeader();
  out.dxfString(9, "$ACADVER");
  out.dxfString(1, "AC1009");
  out.sectionEnd();
  out.sectionTables();
  out.tableLinetypes(1);
  dxf.writeLinetype(out, DL_LinetypeData("CONTINUOUS", "Continuous", 0, 0, 0.0));
  out.tableEnd();
  out.tableLayers(2);
  dxf.writeLayer(out, DL_LayerData("WALLS", 0), DL_Attributes("", 7, 0, -1, "CONTINUOUS", 1.0));
  dxf.writeLayer(out, DL_LayerData("OPENINGS", 0), DL_Attributes("", 5, 0, -1, "CONTINUOUS", 1.0));
  out.tableEnd();
  out.tableAppid(1);
  dxf.writeAppid(out, kApplication);
  out.tableEnd();
  out.sectionEnd();
  out.sectionEntities();
  const auto line = [&](const auto& a, const auto& b, const char* layer) {
    dxf.writeLine(out, DL_LineData(a.x, a.y, 0, b.x, b.y, 0),
                  DL_Attributes(layer, 256, 0, -1, "BYLAYER", 1.0));
  };
  for (const PlanWall& wall : plan.walls) {
    line(wall.start, wall.end, "WALLS");
    writeCovariance(wall, out);
  }
  for (const Opening& opening : plan.openings) line(opening.start, opening.end, "OPENINGS");
  out.sectionEnd();
  out.dxfEOF();
}

}  // namespace

void savePlanDxf(const files::OutputFolder& folder, const FloorPlan& plan) {
  files::PartialFile file(folder.path("plan.dxf"));
  errno = 0;
  {
    DL_Dxf dxf;
    DL_WriterA out(file.path().c_str(), DL_Codes::AC1009);
    if (out.openFailed()) file.fail(errno);
    write(plan, dxf, out);
    out.close();
  }
  if (!isComplete(file.path())) file.fail(errno);
  file.commit();
}

}  // namespace hybrid_slam::run
