#include "readings/BeamAngles.h"

#include <cmath>

#include "base/Degree.h"

namespace hybrid_slam::readings {

std::optional<double> angularStepFor(size_t beams) {
  switch (beams) {
    case 100:
    case 101:
    case 180:
    case 181:
      return kDegree;
    case 200:
    case 201:
    case 360:
    case 361:
    case 540:
    case 541:
      return 0.5 * kDegree;
    case 400:
    case 401:
    case 720:
    case 721:
    case 1080:
    case 1081:
      return 0.25 * kDegree;
    case 682:
    case 683:
    case 726:
    case 769:
      return 2 * M_PI / 1024;
    default:
      return std::nullopt;
  }
}

BeamAngles beamAngles(size_t beams, double step) {
  const size_t ahead = beams / 2;
  return {-static_cast<double>(ahead) * step, step};
}

}  // namespace hybrid_slam::readings
