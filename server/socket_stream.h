// A connection as the HTTP library reads and writes it, with deadlines that the library lacks.
#pragma once

#include <httplib.h>

#include <array>
#include <atomic>
#include <chrono>
#include <cstddef>
#include <limits>
#include <string>

namespace spherematch {

/// The library bounds each header, but not their number.
inline constexpr std::size_t max_head_bytes = 65536;

/// What a peer may take. Each connection takes a thread, so one that trickles must not keep it for long.
struct StreamLimits {
  std::chrono::milliseconds idle{10'000};      ///< longest pause within a request or a response
  std::chrono::milliseconds patience{20'000};  ///< so long the rate does not matter
  std::size_t least_rate = 32768;              ///< bytes per second that a request, and a response, must make on average beyond that
};

/// Does not own the socket. Used by one thread; `stopping` may be set by another, and then ends every wait for input.
class SocketStream final : public httplib::Stream {
 public:
  SocketStream(int socket, StreamLimits limits, const std::atomic<bool>& stopping);

  [[nodiscard]] bool is_readable() const override;
  [[nodiscard]] bool is_writable() const override;  ///< false also when the peer has closed its end
  ssize_t read(char* to, size_t size) override;
  ssize_t write(const char* from, size_t size) override;
  void get_remote_ip_and_port(std::string& ip, int& port) const override;
  void get_local_ip_and_port(std::string& ip, int& port) const override;
  [[nodiscard]] int socket() const override { return socket_; }

  /// The status of the response that was written, 0 before.
  [[nodiscard]] int written_status() const { return status_; }

  /// From here on reading is not bounded by the limit on the request line and headers.
  void end_of_head() { head_left_ = std::numeric_limits<std::size_t>::max(); }

  /// Tells the peer that nothing more comes, then swallows what it still sends, for some seconds: closing a socket with unread
  /// input would reset the connection and could take the response with it.
  void drain();

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] bool wait_for(short events, Clock::time_point deadline) const;
  /// How long the peer may take for the next of so many bytes, when it took `taken` for those before.
  [[nodiscard]] Clock::duration time_left(Clock::duration taken, std::size_t bytes) const;

  const int socket_;
  const StreamLimits limits_;
  const std::atomic<bool>& stopping_;
  const Clock::time_point opened_;
  std::size_t received_ = 0;
  std::size_t sent_ = 0;
  Clock::duration waited_to_send_{};  ///< the time in which the response waited for the peer, not for its own making
  std::array<char, 16384> buffer_;    ///< the library asks for headers byte by byte
  std::size_t head_left_ = max_head_bytes;
  std::size_t begin_ = 0;
  std::size_t end_ = 0;
  int status_ = 0;
};

}  // namespace spherematch
