/// @file TcpSocket.h
/// @brief TCP connections that can neither block for ever nor end the program.
///
/// MRPT's sockets would not do. CServerTCPSocket does not tell the port that the system chose, which tests
/// need. CClientTCPSocket::writeAsync goes round for ever once the peer is gone (it takes a failed send for
/// no progress), after a SIGPIPE that ends the program.
#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace hybrid_slam::live {

/// HOST:PORT, an IPv6 address in brackets.
std::string addressText(const std::string& host, uint16_t port);

/// One end of a connection; closed with the object.
class TcpSocket {
 public:
  TcpSocket() = default;
  explicit TcpSocket(int descriptor) : descriptor_(descriptor) {}
  ~TcpSocket() { close(); }
  TcpSocket(TcpSocket&& other) noexcept : descriptor_(other.release()) {}
  TcpSocket& operator=(TcpSocket&& other) noexcept;

  /// Tries the host's addresses, IPv6 ones among them, one after the other.
  /// @param timeout    s, in which each address that is left has an equal share
  /// @param isStopped  asked every 0.1 s
  /// @return a closed socket if it was to stop
  /// @throws std::runtime_error with the reason if nobody answers
  static TcpSocket connectTo(
      const std::string& host, uint16_t port, double timeout,
      const std::function<bool()>& isStopped = [] { return false; });

  bool isOpen() const { return descriptor_ >= 0; }
  int descriptor() const { return descriptor_; }
  void close();

  /// What has come, at most 64 KiB, waiting at most `timeout` s for the first byte; empty if nothing came.
  /// @throws std::runtime_error if the peer has closed the connection, or it broke
  std::string receive(double timeout);
  /// Sends without waiting. @return how many bytes were taken, 0 if there is no room
  /// @throws std::runtime_error if the connection is gone
  size_t sendSome(const char* bytes, size_t count);
  /// Sends all. @throws std::runtime_error if that takes longer than `timeout` s, or the connection is gone
  void send(const std::string& bytes, double timeout);

 private:
  int release();
  int descriptor_ = -1;
};

/// Waits for connections.
class TcpListener {
 public:
  /// @param address  of this machine, "127.0.0.1", "::1"; "0.0.0.0" for all of IPv4, "::" for all
  /// @param port     0: one that is free
  /// @throws InputError if it cannot listen there
  TcpListener(const std::string& address, uint16_t port);

  uint16_t port() const { return port_; }
  int descriptor() const { return socket_.descriptor(); }
  /// The next connection; a closed socket if there is none within `timeout` s. errno says why.
  TcpSocket accept(double timeout);

 private:
  TcpSocket socket_;
  uint16_t port_ = 0;
};

}  // namespace hybrid_slam::live
