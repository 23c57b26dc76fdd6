#include "study/comparison/MapPictures.h"

#include <mrpt/system/string_utils.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "study/comparison/RankedRuns.h"
#include "study/comparison/ReportText.h"

namespace hybrid_slam::comparison {
namespace {

constexpr uint64_t kMostPixels = 1 << 27;  // twice those of a run's picture, without its margins

/// Returns the number of pixels that a PNG file claims, whose first chunk begins with width and height; 0 for
/// another file.
uint64_t pixelsOf(const std::string& png) {
  constexpr size_t kWidth = 16, kHeight = 20, kEnd = 24;
  const auto numberAt = [&png](size_t at) {
    uint64_t number = 0;
    for (size_t i = at; i < at + 4; ++i) number = 256 * number + static_cast<uint8_t>(png[i]);
    return number;
  };
  return png.size() < kEnd || png.rfind("\x89PNG", 0) != 0 ? 0 : numberAt(kWidth) * numberAt(kHeight);
}

std::string mapPicture(const ReportInput& input, const RunResult& r, const std::string& caption) {
  constexpr uintmax_t kMostBytes = 100'000'000;  // a run's picture has far fewer
  const std::filesystem::path file = folderOf(input, r).file("map.png");
  std::error_code missing;
  const uintmax_t size = std::filesystem::file_size(file, missing);
  if (missing || size > kMostBytes) return {};
  std::ifstream in(file, std::ios::binary);
  const std::string picture = reducedPicture(std::string(std::istreambuf_iterator<char>(in), {}));
  if (picture.empty()) return {};
  const std::string text =
      escapeXml(input.groups[r.run.group].name() + ", seed " + std::to_string(r.run.seed) + ": " + caption);
  return "<figure><img alt=\"map of " + text + "\" src=\"data:image/png;base64," + base64(picture) +
         "\"/><figcaption>" + text + "</figcaption></figure>\n";
}

}  // namespace

std::string base64(const std::string& bytes) {
  std::string text;
  mrpt::system::encodeBase64({bytes.begin(), bytes.end()}, text);
  text.erase(std::remove(text.begin(), text.end(), '\n'), text.end());
  return text;
}

std::string reducedPicture(const std::string& png) {
  constexpr double kSide = 700, kLevels = 16;
  if (pixelsOf(png) == 0 || pixelsOf(png) > kMostPixels) return {};
  cv::Mat picture = cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_COLOR);
  if (picture.empty()) return {};
  if (const double scale = kSide / std::max(picture.cols, picture.rows); scale < 1)
    cv::resize(picture, picture, {}, scale, scale, cv::INTER_AREA);
  constexpr double kStep = 255 / (kLevels - 1);
  picture.convertTo(picture, CV_8U, 1 / kStep);  // rounds to the nearest level
  picture.convertTo(picture, CV_8U, kStep);
  std::vector<unsigned char> reduced;
  cv::imencode(".png", picture, reduced, {cv::IMWRITE_PNG_COMPRESSION, 9});
  return {reduced.begin(), reduced.end()};
}

std::string mapPictures(const ReportInput& input) {
  const auto ranking = rankingFigure(input);
  std::string all;
  for (size_t g = 0; g < input.groups.size(); ++g) {
    const auto runs = rankedRuns(input, g);
    if (runs.empty()) continue;
    if (!ranking) {
      all += mapPicture(input, *runs[0], "the first");
      continue;
    }
    const FigureName& name = kFigureNames[static_cast<size_t>(*ranking)];
    const auto caption = [&](const char* which, const RunResult& r) {
      return std::string(which) + " run, " + name.title + " " + shortNumber(r[*ranking].value_or(0), 3) +
             " " + name.unit;
    };
    const RunResult& median = *medianRun(input, g);
    all += mapPicture(input, median, caption("median", median));
    if (runs.size() > 1) all += mapPicture(input, *runs.back(), caption("worst", *runs.back()));
  }
  return all;
}

}  // namespace hybrid_slam::comparison
