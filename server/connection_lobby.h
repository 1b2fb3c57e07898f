// Where connections wait until the head of their request is there, so that a silent or slow client takes no thread.
#pragma once

#include <chrono>
#include <cstddef>
#include <functional>
#include <list>
#include <mutex>
#include <thread>
#include <unordered_map>
#include <vector>

namespace spherematch {

struct LobbyLimits {
  std::size_t sockets = 512;                   ///< who waits longest is closed when one more comes
  std::size_t head_bytes = 65536;              ///< a longer head is not waited for to the end
  std::chrono::milliseconds patience{10'000};  ///< from the connection to the end of the head
};

/// Thread-safe. Owns the sockets it holds.
class ConnectionLobby {
 public:
  enum class Arrival {
    complete,  ///< the head is there, is too long, or ends early: somebody should read it
    late,      ///< a part of it came, but not the end in time
  };
  /// Gets the socket. Called on the lobby's thread, so it must not wait. A connection that stays silent is closed without a call.
  using Arrived = std::function<void(int socket, Arrival arrival)>;

  ConnectionLobby(const LobbyLimits& limits, Arrived arrived);
  ~ConnectionLobby();  ///< closes who still waits
  ConnectionLobby(const ConnectionLobby&) = delete;
  ConnectionLobby& operator=(const ConnectionLobby&) = delete;

  void admit(int socket);

 private:
  using Clock = std::chrono::steady_clock;
  struct Guest {
    int socket = -1;
    Clock::time_point deadline;
    bool has_spoken = false;
  };
  using Guests = std::list<Guest>;  ///< in the order of arrival, and so of their deadlines

  void watch();
  void look_at(int socket, bool ended);
  [[nodiscard]] int milliseconds_to_next_deadline();
  void turn_out_the_late();
  /// Whether somebody should read what has arrived.
  [[nodiscard]] bool has_head(Guest& guest);
  /// The guest's socket leaves the lobby. Under the lock.
  int let_go(Guests::iterator guest);

  const LobbyLimits limits_;
  const Arrived arrived_;
  std::vector<char> scratch_;  ///< of the lobby's thread
  int epoll_ = -1;
  int wake_ = -1;  ///< an eventfd that ends the thread's waiting
  std::mutex mutex_;
  Guests guests_;
  std::unordered_map<int, Guests::iterator> by_socket_;
  bool stopping_ = false;
  std::jthread thread_;  ///< last: it uses everything above
};

}  // namespace spherematch
