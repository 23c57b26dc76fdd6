#include "window/view/LiveSession.h"

#include <chrono>
#include <utility>

#include "base/Errors.h"
#include "live/ObservationClient.h"
#include "live/Token.h"
#include "live_run/LiveRun.h"

namespace hybrid_slam::window {
namespace {

constexpr size_t kEvents = 200;
constexpr double kVerdicts = 0.5;  // s, between two on the map so far
constexpr auto kPictures = std::chrono::milliseconds(200);

}  // namespace

LiveSession::LiveSession(const run::Configuration& configuration, const live::LiveOptions& options,
                         const std::string& server)
    : configuration_(configuration),
      options_(options),
      server_(live::hostAndPort(server, "the live view's server")),
      log_("live",
           [this](const std::string& line) {
             snapshot_.change([&line](LiveSnapshot& next) {
               next.events.push_back(line);
               if (next.events.size() > kEvents) next.events.erase(next.events.begin());
             });
           }),
      thread_([this] { work(); }) {}

LiveSession::~LiveSession() { finish(); }

void LiveSession::finish() {
  stop();
  if (thread_.joinable()) thread_.join();
}

void LiveSession::work() {
  try {
    const std::string summary = run();
    snapshot_.change(
        [&](LiveSnapshot& next) { next.state = LiveSnapshot::State::done, next.message = summary; });
  } catch (const std::exception& e) {
    snapshot_.change(
        [&](LiveSnapshot& next) { next.state = LiveSnapshot::State::failed, next.message = messageOf(e); });
  }
}

std::string LiveSession::run() {
  for (const std::string& warning : configuration_.warnings) log_.report("warning", warning);
  live::ObservationClient client({server_.first, server_.second, options_.timeout,
                                  live::readToken(options_.tokenFile, "section [live], key `token_file`")},
                                 log_);
  FilterWatch watch(configuration_);
  std::shared_ptr<const run::Verdict> verdict;
  auto lastPicture = std::chrono::steady_clock::time_point{};
  bool isOutdated = false;
  const auto picture = [&watch, &verdict](const FilterView& view) {
    const auto taken = watch.snapshot(view);
    if (verdict && !taken->place) taken->verdict = *verdict;
    return taken;
  };
  live::LiveRun live(configuration_, options_, log_, true);
  live.setStateInterval(kVerdicts);
  live.setWatcher([&](const FilterView& view, const readings::Reading& reading, bool isUpdate) {
    watch.saw(view, reading, isUpdate);
    isOutdated |= isUpdate || verdict != live.verdict();
    verdict = live.verdict();
    const auto now = std::chrono::steady_clock::now();
    std::shared_ptr<FilterSnapshot> next;
    if (isOutdated && now - lastPicture > kPictures) {
      next = picture(view);
      lastPicture = now;
      isOutdated = false;
    }
    snapshot_.change([&next](LiveSnapshot& shown) {
      ++shown.scans;
      if (next) shown.filter = next;
    });
  });
  try {
    client.run([&](const mrpt::obs::CSensoryFrame::Ptr& cycle) { live.take(cycle); },
               [&] {
                 if (const bool isConnected = client.isConnected(); isConnected != snapshot()->isConnected)
                   snapshot_.change([&](LiveSnapshot& next) { next.isConnected = isConnected; });
                 if (wantsSave_.exchange(false)) live.requestSave();
                 return isStopping_ || live.hasFailed();
               });
  } catch (const std::exception&) {
    try {
      live.finish(client.lost(), live::kPatience);  // the results so far
    } catch (const std::exception& e) {
      log_.report("results", messageOf(e));
    }
    throw;
  }
  snapshot_.change([](LiveSnapshot& next) { next.state = LiveSnapshot::State::finishing; });
  const std::string summary = live.finish(client.lost(), live::kPatience);
  const auto last = isOutdated ? picture(live.view()) : nullptr;
  snapshot_.change([&](LiveSnapshot& shown) {
    shown.recording = live.recording();
    if (last) shown.filter = last;
  });
  return summary;
}

}  // namespace hybrid_slam::window
