/// @file SipOdometry.h
/// @brief From the counters of server information packets to a pose.
#pragma once

#include <mrpt/math/TPose2D.h>

#include <cstdint>
#include <optional>

#include "live/ArcosPacket.h"

namespace hybrid_slam::live {

/// Adds up the counters of SIPs over their wrap-around.
class SipOdometry {
 public:
  explicit SipOdometry(double metresPerUnit) : metresPerUnit_(metresPerUnit) {}
  /// @return the pose (m, rad) from that of the first SIP's counters on
  mrpt::math::TPose2D operator()(const arcos::Sip& sip);

 private:
  double metresPerUnit_;
  std::optional<arcos::Sip> last_;
  int64_t x_ = 0, y_ = 0;  ///< units
};

}  // namespace hybrid_slam::live
