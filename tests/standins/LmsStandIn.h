/// @file LmsStandIn.h
/// @brief A SICK LMS-100 on TCP: the CoLa-A telegrams that our Lms100 and MRPT's CLMS100Eth send, and scans
/// of a floor plan.
#pragma once

#include <chrono>

#include "standins/SimulatedRobot.h"
#include "standins/StandIn.h"

namespace hybrid_slam::test {

/// Telegrams are text between STX and ETX. The stand-in acknowledges `sMN SetAccessMode`, `sMN
/// mLMPsetscancfg`, `sWN LMDscandatacfg` and `sMN LMCstartmeas`. It answers `sRN STlms` with the state 7,
/// measuring, and `sRN LMDscandata` with a scan; after `sEN LMDscandata 1`, it sends scans without being
/// asked. Distances are in mm as hexadecimal numbers, from right to left, in the order of the device's beams.
class LmsStandIn : public StandIn {
 public:
  explicit LmsStandIn(SimulatedRobot& robot, uint16_t port = 0) : StandIn(port), robot_(robot) { start(); }
  ~LmsStandIn() override { join(); }

 private:
  void connected() override { buffer_.clear(), late_.clear(), sends_ = false; }
  void send(live::TcpSocket& socket, const std::string& telegram);
  void step(live::TcpSocket& socket, const std::string& bytes) override;
  std::string answerTo(const std::string& telegram);
  std::string scan();

  SimulatedRobot& robot_;
  std::string buffer_;
  std::string late_;  ///< the second half of a telegram that was cut
  bool measures_ = false, sends_ = false;
  std::chrono::steady_clock::time_point lastScan_{};
  unsigned scanNumber_ = 0;
};

}  // namespace hybrid_slam::test
