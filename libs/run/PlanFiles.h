/// @file PlanFiles.h
/// @brief Writes and reads floor plans. All coordinates are metres in the map frame.
#pragma once

#include <string>
#include <vector>

#include "files/OutputFolder.h"
#include "slam/plan/FloorPlan.h"
#include "slam/plan/PlanLine.h"

namespace hybrid_slam::run {

/// Writes `plan.svg`: walls black, filled between their two faces; openings dashed. The attribute
/// `data-covariance` of a wall holds the upper triangle of PlanWall::covariance.
void savePlanSvg(const files::OutputFolder& folder, const FloorPlan& plan);

/// Writes `plan.dxf` (R12, metres): a LINE for each wall on the layer WALLS, and for each opening on
/// OPENINGS. A wall's extended data (HYBRID_SLAM) holds the upper triangle of PlanWall::covariance.
/// @throws InputError if it cannot be written completely
void savePlanDxf(const files::OutputFolder& folder, const FloorPlan& plan);

/// Writes `plan.geojson`: a LineString for each wall and opening, with the covariance of the wall.
void savePlanGeoJson(const files::OutputFolder& folder, const FloorPlan& plan);

/// Writes all three files.
void savePlan(const files::OutputFolder& folder, const FloorPlan& plan);

/// Reads the walls of a plan: GeoJSON with LineStrings or Polygons (m), DXF (readPlanDxf), or an SVG that
/// savePlanSvg wrote. The file name's ending selects the format. Openings are left out.
/// @throws InputError for a file that is unreadable, of another format or without walls, and as
/// PlanLines::add
std::vector<PlanLine> loadPlan(const std::string& file);
/// Reads the walls of a plan from the content of its file, as loadPlan does.
std::vector<PlanLine> planOf(const std::string& text, const std::string& file);

/// Bounds the number of pieces in which plans are compared and searched.
/// @param length  m, of all walls
/// @throws InputError for over 30 km
void checkPlanLength(double length, const std::string& file);

}  // namespace hybrid_slam::run
