#include "live/ObservationServer.h"

#include <netdb.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <random>
#include <stdexcept>
#include <vector>

#include "base/Clock.h"
#include "base/Errors.h"
#include "base/Numbers.h"
#include "live/Token.h"

namespace hybrid_slam::live {
namespace {

using Clock = std::chrono::steady_clock;

constexpr std::chrono::milliseconds kHeartbeat{1000};  // without a message
constexpr size_t kMostReceived = size_t{1} << 20;      // bytes of a client, which has only a token to send

const std::string& checkedAddress(const std::string& address, const std::string& token) {
  if (token.empty() && !isLoopback(address))
    throw InputError("no token", "section [server], key `token_file`",
                     "expected a token where other machines can connect (address " + address +
                         "), or address 127.0.0.1 and an SSH tunnel");
  return address;
}

uint64_t drawSession() {
  std::random_device device;
  return static_cast<uint64_t>(device()) << 32 | device();
}

/// @param hasPort  without it, all connections of a machine have one name
std::string nameOf(int descriptor, bool hasPort) {
  sockaddr_storage peer{};
  socklen_t size = sizeof peer;
  ::getpeername(descriptor, reinterpret_cast<sockaddr*>(&peer), &size);
  char host[NI_MAXHOST] = "", port[NI_MAXSERV] = "0";
  ::getnameinfo(reinterpret_cast<sockaddr*>(&peer), size, host, sizeof host, port, sizeof port,
                NI_NUMERICHOST | NI_NUMERICSERV);
  return "client " + (hasPort ? addressText(host, static_cast<uint16_t>(std::stoi(port))) : host);
}

}  // namespace

ObservationServer::ObservationServer(const std::string& address, uint16_t port, Limits limits, EventLog& log)
    : limits_(std::move(limits)),
      log_(log),
      listener_(checkedAddress(address, limits_.token), port),
      wakeUp_(::eventfd(0, EFD_NONBLOCK | EFD_CLOEXEC)),
      session_(drawSession()),
      allowed_(static_cast<double>(limits_.clients)) {
  if (wakeUp_ < 0) throw std::runtime_error("no eventfd");
  thread_ = std::thread([this] { serve(); });
}

ObservationServer::~ObservationServer() {
  stop_ = true;
  wake();
  thread_.join();
  ::close(wakeUp_);
}

void ObservationServer::wake() const {
  const uint64_t one = 1;
  [[maybe_unused]] const ssize_t ignored = ::write(wakeUp_, &one, sizeof one);  // fails only if already awake
}

void ObservationServer::publish(const mrpt::obs::CSensoryFrame& cycle) {
  std::string payload = serialise(cycle);
  if (payload.size() > kMaxPayload) return log_.report("server", "cycle larger than 16 MiB skipped");
  enqueue(MessageKind::cycle, std::move(payload));
}

void ObservationServer::enqueue(MessageKind kind, std::string payload) {
  {
    // Number and queue in one step: a heartbeat ahead of its cycle would make it count as lost.
    const std::lock_guard<std::mutex> lock(mutex_);
    if (kind == MessageKind::cycle) ++number_;
    lastMessage_ = Clock::now();
    const auto message =
        std::make_shared<const Encoded>(Encoded{kind, encode({kind, session_, number_, std::move(payload)})});
    for (Client& client : clients_) {
      if (!client.isKnown) continue;
      if (kind == MessageKind::heartbeat && !client.queue.empty()) continue;
      // A partly sent message must be finished; drop the next oldest.
      const auto oldest = client.queue.begin() + (client.sent > 0 ? 1 : 0);
      if (kind == MessageKind::cycle && client.queue.size() >= limits_.queue &&
          oldest != client.queue.end()) {
        if ((*oldest)->kind == MessageKind::cycle) ++client.dropped, ++dropped_;
        client.queue.erase(oldest);
      }
      client.queue.push_back(message);
    }
  }
  wake();
}

void ObservationServer::finish(double timeout) {
  enqueue(MessageKind::end);
  const auto end = Clock::now() + std::chrono::duration<double>(timeout);
  const auto isAllSent = [this] {
    const std::lock_guard<std::mutex> lock(mutex_);
    for (const Client& client : clients_)
      if (!client.queue.empty()) return false;
    return true;
  };
  while (!isAllSent() && Clock::now() < end) std::this_thread::sleep_for(std::chrono::milliseconds(10));
}

/// Further clients wait in the system's queue.
bool ObservationServer::isOpenToClients() {
  const auto now = Clock::now();
  const std::chrono::duration<double> passed = now - lastAllowed_;
  lastAllowed_ = now;
  allowed_ = std::min(static_cast<double>(limits_.clients), allowed_ + limits_.newPerSecond * passed.count());
  return clients_.size() < limits_.clients && allowed_ >= 1;
}

void ObservationServer::serve() {
  while (!stop_) {
    std::vector<pollfd> ready{{wakeUp_, POLLIN, 0}};
    Clock::duration left{};  // until a heartbeat is due
    {
      const std::lock_guard<std::mutex> lock(mutex_);
      left = lastMessage_ + kHeartbeat - Clock::now();
      for (const Client& client : clients_)
        ready.push_back({client.socket.descriptor(),
                         static_cast<short>(POLLIN | (client.queue.empty() ? 0 : POLLOUT)), 0});
    }
    if (left <= Clock::duration::zero()) {
      enqueue(MessageKind::heartbeat);
      continue;
    }
    if (isOpenToClients()) ready.push_back({listener_.descriptor(), POLLIN, 0});
    ::poll(ready.data(), ready.size(),
           static_cast<int>(std::chrono::ceil<std::chrono::milliseconds>(left).count()));

    uint64_t count = 0;
    [[maybe_unused]] const ssize_t ignored = ::read(wakeUp_, &count, sizeof count);
    size_t i = 1;
    for (auto client = clients_.begin(); client != clients_.end(); ++i) {
      try {
        if (ready[i].revents & (POLLIN | POLLERR | POLLHUP)) read(*client);
        write(*client);
        ++client;
      } catch (const std::runtime_error& e) {
        log_.report(client->name, "disconnected (" + messageOf(e) + ")");
        const std::lock_guard<std::mutex> lock(mutex_);
        client = clients_.erase(client);
      }
    }
    if (i < ready.size() && ready[i].revents) accept();
    clientCount_ = static_cast<size_t>(
        std::count_if(clients_.begin(), clients_.end(), [](const Client& client) { return client.isKnown; }));
  }
}

void ObservationServer::accept() {
  TcpSocket socket = listener_.accept(0);
  if (!socket.isOpen()) {
    // Out of descriptors, or the client has already left.
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
    return;
  }
  allowed_ -= 1;
  Client client;
  client.name = nameOf(socket.descriptor(), false);
  client.socket = std::move(socket);
  client.lastTaken = Clock::now();
  if (limits_.token.empty()) becomeKnown(client);
  const std::lock_guard<std::mutex> lock(mutex_);
  clients_.push_back(std::move(client));
}

/// Unknown clients are reported under the name of their machine, so that a repeated fault is logged once.
void ObservationServer::becomeKnown(Client& client) {
  client.name = nameOf(client.socket.descriptor(), true);
  client.isKnown = true;
  log_.report(client.name, "connected");
}

/// Data from known clients is discarded; reading detects when they leave.
void ObservationServer::read(Client& client) {
  const std::string bytes = client.socket.receive(0);
  client.received += bytes.size();
  if (client.received > kMostReceived) throw std::runtime_error("sent over 1 MiB");
  if (client.isKnown) return;
  client.shown += bytes.substr(0, kMaxToken + 1);
  const size_t end = client.shown.find('\n');
  if (end == std::string::npos && client.shown.size() <= kMaxToken) return;
  if (!isSameToken(client.shown.substr(0, end), limits_.token)) throw std::runtime_error("wrong token");
  const std::lock_guard<std::mutex> lock(mutex_);
  becomeKnown(client);
}

void ObservationServer::write(Client& client) {
  if (!client.isKnown && secondsSince(client.lastTaken) > limits_.tokenPatience)
    throw std::runtime_error("no token");
  if (!client.isKnown) return;
  const std::lock_guard<std::mutex> lock(mutex_);
  if (client.queue.empty()) client.lastTaken = Clock::now();
  while (!client.queue.empty()) {
    const std::string& bytes = client.queue.front()->bytes;
    client.sent += client.socket.sendSome(bytes.data() + client.sent, bytes.size() - client.sent);
    if (client.sent < bytes.size()) break;
    client.queue.pop_front();
    client.sent = 0;
    client.lastTaken = Clock::now();
  }
  if (secondsSince(client.lastTaken) > limits_.patience) throw std::runtime_error("does not read");
  if (client.dropped == 0) return;
  if (client.queue.empty()) {
    log_.report(client.name, "keeps up again; missed " + counted(client.dropped, "cycle(s)"));
    client.dropped = 0;
  } else {
    log_.report(client.name, "too slow: oldest cycles dropped");
  }
}

}  // namespace hybrid_slam::live
