#include "io/StepsTable.h"

#include <cstdio>

namespace hybrid_slam {

void writeStepsHeader(std::ostream& out) {
  out << "timestamp,particles,ess,resampled,std_x,std_y,std_phi,std_along,std_across,w_grid_best,w_line_best,"
         "lines_seen,lines_matched,step_ms,matched,slipped\n";
}

void writeStep(std::ostream& out, double timestamp, const FilterStep& s, double milliseconds) {
  const auto number = [&out](const char* format, double value) {
    char text[64];
    std::snprintf(text, sizeof text, format, value);
    out << text << ',';
  };
  number("%.6f", timestamp);
  out << s.particles << ',';
  number("%.6f", s.ess);
  if (s.resampled) out << (*s.resampled ? 1 : 0);
  out << ',';
  for (const double spread : {s.stdX, s.stdY, s.stdPhi, s.stdAlong, s.stdAcross}) number("%.6f", spread);
  for (const auto& weight : {s.gridWeight, s.lineWeight})
    if (weight)
      number("%.6f", *weight);
    else
      out << ',';
  out << s.linesSeen << ',' << s.linesMatched << ',';
  number("%.3f", milliseconds);
  if (s.matched)
    number("%.3f", *s.matched);
  else
    out << ',';
  if (s.slipped) out << (*s.slipped ? 1 : 0);
  out << '\n';
}

void writeParticlesHeader(std::ostream& out) { out << "timestamp,x,y,phi,log_weight\n"; }

void writeParticles(std::ostream& out, double timestamp, const FilterStep& step) {
  for (const auto& [pose, logWeight] : step.poses) {
    char text[160];
    std::snprintf(text, sizeof text, "%.6f,%.6f,%.6f,%.6f,%.6g\n", timestamp, pose.x, pose.y, pose.phi,
                  logWeight);
    out << text;
  }
}

}  // namespace hybrid_slam
