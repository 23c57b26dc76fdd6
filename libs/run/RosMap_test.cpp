#include "run/RosMap.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <opencv2/imgcodecs.hpp>

#include "base/Errors.h"
#include "files/TemporaryFolder.h"
#include "testing/CommaLocale.h"

namespace hybrid_slam::run {
namespace {

using testing::AllOf;
using testing::ElementsAre;
using testing::HasSubstr;

using Keys = std::map<std::string, std::string>;

class RosMap : public testing::Test {
 protected:
  /// Writes a valid map.yaml with changed keys; those without a value are left out.
  std::string write(const Keys& changed) {
    Keys keys{{"image", "map.pgm"}, {"resolution", "0.05"},      {"origin", "[-0.1, 0.2, 0]"},
              {"negate", "0"},      {"occupied_thresh", "0.65"}, {"free_thresh", "0.25"}};
    for (const auto& [key, value] : changed) keys[key] = value;
    std::string text;
    for (const auto& [key, value] : keys)
      if (!value.empty()) text += key + ": " + value + "\n";
    return folder.write("map.yaml", text);
  }
  std::string errorOf(const Keys& changed) {
    const std::string file = write(changed);
    try {
      readRosMap(file);
    } catch (const InputError& e) {
      EXPECT_THAT(e.what(),
                  AllOf(HasSubstr(folder.path("")), HasSubstr("; expected "), testing::Not(HasSubstr("\n"))));
      return e.what();
    }
    return "";
  }
  /// Returns the occupancies of the map's row from left to right.
  std::vector<double> row(const Keys& changed) {
    const OccupancyGrid grid = readRosMap(write(changed));
    std::vector<double> occupancies;
    for (int i = 0; i < 5; ++i) occupancies.push_back(std::round(100 * grid.occupancy({-2 + i, 4})) / 100);
    return occupancies;
  }
  files::TemporaryFolder folder;
  const std::string picture = folder.write("map.pgm", "P2 5 1 255  0 75 140 205 254");
};

TEST_F(RosMap, Trinary) {
  EXPECT_THAT(row({}), ElementsAre(0.97, 0.97, 0.5, 0.03, 0.03));
  EXPECT_THAT(row({{"mode", "trinary"}, {"free_thresh", "0.196"}}), ElementsAre(0.97, 0.97, 0.5, 0.5, 0.03));
  EXPECT_THAT(row({{"negate", "1"}}), ElementsAre(0.03, 0.5, 0.5, 0.97, 0.97));
  EXPECT_THAT(row({{"negate", "true"}}), ElementsAre(0.03, 0.5, 0.5, 0.97, 0.97));
}

TEST_F(RosMap, Scale) {
  folder.write("map.pgm", "P2 5 1 100  0 50 60 70 100");  // darkness: 1, 0.5, 0.4, 0.3, 0
  EXPECT_THAT(row({{"mode", "scale"}}),
              ElementsAre(0.97, testing::DoubleNear(0.62, 0.03), testing::DoubleNear(0.375, 0.03),
                          testing::DoubleNear(0.125, 0.03), 0.03));
}

TEST_F(RosMap, TransparentPixelsAreUnknownInScale) {
  cv::Mat image(1, 5, CV_8UC4, cv::Scalar(0, 0, 0, 255));
  image.at<cv::Vec4b>(0, 1)[3] = 0;
  cv::imwrite(folder.path("map.png"), image);
  EXPECT_THAT(row({{"image", "map.png"}, {"mode", "scale"}}), ElementsAre(0.97, 0.5, 0.97, 0.97, 0.97));
  EXPECT_THAT(row({{"image", "map.png"}}), ElementsAre(0.97, 0.97, 0.97, 0.97, 0.97));
}

TEST_F(RosMap, Raw) {
  folder.write("map.pgm", "P2 5 1 255  0 30 100 101 255");
  EXPECT_THAT(row({{"mode", "raw"}}), ElementsAre(0.03, testing::DoubleNear(0.3, 0.02), 0.97, 0.5, 0.5));
}

TEST_F(RosMap, TheOriginIsTheLowerLeftCornerToHalfACell) {
  folder.write("map.pgm", "P2 2 3 255  0 254 254 254 254 254");  // occupied: upper left
  for (const auto& [origin, x, y] : {std::tuple("[-0.1, 0.2, 0]", -2, 6),
                                     {"[-0.11, 0.21, 0.0]", -2, 6},
                                     {"[-0.13, 0.23, 0]", -3, 7},
                                     {"[1e2, -1e2, 0]", 2000, -1998}}) {
    const OccupancyGrid grid = readRosMap(write({{"origin", origin}}));
    EXPECT_GT(grid.occupancy({x, y}), 0.9) << origin;
    EXPECT_LT(grid.occupancy({x + 1, y}), 0.1) << origin;
    EXPECT_LT(grid.occupancy({x, y - 2}), 0.1) << origin;
    EXPECT_EQ(grid.occupancy({x, y + 1}), 0.5) << origin;
  }
}

TEST_F(RosMap, ThePictureIsFoundBesideItOrByItsWholeName) {
  EXPECT_EQ(errorOf({{"image", "\"" + picture + "\""}}), "");
  EXPECT_THAT(errorOf({{"image", "other.pgm"}}), HasSubstr("no such file: " + folder.path("other.pgm")));
  EXPECT_THAT(errorOf({{"image", "."}}), HasSubstr("not a file"));
}

TEST_F(RosMap, WrongValues) {
  EXPECT_THAT(errorOf({{"image", ""}}), HasSubstr("not a map"));
  EXPECT_THAT(errorOf({{"resolution", ""}}), HasSubstr("missing key `resolution`"));
  for (const char* value : {"-0.05", "0", ".nan", "nan", ".inf", "1e300", "0.05 m", "[0.05]", "0,05"})
    EXPECT_THAT(errorOf({{"resolution", value}}), AllOf(HasSubstr("wrong value of `resolution`"),
                                                        HasSubstr("expected 0.001 .. 10 m per cell")));
  EXPECT_THAT(errorOf({{"origin", ""}}), HasSubstr("missing key `origin`"));
  for (const char* value : {"0", "[0, 0]", "[0, 0, 0, 0]", "[nan, 0, 0]", "[0, 1e9, 0]", "[[0], 0, 0]"})
    EXPECT_THAT(errorOf({{"origin", value}}), HasSubstr("wrong value of `origin`"));
  EXPECT_THAT(errorOf({{"origin", "[0, 0, 0.5]"}}), AllOf(HasSubstr("rotated map"), HasSubstr("a yaw of 0")));
  EXPECT_THAT(errorOf({{"negate", "2"}}), HasSubstr("wrong value of `negate`"));
  EXPECT_THAT(errorOf({{"negate", ""}}), HasSubstr("missing key `negate`"));
  EXPECT_THAT(errorOf({{"occupied_thresh", "1.1"}}), HasSubstr("wrong value of `occupied_thresh`"));
  EXPECT_THAT(errorOf({{"free_thresh", "0.66"}}), HasSubstr("wrong value of `free_thresh`"));
  EXPECT_THAT(errorOf({{"mode", "binary"}}), HasSubstr("expected trinary, scale or raw"));
}

TEST_F(RosMap, TextThatIsNoYaml) {
  const auto error = [this](const std::string& text) {
    try {
      readRosMap(folder.write("map.yaml", text));
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_THAT(error("image: map.pgm\nresolution: [0.05\n"),
              AllOf(HasSubstr("not a map"), HasSubstr(", line ")));
  EXPECT_THAT(error(std::string(5000, '[')), HasSubstr("not a map"));
  EXPECT_THAT(error("image: map.pgm\n" + std::string(100000, '#')), HasSubstr("not a map"));
  EXPECT_THAT(error("? [image]\n: map.pgm\n"), HasSubstr("not a map"));
}

TEST_F(RosMap, NumbersHaveADecimalPointInEveryLocale) {
  const test::CommaLocale german;
  EXPECT_EQ(readRosMap(write({})).resolution(), 0.05);
}

}  // namespace
}  // namespace hybrid_slam::run
