#include "study/comparison/Groups.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "testing/ErrorOf.h"

namespace hybrid_slam::comparison {
namespace {

using testing::ElementsAre;
using testing::HasSubstr;

std::string errorOf(const std::function<void()>& call) {
  const std::string error = test::errorOf(call);
  EXPECT_THAT(error, testing::Not(HasSubstr("\n")));
  return error;
}

TEST(Variant, NameMethodSettingsAndFile) {
  const Variant plain = parseVariant("eq9:line_weight.method=paper,line_weight.threshold_deg=1.5");
  EXPECT_EQ(plain.name, "eq9");
  EXPECT_EQ(plain.method, "");
  EXPECT_THAT(plain.settings, ElementsAre("line_weight.method=paper", "line_weight.threshold_deg=1.5"));
  const Variant limited = parseVariant("stock/shipped:@mrpt.ini,grid.resolution=0.1");
  EXPECT_EQ(limited.name, "shipped");
  EXPECT_EQ(limited.method, "stock");
  EXPECT_EQ(limited.iniFile, "mrpt.ini");
  EXPECT_THAT(limited.settings, ElementsAre("grid.resolution=0.1"));
}

TEST(Variant, EveryWrongOneIsNamed) {
  for (const char* text : {"", "eq9", "eq9:", ":a.b=c", "e q:a.b=c", "..:a.b=c", "a/b/c:a.b=c", "eq9:ab=c",
                           "eq9:a.=c", "eq9:.b=c", "eq9:a.b", "eq9:a.b=c,", "eq9:@", "eq9:@a,@b"}) {
    const std::string error = errorOf([&] { parseVariant(text); });
    if (std::string(text) == "eq9:a.b=c,")
      EXPECT_EQ(error, "no error");  // nothing after the comma
    else
      EXPECT_THAT(error, HasSubstr("--variant")) << text;
  }
  EXPECT_THAT(errorOf([] { parseVariant("magic/x:a.b=c"); }), HasSubstr("unknown method `magic`"));
  EXPECT_THAT(errorOf([] { parseVariant(std::string(101, 'x') + ":a.b=c"); }), HasSubstr("at most 100"));
}

TEST(Setting, KeysControlledByTheComparisonAreErrors) {
  for (const char* setting : {"run.output=x", "Run.method=stock", "particle_filter.particles=3",
                              "particle_filter.seed=3", "Particle_Filter.Threads=2"})
    EXPECT_THAT(errorOf([&] { checkSetting(setting, "option --set"); }), HasSubstr("option --set"))
        << setting;
  EXPECT_EQ(errorOf([] { checkSetting("run.particles_every=5", "here"); }), "no error");
  EXPECT_EQ(errorOf([] { checkSetting("run.refine=1", "here"); }), "no error");
  EXPECT_EQ(errorOf([] { checkSetting("particle_filter.ess_threshold=0.3", "here"); }), "no error");
}

TEST(Groups, MethodsTimesVariantsTimesParticles) {
  const auto groups = makeGroups(
      {"hybrid", "general"},
      {parseVariant("hybrid/eq9:line_weight.method=paper"), parseVariant("fine:grid.resolution=0.03")},
      {{"", 20}, {"", 50}, {"general", 60}});
  std::vector<std::string> names;
  for (const Group& g : groups) names.push_back(g.name());
  EXPECT_THAT(names, ElementsAre("hybrid-20", "hybrid-50", "hybrid-eq9-20", "hybrid-eq9-50", "hybrid-fine-20",
                                 "hybrid-fine-50", "general-20", "general-50", "general-60",
                                 "general-fine-20", "general-fine-50", "general-fine-60"));
}

TEST(Groups, WrongOnesAreNamed) {
  EXPECT_THAT(errorOf([] { makeGroups({}, {}, {{"", 20}}); }), HasSubstr("no method"));
  EXPECT_THAT(errorOf([] {
                makeGroups({"hybrid", "gmapping"}, {}, {{"", 20}});
              }),
              HasSubstr("unknown method `gmapping`"));
  EXPECT_THAT(errorOf([] {
                makeGroups({"hybrid", "hybrid"}, {}, {{"", 20}});
              }),
              HasSubstr("`hybrid-20` twice"));
  EXPECT_THAT(errorOf([] {
                makeGroups({"hybrid"}, {}, {{"", 20}, {"hybrid", 20}});
              }),
              HasSubstr("`hybrid-20` twice"));
  EXPECT_THAT(errorOf([] {
                makeGroups({"hybrid", "general"}, {}, {{"hybrid", 20}});
              }),
              HasSubstr("no particle count for the method `general`"));
  EXPECT_THAT(errorOf([] { makeGroups({"hybrid"}, {}, {{"", 20}, {"stock", 20}}); }), HasSubstr("`stock`"));
  EXPECT_THAT(errorOf([] {
                makeGroups({"hybrid"}, {parseVariant("stock/x:a.b=c")}, {{"", 20}});
              }),
              HasSubstr("`stock`"));
}

TEST(ParticleCounts, OfAllMethodsOrOfOne) {
  EXPECT_EQ(parseParticleCount("20").method, "");
  EXPECT_EQ(parseParticleCount("20").particles, 20);
  EXPECT_EQ(parseParticleCount("general:60").method, "general");
  EXPECT_EQ(parseParticleCount("general:60").particles, 60);
  for (const char* wrong :
       {"", "0", "-3", "x", "20x", "2.5", "general:", ":20", "gmapping:20", "99999999999"})
    EXPECT_THAT(errorOf([&] { parseParticleCount(wrong); }), HasSubstr("--particles")) << wrong;
}

TEST(Runs, EveryGroupWithEverySeed) {
  const auto runs = makeRuns(2, 5, 3);
  ASSERT_EQ(runs.size(), 6u);
  EXPECT_EQ(runs[0].group, 0u);
  EXPECT_EQ(runs[0].seed, 5);
  EXPECT_EQ(runs[2].seed, 7);
  EXPECT_EQ(runs[3].group, 1u);
  EXPECT_EQ(runs[3].seed, 5);
}

}  // namespace
}  // namespace hybrid_slam::comparison
