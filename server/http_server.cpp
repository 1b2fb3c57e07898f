// Guards around cpp-httplib 0.11.4, whose limits are fixed when its library is compiled:
// - one request per connection: it would parse an unread body as the next request;
// - bodies only by content readers, of declared length, unencoded (server/body_reader.h): it limits form bodies to 8 KiB, and
//   neither counts chunks nor what it decompresses;
// - routing before its own, which answers 404 to a wrong method and matches paths with recursive regular expressions;
// - Range is ignored: it would send 206 and a part under a tag of the whole;
// - connections wait for their heads without a thread (server/connection_lobby.h), and then in a bounded queue for a thread;
// - a longer listen backlog, no shared listening port;
// - a stop that comes before the library runs is not lost;
// - least rates of requests and responses, a limit on all headers together, and input drained before a refused connection closes
// (server/socket_stream.h).
#include "server/http_server.h"

#include <fmt/format.h>
#include <httplib.h>
#include <sys/socket.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <mutex>
#include <optional>
#include <random>
#include <stdexcept>
#include <thread>

#include "api/json.h"
#include "server/body_reader.h"
#include "server/event_log.h"
#include "server/problem.h"
#include "server/socket_stream.h"
#include "server/task_queue.h"

namespace spherematch {

namespace {

constexpr int listen_backlog = 511;
constexpr const char* id_header = "X-Request-Id";

std::string random_id() {
  std::random_device device;
  std::string id;
  for (int i = 0; i < 4; ++i) id += fmt::format("{:08x}", device());
  return id;
}

/// Runs what the library would give to its threads on the spot: it is only a walk to the lobby.
class Immediately final : public httplib::TaskQueue {
 public:
  void enqueue(std::function<void()> task) override { task(); }
  void shutdown() override {}
};

/// A client's request id is taken over when it is fit to be written into headers and logs.
std::string request_id_of(const httplib::Request& request) {
  const std::string given = request.get_header_value(id_header);
  const bool sound = !given.empty() && given.size() <= 128 && std::all_of(given.begin(), given.end(), [](unsigned char c) {
    return std::isalnum(c) != 0 || c == '-' || c == '_' || c == '.' || c == ':';
  });
  return sound ? given : random_id();
}

api::Code code_of_status(int status) {
  switch (status) {
    case 404:
      return api::Code::not_found;
    case 413:
      return api::Code::payload_too_large;
    case 414:
      return api::Code::uri_too_long;
    default:
      return status < 500 ? api::Code::bad_request : api::Code::internal;
  }
}

HttpRequest request_of(const httplib::Request& from) {
  HttpRequest request;
  request.method = from.method;
  request.path = from.path;
  request.query = from.params;
  request.request_id = from.get_header_value(id_header);
  for (const auto& [name, value] : from.headers) {
    std::string lower = name;
    std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    request.headers.emplace(std::move(lower), value);
  }
  return request;
}

void stream_to(httplib::Response& to, const std::string& content_type, BodyStream stream) {
  to.set_chunked_content_provider(content_type, [stream = std::move(stream)](std::size_t, httplib::DataSink& sink) {
    const std::optional<std::string> piece = stream();
    if (!piece) {
      sink.done();
    } else if (!piece->empty()) {
      return sink.write(piece->data(), piece->size());
    }
    return sink.is_writable();
  });
}

void write_to(httplib::Response& to, HttpResponse from) {
  to.status = from.status;
  for (auto& [name, value] : from.headers) to.set_header(name, value);
  if (from.stream) {
    stream_to(to, from.content_type, std::move(from.stream));
    return;
  }
  const bool encoded = to.has_header("Content-Encoding") && !from.body.empty();
  if (encoded) {
    // The library compresses a plain body, also one that is compressed already.
    const std::size_t size = from.body.size();
    to.set_content_provider(size, from.content_type,
                            [body = std::move(from.body)](std::size_t offset, std::size_t length, httplib::DataSink& sink) {
                              return sink.write(body.data() + offset, length);
                            });
    return;
  }
  if (!from.content_type.empty()) to.set_header("Content-Type", from.content_type);
  to.body = std::move(from.body);
}

}  // namespace

class HttpServer::Library final : public httplib::Server {
 public:
  Library(const Router& router, Gate& uploads, const HttpServerSettings& settings);

  int bind(const std::string& host, int port);
  void run();
  void stop_all();

 private:
  /// What the log says of a request.
  struct Exchange {
    std::string method = "-";
    std::string path;
    std::string request_id = "-";
    std::string caller;
    bool has_body = false;
  };

  bool process_and_close_socket(socket_t socket) override;
  void take_in(int socket, ConnectionLobby::Arrival arrival);
  void serve(int socket);
  void turn_away(int socket, const ProblemError& reason) const;
  void prepare(httplib::Request& request, Exchange& exchange) const;
  void log(const Exchange& exchange, int status, double milliseconds) const;
  void install_handlers();
  HandlerResponse route(const httplib::Request& request, httplib::Response& response);
  [[nodiscard]] std::size_t max_bytes(Body kind) const;

