#include "study/comparison/ChildProcesses.h"

#include <fcntl.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <map>
#include <stdexcept>
#include <thread>

namespace hybrid_slam::comparison {
namespace {

pid_t start(const ChildCommand& command) {
  // Allocate before fork: the child of a multithreaded program must not.
  std::vector<char*> arguments;
  for (const std::string& argument : command.arguments)
    arguments.push_back(const_cast<char*>(argument.c_str()));
  arguments.push_back(nullptr);
  const std::string messages = command.messages.string();
  const pid_t parent = getpid(), child = fork();
  if (child < 0) throw std::runtime_error("cannot start a process: " + std::string(std::strerror(errno)));
  if (child > 0) return child;

  setpgid(0, 0);
  prctl(PR_SET_PDEATHSIG, SIGKILL);
  if (getppid() != parent) _exit(127);
  const int nowhere = open("/dev/null", O_RDWR),
            errors = open(messages.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0666);
  dup2(nowhere, STDIN_FILENO);
  dup2(nowhere, STDOUT_FILENO);
  dup2(errors < 0 ? nowhere : errors, STDERR_FILENO);
  execvp(arguments[0], arguments.data());
  dprintf(STDERR_FILENO, "%s: error: cannot be started: %s\n", arguments[0], std::strerror(errno));
  _exit(127);
}

/// Returns the last line containing `error`, else the last line.
std::string lastError(const std::filesystem::path& messages) {
  std::ifstream in(messages);
  std::string last, error;
  for (std::string line; std::getline(in, line);) {
    if (!line.empty()) last = line;
    if (line.find("error: ") != std::string::npos) error = line.substr(line.find("error: ") + 7);
  }
  return error.empty() ? last : error;
}

std::string errorOf(int status, const ChildCommand& command) {
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  if (WIFSIGNALED(status)) return "ended by signal " + std::to_string(WTERMSIG(status));
  const std::string error = lastError(command.messages);
  return error.empty() ? "exit status " + std::to_string(WEXITSTATUS(status)) : error;
}

}  // namespace

bool runCommands(const std::vector<ChildCommand>& commands, size_t atOnce, const std::atomic<bool>& stop,
                 const std::function<void(size_t)>& onStart, const CommandEnd& onEnd) {
  std::map<pid_t, size_t> running;
  const auto endAll = [&running] {
    for (const auto& [child, command] : running) kill(child, SIGKILL);
    for (const auto& [child, command] : running) waitpid(child, nullptr, 0);
    running.clear();
  };
  try {
    size_t next = 0;
    while (next < commands.size() || !running.empty()) {
      if (stop) {
        endAll();
        return false;
      }
      while (next < commands.size() && running.size() < atOnce) {
        onStart(next);
        running[start(commands[next])] = next;
        ++next;
      }
      for (auto it = running.begin(); it != running.end();) {
        int status = 0;
        const pid_t ended = waitpid(it->first, &status, WNOHANG);
        if (ended == 0 || (ended < 0 && errno == EINTR)) {
          ++it;
          continue;
        }
        // No status is available if SIGCHLD was ignored at program start.
        const std::string error = ended < 0 ? "exit status unknown: " + std::string(std::strerror(errno))
                                            : errorOf(status, commands[it->second]);
        const size_t command = it->second;
        it = running.erase(it);
        onEnd(command, error);
      }
      std::this_thread::sleep_for(std::chrono::milliseconds(10));
    }
  } catch (...) {
    endAll();
    throw;
  }
  return true;
}

}  // namespace hybrid_slam::comparison
