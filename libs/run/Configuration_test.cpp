#include "run/Configuration.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "files/TemporaryFolder.h"
#include "testing/ErrorOf.h"

namespace hybrid_slam::run {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

class ConfigurationTest : public testing::Test {
 protected:
  Configuration load(const std::string& text, const std::vector<std::string>& settings = {}) {
    return {folder.write("run.ini", text), settings};
  }
  std::string errorOf(const std::string& text, const std::vector<std::string>& settings = {}) {
    const std::string error = test::errorOf([&] { load(text, settings); });
    EXPECT_THAT(error, Not(HasSubstr("\n")));
    return error;
  }
  files::TemporaryFolder folder;
  std::string ini = folder.path("run.ini");
};

TEST_F(ConfigurationTest, LoadsEverySection) {
  const Configuration c = load(
      "[run]\nmethod = general\nrawlog = a b.rawlog // a comment\n[input]\nmax_odometry_gap=2.5\n"
      "# another\n; and another\n// and one more\n\n[particle_filter]\r\nparticles = 7\r\n[grid]\n "
      "resolution\t=0.1\n");
  EXPECT_EQ(c.run.method, RunOptions::Method::general);
  EXPECT_EQ(c.run.rawlog, "a b.rawlog");
  EXPECT_EQ(c.run.output, "out");
  EXPECT_EQ(c.input.maxOdometryGap, 2.5);
  EXPECT_EQ(c.filter.filter.particles, 7);
  EXPECT_EQ(c.filter.grid.resolution, 0.1);
  EXPECT_FALSE(c.filter.useLines);
  EXPECT_TRUE(load("[run]\nmethod = hybrid\n").filter.useLines);
}

TEST_F(ConfigurationTest, UnreadableFile) {
  const auto errorOfFile = [](const std::string& path) {
    return test::errorOf([&] { Configuration(path, {}); });
  };
  EXPECT_EQ(errorOfFile(folder.path("none.ini")),
            "no such file: " + folder.path("none.ini") + "; expected a readable INI file");
  EXPECT_THAT(errorOfFile(folder.path("")), StartsWith("a folder, not a file: "));
  EXPECT_THAT(errorOfFile(folder.write("binary", std::string("[run]\0", 6))),
              StartsWith("not a text file: "));
}

TEST_F(ConfigurationTest, NoneOfOurSections) {
  for (const char* text : {"", "[other]\nx = 1\n", "# nothing but a comment\n"})
    EXPECT_THAT(errorOf(text), StartsWith("missing section: " + ini + "; expected at least one of")) << text;
  EXPECT_EQ(errorOf("[MappingApplication]\nsampleSize = 3\n"), "no error") << "MRPT's own INI";
}

TEST_F(ConfigurationTest, TheCaseOfSectionsDoesNotMatter) {
  EXPECT_EQ(load("[Particle_Filter]\nparticles = 7\n").filter.filter.particles, 7);
  EXPECT_EQ(load("[PARTICLE_FILTER]\nparticles = 7\n", {"particle_filter.seed=3"}).filter.filter.seed, 3);
  const Configuration set = load("[particle_filter]\nparticles = 7\n", {"PARTICLE_FILTER.particles=8"});
  EXPECT_EQ(set.filter.filter.particles, 8);
  EXPECT_EQ(load("[run]\n", {"Particle_Filter.particles=8"}).filter.filter.particles, 8);
}

TEST_F(ConfigurationTest, MisspeltSection) {
  EXPECT_EQ(errorOf("[run]\n[particlefilter]\nparticles = 3\n"),
            "unknown section [particlefilter]: " + ini + "; the nearest known section is [particle_filter]");
  EXPECT_THAT(errorOf("[run]\n[gird]\n"), HasSubstr("[grid]"));
  EXPECT_THAT(errorOf("[gird]\n"), HasSubstr("[grid]")) << "alone";
  EXPECT_THAT(errorOf("[grid]\n[rnu]\n"), HasSubstr("[run]"));
  EXPECT_EQ(errorOf("[run]\n[gui]\nx=1\n[grab]\n[laser]\n[MappingApplication_pointsMap_00_insertOpts]\n"),
            "no error")
      << "sections of other programs are ignored";
}

TEST_F(ConfigurationTest, SectionsThatNobodyUsesGiveAWarning) {
  const auto warningsOf = [&](const std::string& text) {
    folder.write("run.ini", text);
    return Configuration(ini, {}).warnings;
  };
  EXPECT_THAT(warningsOf("[run]\n[motion_by_hand]\n"),
              testing::ElementsAre("unknown section [motion_by_hand]: " + ini +
                                   "; ignored, the nearest known section is [motion_model]"));
  EXPECT_THAT(warningsOf("[run]\n[live]\n[LASER]\ndriver = CLMS100Eth\n[MappingApplication_x]\n"),
              testing::IsEmpty());
}

TEST_F(ConfigurationTest, AKeyBehindItsSection) {
  EXPECT_THAT(errorOf("[grid]resolution = 0.5\n"), HasSubstr("wrong line `[grid]resolution = 0.5`"));
  EXPECT_EQ(errorOf("[grid] ; cells\nresolution = 0.5\n[run] # all\n[motion_model] // x\n"), "no error");
}

TEST_F(ConfigurationTest, ARepeatedKeyGivesAWarning) {
  folder.write("run.ini", "[grid]\nresolution = 0.2\nmax_range = 9\nresolution=0.1\n[x]\na=1\na=2\n");
  const Configuration configuration(ini, {});
  EXPECT_THAT(configuration.warnings, testing::Contains("repeated key `resolution`: " + ini +
                                                        ", line 4, section [grid]; its last value is used"));
  EXPECT_EQ(configuration.filter.grid.resolution, 0.1);
  folder.write("run.ini", "[grid]\nresolution = 0.2\nRESOLUTION = 0.1\n");
  EXPECT_THAT(Configuration(ini, {}).warnings, testing::ElementsAre(HasSubstr("repeated key `RESOLUTION`")));
  folder.write("run.ini", "[grid]\nresolution = 0.2\n[run]\n[grid]\nresolution = 0.1\n");
  const Configuration joined(ini, {});
  EXPECT_THAT(joined.warnings, testing::IsEmpty());
  EXPECT_EQ(joined.filter.grid.resolution, 0.1);
}

/// MRPT joins a line that ends in a backslash with the next one, also a comment.
TEST_F(ConfigurationTest, ACommentDoesNotHideTheNextLine) {
  for (const char* const comment : {"# C:\\logs\\", " ; C:\\logs\\", "// C:\\logs\\\\", "# C:\\logs\\\r"}) {
    folder.write("run.ini", std::string("[grid]\n") + comment + "\nresolution = 0.2\n");
    EXPECT_EQ(Configuration(ini, {}).filter.grid.resolution, 0.2) << comment;
  }
}

TEST_F(ConfigurationTest, OverlongLines) {
  EXPECT_EQ(errorOf("[run]\noutput = " + std::string(10000, 'x') + "\n"),
            "line too long: " + ini + ", line 2; expected at most 10000 characters");
  const std::string part = std::string(4000, 'x') + "\\\n";  // MRPT joins continued lines
  EXPECT_EQ(errorOf("[run]\noutput = " + part + part + part + "\n"),
            "line too long: " + ini + ", line 4; expected at most 10000 characters");
  EXPECT_THAT(errorOf(std::string(1000001, '\n')), StartsWith("too large for an INI file: " + ini));
}

TEST_F(ConfigurationTest, UnknownKey) {
  EXPECT_EQ(errorOf("[particle_filter]\nparticels = 3\n"),
            "unknown key: " + ini +
                ", section [particle_filter], key `particels`; the nearest known key is `particles`");
}

TEST_F(ConfigurationTest, WrongTypeAndRange) {
  const std::string where =
      ": " + ini + ", section [particle_filter], key `particles`; expected a whole number in 0..100000";
  for (const char* value : {"many", "", "3.5", "-1", "1e9", "nan", "inf", "3 4"})
    EXPECT_EQ(errorOf(std::string("[particle_filter]\nparticles = ") + value + "\n"),
              "wrong value `" + std::string(value) + "`" + where);
  EXPECT_THAT(errorOf("[run]\nmethod = best\n"),
              HasSubstr("expected one of hybrid | general | linemap | ortho | stock"));
  EXPECT_THAT(errorOf("[input]\nrequire_odometry = maybe\n"), HasSubstr("expected true or false"));
  EXPECT_THAT(errorOf("[grid]\nresolution = 0\n"), HasSubstr("expected a number in 0.01..1 m"));
}

TEST_F(ConfigurationTest, TheTimeOfAScanIsSetInOneWay) {
  const Configuration c = load("[input]\nscan_rate = 25\n");
  EXPECT_EQ(c.input.sweep().rate, 25);
  EXPECT_EQ(c.input.sweep().seconds, std::nullopt);
  const std::string both =
      "both scan_time and scan_rate are set: section [input], keys `scan_time`, `scan_rate`; expected one of "
      "them, and `auto` for the other";
  EXPECT_EQ(errorOf("[input]\nscan_rate = 25\nscan_time = 0.01\n"), both);
  EXPECT_EQ(errorOf("[input]\nscan_time = 0\n", {"input.scan_rate=25"}), both);
  EXPECT_EQ(errorOf("[input]\nscan_rate = 25\n", {"input.scan_time=0.01", "input.scan_rate=auto"}),
            "no error");
  EXPECT_THAT(errorOf("[input]\nscan_rate = 0\n"), HasSubstr("expected auto or a number in 1..1000 Hz"));
  Configuration ofASession;
  EXPECT_EQ(test::errorOf([&] { ofASession.load("[input]\nscan_rate = 25\nscan_time = 0\n", "a.session"); }),
            both);
}

TEST_F(ConfigurationTest, LinesThatTheParserIgnoresAreErrors) {
  EXPECT_EQ(errorOf("[particle_filter]\nparticles 7\n"),
            "wrong line `particles 7`: " + ini + ", line 2; expected [section], key = value, or # comment");
  EXPECT_THAT(errorOf("[grid]\n= 0.05\n"), StartsWith("wrong line `= 0.05`"));
  EXPECT_THAT(errorOf("particles\n[run]\n"), StartsWith("wrong line `particles`"));
  EXPECT_THAT(errorOf("particles = 7\n[run]\n"), StartsWith("wrong line `particles = 7`"));
  EXPECT_THAT(errorOf("[run\nmethod = general\n[grid]\n"), StartsWith("wrong line `[run`"));
  EXPECT_EQ(errorOf("[run]\n[other]\nfree text\n"), "no error") << "other sections are ignored";
  EXPECT_EQ(errorOf("[run]\r\n\r\nmethod = general\r\n\r\n"), "no error");
  EXPECT_EQ(errorOf("\xEF\xBB\xBF[run]\nmethod = general\n"), "no error") << "a byte order mark";
}

TEST_F(ConfigurationTest, ExpandsMrptsSubstitutions) {
  EXPECT_EQ(load("@define N 7\n[particle_filter]\nparticles = ${N}\n").filter.filter.particles, 7);
  EXPECT_THAT(errorOf("[particle_filter]\nparticles = ${NUMBER\n"),
              StartsWith("cannot parse: " + ini + "; "));
}

/// MRPT's parser would loop forever, or fill the memory.
TEST_F(ConfigurationTest, EndlessMacrosAreRefused) {
  const std::string expected = "; expected its value; of MRPT's macros, only @define is expanded";
  const std::string loop = "$eval{var a:=0; while (a < 1) {a:=0;}}";
  EXPECT_EQ(errorOf("[run]\n@define a 1\n# $eval{repeat a:=1; until (a > 2)}\n"),
            "macro $eval{...}: " + ini + ", line 3" + expected);
  EXPECT_EQ(errorOf("@define a " + loop + "\n[run]\noutput = ${a}\n"),
            "macro $eval{...}: " + ini + ", line 1" + expected);
  EXPECT_EQ(errorOf("@define a $\n[run]\noutput = ${a}{b}\n"),
            "`$` in a definition: " + ini + ", line 1; expected its value");
  EXPECT_EQ(errorOf("[run]\noutput = $env{HOME}\n"), "macro $env{...}: " + ini + ", line 2" + expected);
  EXPECT_THAT(errorOf("[run]\noutput = $e\\\nval{" + loop.substr(6) + "\n"),  // in two lines
              StartsWith("macro $eval{...}: " + ini));
  Configuration ofASession;
  EXPECT_THAT(test::errorOf([&] { ofASession.load("[run]\noutput = " + loop + "\n", "a.session"); }),
              StartsWith("macro $eval{...}: a.session, line 2"));
}

TEST_F(ConfigurationTest, DefinitionsCannotMakeAFileLarge) {
  const auto withUses = [](int uses) {
    std::string text = "@define a " + std::string(9900, 'x') + "\n[run]\n[other]\n";
    for (int i = 0; i < uses; ++i) text += "k" + std::to_string(i) + " = ${a}\n";
    return text;
  };
  EXPECT_EQ(errorOf(withUses(100)), "no error");
  EXPECT_EQ(errorOf(withUses(101)), "definitions too long: " + ini +
                                        ", line 104; expected at most 1000000 bytes once they are expanded");
}

TEST_F(ConfigurationTest, SettingsOverrideTheFile) {
  const Configuration c = load("[particle_filter]\nparticles = 7\nseed = 2\n",
                               {"particle_filter.particles=8", "particle_filter.particles=9",
                                "run.method=stock", "run.rawlog=a=b.c d", "grid.max_range= 12 "});
  EXPECT_EQ(c.filter.filter.particles, 9);
  EXPECT_EQ(c.filter.filter.seed, 2);
  EXPECT_EQ(c.run.method, RunOptions::Method::stock);
  EXPECT_EQ(c.run.rawlog, "a=b.c d");
  EXPECT_EQ(c.filter.grid.maxRange, 12);
}

TEST_F(ConfigurationTest, WrongSettingsNameTheCommandLine) {
  for (const char* setting : {"", "=", "a", "a.b", ".b=1", "run.=x", "a=b.c", "particles=3"})
    EXPECT_EQ(errorOf("[run]\n", {setting}),
              "wrong setting `" + std::string(setting) + "`: command line; expected SECTION.KEY=VALUE");
  EXPECT_EQ(
      errorOf("[run]\n", {"particle_filter.particles=x"}),
      "wrong value `x`: command line, section [particle_filter], key `particles`; expected a whole number in "
      "0..100000");
  EXPECT_THAT(errorOf("[run]\n", {"run.outptu=x"}), AllOf(HasSubstr("command line"), HasSubstr("`output`")));
  EXPECT_EQ(
      errorOf("[run]\n", {"particles.number=3"}),
      "unknown section [particles]: command line, setting `particles.number=3`; the nearest known section is "
      "[particle_filter]");
  EXPECT_EQ(errorOf("[run]\n[MappingApplication]\n", {"MappingApplication.sampleSize=3"}), "no error");
}

TEST_F(ConfigurationTest, TextRoundTrip) {
  Configuration c = load(
      "# my file\n[run]\nmethod = stock // comment\nrawlog = /a "
      "b/c.rawlog\n[particle_filter]\nupdate_angle_deg = 12.345\n"
      "[motion_model]\nturn_var_t = 1e-05\n[MappingApplication]\nsampleSize = 3\n",
      {"grid.resolution=0.075", "MappingApplication.BETA=0.25"});
  const std::string text = c.text();
  Configuration again = load(text);
  EXPECT_EQ(again.text(), text);
  EXPECT_EQ(again.run.rawlog, "/a b/c.rawlog");
  EXPECT_EQ(again.run.method, RunOptions::Method::stock);
  EXPECT_EQ(again.filter.filter.updateAngle, c.filter.filter.updateAngle);
  EXPECT_EQ(again.filter.motion.turn.varianceT, 1e-5);
  EXPECT_EQ(again.filter.grid.resolution, 0.075);
  EXPECT_EQ(again.source.read_int("MappingApplication", "sampleSize", 0), 3);
  EXPECT_EQ(again.source.read_double("MappingApplication", "BETA", 0), 0.25);
}

TEST_F(ConfigurationTest, TextHasEveryKey) {
  Configuration c;
  const std::string text = c.text();
  for (const auto& [name, options] : c.sections()) {
    EXPECT_THAT(text, HasSubstr("[" + name + "]"));
    for (const Option& option : options->table()) EXPECT_THAT(text, HasSubstr("\n" + option.key + " ="));
  }
  EXPECT_EQ(load(text).text(), text);
}

TEST_F(ConfigurationTest, ManualListsEveryKey) {
  const std::string manual = configurationManual();
  Configuration c;
  for (const auto& [name, options] : c.sections()) {
    EXPECT_THAT(manual, HasSubstr("## [" + name + "]"));
    for (const Option& option : options->table()) EXPECT_THAT(manual, HasSubstr("| `" + option.key + "` | "));
  }
}

}  // namespace
}  // namespace hybrid_slam::run
