/// @file SipOdometry.h
/// @brief Pose from the counters of server information packets.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>

#include "live/ArcosPacket.h"

namespace hybrid_slam::live {

/// Accumulates the counters of SIPs across wrap-arounds.
class SipOdometry {
 public:
  explicit SipOdometry(double metresPerUnit) : metresPerUnit_(metresPerUnit) {}
  /// @return the pose (m, rad) relative to the first SIP
  mrpt::math::TPose2D operator()(const arcos::Sip& sip);

 private:
  double metresPerUnit_;
  std::optional<arcos::Sip> last_;
  int64_t x_ = 0, y_ = 0;  ///< units
};

}  // namespace hybrid_slam::live
