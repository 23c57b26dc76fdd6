#include "live/TcpSocket.h"

#include <arpa/inet.h>
#include <fcntl.h>
#include <netdb.h>
#include <netinet/in.h>
#include <netinet/tcp.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <future>
#include <memory>
#include <stdexcept>
#include <thread>

#include "base/Clock.h"
#include "base/Errors.h"

namespace hybrid_slam::live {
namespace {

using Clock = std::chrono::steady_clock;
constexpr double kStopInterval = 0.1;  // s

[[noreturn]] void fail(int error) { throw std::runtime_error(std::strerror(error)); }

/// Returns whether the socket is ready for `events` within `timeout` s.
bool waitFor(int descriptor, short events, double timeout) {
  const auto end = Clock::now() + std::chrono::duration<double>(timeout);
  for (;;) {
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    pollfd entry{descriptor, events, 0};
    const int ready = ::poll(&entry, 1, std::max(0, static_cast<int>(1000 * left + 0.999)));
    if (ready > 0) return true;
    if (ready == 0) return false;
    if (errno != EINTR) fail(errno);
  }
}

/// Sends small messages immediately and detects dead peers: bytes unacknowledged for 30 s end the connection.
void prepare(int descriptor) {
  const int on = 1, idle = 10, interval = 5, count = 4, userTimeout = 30000;
  ::fcntl(descriptor, F_SETFL, ::fcntl(descriptor, F_GETFL) | O_NONBLOCK);
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_NODELAY, &on, sizeof on);
  ::setsockopt(descriptor, SOL_SOCKET, SO_KEEPALIVE, &on, sizeof on);
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPIDLE, &idle, sizeof idle);
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPINTVL, &interval, sizeof interval);
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_KEEPCNT, &count, sizeof count);
  ::setsockopt(descriptor, IPPROTO_TCP, TCP_USER_TIMEOUT, &userTimeout, sizeof userTimeout);
}

using Addresses = std::unique_ptr<addrinfo, void (*)(addrinfo*)>;

Addresses lookUp(const std::string& host, uint16_t port, int flags) {
  addrinfo hints{};
  hints.ai_family = AF_UNSPEC;
  hints.ai_socktype = SOCK_STREAM;
  hints.ai_flags = flags;
  addrinfo* found = nullptr;
  const int error = ::getaddrinfo(host.c_str(), std::to_string(port).c_str(), &hints, &found);
  if (error) throw std::runtime_error(::gai_strerror(error));
  return {found, ::freeaddrinfo};
}

/// Looks a name up in a separate thread, abandoned on a stop: getaddrinfo cannot be interrupted. @return none
/// if stopped
Addresses lookUp(const std::string& host, uint16_t port, double timeout,
                 const std::function<bool()>& isStopped) {
  std::packaged_task<Addresses()> task([host, port] { return lookUp(host, port, 0); });
  auto found = task.get_future();
  std::thread(std::move(task)).detach();
  const auto start = Clock::now();
  const std::chrono::duration<double> interval(std::min(timeout, kStopInterval));
  while (found.wait_for(interval) != std::future_status::ready) {
    if (isStopped()) return {nullptr, ::freeaddrinfo};
    if (secondsSince(start) > timeout) fail(ETIMEDOUT);
  }
  return found.get();
}

/// @return 0 if connected, else the errno
int connectWithin(int descriptor, const addrinfo& address, double timeout,
                  const std::function<bool()>& isStopped) {
  const auto start = Clock::now();
  prepare(descriptor);
  if (::connect(descriptor, address.ai_addr, address.ai_addrlen) != 0 && errno != EINPROGRESS) return errno;
  while (!waitFor(descriptor, POLLOUT, std::min(timeout, kStopInterval)))
    if (isStopped() || secondsSince(start) > timeout) return ETIMEDOUT;
  int error = 0;
  socklen_t size = sizeof error;
  ::getsockopt(descriptor, SOL_SOCKET, SO_ERROR, &error, &size);
  return error;
}

}  // namespace

std::string addressText(const std::string& host, uint16_t port) {
  const bool isIPv6 = host.find(':') != std::string::npos;
  return (isIPv6 ? "[" + host + "]" : host) + ":" + std::to_string(port);
}

