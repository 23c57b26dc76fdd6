#include "run/LogAgain.h"

#include <new>

#include "base/Errors.h"
#include "files/InputFile.h"

namespace hybrid_slam::run {
namespace {

template <class Read>
auto checked(const Read& read) {
  try {
    return read();
  } catch (const std::bad_alloc&) {
    throw;
  } catch (const std::exception& e) {
    throw UnreadableLog("the log cannot be read again (" + messageOf(e) + ")");
  }
}

}  // namespace

bool hasChanged(const std::string& file, const readings::RawlogSummary& log) {
  return !log.state.empty() && files::stateOf(file) != log.state;
}

LogAgain::LogAgain(const std::string& file, const readings::InputOptions& options,
                   const readings::RawlogSummary& summary)
    : file_(file) {
  checked([&] { source_.emplace(file, options, summary); });
}

readings::Reading LogAgain::next() {
  auto reading = checked([this] { return source_->next(); });
  if (!reading) throw UnreadableLog("the log cannot be read again (" + file_ + " ends before the run)");
  return std::move(*reading);
}

}  // namespace hybrid_slam::run
