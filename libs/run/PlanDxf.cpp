// The DXF of a floor plan.
#include <dxflib/dl_dxf.h>

#include <cerrno>
#include <fstream>
#include <string>

#include "files/PartialFile.h"
#include "run/PlanFiles.h"

namespace hybrid_slam::run {
namespace {

/// dxflib does not report a full disk.
bool isComplete(const std::string& path) {
  std::ifstream in(path, std::ios::binary | std::ios::ate);
  if (!in || in.tellg() < 4) return false;
  in.seekg(-4, std::ios::end);
  std::string last(4, ' ');
  in.read(last.data(), 4);
  return last == "EOF\n";
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
  out.sectionEnd();
  out.sectionEntities();
  const auto line = [&](const auto& a, const auto& b, const char* layer) {
    dxf.writeLine(out, DL_LineData(a.x, a.y, 0, b.x, b.y, 0),
                  DL_Attributes(layer, 256, 0, -1, "BYLAYER", 1.0));
  };
  for (const Wall& wall : plan.walls) line(wall.start, wall.end, "WALLS");
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
