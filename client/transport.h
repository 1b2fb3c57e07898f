// SPDX-License-Identifier: MIT
// One request at a time with timeouts and retries. Internal to client/.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "client/client.h"

namespace spherematch::client {

struct Request {
  std::string method = "GET";
  std::string path;
  std::vector<std::pair<std::string, std::string>> query;  ///< percent-encoded on sending
  std::string_view body;
  std::string content_type;
  std::chrono::milliseconds wait{};  ///< that the server was asked to wait
  bool repeatable = true;            ///< sending it twice does no harm
};

/// Thread-safe.
class Client::Transport {
 public:
  Transport(std::string url, Settings settings);

  /// The body of the answer. @throws ProblemError, TransportError, FormatError
  [[nodiscard]] std::string send(const Request& request) const;

  /// Hands over the pieces of the answer as they come, until there is no more (true) or `take` returns false. Not repeated.
  /// @throws ProblemError, TransportError, FormatError
  bool stream(const Request& request, const std::function<bool(std::string_view)>& take) const;

  /// Before another try, counted from 0.
  void pause(int attempt) const;
  [[nodiscard]] int retries() const { return settings_.retries; }

 private:
  [[nodiscard]] std::string send_once(const Request& request, int& retry_after) const;

  const std::string url_;
  const Settings settings_;
};

}  // namespace spherematch::client
