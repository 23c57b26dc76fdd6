/// @file LineExtractor.h
/// @brief Line detection (Sec. III-B): converts a scan to line segments. A new method needs a file that
/// defines its LineExtractor, and an entry in the list below.
#pragma once

#include <vector>

#include "slam/lines/HoughRefinement.h"
#include "slam/lines/LineFit.h"
#include "slam/lines/LineSegment.h"
#include "slam/lines/Segmentation.h"

namespace hybrid_slam {

struct LineExtractionOptions;

/// A method of line extraction. Stateless: it serves all threads.
struct LineExtractor {
  const char* name;         ///< of the key `method`
  const char* description;  ///< for the documentation of that key
  /// Returns the lines of at least minLength, in the robot frame, in beam order.
  std::vector<LineSegment> (*extract)(const LaserScan& scan, const LineExtractionOptions& options);
};

extern const LineExtractor kSplitExtractor, kSplitMergeExtractor, kIncrementalExtractor, kRegressionExtractor,
    kRansacExtractor, kHoughExtractor, kEmExtractor;
/// All methods, the default first.
inline std::vector<const LineExtractor*> lineExtractors() {
  return {&kSplitExtractor,  &kSplitMergeExtractor, &kIncrementalExtractor, &kRegressionExtractor,
          &kRansacExtractor, &kHoughExtractor,      &kEmExtractor};
}

/// Section [line_extraction], and the sections of the steps that the methods share.
struct LineExtractionOptions : Options {
  const LineExtractor* method = &kSplitExtractor;
  SegmentationOptions segmentation;
  LineFitOptions fit;
  HoughOptions hough;

  void describe(OptionTable& table) override;
};

/// Extracts the lines of a scan by the chosen method.
std::vector<LineSegment> extractLines(const LaserScan& scan, const LineExtractionOptions& options);

/// Largest number of beams in a row that miss a line without dividing it.
constexpr size_t kMostMissing = 2;

/// Steps 2 and 3 of Sec. III-B: a line for each piece that is straight and long enough.
/// @param pieces  in the sensor frame
std::vector<LineSegment> linesOf(const std::vector<PointRange>& pieces, const LaserScan& scan,
                                 const LineExtractionOptions& options);

}  // namespace hybrid_slam
