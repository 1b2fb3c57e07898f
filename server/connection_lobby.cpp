#include "server/connection_lobby.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <optional>
#include <string_view>
#include <system_error>
#include <utility>

namespace spherematch {

namespace {

void close_socket(int socket) {
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
}

}  // namespace

ConnectionLobby::ConnectionLobby(const LobbyLimits& limits, Arrived arrived)
    : limits_(limits), arrived_(std::move(arrived)), scratch_(limits.head_bytes) {
  epoll_ = ::epoll_create1(EPOLL_CLOEXEC);
  wake_ = ::eventfd(0, EFD_CLOEXEC);
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.fd = wake_;
  if (epoll_ < 0 || wake_ < 0 || ::epoll_ctl(epoll_, EPOLL_CTL_ADD, wake_, &event) != 0) {
    throw std::system_error(errno, std::generic_category(), "epoll");
  }
  thread_ = std::jthread([this] { watch(); });
}

ConnectionLobby::~ConnectionLobby() {
  {
    const std::lock_guard lock(mutex_);
    stopping_ = true;
  }
  (void)::eventfd_write(wake_, 1);
  thread_.join();
  for (const Guest& guest : guests_) close_socket(guest.socket);
  ::close(wake_);
  ::close(epoll_);
}

void ConnectionLobby::admit(int socket) {
  std::optional<int> displaced;
  bool only_one = false;
  {
    const std::lock_guard lock(mutex_);
    // Who means it sends a request at once, so the one that has waited longest is the least loss.
    if (guests_.size() >= limits_.sockets) displaced = let_go(guests_.begin());
    guests_.push_back({socket, Clock::now() + limits_.patience});
    by_socket_[socket] = std::prev(guests_.end());
    only_one = guests_.size() == 1;
    // Edge-triggered: what has been looked at stays in the socket, and only more of it is news.
    epoll_event event{};
    event.events = EPOLLIN | EPOLLRDHUP | EPOLLET;
    event.data.fd = socket;
    if (::epoll_ctl(epoll_, EPOLL_CTL_ADD, socket, &event) != 0) displaced = let_go(std::prev(guests_.end()));
  }
  if (displaced) close_socket(*displaced);
  if (only_one) (void)::eventfd_write(wake_, 1);  // the thread waits without a deadline
}

void ConnectionLobby::watch() {
  std::array<epoll_event, 64> events{};
  while (true) {
    const int count = ::epoll_wait(epoll_, events.data(), static_cast<int>(events.size()), milliseconds_to_next_deadline());
    for (int i = 0; i < count; ++i) {
      const int socket = events[static_cast<std::size_t>(i)].data.fd;
      if (socket != wake_) {
        look_at(socket, (events[static_cast<std::size_t>(i)].events & (EPOLLRDHUP | EPOLLHUP | EPOLLERR)) != 0);
        continue;
      }
      eventfd_t ignored = 0;
      (void)::eventfd_read(wake_, &ignored);
      const std::lock_guard lock(mutex_);
      if (stopping_) return;
    }
    turn_out_the_late();
  }
}

int ConnectionLobby::milliseconds_to_next_deadline() {
  const std::lock_guard lock(mutex_);
  if (guests_.empty()) return -1;
  const auto left = std::chrono::ceil<std::chrono::milliseconds>(guests_.front().deadline - Clock::now());
  return static_cast<int>(std::max<std::chrono::milliseconds::rep>(left.count(), 0));
}

void ConnectionLobby::look_at(int socket, bool ended) {
  {
    const std::lock_guard lock(mutex_);
    const auto found = by_socket_.find(socket);
    if (found == by_socket_.end() || !(has_head(*found->second) || ended)) return;
    let_go(found->second);
  }
  arrived_(socket, Arrival::complete);
}

void ConnectionLobby::turn_out_the_late() {
  std::vector<Guest> late;
  {
    const std::lock_guard lock(mutex_);
    const auto now = Clock::now();
    while (!guests_.empty() && guests_.front().deadline <= now) {
      late.push_back(guests_.front());
      let_go(guests_.begin());
    }
  }
  for (const Guest& guest : late) {
    if (guest.has_spoken) {
      arrived_(guest.socket, Arrival::late);
    } else {
      close_socket(guest.socket);
    }
  }
}

bool ConnectionLobby::has_head(Guest& guest) {
  const ssize_t count = ::recv(guest.socket, scratch_.data(), scratch_.size(), MSG_PEEK | MSG_DONTWAIT);
  if (count < 0) return errno != EAGAIN && errno != EINTR;
  guest.has_spoken = true;
  const std::string_view head(scratch_.data(), static_cast<std::size_t>(count));
  return head.empty() || head.size() == scratch_.size() || head.find("\r\n\r\n") != std::string_view::npos;
}

int ConnectionLobby::let_go(Guests::iterator guest) {
  const int socket = guest->socket;
  ::epoll_ctl(epoll_, EPOLL_CTL_DEL, socket, nullptr);
  by_socket_.erase(socket);
  guests_.erase(guest);
  return socket;
}

}  // namespace spherematch
