#include "window/view/LiveSession.h"

#include <chrono>

#include "base/Errors.h"
#include "live/ObservationClient.h"
#include "live/Token.h"
#include "live_run/LiveRun.h"

namespace hybrid_slam::window {
namespace {

constexpr size_t kEvents = 200;

}  // namespace

LiveSession::LiveSession(const run::Configuration& configuration, const live::LiveOptions& options,
                         const std::string& server)
    : configuration_(configuration),
      options_(options),
      server_(live::hostAndPort(server, "the live view's server")),
      log_("live",
           [this](const std::string& line) {
             publish([&line](LiveSnapshot& next) {
               next.events.push_back(line);
               if (next.events.size() > kEvents) next.events.erase(next.events.begin());
             });
           }),
      thread_([this] { work(); }) {}

LiveSession::~LiveSession() {
  stop();
  thread_.join();
}

std::shared_ptr<const LiveSnapshot> LiveSession::snapshot() const {
  const std::lock_guard<std::mutex> lock(mutex_);
  return snapshot_;
}

template <class Change>
void LiveSession::publish(const Change& change) {
  const std::lock_guard<std::mutex> lock(mutex_);
  auto next = std::make_shared<LiveSnapshot>(*snapshot_);
  change(*next);
  snapshot_ = next;
}

void LiveSession::work() {
  try {
    const std::string summary = run();
    publish([&](LiveSnapshot& next) { next.state = LiveSnapshot::State::done, next.message = summary; });
  } catch (const std::exception& e) {
    publish(
        [&](LiveSnapshot& next) { next.state = LiveSnapshot::State::failed, next.message = messageOf(e); });
  }
}

std::string LiveSession::run() {
  FilterWatch watch(configuration_);
  auto lastPicture = std::chrono::steady_clock::time_point{};
  bool isOutdated = false;
  live::ObservationClient client({server_.first, server_.second, options_.timeout,
                                  live::readToken(options_.tokenFile, "section [live], key `token_file`")},
                                 log_);
  live::LiveRun live(configuration_, options_, log_, true);
  live.setWatcher([&](const FilterView& view, const readings::Reading& reading, bool isUpdate) {
    watch.saw(view, reading, isUpdate);
    isOutdated |= isUpdate;
    const auto now = std::chrono::steady_clock::now();
    std::shared_ptr<const FilterSnapshot> picture;
    if (isOutdated && now - lastPicture > std::chrono::milliseconds(200)) {
      picture = watch.snapshot(view);
      lastPicture = now;
      isOutdated = false;
    }
    publish([&](LiveSnapshot& next) {
      ++next.scans;
      if (picture) next.filter = picture;
    });
  });
  client.run([&](const mrpt::obs::CSensoryFrame::Ptr& cycle) { live.take(cycle); },
             [&] {
               if (const bool isConnected = client.isConnected(); isConnected != snapshot()->isConnected)
                 publish([&](LiveSnapshot& next) { next.isConnected = isConnected; });
               if (wantsSave_.exchange(false)) live.requestSave();
               return isStopping_ || live.hasFailed();
             });
  publish([](LiveSnapshot& next) { next.state = LiveSnapshot::State::finishing; });
  const std::string summary = live.finish(client.lost());
  publish([&](LiveSnapshot& next) { next.recording = live.recording(); });
  return summary;
}

}  // namespace hybrid_slam::window
