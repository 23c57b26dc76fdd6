/// @file LineTable.h
/// @brief The lines of a map as a table of numbers.
#pragma once

#include <ostream>
#include <vector>

#include "slam/lines/LineDatabase.h"

namespace hybrid_slam {

/// Writes a header and rows `rho,theta,length,x_start,y_start,x_end,y_end,count` (m, rad; map frame).
void writeLineTable(const std::vector<DatabaseLine>& lines, std::ostream& out);

}  // namespace hybrid_slam
