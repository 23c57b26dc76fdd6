/// @file Restricted.h
/// @brief Runs part of a test as on another system: without a system call, or as an ordinary user.
#pragma once

#include <linux/filter.h>
#include <linux/seccomp.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/syscall.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cstddef>
#include <exception>
#include <fstream>
#include <functional>
#include <iostream>
#include <memory>
#include <new>
#include <string>
#include <vector>

namespace hybrid_slam::test {

/// Runs `body` in a child process after `restrict`.
/// @return whether `body` returned true
inline bool holdsInChild(const std::function<bool()>& restrict, const std::function<bool()>& body) {
  const pid_t child = fork();
  if (child == 0) {
    bool holds = false;
    try {
      const bool isRestricted = restrict();
      if (!isRestricted) std::cerr << "the child cannot be restricted" << std::endl;
      holds = isRestricted && body();
    } catch (const std::exception& e) {
      std::cerr << e.what() << std::endl;
    }
    _exit(holds ? 0 : 1);
  }
  int status = 1;
  return child > 0 && waitpid(child, &status, 0) == child && status == 0;
}

/// Limits the address space of this process to what it uses and `more` bytes.
inline bool restrictMemory(size_t more) {
  std::ifstream pages("/proc/self/statm");
  rlim_t all = 0;
  pages >> all;
  const rlim_t most = all * static_cast<rlim_t>(sysconf(_SC_PAGESIZE)) + more;
  const rlimit limit{most, most};
  return setrlimit(RLIMIT_AS, &limit) == 0;
}

/// Runs `body` in a child process without free memory. @return whether it throws std::bad_alloc
inline bool throwsWithoutMemory(const std::function<void()>& body) {
  return holdsInChild([] { return restrictMemory(0); },
                      [&] {
                        std::vector<std::unique_ptr<char[]>> rest;
                        try {
                          for (;;) rest.push_back(std::make_unique<char[]>(1 << 19));
                        } catch (const std::bad_alloc&) {  // what earlier tests have freed is used
                        }
                        try {
                          body();
                        } catch (const std::bad_alloc&) {
                          return true;
                        }
                        return false;
                      });
}

/// Lets a system call of this process fail or kill it.
/// @param action  SECCOMP_RET_ERRNO | error, or SECCOMP_RET_KILL_PROCESS
inline bool restrictCall(unsigned number, unsigned action) {
  std::array<sock_filter, 4> rules{{BPF_STMT(BPF_LD | BPF_W | BPF_ABS, offsetof(seccomp_data, nr)),
                                    BPF_JUMP(BPF_JMP | BPF_JEQ | BPF_K, number, 0, 1),
                                    BPF_STMT(BPF_RET | BPF_K, action),
                                    BPF_STMT(BPF_RET | BPF_K, SECCOMP_RET_ALLOW)}};
  sock_fprog program{rules.size(), rules.data()};
  return prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0 &&
         prctl(PR_SET_SECCOMP, SECCOMP_MODE_FILTER, &program) == 0;
}

/// Runs `body` in a child process whose system call `number` fails with `error`.
inline bool holdsWithout(unsigned number, unsigned error, const std::function<bool()>& body) {
  return holdsInChild([&] { return restrictCall(number, SECCOMP_RET_ERRNO | error); }, body);
}

/// Runs `body` as an ordinary user, who owns `folder`, if the test runs as root.
inline bool holdsWithoutRoot(const std::string& folder, const std::function<bool()>& body) {
  constexpr uid_t kNobody = 65534;
  return holdsInChild(
      [&] {
        return geteuid() != 0 ||
               (chown(folder.c_str(), kNobody, kNobody) == 0 && setgid(kNobody) == 0 && setuid(kNobody) == 0);
      },
      body);
}

}  // namespace hybrid_slam::test
