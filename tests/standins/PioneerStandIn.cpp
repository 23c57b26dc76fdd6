#include "standins/PioneerStandIn.h"

#include <cmath>

namespace hybrid_slam::test {
namespace {

void putInteger(live::arcos::Payload& payload, long value) {
  payload.push_back(static_cast<uint8_t>(value & 0xff));
  payload.push_back(static_cast<uint8_t>(value >> 8 & 0xff));
}

}  // namespace

void PioneerStandIn::connected() {
  decoder_ = {};
  synced_ = 0;
  isOpen_ = false;
}

void PioneerStandIn::step(live::TcpSocket& socket, const std::string& bytes) {
  decoder_.feed(bytes);
  while (const auto command = decoder_.next()) obey(socket, *command);
  if (!isOpen_ || Clock::now() - lastSip_ < period_ || fault() == Fault::silent) return;
  lastSip_ = Clock::now();
  std::string packet = live::arcos::encode(sip());
  if (fault() == Fault::garbled) {
    std::string wrong = packet;
    wrong[4] = static_cast<char>(wrong[4] ^ 0x40);
    packet = "\xfa noise \xfa\xfb\xff" + wrong + packet;
  }
  if (fault() == Fault::cut) {
    socket.send(packet.substr(0, 5), 5);
    packet.erase(0, 5);
  }
  socket.send(packet, 5);
}

void PioneerStandIn::obey(live::TcpSocket& socket, const live::arcos::Payload& command) {
  const uint8_t number = command.front();
  if (isOpen_) {
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      commands_.insert(number);
    }
    if (number == live::arcos::pulse) ++pulses_;
    if (number == live::arcos::close) ++closes_, isOpen_ = false, synced_ = 0;
    return;
  }
  if (synced_ == 3 && number == live::arcos::open) {
    const std::lock_guard<std::mutex> lock(mutex_);
    commands_.clear();
    isOpen_ = true;
    start_ = robot_.odometry();
  } else if (number == synced_ && fault() != Fault::silent) {
    live::arcos::Payload answer{number};
    if (number == live::arcos::sync2)
      for (const char c : std::string("Stand_in\0Pioneer\0p3dx-sh\0", 25))
        answer.push_back(static_cast<uint8_t>(c));
    socket.send(live::arcos::encode(answer), 5);
    ++synced_;
  }
}

live::arcos::Payload PioneerStandIn::sip() const {
  const auto pose = robot_.odometry() - start_;
  live::arcos::Payload payload{0x33};
  putInteger(payload, std::lround(1000 * pose.x) & 0x7fff);
  putInteger(payload, std::lround(1000 * pose.y) & 0x7fff);
  putInteger(payload, std::lround(pose.phi / (2 * M_PI) * 4096));
  for (int i = 0; i < 4; ++i) payload.push_back(0);  // wheel speeds
  payload.push_back(120);                            // battery, 0.1 V
  for (int i = 0; i < 10; ++i) payload.push_back(0);
  return payload;
}

}  // namespace hybrid_slam::test
