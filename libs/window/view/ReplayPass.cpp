#include "window/view/ReplayPass.h"

#include <algorithm>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace hybrid_slam::window {
namespace {

/// Only the hybrid filter begins with the floor plan; one without lines, or with other lines, maps without
/// it.
run::Configuration withMethod(run::Configuration c, run::RunOptions::Method method,
                              const std::string& folder) {
  c.setMethod(method);
  if (method != run::RunOptions::Method::hybrid && !c.run.priorPlan.empty()) {
    c.run.priorPlan.clear();
    c.run.start.reset();
  }
  c.run.output = folder;
  return c;
}

}  // namespace

Lane::Lane(const run::Configuration& all, run::RunOptions::Method method, const std::string& folder)
    : configuration(withMethod(all, method, folder)), run(configuration), watch(configuration, true) {}

std::string Lane::finish(const std::string& file, const readings::RawlogSummary& log,
                         const std::string& target) {
  isFinished = true;
  if (!results) {
    configuration.run.output = target;
    results = run.finish(file, log, nlohmann::ordered_json::object());
  }
  return results->incomplete;
}

ReplayPass::ReplayPass(const run::Configuration& configuration, const std::vector<Method>& methods,
                       const readings::RawlogSummary& summary,
                       const std::pair<const size_t, Checkpoint>* from)
    : file(configuration.run.rawlog), log(summary), source(file, configuration.input, log) {
  for (const Method method : methods)
    lanes.push_back(std::make_unique<Lane>(configuration, method, folder.path(nameOf(method))));
  // The maps of MRPT's filter, which has its own limit, are in the memory of the same program.
  if (std::count(methods.begin(), methods.end(), Method::stock) > 0)
    for (const auto& lane : lanes) lane->run.limitMemory(std::numeric_limits<double>::infinity());
  if (from) {
    for (size_t i = 0; i < lanes.size(); ++i) {
      lanes[i]->run.restore(from->second.lanes.at(i).run);
      lanes[i]->watch = from->second.lanes[i].watch;
    }
    lanes.front()->run.passOver(source, file);
    scans = from->first;
    start = from->second.start;
    time = from->second.time;
  }
  next = source.next();
  if (!from && next) start = next->timestamp;
}

std::vector<std::string> ReplayPass::advance() {
  std::vector<std::string> notes;
  lastScan = Clock::now();
  for (const auto& lane : lanes) {
    const bool isUpdate = lane->run.process(*next);
    lane->watch.saw(lane->run.view(), *next, isUpdate);
    isOutdated |= isUpdate;
    for (const std::string& text : lane->run.takeNotes())
      notes.push_back(nameOf(lane->configuration.run.method) + ": " + text);
  }
  ++scans;
  time = next->timestamp - start;
  next = source.next();
  return notes;
}

std::optional<Checkpoint> ReplayPass::checkpoint() {
  Checkpoint made{start, time, {}};
  for (const auto& lane : lanes) {
    made.lanes.push_back({lane->run.state(), lane->watch});
    if (made.lanes.back().run.empty()) return std::nullopt;
  }
  return made;
}

std::vector<std::string> ReplayPass::names() const {
  std::vector<std::string> all;
  for (const auto& lane : lanes) all.push_back(nameOf(lane->configuration.run.method));
  return all;
}

bool ReplayPass::isFinished() const {
  return std::any_of(lanes.begin(), lanes.end(), [](const auto& lane) { return lane->isFinished; });
}

}  // namespace hybrid_slam::window
