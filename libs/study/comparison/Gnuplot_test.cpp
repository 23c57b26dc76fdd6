#include "study/comparison/Gnuplot.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <stdlib.h>

#include <filesystem>

#include "files/TemporaryFolder.h"

namespace hybrid_slam::comparison {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::Not;

Plot line(const std::string& title) {
  DataBlock data("data");
  data.add({0, 1});
  data.add({1, 2.5});
  return {"the description of " + title, 320, 200,
          "set title " + gnuplotText(title) + "\n" + data.script() + "plot $data with linespoints notitle\n"};
}

/// Sets an environment variable during a test.
struct Environment {
  Environment(const char* name, const std::string& value) : name_(name) {
    if (const char* before = getenv(name)) before_ = before, isSet_ = true;
    setenv(name, value.c_str(), 1);
  }
  ~Environment() { isSet_ ? setenv(name_, before_.c_str(), 1) : unsetenv(name_); }

 private:
  const char* name_;
  std::string before_;
  bool isSet_ = false;
};

TEST(GnuplotScript, TextIsLiteral) {
  EXPECT_EQ(gnuplotText("it's `date` \\n @x"), "'it''s `date` \\n @x'");
  EXPECT_EQ(gnuplotText("two\nlines"), "'two lines'");
}

TEST(GnuplotScript, DataAreABlockOfRows) {
  DataBlock data("dots");
  data.add({0.5, -2});
  data.add({});
  data.add({0xe69f00});
  EXPECT_EQ(data.script(), "$dots << EOD\n0.5 -2\n\n15113984\nEOD\n");
}

TEST(Gnuplot, DrawsEachPlotAsAnElement) {
  Gnuplot gnuplot;
  const std::string svg = gnuplot.draw({line("a < b & \"c_d\""), Plot(), line("second")});
  EXPECT_EQ(gnuplot.error(), "");
  EXPECT_THAT(svg, HasSubstr("aria-label=\"the description of a &lt; b &amp; &quot;c_d&quot;\" width=\"320\" "
                             "height=\"200\" viewBox=\"0 0 320 200\">"));
  EXPECT_THAT(svg, HasSubstr(">a &lt; b &amp; \"c_d\"<"));
  EXPECT_THAT(svg, HasSubstr("aria-label=\"the description of second\""));
  EXPECT_THAT(svg, HasSubstr(">2.4</text>"));  // a tick: a number without blanks
  EXPECT_THAT(svg, Not(HasSubstr("<?xml")));
  EXPECT_THAT(svg, Not(HasSubstr("<title>gnuplot_plot")));
}

TEST(Gnuplot, IdentifiersAreUnique) {
  Gnuplot gnuplot;
  const std::string both = gnuplot.draw({line("first"), line("second")}) + gnuplot.draw({line("third")});
  for (const char* number : {"p1-", "p2-", "p3-"})
    EXPECT_THAT(both, HasSubstr("xlink:href='#" + std::string(number) + "gpPt"));
  EXPECT_THAT(both, Not(HasSubstr("'#gp")));
  EXPECT_THAT(both, Not(HasSubstr("id='gp")));
  EXPECT_THAT(both, Not(HasSubstr("id=\"gnuplot")));
}

TEST(Gnuplot, TheSamePlotsGiveTheSameBytes) {
  const files::TemporaryFolder home;
  const std::string svg = Gnuplot().draw({line("a")});
  home.write(".gnuplot", "set title 'of the user'\nexit status 3\n");
  const Environment user("HOME", home.path("")), locale("LC_ALL", "C"), terminal("GNUTERM", "dumb");
  EXPECT_NE(svg, "");
  EXPECT_EQ(Gnuplot().draw({line("a")}), svg);
}

TEST(Gnuplot, LeavesNoFile) {
  const files::TemporaryFolder folder;
  const Environment temporary("TMPDIR", folder.path(""));
  EXPECT_NE(Gnuplot().draw({line("`touch " + folder.path("shell") + "`")}), "");
  EXPECT_EQ(Gnuplot().draw({{"broken", 100, 100, "plot $nothing\n"}}), "");
  EXPECT_TRUE(fs::is_empty(folder.path("")));
}

TEST(Gnuplot, AFailureIsOneLine) {
  Gnuplot gnuplot;
  EXPECT_EQ(gnuplot.draw({line("a"), {"broken", 100, 100, "plot $nothing\n"}}), "");
  EXPECT_THAT(gnuplot.error(), testing::MatchesRegex("gnuplot: [^\n]*nothing[^\n]*"));
  EXPECT_EQ(gnuplot.draw({line("a")}), "");
}

TEST(Gnuplot, MissingItNamesItsPackage) {
  Gnuplot gnuplot("/nowhere/gnuplot");
  EXPECT_EQ(gnuplot.draw({}), "");
  EXPECT_EQ(gnuplot.error(), "");
  EXPECT_EQ(gnuplot.draw({line("a")}), "");
  EXPECT_THAT(gnuplot.error(), HasSubstr("cannot be started: No such file or directory; expected the Debian "
                                         "package gnuplot-nox"));
}

TEST(Gnuplot, AFolderThatCannotBeWrittenToIsAFailure) {
  const Environment temporary("TMPDIR", "/nowhere");
  Gnuplot gnuplot;
  EXPECT_EQ(gnuplot.draw({line("a")}), "");
  EXPECT_NE(gnuplot.error(), "");
}

}  // namespace
}  // namespace hybrid_slam::comparison
