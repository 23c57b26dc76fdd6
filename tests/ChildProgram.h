/// @file ChildProgram.h
/// @brief For the tests: a program in a separate process.
#pragma once

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <optional>
#include <string>
#include <vector>

#include "files/TemporaryFolder.h"
#include "testing/Happens.h"
#include "testing/TestLogs.h"

namespace hybrid_slam::test {

/// A program started without a shell. It does not outlive the object.
class ChildProgram {
 public:
  /// @param name  name of its output files in the folder: NAME.out and NAME.err
  ChildProgram(const files::TemporaryFolder& folder, const std::string& name,
               std::vector<std::string> arguments)
      : out_(folder.path(name + ".out")), err_(folder.path(name + ".err")) {
    std::vector<char*> argv;
    for (std::string& argument : arguments) argv.push_back(argument.data());
    argv.push_back(nullptr);
    child_ = ::fork();
    if (child_ != 0) return;
    ::prctl(PR_SET_PDEATHSIG, SIGKILL);
    ::dup2(::open(out_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDOUT_FILENO);
    ::dup2(::open(err_.c_str(), O_CREAT | O_TRUNC | O_WRONLY, 0600), STDERR_FILENO);
    ::execv(argv[0], argv.data());
    ::_exit(127);
  }
  ~ChildProgram() {
    if (hasEnded()) return;
    signal(SIGKILL);
    ::waitpid(child_, nullptr, 0);
  }
  ChildProgram(const ChildProgram&) = delete;
  ChildProgram& operator=(const ChildProgram&) = delete;

  void signal(int number) {
    if (!hasEnded()) ::kill(child_, number);
  }
  bool hasEnded() {
    if (!hasEnded_) hasEnded_ = ::waitpid(child_, &status_, WNOHANG) == child_;
    return hasEnded_;
  }
  /// Waits for the exit code; -1 if a signal ended the program or it does not end.
  int wait() {
    return test::happens([this] { return hasEnded(); }) && WIFEXITED(status_) ? WEXITSTATUS(status_) : -1;
  }
  /// Waits for the signal that ends the program; none if it exits by itself or does not end.
  std::optional<int> endedBySignal() {
    if (!test::happens([this] { return hasEnded(); }) || !WIFSIGNALED(status_)) return {};
    return WTERMSIG(status_);
  }
  std::string out() const { return test::contentOf(out_); }
  std::string err() const { return test::contentOf(err_); }

 private:
  std::string out_, err_;
  pid_t child_ = -1;
  int status_ = 0;
  bool hasEnded_ = false;
};

}  // namespace hybrid_slam::test
