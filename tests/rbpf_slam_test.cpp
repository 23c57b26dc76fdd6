// MRPT's own rbpf-slam with the plugin.

#include <gtest/gtest.h>
#include <mrpt/opengl/COpenGLScene.h>
#include <mrpt/opengl/CSetOfLines.h>

#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string>

#include "Shell.h"
#include "files/TemporaryFolder.h"

namespace hybrid_slam {
namespace {

constexpr const char* kLog =
    "/usr/share/mrpt/datasets/2006-01ENE-21-SENA_Telecom Faculty_one_loop_only.rawlog";

class RbpfSlam : public testing::Test {
 protected:
  void SetUp() override {
    if (std::system("command -v rbpf-slam >/dev/null") != 0)
      GTEST_SKIP() << "rbpf-slam is not installed: Debian's package mrpt-apps has it";
  }
  /// The path of a run with the shipped INI file, with fewer particles. @param edit  of that file, by sed
  std::string path(const std::string& environment, const std::string& edit) {
    const std::string few = "sed -e 's/^sampleSize = 10/sampleSize = 3/' -e '";
    const test::Outcome outcome =
        test::shell(folder, few + edit + "' " SOURCE_DIR "/config-ini/rbpf-slam-lines.ini >lines.ini; " +
                                environment + " rbpf-slam lines.ini '" + kLog + "' </dev/null");
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return result("log_estimated_path.txt");
  }
  std::string result(const std::string& name) const {
    return test::contentOf(folder.path("out-rbpf-slam-lines/" + name));
  }
  files::TemporaryFolder folder;
};

TEST_F(RbpfSlam, WeighsItsParticlesWithTheLinesOfThePlugin) {
  const std::string load = "LD_PRELOAD=" MRPT_PLUGIN;
  const std::string with = path(load, "");
  const std::string lines = result("finalMap_hybrid_slam__mrpt_maps__CHybridLineMap_00.csv");
  EXPECT_GE(std::count(lines.begin(), lines.end(), '\n'), 5) << lines;
  EXPECT_EQ(std::count(with.begin(), with.end(), '\n'), 224);
  EXPECT_EQ(path(load, ""), with);  // the seed decides

  // Only the line weight makes the difference: with exponent 0, the path is that without the plugin.
  const std::string without = path("", "s/^hybridLineMap_count.*//");
  EXPECT_NE(with, without);
  EXPECT_EQ(path(load, "s/^exponent = 1 /exponent = 0 /"), without);
}

TEST_F(RbpfSlam, PutsTheLinesIntoItsScenes) {
  path("LD_PRELOAD=" MRPT_PLUGIN, "s/^LOG_FREQUENCY = 0 /LOG_FREQUENCY = 200 /");
  mrpt::opengl::COpenGLScene scene;
  ASSERT_TRUE(scene.loadFromFile(folder.path("out-rbpf-slam-lines/3D/buildingmap_00200.3Dscene")));
  size_t drawn = 0;  // green lines; the paths of the particles are light blue
  scene.visitAllObjects([&](const mrpt::opengl::CRenderizable::Ptr& object) {
    const auto lines = std::dynamic_pointer_cast<mrpt::opengl::CSetOfLines>(object);
    if (!lines) return;
    const mrpt::img::TColor color = lines->getColor_u8();
    if (color.G > color.R + 100 && color.G > color.B + 100) drawn += lines->getLineCount();
  });
  EXPECT_GE(drawn, 5u);
}

TEST_F(RbpfSlam, NamesAMisspeltSetting) {
  const test::Outcome outcome = test::shell(
      folder, "sed 's/^sigma_deg/sigma/' " SOURCE_DIR
              "/config-ini/rbpf-slam-lines.ini >lines.ini; LD_PRELOAD=" MRPT_PLUGIN " rbpf-slam lines.ini '" +
                  std::string(kLog) + "' </dev/null");
  EXPECT_NE(outcome.status, 0);
  EXPECT_THAT(outcome.err, testing::HasSubstr("the nearest known key is `sigma_deg`"));
}

}  // namespace
}  // namespace hybrid_slam
