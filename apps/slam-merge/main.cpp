/// @file main.cpp
/// @brief slam-merge: joins two maps of overlapping areas (doc/sessions.md).

#include <CLI/CLI.hpp>
#include <iostream>

#include "OutputArgument.h"
#include "Program.h"
#include "run/MergeRun.h"

namespace {

using namespace hybrid_slam;

struct CommandLine {
  run::MergeOptions merge;
  bool isQuiet = false;
};

void describe(CLI::App& app, CommandLine& line) {
  app.set_version_flag("--version", "slam-merge " HYBRID_SLAM_VERSION);
  const std::string files = "session.hslam, map.yaml, gridmap, or a folder of results with its session";
  app.add_option("A", line.merge.older, files + "; the merged map has its frame and its cells")->required();
  app.add_option("B", line.merge.newer, "the same for an overlapping area")->required();
  addOutput(app, line.merge.output, "folder for the results, created if missing")->required();
  app.add_flag("--overwrite", line.merge.overwrite,
               "replace earlier results in DIR (default: write to a dated subfolder)");
  app.add_option("-j,--threads", line.merge.threads, "number of threads; 0: all cores")
      ->check(CLI::Range(0, 1024))
      ->capture_default_str()
      ->type_name("N");
  addQuiet(app, line.isQuiet);
  app.footer(
      "Results: session.hslam (for --continue and --localize), map.png, map.pgm + map.yaml, map.gridmap.gz,\n"
      "lines.csv, config.ini, trajectory.tum of both sessions, metrics.json (place of B in A, evidence).\n"
      "Exit: 0 done, 1 no overlap was found or the maps fit in several places,\n"
      "2 wrong command line or input.");
}

int merge(const CommandLine& line) {
  const run::MergeOutcome outcome = run::merge(line.merge);
  if (!outcome.isMerged) return fail(1, outcome.summary);
  if (line.isQuiet) return 0;
  if (!outcome.note.empty()) std::cout << outcome.note << "\n";
  std::cout << outcome.summary << "\n";
  return 0;
}

}  // namespace

int main(int argc, char** argv) {
  CommandLine line;
  return exitCodeOf([&] {
    CLI::App app{"Joins two maps of overlapping areas: B is searched for in A, without a starting pose"};
    describe(app, line);
    if (const auto code = parse(app, argc, argv)) return *code;
    files::findInputFiles({&line.merge.older, &line.merge.newer});
    return merge(line);
  });
}
