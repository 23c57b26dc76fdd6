/// @file OdometryIncrement.h
/// @brief The odometry of an MRPT action.
#pragma once

#include <mrpt/math/TPose2D.h>

namespace mrpt::obs {
class CActionCollection;
}

namespace hybrid_slam {

/// The increment (m, rad) that an action holds: the raw odometry where there is one, else the mean.
/// @throws InputError if it holds neither
mrpt::math::TPose2D odometryIncrement(const mrpt::obs::CActionCollection& action);

}  // namespace hybrid_slam
