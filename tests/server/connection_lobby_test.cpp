#include "server/connection_lobby.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <condition_variable>
#include <string>

namespace spherematch {
namespace {

using namespace std::chrono_literals;
using Arrival = ConnectionLobby::Arrival;

/// A lobby and what came out of it.
class ConnectionLobbyTest : public ::testing::Test {
 protected:
  ~ConnectionLobbyTest() override {
    lobby.reset();
    for (const int end : peers) ::close(end);
    for (const auto& [socket, arrival] : arrived) ::close(socket);
  }

  void open(LobbyLimits limits = {}) {
    lobby = std::make_unique<ConnectionLobby>(limits, [this](int socket, Arrival arrival) {
      {
        const std::lock_guard lock(mutex);
        arrived.emplace_back(socket, arrival);
      }
      changed.notify_all();
    });
  }
  /// Admits one end of a new connection; returns the other.
  int guest() {
    std::array<int, 2> ends{};
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    peers.push_back(ends[1]);
    lobby->admit(ends[0]);
    return ends[1];
  }
  static void say(int peer, const std::string& text) {
    EXPECT_EQ(::send(peer, text.data(), text.size(), MSG_NOSIGNAL), static_cast<ssize_t>(text.size()));
  }
  bool arrivals_become(std::size_t count, std::chrono::milliseconds within = 10s) {
    std::unique_lock lock(mutex);
    return changed.wait_for(lock, within, [&] { return arrived.size() == count; });
  }
  /// Waits for the other side to close without a word.
  static bool is_closed(int peer) {
    char byte = 0;
    return ::recv(peer, &byte, 1, 0) == 0;
  }

  std::mutex mutex;
  std::condition_variable changed;
  std::vector<std::pair<int, Arrival>> arrived;
  std::vector<int> peers;
  std::unique_ptr<ConnectionLobby> lobby;
};

TEST_F(ConnectionLobbyTest, WaitsForTheWholeHeadAndLeavesItInTheSocket) {
  open();
  const int peer = guest();
  say(peer, "GET / HTTP/1.1\r\nA: b\r");
  EXPECT_FALSE(arrivals_become(1, 100ms));
  say(peer, "\n\r\nbody");
  ASSERT_TRUE(arrivals_become(1));
  EXPECT_EQ(arrived[0].second, Arrival::complete);
  std::array<char, 100> buffer{};
  const ssize_t size = ::recv(arrived[0].first, buffer.data(), buffer.size(), 0);
  EXPECT_EQ(std::string(buffer.data(), static_cast<std::size_t>(size)), "GET / HTTP/1.1\r\nA: b\r\n\r\nbody");
}

TEST_F(ConnectionLobbyTest, ManySilentGuestsKeepNobodyFromArriving) {
  open();
  for (int i = 0; i < 300; ++i) guest();
  for (int i = 0; i < 50; ++i) say(guest(), "GET / HTTP/1.1\r\n\r\n");
  EXPECT_TRUE(arrivals_become(50));
}

TEST_F(ConnectionLobbyTest, EndlessHeadsAndEndedOnesArrive) {
  open({.head_bytes = 1000});
  say(guest(), std::string(1000, 'x'));
  EXPECT_TRUE(arrivals_become(1));
  const int half = guest();
  say(half, "GET / HTT");
  ::shutdown(half, SHUT_WR);
  EXPECT_TRUE(arrivals_become(2));
  ::shutdown(guest(), SHUT_WR);
  EXPECT_TRUE(arrivals_become(3));
  for (const auto& [socket, arrival] : arrived) EXPECT_EQ(arrival, Arrival::complete);
}

TEST_F(ConnectionLobbyTest, TheLateAreTurnedOut) {
  open({.patience = 100ms});
  const int silent = guest();
  const int slow = guest();
  say(slow, "GET / HTT");
  ASSERT_TRUE(arrivals_become(1));
  EXPECT_EQ(arrived[0].second, Arrival::late);
  EXPECT_TRUE(is_closed(silent));
}

TEST_F(ConnectionLobbyTest, TrickledBytesBuyNoTime) {
  open({.patience = 200ms});
  const int peer = guest();
  const auto start = std::chrono::steady_clock::now();
  while (!arrivals_become(1, 10ms)) say(peer, "x");
  EXPECT_EQ(arrived[0].second, Arrival::late);
  EXPECT_LT(std::chrono::steady_clock::now() - start, 10s);
}

TEST_F(ConnectionLobbyTest, InAFullLobbyTheOldestGivesWay) {
  open({.sockets = 3});
  const int oldest = guest();
  guest();
  const int third = guest();
  const int fourth = guest();
  EXPECT_TRUE(is_closed(oldest));
  say(third, "\r\n\r\n");
  say(fourth, "\r\n\r\n");
  EXPECT_TRUE(arrivals_become(2));
}

TEST_F(ConnectionLobbyTest, ItsEndClosesWhoWaits) {
  open();
  const int peer = guest();
  lobby.reset();
  EXPECT_TRUE(is_closed(peer));
}

}  // namespace
}  // namespace spherematch
