/// MRPT's CLMS100Eth waits 1 s after each of five answers, and once 10 s. These replacements of C library
/// functions shorten the waits in this program.
#include <sys/epoll.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>

extern "C" {

int nanosleep(const timespec* wanted, timespec* left) {
  const timespec shorter{0, 1000000};
  return static_cast<int>(syscall(SYS_nanosleep, wanted->tv_sec >= 5 ? &shorter : wanted, left));
}

int epoll_wait(int descriptor, epoll_event* events, int count, int timeout) {
  return epoll_pwait(descriptor, events, count, timeout >= 1000 ? 100 : timeout, nullptr);
}
}
