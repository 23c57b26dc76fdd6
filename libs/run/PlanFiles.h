/// @file PlanFiles.h
/// @brief Writes and reads floor plans. All coordinates are metres in the map frame.
#pragma once

#include <string>
#include <vector>

#include "files/OutputFolder.h"
#include "slam/plan/FloorPlan.h"
#include "slam/plan/PlanLine.h"

namespace hybrid_slam::run {

/// `plan.svg`: walls black, filled between their two faces; openings dashed.
void savePlanSvg(const files::OutputFolder& folder, const FloorPlan& plan);

/// `plan.dxf` (R12, metres): a LINE for each wall on the layer WALLS, for each opening on OPENINGS.
/// @throws InputError if it cannot be written completely
void savePlanDxf(const files::OutputFolder& folder, const FloorPlan& plan);

/// `plan.geojson`: a LineString for each wall and opening, with the covariance of the wall.
void savePlanGeoJson(const files::OutputFolder& folder, const FloorPlan& plan);

/// All three.
void savePlan(const files::OutputFolder& folder, const FloorPlan& plan);

/// The walls of a plan: GeoJSON with LineStrings or Polygons (m), DXF (readPlanDxf), or an SVG that
/// savePlanSvg wrote; told apart by the end of the name. Openings are left out.
/// @throws InputError for an unreadable file, one of another kind, one without walls, or as PlanLines::add
std::vector<PlanLine> loadPlan(const std::string& file);
/// The same for the content of the file.
std::vector<PlanLine> planOf(const std::string& text, const std::string& file);

/// Plans are compared and searched piece by piece: bounds their number.
/// @param length  m, of all walls
/// @throws InputError for over 30 km
void checkPlanLength(double length, const std::string& file);

}  // namespace hybrid_slam::run
