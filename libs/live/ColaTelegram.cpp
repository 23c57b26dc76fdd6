#include "live/ColaTelegram.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string_view>

namespace hybrid_slam::live::cola {
namespace {

constexpr char kStart = '\x02', kEnd = '\x03';
constexpr size_t kLongest = 64 * 1024;           // bytes; two channels of 1,081 beams take 11 KB
constexpr int64_t kMostBeams = 2000;             // an LMS-1xx has at most 1,081
constexpr int64_t kTurn = 3600000;               // in units of the angles
constexpr double kUnit = M_PI / (180. * 10000);  // rad, of the angles
constexpr float kMillimetre = 0.001F;

struct Impossible {};

/// Reads the tokens of a telegram one after the other. Throws Impossible.
class Tokens {
 public:
  explicit Tokens(std::string_view telegram) : rest_(telegram) {}

  std::string_view next() {
    if (rest_.empty()) throw Impossible();
    const size_t length = std::min(rest_.find(' '), rest_.size());
    const std::string_view token = rest_.substr(0, length);
    rest_.remove_prefix(std::min(length + 1, rest_.size()));
    return token;
  }
  void skip(int64_t count) {
    for (; count > 0; --count) next();
  }
  /// @throws Impossible if the number is not within the limits
  int64_t number(int64_t least, int64_t most) {
    const int64_t value = signedNumber();
    if (value < least || value > most) throw Impossible();
    return value;
  }
  /// A hexadecimal number has the bits of a signed one of 32 bits.
  int64_t signedNumber() {
    std::string_view token = next();
    const bool hasSign = !token.empty() && (token[0] == '+' || token[0] == '-');
    if (hasSign) return (token[0] == '-' ? -1 : 1) * int64_t{parsed(token.substr(1), 10)};
    return static_cast<int32_t>(parsed(token, 16));
  }
  /// The bits of a hexadecimal number as a float.
  float real() {
    const uint32_t bits = parsed(next(), 16);
    float value = 0;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }

 private:
  static uint32_t parsed(std::string_view token, int base) {
    uint32_t value = 0;
    const char* const end = token.data() + token.size();
    const auto [stop, error] = std::from_chars(token.data(), end, value, base);
    if (error != std::errc() || stop != end) throw Impossible();
    return value;
  }
  std::string_view rest_;
};

bool startsWith(const std::string& text, std::string_view head) {
  return text.compare(0, head.size(), head) == 0;
}

/// The telegrams' layout is that of SICK's manual (Telegram Listing, LMDscandata).
Scan scanIn(const std::string& telegram) {
  Tokens tokens(telegram);
  tokens.skip(2);   // sRA or sSN, LMDscandata
  tokens.skip(16);  // version, device, status, counters, times, inputs, outputs, frequencies
  const int64_t encoders = tokens.number(0, 3);
  tokens.skip(2 * encoders);
  tokens.number(1, 5);  // channels of 16 bits
  if (tokens.next() != "DIST1") throw Impossible();
  const float scale = tokens.real(), offset = tokens.real();
  if (!(scale > 0 && scale <= 1000 && std::abs(offset) <= 1e6F)) throw Impossible();
  Scan scan;
  scan.first = static_cast<double>(tokens.number(-kTurn, kTurn)) * kUnit;
  const int64_t step = tokens.number(1, kTurn), count = tokens.number(2, kMostBeams);
  if (step * (count - 1) > kTurn) throw Impossible();
  scan.step = static_cast<double>(step) * kUnit;
  for (int64_t i = 0; i < count; ++i) {
    const auto distance = static_cast<float>(tokens.number(0, UINT16_MAX));
    scan.ranges.push_back(distance > 0 ? std::max(0.F, (scale * distance + offset) * kMillimetre) : 0.F);
  }
  return scan;
}

}  // namespace

std::string encode(const std::string& telegram) { return kStart + telegram + kEnd; }

std::optional<std::string> Decoder::next() {
  while (true) {
    const size_t end = buffer_.find(kEnd);
    if (end == std::string::npos) {
      if (buffer_.size() > kLongest) buffer_.clear();
      return std::nullopt;
    }
    const size_t start = buffer_.rfind(kStart, end);
    const std::string telegram = start == std::string::npos ? "" : buffer_.substr(start + 1, end - start - 1);
    buffer_.erase(0, end + 1);
    if (!telegram.empty()) return telegram;
  }
}

bool isScan(const std::string& telegram) {
  return startsWith(telegram, "sSN LMDscandata ") || startsWith(telegram, "sRA LMDscandata ");
}

std::optional<Scan> decodeScan(const std::string& telegram) {
  try {
    if (isScan(telegram)) return scanIn(telegram);
  } catch (const Impossible&) {
  }
  return std::nullopt;
}

}  // namespace hybrid_slam::live::cola
