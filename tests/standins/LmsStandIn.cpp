#include "standins/LmsStandIn.h"

#include <mrpt/core/format.h>

#include <cmath>

namespace hybrid_slam::test {
namespace {

constexpr char kStart = '\x02', kEnd = '\x03';

std::string hex(unsigned value) { return mrpt::format("%X", value); }

bool startsWith(const std::string& text, const std::string& head) {
  return text.compare(0, head.size(), head) == 0;
}

}  // namespace

void LmsStandIn::step(live::TcpSocket& socket, const std::string& bytes) {
  buffer_ += bytes;
  for (auto end = buffer_.find(kEnd); end != std::string::npos; end = buffer_.find(kEnd)) {
    const auto start = buffer_.find(kStart);
    const std::string telegram = start < end ? buffer_.substr(start + 1, end - start - 1) : "";
    buffer_.erase(0, end + 1);
    send(socket, answerTo(telegram));
  }
  const auto now = std::chrono::steady_clock::now();
  if (!sends_ || now - lastScan_ < std::chrono::milliseconds(40)) return;
  lastScan_ = now;
  send(socket, "sSN LMDscandata" + scan());
}

void LmsStandIn::send(live::TcpSocket& socket, const std::string& telegram) {
  std::string bytes = kStart + telegram + kEnd;
  switch (fault()) {
    case Fault::silent:
      return;
    case Fault::garbled:
      bytes = "\x02 garbage \xff\x80\x02sSN LMDscandata 1 1 \x03" + bytes;
      break;
    case Fault::cut:
      late_ = bytes.substr(bytes.size() / 2);
      bytes.resize(bytes.size() / 2);
      break;
    default:
      bytes.insert(0, std::exchange(late_, {}));
  }
  socket.send(bytes, 5);
}

std::string LmsStandIn::answerTo(const std::string& telegram) {
  if (startsWith(telegram, "sMN SetAccessMode")) return "sAN SetAccessMode 1";
  if (startsWith(telegram, "sMN mLMPsetscancfg")) return "sAN mLMPsetscancfg 0 9C4 1 1388 FFF92230 225510";
  if (startsWith(telegram, "sWN LMDscandatacfg")) return "sWA LMDscandatacfg";
  if (startsWith(telegram, "sMN LMCstartmeas")) {
    measures_ = true;
    return "sAN LMCstartmeas 0";
  }
  if (startsWith(telegram, "sRN STlms"))
    return std::string("sRA STlms ") + (measures_ ? '7' : '2') + " 0 8 00:00:00 8";
  if (startsWith(telegram, "sMN Run")) return "sAN Run 1";
  if (startsWith(telegram, "sEN LMDscandata 1")) {
    sends_ = measures_;
    return "sEA LMDscandata 1";
  }
  if (startsWith(telegram, "sRN LMDscandata") && measures_) return "sRA LMDscandata" + scan();
  return "sFA 1";
}

std::string LmsStandIn::scan() {
  const auto scan = robot_.scan();
  ++scanNumber_;
  // Version, device, serial number, 2 x status, telegram counter, scan counter, 2 x time, 2 x inputs, 2 x
  // outputs, reserved, scan and measurement frequency, encoders, channels; then the channel: content, scale,
  // offset, start angle (-45 deg), step (0.5 deg), count.
  std::string text = " 1 1 89A27F 0 0 " + hex(scanNumber_) + " " + hex(scanNumber_) +
                     " 1 2 0 0 7 0 0 9C4 168 0 1 DIST1 3F800000 00000000 FFF92230 1388 " +
                     hex(static_cast<unsigned>(scan.getScanSize()));
  for (size_t i = 0; i < scan.getScanSize(); ++i)
    text += " " + hex(scan.getScanRangeValidity(i)
                          ? static_cast<unsigned>(std::lround(1000 * scan.getScanRange(i)))
                          : 0);
  return text + " 0 0 0 0 0 0";
}

}  // namespace hybrid_slam::test
