#include "slam/lines/LineExtractor.h"

namespace hybrid_slam {

void LineExtractionOptions::describe(OptionTable& table) {
  std::vector<std::pair<const LineExtractor*, std::string>> names;
  std::string why;
  for (const LineExtractor* extractor : lineExtractors()) {
    names.emplace_back(extractor, extractor->name);
    why += (why.empty() ? "" : "; ") + std::string(extractor->name) + ": " + extractor->description;
  }
  table.add("method", method, names, why);
}

std::vector<LineSegment> extractLines(const LaserScan& scan, const LineExtractionOptions& options) {
  return options.method->extract(scan, options);
}

std::vector<LineSegment> linesOf(const std::vector<PointRange>& pieces, const LaserScan& scan,
                                 const LineExtractionOptions& options) {
  std::vector<LineSegment> lines;
  for (const PointRange& points : pieces) {
    auto line = fitLine(points, options.fit);
    if (!line) continue;
    if (options.hough.enabled) line = refineByHough(points, *line, options.hough);
    const LineSegment segment = makeSegment(line->rho, line->theta, points.front(), points.back());
    if (segment.length >= options.segmentation.minLength)
      lines.push_back(transformed(segment, scan.sensorPose));
  }
  return lines;
}

}  // namespace hybrid_slam
