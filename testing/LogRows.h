/// @file LogRows.h
/// @brief For the tests: rows of text logs, parsed one at a time.
#pragma once

#include <gtest/gtest.h>
#include <mrpt/core/bits_math.h>
#include <mrpt/math/TPose2D.h>

#include <cmath>
#include <string>
#include <variant>

#include "readings/LogFields.h"
#include "readings/LogFormats.h"

namespace hybrid_slam::test {

inline const std::string kFlaser = "FLASER 3 1.5 81.83 2.25 9 9 9 -1.5 2 0.75 976052857.348896 host 12.5";

/// Scans of three beams over 180 deg.
inline readings::LogParserOptions threeBeamOptions() {
  readings::LogParserOptions options;
  options.angularStep = mrpt::DEG2RAD(90.0);
  return options;
}

/// Parses a line, which must be a record of this type.
template <class Record>
Record parseAs(readings::LogParser& parser, const std::string& line) {
  return std::get<Record>(parser.parse(line));
}

template <class Record>
Record parseAs(const readings::LogFormat* format, const std::string& line) {
  const auto parser = format->makeParser(threeBeamOptions());
  return parseAs<Record>(*parser, line);
}

/// Returns the reason why a line is broken.
inline std::string whyBroken(const readings::LogFormat* format, const std::string& line) {
  const auto parser = format->makeParser(threeBeamOptions());
  try {
    parser->parse(line);
  } catch (const readings::BrokenLine& e) {
    return e.what();
  }
  return "not broken: " + line;
}

inline void expectPose(const mrpt::math::TPose2D& pose, double x, double y, double phi) {
  EXPECT_NEAR(pose.x, x, 1e-12);
  EXPECT_NEAR(pose.y, y, 1e-12);
  EXPECT_NEAR(std::remainder(pose.phi - phi, 2 * M_PI), 0, 1e-12);
}

}  // namespace hybrid_slam::test
