// The HTTP library behind the routes, with guards against what its version 0.11.4 lacks: see http_server.cpp.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <string_view>

#include "server/byte_budget.h"
#include "server/connection_lobby.h"
#include "server/gate.h"
#include "server/router.h"

namespace spherematch {

/// A request that was answered, or a connection that was turned away.
struct FinishedRequest {
  std::string_view method;  ///< "-" where it is not known
  std::string_view route;   ///< the pattern; "-" where none fits
  int status = 0;
  double seconds = 0;
};

struct HttpServerSettings {
  std::size_t max_body_bytes = std::size_t{64} << 20;
  std::size_t threads = 32;                            ///< connections served at once
  std::size_t max_connections = 256;                   ///< connections whose request waits for a thread; further ones get 503
  std::size_t receiving_uploads = 24;                  ///< bodies on their way at once; further ones get 503
  std::size_t upload_memory = std::size_t{256} << 20;  ///< bytes of all bodies together; who would pass it gets 503
  LobbyLimits lobby{};
  /// The name of who sends a request, by its headers Authorization and X-API-Key; for the log. Empty for nobody in particular.
  std::function<std::string(std::string_view authorization, std::string_view api_key)> caller{};
  /// Called from any thread; must not wait.
  std::function<void(const FinishedRequest&)> on_request{};
};

class HttpServer {
 public:
  /// Router and gate must outlive this.
  /// `uploads` bounds the requests with a body that are worked on, once the body is there.
  HttpServer(const Router& router, Gate& uploads, const HttpServerSettings& settings);
  ~HttpServer();
  HttpServer(const HttpServer&) = delete;
  HttpServer& operator=(const HttpServer&) = delete;

  /// Port 0 takes a free one. Returns the port. @throws std::runtime_error
  int bind(const std::string& host, int port);

  /// Serves until stop(); returns when every connection has ended.
  void run();

  /// From any thread: no new connections, no waiting for input. Requests whose handlers run are still answered.
  void stop();

 private:
  class Library;
  std::unique_ptr<Library> library_;
};

}  // namespace spherematch
