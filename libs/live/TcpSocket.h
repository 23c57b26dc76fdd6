/// @file TcpSocket.h
/// @brief TCP connections that neither block forever nor kill the program.
///
/// MRPT's sockets are not suitable. CServerTCPSocket does not report the port chosen by the system, which
/// tests need. CClientTCPSocket::writeAsync loops forever once the peer is gone (it treats a failed send as
/// no progress), after a SIGPIPE that kills the program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace hybrid_slam::live {

/// Returns HOST:PORT, with an IPv6 address in brackets.
std::string addressText(const std::string& host, uint16_t port);

/// One end of a connection; closed with the object.
class TcpSocket {
 public:
  TcpSocket() = default;
  explicit TcpSocket(int descriptor) : descriptor_(descriptor) {}
  ~TcpSocket() { close(); }
  TcpSocket(TcpSocket&& other) noexcept : descriptor_(other.release()) {}
  TcpSocket& operator=(TcpSocket&& other) noexcept;

  /// Tries the host's addresses, IPv4 and IPv6, one after the other.
  /// @param timeout    s, shared equally between the remaining addresses
  /// @param isStopped  called every 0.1 s
  /// @return a closed socket if stopped
  /// @throws std::runtime_error with the reason if there is no answer
  static TcpSocket connectTo(
      const std::string& host, uint16_t port, double timeout,
      const std::function<bool()>& isStopped = [] { return false; });

  bool isOpen() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  void close();

  /// Receives at most 64 KiB; waits at most `timeout` s for the first byte. Empty if none arrived.
  /// @throws std::runtime_error if the connection was closed or broke
  std::string receive(double timeout);
  /// Sends without blocking. @return number of bytes sent, 0 if the buffer is full
  /// @throws std::runtime_error if the connection is lost
  size_t sendSome(const char* bytes, size_t count);
  /// Sends all. @throws std::runtime_error if that takes longer than `timeout` s, or the connection is lost
  void send(const std::string& bytes, double timeout);

 private:
  int release();
  int descriptor_ = -1;
};

/// A listening socket.
class TcpListener {
 public:
  /// @param address  local address: "127.0.0.1" or "localhost", "::1"; "0.0.0.0": all IPv4 interfaces, "::":
  /// all
  /// @param port     0: any free port
  /// @throws InputError if it cannot listen
  TcpListener(const std::string& address, uint16_t port);

  uint16_t port() const { return port_; }
  int descriptor() const { return socket_.descriptor(); }
  /// Returns the next connection; a closed socket, with errno set, if there is none within `timeout` s.
  TcpSocket accept(double timeout);

 private:
  TcpSocket socket_;
  uint16_t port_ = 0;
};

}  // namespace hybrid_slam::live
