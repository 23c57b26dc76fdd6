#include "slam/lines/LineTable.h"

#include <iomanip>

namespace hybrid_slam {

void writeLineTable(const std::vector<DatabaseLine>& lines, std::ostream& out) {
  out << "rho,theta,length,x_start,y_start,x_end,y_end,count\n" << std::setprecision(9);
  for (const DatabaseLine& l : lines)
    out << l.rho << ',' << l.theta << ',' << l.length << ',' << l.start.x << ',' << l.start.y << ','
        << l.end.x << ',' << l.end.y << ',' << l.count << '\n';
}

}  // namespace hybrid_slam
