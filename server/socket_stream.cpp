#include "server/socket_stream.h"

#include <poll.h>
#include <sys/socket.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <cstring>
#include <string_view>

namespace spherematch {

namespace {

constexpr std::chrono::milliseconds slice{100};  // how soon a stop is noticed

}  // namespace

SocketStream::SocketStream(int socket, StreamLimits limits, const std::atomic<bool>& stopping)
    : socket_(socket), limits_(limits), stopping_(stopping), opened_(Clock::now()), buffer_() {}

bool SocketStream::is_readable() const { return begin_ < end_ || wait_for(POLLIN, Clock::now()); }

bool SocketStream::is_writable() const {
  pollfd entry{.fd = socket_, .events = POLLOUT | POLLRDHUP, .revents = 0};
  return ::poll(&entry, 1, 0) > 0 && (entry.revents & (POLLRDHUP | POLLERR | POLLHUP)) == 0;
}

ssize_t SocketStream::read(char* to, size_t size) {
  if (head_left_ == 0) return -1;
  if (begin_ == end_) {
    const auto now = Clock::now();
    if (!wait_for(POLLIN, now + time_left(now - opened_, received_))) return -1;
    const ssize_t received = ::recv(socket_, buffer_.data(), buffer_.size(), 0);
    if (received <= 0) return received;
    received_ += static_cast<std::size_t>(received);
    begin_ = 0;
    end_ = static_cast<std::size_t>(received);
  }
  const std::size_t count = std::min({size, end_ - begin_, head_left_});
  std::memcpy(to, buffer_.data() + begin_, count);
  begin_ += count;
  head_left_ -= count;
  return static_cast<ssize_t>(count);
}

ssize_t SocketStream::write(const char* from, size_t size) {
  constexpr std::string_view start = "HTTP/1.1 ";
  const std::string_view text(from, size);
  // An interim 100 may come before the final status line.
  if (status_ < 200 && text.size() >= start.size() + 3 && text.starts_with(start)) {
    std::from_chars(from + start.size(), from + start.size() + 3, status_);
  }
  std::size_t sent = 0;
  while (sent < size) {
    const auto asked = Clock::now();
    if (!wait_for(POLLOUT, asked + time_left(waited_to_send_, sent_))) return -1;
    waited_to_send_ += Clock::now() - asked;
    const ssize_t count = ::send(socket_, from + sent, size - sent, MSG_NOSIGNAL | MSG_DONTWAIT);
    if (count < 0 && errno != EAGAIN && errno != EINTR) return -1;
    if (count <= 0) continue;
    sent += static_cast<std::size_t>(count);
    sent_ += static_cast<std::size_t>(count);
  }
  return static_cast<ssize_t>(size);
}

SocketStream::Clock::duration SocketStream::time_left(Clock::duration taken, std::size_t bytes) const {
  const auto earned = std::chrono::milliseconds(1000 * bytes / limits_.least_rate);
  return std::min<Clock::duration>(limits_.patience + earned - taken, limits_.idle);
}

void SocketStream::get_remote_ip_and_port(std::string& ip, int& port) const {
  ip.clear();  // no route asks for it
  port = 0;
}

void SocketStream::get_local_ip_and_port(std::string& ip, int& port) const {
  ip.clear();
  port = 0;
}

void SocketStream::drain() {
  ::shutdown(socket_, SHUT_WR);
  const auto deadline = Clock::now() + std::chrono::seconds(5);
  while (wait_for(POLLIN, std::min(deadline, Clock::now() + std::chrono::seconds(1)))) {
    const ssize_t received = ::recv(socket_, buffer_.data(), buffer_.size(), MSG_DONTWAIT);
    if (received <= 0) return;
  }
}

bool SocketStream::wait_for(short events, Clock::time_point deadline) const {
  while (true) {
    const auto left = std::chrono::ceil<std::chrono::milliseconds>(deadline - Clock::now());
    pollfd entry{.fd = socket_, .events = events, .revents = 0};
    const int ready = ::poll(&entry, 1, static_cast<int>(std::clamp(left, std::chrono::milliseconds(0), slice).count()));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) return false;
    if (left <= std::chrono::milliseconds(0) || (stopping_ && events == POLLIN)) return false;
  }
}

}  // namespace spherematch
