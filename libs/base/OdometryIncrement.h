/// @file OdometryIncrement.h
/// @brief The odometry of an MRPT action.
#pragma once

#include <mrpt/math/TPose2D.h>

namespace mrpt::obs {
class CActionCollection;
}

namespace hybrid_slam {

/// Returns the increment (m, rad) of an action: the raw odometry if there is one, else the mean.
/// @throws InputError if it holds neither
mrpt::math::TPose2D odometryIncrement(const mrpt::obs::CActionCollection& action);

}  // namespace hybrid_slam
