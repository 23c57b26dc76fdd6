#include "study/comparison/MapPictures.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <opencv2/imgcodecs.hpp>

namespace hybrid_slam::comparison {
namespace {

std::string encoded(const cv::Mat& picture) {
  std::vector<unsigned char> png;
  cv::imencode(".png", picture, png);
  return {png.begin(), png.end()};
}

cv::Mat decoded(const std::string& png) {
  return cv::imdecode(std::vector<char>(png.begin(), png.end()), cv::IMREAD_COLOR);
}

TEST(ReducedPicture, KeepsShapeAndColours) {
  cv::Mat map(1000, 1400, CV_8UC3, cv::Scalar(127, 127, 127));
  map(cv::Rect(700, 0, 700, 1000)) = cv::Scalar(0, 0, 220);
  const cv::Mat reduced = decoded(reducedPicture(encoded(map)));
  EXPECT_EQ(reduced.cols, 700);
  EXPECT_EQ(reduced.rows, 500);
  EXPECT_NEAR(reduced.at<cv::Vec3b>(100, 100)[0], 127, 9);
  EXPECT_NEAR(reduced.at<cv::Vec3b>(100, 600)[2], 220, 9);
  EXPECT_EQ(reduced.at<cv::Vec3b>(100, 600)[0], 0);
}

TEST(ReducedPicture, SmallOnesKeepTheirSize) {
  EXPECT_EQ(decoded(reducedPicture(encoded(cv::Mat(30, 40, CV_8UC3, cv::Scalar(255, 255, 255))))).cols, 40);
}

TEST(ReducedPicture, InvalidInputGivesNone) {
  EXPECT_EQ(reducedPicture(""), "");
  EXPECT_EQ(reducedPicture("no picture"), "");
}

TEST(ReducedPicture, OnlyPngFilesOfBoundedSize) {
  std::string png = encoded(cv::Mat(30, 40, CV_8UC3, cv::Scalar(255, 255, 255)));
  std::vector<unsigned char> jpeg;
  cv::imencode(".jpg", cv::Mat(30, 40, CV_8UC3), jpeg);
  EXPECT_EQ(reducedPicture({jpeg.begin(), jpeg.end()}), "");
  // One channel, and a side beyond which a decoder needs 1 GB.
  const cv::Mat large(1 << 14, 1 << 14, CV_8U, cv::Scalar(0));
  EXPECT_EQ(reducedPicture(encoded(large)), "");
  EXPECT_NE(reducedPicture(encoded(large.rowRange(0, 1 << 13))), "");
}

TEST(Base64, MatchesRfc4648WithoutLineBreaks) {
  EXPECT_EQ(base64(""), "");
  EXPECT_EQ(base64("f"), "Zg==");
  EXPECT_EQ(base64("fo"), "Zm8=");
  EXPECT_EQ(base64("foo"), "Zm9v");
  EXPECT_EQ(base64("foobar"), "Zm9vYmFy");
  EXPECT_EQ(base64("\xff\xfe\xfd"), "//79");
  EXPECT_EQ(base64(std::string(300, '\0')), std::string(400, 'A'));  // one line
}

}  // namespace
}  // namespace hybrid_slam::comparison
