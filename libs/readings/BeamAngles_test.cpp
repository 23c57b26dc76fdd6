#include "readings/BeamAngles.h"

#include <gtest/gtest.h>

#include "base/Degree.h"

namespace hybrid_slam::readings {
namespace {

struct Fan {
  size_t beams;
  double first, last;  // deg
};

TEST(BeamAngles, FollowFromTheNumberOfBeams) {
  for (const Fan& fan : {Fan{180, -90, 89}, Fan{181, -90, 90}, Fan{360, -90, 89.5}, Fan{361, -90, 90},
                         Fan{401, -50, 50}, Fan{540, -135, 134.5}, Fan{541, -135, 135}, Fan{721, -90, 90},
                         Fan{1081, -135, 135}, Fan{683, -341 * 360. / 1024, 341 * 360. / 1024}}) {
    const auto step = angularStepFor(fan.beams);
    ASSERT_TRUE(step) << fan.beams;
    const BeamAngles angles = beamAngles(fan.beams, *step);
    EXPECT_NEAR(angles.first / kDegree, fan.first, 1e-9) << fan.beams;
    EXPECT_NEAR((angles.first + static_cast<double>(fan.beams - 1) * angles.step) / kDegree, fan.last, 1e-9)
        << fan.beams;
  }
}

TEST(BeamAngles, AnUnknownNumberHasNoStep) {
  for (const size_t beams : {0u, 1u, 17u, 182u, 359u, 5000u}) EXPECT_FALSE(angularStepFor(beams)) << beams;
}

TEST(BeamAngles, TheMiddleBeamPointsAhead) {
  for (size_t beams = 1; beams < 50; ++beams) {
    const BeamAngles angles = beamAngles(beams, 0.1);
    const size_t middle = beams / 2;
    EXPECT_NEAR(angles.first + static_cast<double>(middle) * angles.step, 0, 1e-12) << beams;
  }
}

}  // namespace
}  // namespace hybrid_slam::readings