  const Router& router_;
  const HttpServerSettings settings_;
  Gate receiving_;
  ByteBudget upload_memory_;
  const BodyBounds bounds_;
  std::mutex run_mutex_;
  bool entered_ = false;  ///< run() has decided to serve
  std::atomic<bool> finished_ = false;
  std::atomic<bool> stopping_ = false;
  std::optional<BoundedTaskQueue> threads_;  ///< while it runs
  std::optional<ConnectionLobby> lobby_;     ///< while it runs
};

HttpServer::Library::Library(const Router& router, Gate& uploads, const HttpServerSettings& settings)
    : router_(router),
      settings_(settings),
      receiving_("request bodies", settings.receiving_uploads, 0),
      upload_memory_(settings.upload_memory),
      bounds_{receiving_, upload_memory_, uploads} {
  new_task_queue = [] { return new Immediately; };
  set_tcp_nodelay(true);
  set_socket_options([](socket_t socket) {
    // The library's own choice, SO_REUSEPORT, would let two servers share a port unnoticed.
    const int yes = 1;
    ::setsockopt(socket, SOL_SOCKET, SO_REUSEADDR, &yes, sizeof yes);
  });
  install_handlers();
}

void HttpServer::Library::install_handlers() {
  set_pre_routing_handler([this](const httplib::Request& request, httplib::Response& response) { return route(request, response); });
  // Only requests whose route takes a body come here, see route(), and their paths are short enough for this expression.
  const HandlerWithContentReader with_body = [this](const httplib::Request& from, httplib::Response& to,
                                                    const httplib::ContentReader& reader) {
    HttpRequest request = request_of(from);
    write_to(to, router_.handle(request, [&](HttpRequest& r, Body kind) { r.body = read_body(from, reader, kind, bounds_); }));
  };
  Post("[^]*", with_body);
  Patch("[^]*", with_body);
  set_expect_100_continue_handler([this](const httplib::Request& request, httplib::Response& response) {
    const Body kind = router_.body_of(request.method, request.path);
    if (kind == Body::none) return 100;
    if (auto refused = router_.refusal(request_of(request))) {
      write_to(response, *std::move(refused));
      return response.status;
    }
    const auto refusal = refuse_body(request, kind, max_bytes(kind));
    if (!refusal) return 100;
    write_to(response, problem_response(*refusal, request.get_header_value(id_header)));
    return response.status;
  });
  // What the library answers by itself, before any handler saw the request.
  set_error_handler(HandlerWithResponse([](const httplib::Request& request, httplib::Response& response) {
    if (!response.body.empty()) return HandlerResponse::Unhandled;
    const api::Code code = code_of_status(response.status);
    const std::string id = request_id_of(request);
    write_to(response, problem_response({code, "the server could not read the request"}, id));
    response.set_header(id_header, id);
    return HandlerResponse::Handled;
  }));
  set_post_routing_handler([](const httplib::Request& request, httplib::Response& response) {
    response.headers.erase("Accept-Ranges");
    if (!response.has_header(id_header)) response.set_header(id_header, request.get_header_value(id_header));
    response.set_header("X-Content-Type-Options", "nosniff");
  });
}

std::size_t HttpServer::Library::max_bytes(Body kind) const { return kind == Body::json ? max_json_bytes : settings_.max_body_bytes; }

httplib::Server::HandlerResponse HttpServer::Library::route(const httplib::Request& from, httplib::Response& to) {
  if (const Body kind = router_.body_of(from.method, from.path); kind != Body::none) {
    if (auto refused = router_.refusal(request_of(from))) {
      write_to(to, *std::move(refused));
      return HandlerResponse::Handled;
    }
    const auto refusal = refuse_body(from, kind, max_bytes(kind));
    if (!refusal) return HandlerResponse::Unhandled;  // goes on to the content reader
    write_to(to, problem_response(*refusal, from.get_header_value(id_header)));
  } else {
    HttpRequest request = request_of(from);
    write_to(to, router_.handle(request, [](HttpRequest&, Body) {}));
  }
  return HandlerResponse::Handled;
}

int HttpServer::Library::bind(const std::string& host, int port) {
  errno = 0;  // a name that does not resolve need not set it
  const int bound = port == 0 ? bind_to_any_port(host) : bind_to_port(host, port) ? port : -1;
  // The library listens with a backlog of 5; listening again changes it.
  if (bound < 0 || ::listen(svr_sock_, listen_backlog) != 0) {
    const std::string reason = errno == EADDRINUSE ? ": the port is in use, --port takes another" : "";
    throw std::runtime_error("cannot listen on " + host + ":" + std::to_string(port) + reason);
  }
  return bound;
}

void HttpServer::Library::run() {
  {
    const std::lock_guard lock(run_mutex_);
    if (stopping_) return;
    entered_ = true;
  }
  threads_.emplace(settings_.threads, settings_.max_connections);
  lobby_.emplace(settings_.lobby, [this](int socket, ConnectionLobby::Arrival arrival) { take_in(socket, arrival); });
  listen_after_bind();
  lobby_.reset();
  threads_.reset();
  finished_ = true;
}

void HttpServer::Library::stop_all() {
  {
    const std::lock_guard lock(run_mutex_);
    stopping_ = true;
    if (!entered_) return;
  }
  // The library's stop() does nothing on a server that is just about to run, which would then never end.
  while (!is_running() && !finished_) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  stop();
}

/// On the accepting thread.
bool HttpServer::Library::process_and_close_socket(socket_t socket) {
  lobby_->admit(socket);
  return true;
}

/// On the lobby's thread.
void HttpServer::Library::take_in(int socket, ConnectionLobby::Arrival arrival) {
  if (arrival == ConnectionLobby::Arrival::late) {
    turn_away(socket, {api::Code::bad_request, "the request's head did not arrive in time"});
  } else if (!threads_->enqueue([this, socket] { serve(socket); })) {
    turn_away(socket, {api::Code::overloaded, "too many connections at once; try again"});
  }
}

void HttpServer::Library::serve(int socket) {
  const auto started = std::chrono::steady_clock::now();
  SocketStream stream(socket, {}, stopping_);
  Exchange exchange;
  bool closed = false;
  process_request(stream, /*close_connection=*/true, closed, [&](httplib::Request& request) {
    stream.end_of_head();
    prepare(request, exchange);
  });
  if (stream.written_status() != 0) {  // else the peer went away without a request
    const auto took = std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - started);
    log(exchange, stream.written_status(), took.count());
    if (exchange.has_body && stream.written_status() >= 400) stream.drain();
  }
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
}

