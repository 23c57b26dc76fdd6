#include "live/SipOdometry.h"

#include <cmath>

namespace hybrid_slam::live {
namespace {

/// Returns the signed difference of a 15-bit counter.
int difference(uint16_t from, uint16_t to) {
  const int forwards = (to - from) & 0x7fff;
  return forwards < 0x4000 ? forwards : forwards - 0x8000;
}

}  // namespace

mrpt::math::TPose2D SipOdometry::operator()(const arcos::Sip& sip) {
  if (last_) x_ += difference(last_->x, sip.x), y_ += difference(last_->y, sip.y);
  last_ = sip;
  const double turn = 2 * M_PI * sip.heading / 4096;
  return {metresPerUnit_ * static_cast<double>(x_), metresPerUnit_ * static_cast<double>(y_),
          std::remainder(turn, 2 * M_PI)};
}

}  // namespace hybrid_slam::live
