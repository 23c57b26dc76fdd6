#include "window/view/LiveSession.h"

#include <chrono>
#include <functional>
#include <future>
#include <utility>

#include "base/Errors.h"
#include "live/ObservationClient.h"
#include "live/Token.h"
#include "live_run/LiveRun.h"

namespace hybrid_slam::window {
namespace {

constexpr size_t kEvents = 200;

/// Finds the verdict on the map so far in another thread, so that no scan waits for it. At most once per
/// second, since showing it takes a copy of the map.
class LiveVerdict {
 public:
  using Show = std::function<void(const run::Verdict&)>;
  explicit LiveVerdict(Show show) : show_(std::move(show)) {}

  /// Called after each scan of a filter that maps.
  void follow(const FilterView& view, const FilterWatch& watch) {
    const auto now = std::chrono::steady_clock::now();
    if (view.place() || view.updates() == judged_ || now - last_ < std::chrono::seconds(1)) return;
    if (next_.valid() && next_.wait_for(std::chrono::seconds(0)) != std::future_status::ready) return;
    judged_ = view.updates();
    last_ = now;
    next_ = std::async(std::launch::async, [this, judge = watch.judge(view)] { show_(judge()); });
  }

 private:
  Show show_;
  size_t judged_ = 0;  ///< updates
  std::chrono::steady_clock::time_point last_;
  std::future<void> next_;  ///< its destructor waits
};

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

/// Sets the verdict in the snapshot on display; later snapshots keep it.
void LiveSession::showVerdict(const run::Verdict& verdict) {
  snapshot_.change([&](LiveSnapshot& next) {
    if (!next.filter) return;
    const auto judged = std::make_shared<FilterSnapshot>(*next.filter);
    judged->verdict = verdict;
    next.filter = judged;
  });
}

std::string LiveSession::run() {
  for (const std::string& warning : configuration_.warnings) log_.report("warning", warning);
  FilterWatch watch(configuration_, true);
  LiveVerdict verdict([this](const run::Verdict& found) { showVerdict(found); });
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
    std::shared_ptr<FilterSnapshot> picture;
    if (isOutdated && now - lastPicture > std::chrono::milliseconds(200)) {
      picture = watch.snapshot(view);
      lastPicture = now;
      isOutdated = false;
    }
    snapshot_.change([&](LiveSnapshot& next) {
      ++next.scans;
      if (!picture) return;
      if (next.filter && !picture->place) picture->verdict = next.filter->verdict;
      next.filter = picture;
    });
    verdict.follow(view, watch);
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
  const auto last = isOutdated ? watch.snapshot(live.view()) : nullptr;
  snapshot_.change([&](LiveSnapshot& next) {
    next.recording = live.recording();
    if (!last) return;
    if (next.filter && !last->place) last->verdict = next.filter->verdict;
    next.filter = last;
  });
  return summary;
}

}  // namespace hybrid_slam::window