void HttpServer::Library::prepare(httplib::Request& request, Exchange& exchange) const {
  request.ranges.clear();
  exchange.request_id = request_id_of(request);
  request.headers.erase(id_header);
  request.set_header(id_header, exchange.request_id);
  exchange.method = request.method;
  exchange.path = request.path;
  if (settings_.caller) {
    exchange.caller = settings_.caller(request.get_header_value("Authorization"), request.get_header_value("X-API-Key"));
  }
  exchange.has_body = request.has_header("Content-Length") || request.has_header("Transfer-Encoding");
}

/// On the lobby's thread, so it must not wait for the peer: the request is not read.
void HttpServer::Library::turn_away(int socket, const ProblemError& reason) const {
  const std::string id = random_id();
  const HttpResponse problem = problem_response(reason, id);
  const api::ErrorEntry& entry = api::entry_of(reason.problem().code);
  std::string text = fmt::format("HTTP/1.1 {} {}\r\nConnection: close\r\n{}: {}\r\nContent-Type: {}\r\nContent-Length: {}", entry.status,
                                 entry.title, id_header, id, problem.content_type, problem.body.size());
  for (const auto& [name, value] : problem.headers) text.append("\r\n").append(name).append(": ").append(value);
  text.append("\r\n\r\n").append(problem.body);
  ::send(socket, text.data(), text.size(), MSG_NOSIGNAL | MSG_DONTWAIT);
  // Taking what has arrived makes a reset, which could overtake the response, unlikely.
  std::array<char, 8192> scrap{};
  ::recv(socket, scrap.data(), scrap.size(), MSG_DONTWAIT);
  ::shutdown(socket, SHUT_RDWR);
  ::close(socket);
  log_warning("connection_turned_away", {{"code", entry.wire}, {"id", id}});
  if (settings_.on_request) settings_.on_request({.method = "-", .route = "-", .status = entry.status, .seconds = 0});
}

void HttpServer::Library::log(const Exchange& exchange, int status, double milliseconds) const {
  std::vector<LogField> fields{{"method", exchange.method},
                               {"route", router_.pattern_of(exchange.path)},
                               {"status", status},
                               {"ms", milliseconds},
                               {"id", exchange.request_id}};
  if (!exchange.caller.empty()) fields.emplace_back("key", exchange.caller);
  log_info("request", fields);
  if (settings_.on_request) {
    settings_.on_request(
        {.method = exchange.method, .route = router_.pattern_of(exchange.path), .status = status, .seconds = milliseconds / 1000});
  }
}

HttpServer::HttpServer(const Router& router, Gate& uploads, const HttpServerSettings& settings)
    : library_(std::make_unique<Library>(router, uploads, settings)) {}

HttpServer::~HttpServer() = default;

int HttpServer::bind(const std::string& host, int port) { return library_->bind(host, port); }

void HttpServer::run() { library_->run(); }

void HttpServer::stop() { library_->stop_all(); }

}  // namespace spherematch
