#include "run/GreyPicture.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <array>
#include <opencv2/imgcodecs.hpp>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/PngFile.h"

namespace hybrid_slam::run {
namespace {

using namespace std::string_literals;
using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

std::string pngOf(const cv::Mat& image) {
  std::vector<unsigned char> bytes;
  cv::imencode(".png", image, bytes);
  return {bytes.begin(), bytes.end()};
}

/// A PNG file with a header that claims a size, 8 bits of grey, and some bytes as pixels.
std::string claimedPng(size_t width, size_t height, const std::string& deflated, bool isInterlaced = false) {
  return test::pngFile(
      test::bigEndian(width) + test::bigEndian(height) + "\x08\0\0\0"s + static_cast<char>(isInterlaced),
      deflated);
}

class Grey : public testing::Test {
 protected:
  GreyPicture read(const std::string& bytes) { return readGreyPicture(folder.write("map", bytes)); }
  std::string errorOf(const std::string& bytes) {
    testing::internal::CaptureStderr();
    std::string error;
    try {
      read(bytes);
    } catch (const InputError& e) {
      error = e.what();
      EXPECT_THAT(error, AllOf(HasSubstr(folder.path("map")), HasSubstr("; expected "),
                               testing::Not(HasSubstr("\n"))));
    }
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "") << error;
    return error;
  }
  files::TemporaryFolder folder;
};

TEST_F(Grey, Pgm) {
  const GreyPicture binary = read("P5\n# by hand\n3 2\n255\n\0\x7f\xff\1\2\3\n"s);
  EXPECT_EQ(binary.width, 3u);
  EXPECT_EQ(binary.height, 2u);
  EXPECT_THAT(binary.grey, ElementsAre(0, 127, 255, 1, 2, 3));
  EXPECT_TRUE(binary.isTransparent.empty());
  EXPECT_THAT(read("P2 3 1 # size\n4\n0 2\t4").grey, ElementsAre(0, 128, 255));
  EXPECT_THAT(read("P5 2 1 65535 \xff\xff\x80\0"s).grey, ElementsAre(255, 128));
}

TEST_F(Grey, PgmThatIsWrong) {
  EXPECT_THAT(errorOf("P5 3 2 255 12345"), HasSubstr("cut off"));
  EXPECT_THAT(errorOf("P5 3 2 255 1234567"), HasSubstr("bytes after the pixels"));
  EXPECT_THAT(errorOf("P2 3 2 255 1 2 3 4 5"), HasSubstr("cut off"));
  EXPECT_THAT(errorOf("P2 2 1 4 1 5"), HasSubstr("brighter than white"));
  EXPECT_THAT(errorOf("P2 2 1 4 1 -1"), HasSubstr("no number"));
  EXPECT_THAT(errorOf("P5 3 2 0 123456"), HasSubstr("a white of 0"));
  EXPECT_THAT(errorOf("P5 3 2 65536 123456"), HasSubstr("a white of 65536"));
  EXPECT_THAT(errorOf("P5 0 2 255 "), HasSubstr("no pixels"));
  EXPECT_THAT(errorOf("P5 -3 2 255 123456"), HasSubstr("no number"));
  EXPECT_THAT(errorOf("P5 99999999999999999999 2 255 123456"), HasSubstr("no number"));
  EXPECT_THAT(errorOf("P5 3 2 255"), HasSubstr("no pixels"));
  EXPECT_THAT(errorOf("P6 1 1 255 123"), HasSubstr("neither PGM nor PNG"));
  EXPECT_THAT(errorOf(""), HasSubstr("neither PGM nor PNG"));
  EXPECT_THROW(readGreyPicture("/nowhere/map.pgm"), InputError);
  EXPECT_THROW(readGreyPicture("/"), InputError);
}

TEST_F(Grey, PngOfEveryKind) {
  EXPECT_THAT(read(pngOf(cv::Mat_<uint8_t>({1, 3}, {0, 205, 254}))).grey, ElementsAre(0, 205, 254));
  EXPECT_THAT(read(pngOf(cv::Mat_<uint16_t>({1, 3}, {0, 257 * 205, 65535}))).grey, ElementsAre(0, 205, 255));
  EXPECT_THAT(read(pngOf(cv::Mat(1, 2, CV_8UC3, cv::Scalar(10, 20, 33)))).grey, ElementsAre(21, 21));
  cv::Mat image(1, 2, CV_8UC4, cv::Scalar(9, 9, 9, 255));
  image.at<cv::Vec4b>(0, 1)[3] = 254;
  const GreyPicture transparent = read(pngOf(image));
  EXPECT_THAT(transparent.grey, ElementsAre(9, 9));
  EXPECT_THAT(transparent.isTransparent, ElementsAre(false, true));
}

TEST_F(Grey, InterlacedPngOfEverySize) {
  for (size_t width = 1; width < 20; ++width)
    for (size_t height = 1; height < 20; ++height) {
      // Black, as all passes hold the same.
      size_t bytes = 0;
      for (const auto [x0, dx, y0, dy] : std::initializer_list<std::array<size_t, 4>>{{0, 8, 0, 8},
                                                                                      {4, 8, 0, 8},
                                                                                      {0, 4, 4, 8},
                                                                                      {2, 4, 0, 4},
                                                                                      {0, 2, 2, 4},
                                                                                      {1, 2, 0, 2},
                                                                                      {0, 1, 1, 2}})
        for (size_t y = y0; y < height && x0 < width; y += dy) bytes += 1 + (width - x0 + dx - 1) / dx;
      std::string png = claimedPng(width, height, test::deflated(std::string(bytes, '\0')), true);
      const GreyPicture picture = read(png);
      ASSERT_EQ(picture.width, width);
      ASSERT_THAT(picture.grey, testing::SizeIs(width * height));
    }
}

TEST_F(Grey, PngThatIsCutOrDamaged) {
  cv::Mat image(20, 20, CV_8U);
  for (int i = 0; i < 400; ++i) image.at<uint8_t>(i / 20, i % 20) = static_cast<uint8_t>(i * i);
  const std::string png = pngOf(image);
  for (size_t length = 0; length < png.size(); ++length)
    ASSERT_NE(errorOf(png.substr(0, length)), "") << length;
  for (size_t i = 0; i < png.size(); ++i) {
    std::string damaged = png;
    damaged[i] ^= 0x10;
    ASSERT_NE(errorOf(damaged), "") << i;
  }
}

TEST_F(Grey, ASizeThatTheFileDoesNotHaveTakesNoMemory) {
  const auto peakKilobytes = [] {
    rusage used{};
    getrusage(RUSAGE_SELF, &used);
    return used.ru_maxrss;
  };
  errorOf("P5 3 2 255 12345");
  const auto before = peakKilobytes();
  EXPECT_THAT(errorOf("P5 16384 16384 255 few"), HasSubstr("cut off"));
  EXPECT_THAT(errorOf("P2 16384 16384 255 1 2 3"), HasSubstr("cut off"));
  EXPECT_THAT(errorOf("P5 16385 16384 255 few"), HasSubstr("more than 2^28 pixels"));
  EXPECT_THAT(errorOf("P5 4294967296 4294967296 255 few"), HasSubstr("more than 2^20 pixels on a side"));
  EXPECT_THAT(errorOf(claimedPng(16384, 16384, std::string(1000, 'x'))), HasSubstr("damaged"));
  EXPECT_THAT(errorOf(claimedPng(16384, 16384, test::deflated(std::string(100000, '\0')))),
              HasSubstr("cut off"));
  EXPECT_THAT(errorOf(claimedPng(2, 2, test::deflated(std::string(100000, '\0')))), HasSubstr("damaged"));
  EXPECT_THAT(errorOf(claimedPng(16385, 16384, "few")), HasSubstr("more than 2^28 pixels"));
  EXPECT_THAT(errorOf(claimedPng(0xffffffff, 1, "few")), HasSubstr("on a side"));
  EXPECT_LT(peakKilobytes() - before, 4000);
}

}  // namespace
}  // namespace hybrid_slam::run
