#include "server/socket_stream.h"

#include <gtest/gtest.h>
#include <sys/socket.h>
#include <unistd.h>

#include <array>
#include <string>
#include <thread>

namespace spherematch {
namespace {

using namespace std::chrono_literals;
using Clock = std::chrono::steady_clock;

class SocketStreamTest : public ::testing::Test {
 protected:
  SocketStreamTest() {
    EXPECT_EQ(::socketpair(AF_UNIX, SOCK_STREAM, 0, ends.data()), 0);
    const int small = 4096;
    for (const int end : ends) ::setsockopt(end, SOL_SOCKET, SO_SNDBUF, &small, sizeof small);
  }
  ~SocketStreamTest() override {
    for (const int end : ends) ::close(end);
  }

  std::array<int, 2> ends{};
  std::atomic<bool> stopping = false;
};

TEST_F(SocketStreamTest, ASilentPeerIsGivenUp) {
  SocketStream stream(ends[0], {.idle = 50ms}, stopping);
  char byte = 0;
  EXPECT_EQ(stream.read(&byte, 1), -1);
}

TEST_F(SocketStreamTest, AStopEndsTheWaiting) {
  SocketStream stream(ends[0], {}, stopping);
  std::jthread stopper([this] {
    std::this_thread::sleep_for(50ms);
    stopping = true;
  });
  const auto start = Clock::now();
  char byte = 0;
  EXPECT_EQ(stream.read(&byte, 1), -1);
  EXPECT_LT(Clock::now() - start, 5s);
}

TEST_F(SocketStreamTest, ATricklingPeerIsGivenUpThoughItNeverPausesLong) {
  SocketStream stream(ends[0], {.idle = 10s, .patience = 200ms, .least_rate = 1000}, stopping);
  std::jthread peer([this](const std::stop_token& stop) {
    while (!stop.stop_requested()) {
      (void)!::send(ends[1], "x", 1, MSG_NOSIGNAL);
      std::this_thread::sleep_for(10ms);
    }
  });
  const auto start = Clock::now();
  char byte = 0;
  int count = 0;
  while (stream.read(&byte, 1) == 1) ++count;
  EXPECT_GT(count, 5);
  EXPECT_GE(Clock::now() - start, 200ms);
  EXPECT_LT(Clock::now() - start, 5s);
}

TEST_F(SocketStreamTest, WhoKeepsTheRateMayTakeLongerThanThePatience) {
  SocketStream stream(ends[0], {.idle = 10s, .patience = 100ms, .least_rate = 1000}, stopping);
  std::jthread peer([this] {
    for (int i = 0; i < 20; ++i) {
      const std::string piece(100, 'x');
      (void)!::send(ends[1], piece.data(), piece.size(), MSG_NOSIGNAL);
      std::this_thread::sleep_for(20ms);
    }
    ::shutdown(ends[1], SHUT_WR);
  });
  char byte = 0;
  int count = 0;
  ssize_t last = 0;
  while ((last = stream.read(&byte, 1)) == 1) ++count;
  EXPECT_EQ(last, 0);  // the end rather than a lost patience
  EXPECT_EQ(count, 2000);
}

TEST_F(SocketStreamTest, APeerThatDoesNotReadIsGivenUp) {
  const std::string response(10'000'000, 'x');
  SocketStream idle(ends[0], {.idle = 50ms}, stopping);
  EXPECT_EQ(idle.write(response.data(), response.size()), -1);

  SocketStream trickling(ends[0], {.idle = 10s, .patience = 200ms, .least_rate = 1'000'000}, stopping);
  std::jthread peer([this](const std::stop_token& stop) {
    std::array<char, 100> buffer{};
    while (!stop.stop_requested()) {
      (void)::recv(ends[1], buffer.data(), buffer.size(), MSG_DONTWAIT);
      std::this_thread::sleep_for(10ms);
    }
  });
  const auto start = Clock::now();
  EXPECT_EQ(trickling.write(response.data(), response.size()), -1);
  EXPECT_LT(Clock::now() - start, 5s);
}

TEST_F(SocketStreamTest, RemembersTheFinalStatus) {
  SocketStream stream(ends[0], {}, stopping);
  EXPECT_EQ(stream.written_status(), 0);
  for (const std::string text : {"HTTP/1.1 100 Continue\r\n\r\n", "HTTP/1.1 404 Not Found\r\n", "HTTP/1.1 200 in a body"}) {
    EXPECT_EQ(stream.write(text.data(), text.size()), static_cast<ssize_t>(text.size()));
  }
  EXPECT_EQ(stream.written_status(), 404);
}

}  // namespace
}  // namespace spherematch
