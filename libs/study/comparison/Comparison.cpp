#include "study/comparison/Comparison.h"

#include <algorithm>

#include "study/comparison/ChildProcesses.h"

namespace hybrid_slam::comparison {

SweepOutcome runSweep(const std::vector<ComparisonRun>& runs, size_t atOnce, const std::atomic<bool>& stop,
                      const std::function<void(const ComparisonRun&, const std::string& error)>& onEnd) {
  SweepOutcome outcome;
  std::vector<const ComparisonRun*> todo;
  for (const ComparisonRun& r : runs) {
    if (r.folder.isFinished()) {
      r.folder.expect(r.identity);
      ++outcome.kept;
    } else {
      todo.push_back(&r);
    }
  }
  std::stable_sort(todo.begin(), todo.end(),
                   [](const auto* a, const auto* b) { return a->run.seed < b->run.seed; });

  std::vector<ChildCommand> commands;
  for (const ComparisonRun* r : todo) {
    std::vector<std::string> arguments = r->command;
    arguments.insert(arguments.end(), {"-o", r->folder.partial().string()});
    commands.push_back({arguments, r->folder.messages()});
  }
  const auto begin = [&](size_t i) { todo[i]->folder.begin(todo[i]->identity); };
  const auto end = [&](size_t i, const std::string& error) {
    const ComparisonRun& r = *todo[i];
    if (error.empty()) {
      r.folder.finish();
      ++outcome.done;
    } else {
      r.folder.fail(error);
      ++outcome.failed;
    }
    onEnd(r, error);
  };
  try {
    outcome.isInterrupted = !runCommands(commands, atOnce, stop, begin, end);
  } catch (...) {
    for (const ComparisonRun* r : todo) r->folder.abandon();
    throw;
  }
  for (const ComparisonRun* r : todo) r->folder.abandon();
  return outcome;
}

}  // namespace hybrid_slam::comparison