TcpSocket& TcpSocket::operator=(TcpSocket&& other) noexcept {
  if (this != &other) {
    close();
    descriptor_ = other.release();
  }
  return *this;
}

int TcpSocket::release() {
  const int descriptor = descriptor_;
  descriptor_ = -1;
  return descriptor;
}

void TcpSocket::close() {
  if (isOpen()) ::close(release());
}

TcpSocket TcpSocket::connectTo(const std::string& host, uint16_t port, double timeout,
                               const std::function<bool()>& isStopped) {
  const auto start = Clock::now();
  const Addresses found = lookUp(host, port, timeout, isStopped);
  int left = 0, firstError = 0;
  for (const addrinfo* address = found.get(); address; address = address->ai_next) ++left;
  for (const addrinfo* address = found.get(); address && !isStopped(); address = address->ai_next, --left) {
    TcpSocket out(::socket(address->ai_family, SOCK_STREAM | SOCK_CLOEXEC, 0));
    const double share = (timeout - secondsSince(start)) / left;
    const int error = out.isOpen() ? connectWithin(out.descriptor_, *address, share, isStopped) : errno;
    if (error == 0) return out;
    if (firstError == 0) firstError = error;
  }
  if (!isStopped()) fail(firstError);
  return {};
}

std::string TcpSocket::receive(double timeout) {
  if (!waitFor(descriptor_, POLLIN, timeout)) return {};
  std::string bytes(65536, '\0');
  const ssize_t count = ::recv(descriptor_, bytes.data(), bytes.size(), 0);
  if (count == 0) throw std::runtime_error("the other side closed the connection");
  if (count < 0 && errno != EAGAIN && errno != EINTR) fail(errno);
  bytes.resize(static_cast<size_t>(std::max<ssize_t>(count, 0)));
  return bytes;
}

size_t TcpSocket::sendSome(const char* bytes, size_t count) {
  const ssize_t sent = ::send(descriptor_, bytes, count, MSG_NOSIGNAL);
  if (sent < 0 && errno != EAGAIN && errno != EINTR) fail(errno);
  return static_cast<size_t>(std::max<ssize_t>(sent, 0));
}

void TcpSocket::send(const std::string& bytes, double timeout) {
  const auto end = Clock::now() + std::chrono::duration<double>(timeout);
  for (size_t sent = 0; sent < bytes.size();) {
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    if (!waitFor(descriptor_, POLLOUT, left)) fail(ETIMEDOUT);
    sent += sendSome(bytes.data() + sent, bytes.size() - sent);
  }
}

TcpListener::TcpListener(const std::string& address, uint16_t port) {
  const std::string where = addressText(address, port);
  const std::string expected = "expected a numeric local address or localhost, and a free port";
  try {
    const Addresses found =
        lookUp(address == "localhost" ? "127.0.0.1" : address, port, AI_PASSIVE | AI_NUMERICHOST);
    socket_ = TcpSocket(::socket(found->ai_family, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0));
    const int on = 1;
    ::setsockopt(socket_.descriptor(), SOL_SOCKET, SO_REUSEADDR, &on, sizeof on);
    if (::bind(socket_.descriptor(), found->ai_addr, found->ai_addrlen) != 0) fail(errno);
    if (::listen(socket_.descriptor(), 128) != 0) fail(errno);
    sockaddr_storage bound{};
    socklen_t size = sizeof bound;
    ::getsockname(socket_.descriptor(), reinterpret_cast<sockaddr*>(&bound), &size);
    port_ = ntohs(bound.ss_family == AF_INET6 ? reinterpret_cast<sockaddr_in6&>(bound).sin6_port
                                              : reinterpret_cast<sockaddr_in&>(bound).sin_port);
  } catch (const std::runtime_error& e) {
    throw InputError(std::string("cannot listen (") + e.what() + ")", where, expected);
  }
}

TcpSocket TcpListener::accept(double timeout) {
  if (!waitFor(socket_.descriptor(), POLLIN, timeout)) return {};
  TcpSocket out(::accept4(socket_.descriptor(), nullptr, nullptr, SOCK_CLOEXEC));
  if (out.isOpen()) prepare(out.descriptor());
  return out;
}

}  // namespace hybrid_slam::live
