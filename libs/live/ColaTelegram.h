/// @file ColaTelegram.h
/// @brief CoLa-A, the telegrams of SICK's laser scanners (LMS-1xx): text between STX and ETX.
///
/// Its tokens are separated by spaces. A number is hexadecimal, or decimal if it has a sign.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace hybrid_slam::live::cola {

/// Returns a telegram with STX and ETX.
std::string encode(const std::string& telegram);

/// Splits a byte stream into telegrams. A telegram without end is dropped at the next STX, or once it is
/// longer than any scan.
class Decoder {
 public:
  void feed(const std::string& bytes) { buffer_ += bytes; }
  /// Returns the next telegram; empty until more bytes arrive.
  std::optional<std::string> next();

 private:
  std::string buffer_;
};

/// The distances of one scan.
struct Scan {
  double first = 0, step = 0;  ///< rad, angle of the first beam and between beams; 90 deg is ahead
  std::vector<float> ranges;   ///< m, from right to left; 0: no return
};

/// Returns whether a telegram should hold a scan: the answer to `sRN LMDscandata`, or sent after `sEN
/// LMDscandata 1`.
bool isScan(const std::string& telegram);
/// Decodes the channel DIST1 of a scan; empty if a token is missing or impossible: more than 2,000 beams, or
/// over more than a turn.
std::optional<Scan> decodeScan(const std::string& telegram);

}  // namespace hybrid_slam::live::cola
