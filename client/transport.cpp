// SPDX-License-Identifier: MIT
#include "client/transport.h"

#include <httplib.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <thread>

#include "api/json.h"

namespace spherematch::client {

namespace {

/// Refusals after which the same request may succeed.
bool passes(int status) { return status == 429 || status == 502 || status == 503 || status == 504; }

/// RFC 3986, section 2.3: everything else is escaped.
std::string escaped(std::string_view text) {
  constexpr std::string_view digits = "0123456789ABCDEF";
  std::string result;
  for (const char c : text) {
    const auto byte = static_cast<unsigned char>(c);
    const bool plain =
        (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '-' || c == '.' || c == '_' || c == '~';
    if (plain) {
      result += c;
    } else {
      result.append({'%', digits[byte >> 4], digits[byte & 15]});
    }
  }
  return result;
}

std::string target_of(const Request& request) {
  std::string target = request.path;
  char separator = '?';
  for (const auto& [name, value] : request.query) {
    target.append(1, std::exchange(separator, '&')).append(escaped(name)).append("=").append(escaped(value));
  }
  return target;
}

ProblemError problem_of(int status, const std::string& body) {
  try {
    return {status, api::from_text<api::Problem>(body)};
  } catch (const api::JsonError&) {
    throw FormatError("status " + std::to_string(status) + " without a problem that this client knows: " + body.substr(0, 200));
  }
}

httplib::Request to_library(const Request& request) {
  httplib::Request result;
  result.method = request.method;
  result.path = target_of(request);
  result.body = request.body;
  if (!request.content_type.empty()) result.set_header("Content-Type", request.content_type);
  return result;
}

[[noreturn]] void unreachable(const std::string& url, const Request& request, httplib::Error error) {
  throw TransportError(request.method + " " + url + request.path + ": " + httplib::to_string(error));
}

httplib::Client address(const std::string& url) {
  try {
    httplib::Client client(url);
    if (client.is_valid()) return client;
  } catch (const std::invalid_argument&) {  // a scheme that the library does not know
  }
  throw TransportError("'" + url + "' is not an address that this client can use");
}

httplib::Client connect(const std::string& url, const Settings& settings, std::chrono::milliseconds wait) {
  httplib::Client client = address(url);
  client.set_connection_timeout(settings.connect_timeout);
  client.set_read_timeout(settings.read_timeout + wait);
  client.set_write_timeout(settings.read_timeout);
  if (!settings.api_key.empty()) client.set_bearer_token_auth(settings.api_key);
  return client;
}

}  // namespace

Client::Transport::Transport(std::string url, Settings settings) : url_(std::move(url)), settings_(std::move(settings)) {
  (void)connect(url_, settings_, {});
}

void Client::Transport::pause(int attempt) const { std::this_thread::sleep_for(settings_.first_pause * (1 << std::min(attempt, 10))); }

std::string Client::Transport::send(const Request& request) const {
  for (int attempt = 0;; ++attempt) {
    int retry_after = 0;
    try {
      return send_once(request, retry_after);
    } catch (const ProblemError& error) {
      if (attempt == settings_.retries || !passes(error.status())) throw;
    } catch (const TransportError&) {
      if (attempt == settings_.retries || !request.repeatable) throw;
    }
    if (retry_after > 0) {
      std::this_thread::sleep_for(std::chrono::seconds(std::min(retry_after, 30)));
    } else {
      pause(attempt);
    }
  }
}

std::string Client::Transport::send_once(const Request& request, int& retry_after) const {
  httplib::Client client = connect(url_, settings_, request.wait);
  httplib::Result result = client.send(to_library(request));
  if (!result) unreachable(url_, request, result.error());
  if (result->status < 400) return std::move(result->body);
  const std::string pause = result->get_header_value("Retry-After");
  std::from_chars(pause.data(), pause.data() + pause.size(), retry_after);
  throw problem_of(result->status, result->body);
}

bool Client::Transport::stream(const Request& request, const std::function<bool(std::string_view)>& take) const {
  httplib::Client client = connect(url_, settings_, request.wait);
  int status = 0;
  std::string refusal;
  bool wanted = true;
  httplib::Request with_receiver = to_library(request);
  with_receiver.response_handler = [&status](const httplib::Response& response) {
    status = response.status;
    return true;
  };
  with_receiver.content_receiver = [&](const char* data, std::size_t size, std::uint64_t, std::uint64_t) {
    if (status >= 400) {
      refusal.append(data, size);
    } else {
      wanted = take({data, size});
    }
    return wanted;
  };
  const httplib::Result result = client.send(with_receiver);
  if (!wanted) return false;
  if (!result) unreachable(url_, request, result.error());
  if (status >= 400) throw problem_of(status, refusal);
  return true;
}

}  // namespace spherematch::client
