// The guards of server/http_server.cpp, body_reader.cpp and socket_stream.cpp, over real sockets.
#include "server/http_server.h"

#include <arpa/inet.h>
#include <gtest/gtest.h>
#include <httplib.h>
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <latch>
#include <mutex>
#include <stdexcept>
#include <string>
#include <thread>

#include "api/json.h"
#include "server/body_reader.h"
#include "server/problem.h"

namespace spherematch {
namespace {

constexpr std::size_t max_body = 1 << 20;

class HttpServerTest : public ::testing::Test {
 protected:
  HttpServerTest() {
    router.add("GET", "/hello", [](HttpRequest&) { return HttpResponse{200, "text/plain", "hello", {}}; });
    router.add("GET", "/echo", [](HttpRequest& request) {
      std::string text;
      for (const auto& [name, value] : request.query) text += name + "=" + value + ";";
      return HttpResponse{200, "text/plain", text, {{"X-Seen-Id", request.request_id}}};
    });
    router.add("GET", "/block", [this](HttpRequest&) {
      ++blocked;
      release.wait();
      return HttpResponse{200, "text/plain", "done", {}};
    });
    router.add("DELETE", "/things/{id}", [](HttpRequest&) { return HttpResponse{204, {}, {}, {}}; });
    const auto size = [](HttpRequest& request) { return HttpResponse{200, "text/plain", std::to_string(request.body.bytes.size()), {}}; };
    router.add("POST", "/json", size, Body::json);
    router.add("PATCH", "/things/{id}", size, Body::json);
    router.add("POST", "/array", size, Body::array);
    router.add("GET", "/stream", [this](HttpRequest&) {
      HttpResponse response{200, "application/x-ndjson", {}, {}};
      response.stream = [this, piece = 0]() mutable -> std::optional<std::string> {
        ++pieces;
        if (pause > std::chrono::milliseconds(0)) std::this_thread::sleep_for(pause);
        if (++piece > stream_length) return std::nullopt;
        return piece % 2 == 0 ? "" : std::to_string(piece) + "\n";
      };
      return response;
    });
    router.add(
        "POST", "/upload",
        [](HttpRequest& request) {
          return HttpResponse{200, "text/plain", std::to_string(request.body.bytes.size()) + " " + request.body.file_name, {}};
        },
        Body::upload);
  }
  ~HttpServerTest() override {
    if (!released.exchange(true)) release.count_down();
    stop();
  }

  void start(HttpServerSettings settings = {.max_body_bytes = max_body, .threads = 4, .max_connections = 8}) {
    server = std::make_unique<HttpServer>(router, uploads, settings);
    port = server->bind("127.0.0.1", 0);
    thread = std::jthread([this] { server->run(); });
  }
  void stop() {
    if (server) server->stop();
    if (thread.joinable()) thread.join();
  }
  /// A connection on which some bytes were sent.
  [[nodiscard]] int spoken(const std::string& text) const {
    const int socket = connected();
    (void)!::send(socket, text.data(), text.size(), MSG_NOSIGNAL);
    return socket;
  }
  [[nodiscard]] httplib::Client client() const { return httplib::Client("127.0.0.1", port); }

  /// Sends bytes as they are, and returns everything that comes back until the server closes.
  [[nodiscard]] std::string raw(const std::string& request) const {
    const int socket = connected();
    (void)!::send(socket, request.data(), request.size(), MSG_NOSIGNAL);
    return received(socket);
  }
  [[nodiscard]] int connected() const {
    const int socket = ::socket(AF_INET, SOCK_STREAM, 0);
    sockaddr_in address{};
    address.sin_family = AF_INET;
    address.sin_port = htons(static_cast<std::uint16_t>(port));
    address.sin_addr.s_addr = htonl(INADDR_LOOPBACK);
    EXPECT_EQ(::connect(socket, reinterpret_cast<const sockaddr*>(&address), sizeof address), 0);
    return socket;
  }
  static std::string received(int socket) {
    std::string text;
    std::array<char, 4096> buffer{};
    ssize_t count = 0;
    while ((count = ::recv(socket, buffer.data(), buffer.size(), 0)) > 0) text.append(buffer.data(), static_cast<std::size_t>(count));
    ::close(socket);
    return text;
  }
  static int status_of(const std::string& response) { return response.starts_with("HTTP/1.1 ") ? std::stoi(response.substr(9, 3)) : 0; }
  static api::Problem problem_of_raw(const std::string& response) {
    const auto start = response.find("\r\n\r\n");
    const auto problem = api::from_text<api::Problem>(start == std::string::npos ? "" : response.substr(start + 4));
    EXPECT_EQ(api::entry_of(problem.code).status, status_of(response));
    EXPECT_NE(response.find("X-Request-Id: " + problem.request_id + "\r\n"), std::string::npos) << response;
    EXPECT_FALSE(problem.request_id.empty());
    return problem;
  }

  Router router;
  Gate uploads{"uploads", 2, 2};
  std::latch release{1};
  std::atomic<bool> released = false;
  std::atomic<int> blocked = 0;
  std::atomic<int> pieces = 0;  ///< that the stream was asked for
  int stream_length = 5;
  std::chrono::milliseconds pause{0};
  std::unique_ptr<HttpServer> server;
  std::jthread thread;
  int port = 0;
};

TEST_F(HttpServerTest, AnswersAndEchoesOrMakesARequestId) {
  start();
  auto response = client().Get("/echo?a=1%202&b=%26", httplib::Headers{{"X-Request-Id", "my-id.1"}});
  ASSERT_TRUE(response);
  EXPECT_EQ(response->body, "a=1 2;b=&;");
  EXPECT_EQ(response->get_header_value("X-Request-Id"), "my-id.1");
  EXPECT_EQ(response->get_header_value("X-Seen-Id"), "my-id.1");
  response = client().Get("/hello", httplib::Headers{{"X-Request-Id", "bad id\""}});
  EXPECT_EQ(response->get_header_value("X-Request-Id").size(), 32U);
  EXPECT_NE(client().Get("/hello")->get_header_value("X-Request-Id"), client().Get("/hello")->get_header_value("X-Request-Id"));
}

TEST_F(HttpServerTest, APortInUseIsNamed) {
  start();
  HttpServer other(router, uploads, {.max_body_bytes = max_body, .threads = 1, .max_connections = 1});
  try {
    other.bind("127.0.0.1", port);
    ADD_FAILURE() << "two servers on one port";
  } catch (const std::runtime_error& error) {
    EXPECT_EQ(error.what(), "cannot listen on 127.0.0.1:" + std::to_string(port) + ": the port is in use, --port takes another");
  }
}

TEST_F(HttpServerTest, HeadHasTheLengthWithoutTheBody) {
  start();
  const std::string response = raw("HEAD /hello HTTP/1.1\r\n\r\n");
  EXPECT_EQ(status_of(response), 200);
  EXPECT_NE(response.find("Content-Length: 5\r\n"), std::string::npos);
  EXPECT_TRUE(response.ends_with("\r\n\r\n"));
  EXPECT_EQ(response.find("Accept-Ranges"), std::string::npos);
}

TEST_F(HttpServerTest, BodiesOfAnyTypeAndSizeUpToTheLimit) {
  start();
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{9000}, max_body}) {
    for (const char* type : {"application/x-www-form-urlencoded", "application/octet-stream", "text/plain"}) {
      const auto response = client().Post("/upload", std::string(size, 'x'), type);
      ASSERT_TRUE(response);
      EXPECT_EQ(response->body, std::to_string(size) + " ") << type;
    }
  }
}

TEST_F(HttpServerTest, MultipartFieldFile) {
  start();
  auto response = client().Post("/upload", {{"file", std::string(100'000, 'x'), "cat.off", "model/off"}});
  ASSERT_TRUE(response);
  EXPECT_EQ(response->body, "100000 cat.off");
  for (const httplib::MultipartFormDataItems& items : {httplib::MultipartFormDataItems{{"other", "x", "", ""}},
                                                       httplib::MultipartFormDataItems{{"file", "x", "", ""}, {"file", "y", "", ""}},
                                                       httplib::MultipartFormDataItems{{"file", "x", "", ""}, {"name", "y", "", ""}}}) {
    response = client().Post("/upload", items);
    ASSERT_TRUE(response);
    EXPECT_EQ(api::from_text<api::Problem>(response->body).code, api::Code::invalid_parameter);
  }
  const auto multipart = [&](const std::string& type) {
    return problem_of_raw(raw("POST /upload HTTP/1.1\r\nContent-Length: 3\r\nContent-Type: " + type + "\r\n\r\nabc")).code;
  };
  EXPECT_EQ(multipart("multipart/form-data"), api::Code::bad_request);
  EXPECT_EQ(multipart("multipart/form-data; boundary=x"), api::Code::bad_request);
  EXPECT_EQ(multipart("multipart/mixed; boundary=x"), api::Code::unsupported_media_type);
}

TEST_F(HttpServerTest, OtherBodiesAreTakenAsTheyAre) {
  start({.max_body_bytes = std::size_t{8} << 20, .threads = 4, .max_connections = 8});
  // A client that calls its document a form, as curl -d does, beyond what the library takes of forms.
  const std::string document(20'000, ' ');
  EXPECT_EQ(client().Post("/json", document, "application/x-www-form-urlencoded")->body, "20000");
  EXPECT_EQ(client().Patch("/things/x", document, "application/merge-patch+json")->body, "20000");
  EXPECT_EQ(client().Post("/array", document, "application/x-npy")->body, "20000");
  EXPECT_EQ(client().Post("/array", httplib::MultipartFormDataItems{{"file", "abc", "", ""}})->status, 415);
  EXPECT_EQ(client().Patch("/upload", "x", "text/plain")->status, 405);

  const std::string large(max_json_bytes + 1, ' ');
  EXPECT_EQ(client().Post("/json", large, "application/json")->status, 413);
  EXPECT_EQ(client().Post("/array", large, "application/x-npy")->status, 200);
  EXPECT_EQ(status_of(raw("PATCH /things/x HTTP/1.1\r\n\r\n")), 411);
  EXPECT_EQ(status_of(raw("PATCH /things/" + std::string(129, 'a') + " HTTP/1.1\r\nContent-Length: 1\r\n\r\nx")), 404);
}

TEST_F(HttpServerTest, AStreamComesInPieces) {
  start();
  const auto response = client().Get("/stream");
  ASSERT_TRUE(response);
  EXPECT_EQ(response->get_header_value("Content-Type"), "application/x-ndjson");
  EXPECT_EQ(response->body, "1\n3\n5\n");
}

TEST_F(HttpServerTest, AStreamEndsWithItsClient) {
  stream_length = 1'000'000;
  pause = std::chrono::milliseconds(5);
  start({.max_body_bytes = max_body, .threads = 1, .max_connections = 8});
  const int socket = spoken("GET /stream HTTP/1.1\r\n\r\n");
  while (pieces < 3) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  ::close(socket);
  EXPECT_EQ(status_of(raw("GET /hello HTTP/1.1\r\n\r\n")), 200);  // the one thread is free again
  EXPECT_LT(pieces, 1000);
}

TEST_F(HttpServerTest, RefusedBodiesAreAnsweredThoughUnread) {
  start();
  const auto refused = [&](const std::string& headers, const std::string& body) {
    return problem_of_raw(raw("POST /upload HTTP/1.1\r\n" + headers + "\r\n" + body)).code;
  };
  EXPECT_EQ(refused("Transfer-Encoding: chunked\r\n", "3\r\nabc\r\n0\r\n\r\n"), api::Code::length_required);
  EXPECT_EQ(refused("Transfer-Encoding: chunked\r\nContent-Length: 3\r\n", "abc"), api::Code::length_required);
  EXPECT_EQ(refused("", ""), api::Code::length_required);
  EXPECT_EQ(refused("Content-Length: 3\r\nContent-Encoding: gzip\r\n", "abc"), api::Code::content_encoding);
  EXPECT_EQ(refused("Content-Length: -1\r\n", "abc"), api::Code::bad_request);
  EXPECT_EQ(refused("Content-Length: 3x\r\n", "abc"), api::Code::bad_request);
  EXPECT_EQ(refused("Content-Length: 3\r\nContent-Length: 4\r\n", "abc"), api::Code::bad_request);
  EXPECT_EQ(refused("Content-Length: 99999999999999999999\r\n", "abc"), api::Code::bad_request);
  EXPECT_EQ(refused("Content-Length: 18446744073709551615\r\n", "abc"), api::Code::payload_too_large);
}

TEST_F(HttpServerTest, ATooLargeBodyGetsItsAnswerAfterSendingEverything) {
  start();
  // The client sends all of it before it reads; a server that closed at once would reset the connection.
  const std::size_t size = 20 * max_body;
  const auto problem =
      problem_of_raw(raw("POST /upload HTTP/1.1\r\nContent-Length: " + std::to_string(size) + "\r\n\r\n" + std::string(size, 'x')));
  EXPECT_EQ(problem.code, api::Code::payload_too_large);
  EXPECT_EQ(problem.limit, static_cast<std::int64_t>(max_body));
  EXPECT_EQ(problem.actual, static_cast<std::int64_t>(size));
}

TEST_F(HttpServerTest, ExpectContinueIsRefusedBeforeTheBody) {
  start();
  const std::string refused = raw("POST /upload HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 99999999\r\n\r\n");
  EXPECT_EQ(problem_of_raw(refused).code, api::Code::payload_too_large);
  const std::string accepted = raw("POST /upload HTTP/1.1\r\nExpect: 100-continue\r\nContent-Length: 3\r\n\r\nabc");
  EXPECT_TRUE(accepted.starts_with("HTTP/1.1 100 "));
  EXPECT_TRUE(accepted.ends_with("3 "));
}

TEST_F(HttpServerTest, ABodyIsNeverTakenForTheNextRequest) {
  start();
  const std::string smuggled = "GET /hello HTTP/1.1\r\n\r\n";
  for (const std::string first :
       {"POST /nowhere HTTP/1.1\r\nContent-Length: 24\r\n\r\n", "GET /hello HTTP/1.1\r\nContent-Length: 24\r\n\r\n",
        "DELETE /things/1 HTTP/1.1\r\nContent-Length: 24\r\n\r\n", "GET /hello HTTP/1.1\r\n\r\n"}) {
    const std::string response = raw(first + smuggled);
    EXPECT_EQ(response.rfind("HTTP/1.1 "), 0U) << response;
    EXPECT_NE(response.find("Connection: close"), std::string::npos);
  }
}

TEST_F(HttpServerTest, WrongPathsAndMethods) {
  start();
  EXPECT_EQ(problem_of_raw(raw("GET /nowhere HTTP/1.1\r\n\r\n")).code, api::Code::not_found);
  const std::string response = raw("PUT /upload HTTP/1.1\r\nContent-Length: 3\r\n\r\nabc");
  EXPECT_EQ(problem_of_raw(response).code, api::Code::method_not_allowed);
  EXPECT_NE(response.find("Allow: POST\r\n"), std::string::npos);
  EXPECT_EQ(problem_of_raw(raw("OPTIONS /hello HTTP/1.1\r\n\r\n")).code, api::Code::method_not_allowed);
  EXPECT_EQ(status_of(raw("DELETE /things/1 HTTP/1.1\r\n\r\n")), 204);
}

TEST_F(HttpServerTest, WhatTheLibraryRefusesIsAProblemToo) {
  start();
  EXPECT_EQ(problem_of_raw(raw("garbage\r\n\r\n")).code, api::Code::bad_request);
  EXPECT_EQ(problem_of_raw(raw("BREW / HTTP/1.1\r\n\r\n")).code, api::Code::bad_request);
  EXPECT_EQ(problem_of_raw(raw("GET / HTTP/3.0\r\n\r\n")).code, api::Code::bad_request);
  EXPECT_EQ(problem_of_raw(raw("PRI * HTTP/2.0\r\n\r\nSM\r\n\r\n")).code, api::Code::bad_request);
  EXPECT_EQ(problem_of_raw(raw("GET /" + std::string(9000, 'a') + " HTTP/1.1\r\n\r\n")).code, api::Code::uri_too_long);
  EXPECT_EQ(problem_of_raw(raw("GET / HTTP/1.1\r\nX: " + std::string(9000, 'a') + "\r\n\r\n")).code, api::Code::bad_request);
  std::string headers;
  for (int i = 0; i < 20'000; ++i) headers += "A: b\r\n";
  EXPECT_EQ(problem_of_raw(raw("GET /hello HTTP/1.1\r\n" + headers + "\r\n")).code, api::Code::bad_request);
}

TEST_F(HttpServerTest, RangesAreIgnored) {
  start();
  for (const std::string& range : {std::string("bytes=0-1"), std::string("bytes=0-0,2-3"), std::string("bytes=9-")}) {
    const std::string response = raw("GET /hello HTTP/1.1\r\nRange: " + range + "\r\n\r\n");
    EXPECT_EQ(status_of(response), 200) << range;
    EXPECT_TRUE(response.ends_with("\r\n\r\nhello")) << range;
  }
  std::string many = "bytes=1-2";
  for (int i = 0; i < 1500; ++i) many += ",1-2";
  EXPECT_EQ(status_of(raw("GET /hello HTTP/1.1\r\nRange: " + many + "\r\n\r\n")), 200);
}

TEST_F(HttpServerTest, StrangePathsAreNotFound) {
  start();
  for (const char* path : {"/%00", "/%ff%fe", "/..%2f..%2fetc/passwd", "//", "/hello/", "/hello%00", "*"}) {
    EXPECT_EQ(status_of(raw(std::string("GET ") + path + " HTTP/1.1\r\n\r\n")), 404) << path;
  }
}

TEST_F(HttpServerTest, BeyondItsThreadsAndQueueConnectionsAreShed) {
  start({.max_body_bytes = max_body, .threads = 1, .max_connections = 1});
  const std::string request = "GET /block HTTP/1.1\r\n\r\n";
  const int first = connected();
  (void)!::send(first, request.data(), request.size(), 0);
  while (blocked < 1) std::this_thread::yield();
  const int second = connected();  // waits in the queue
  (void)!::send(second, request.data(), request.size(), 0);
  std::string shed;
  for (int i = 0; i < 50 && shed.empty(); ++i) shed = raw("GET /hello HTTP/1.1\r\n\r\n");
  EXPECT_EQ(status_of(shed), 503);
  EXPECT_NE(shed.find("Retry-After: "), std::string::npos);
  EXPECT_NE(shed.find("\"code\":\"overloaded\""), std::string::npos);
  released = true;
  release.count_down();
  EXPECT_EQ(status_of(received(first)), 200);
  EXPECT_EQ(status_of(received(second)), 200);
  EXPECT_EQ(status_of(raw("GET /hello HTTP/1.1\r\n\r\n")), 200);
}

TEST_F(HttpServerTest, SilentAndSlowConnectionsTakeNoThread) {
  start({.max_body_bytes = max_body, .threads = 2, .max_connections = 2});
  std::vector<int> idle;
  for (int i = 0; i < 100; ++i) idle.push_back(spoken(i % 2 == 0 ? "" : "GET /hello HTTP/1.1\r\nA: b\r\n"));
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 5; ++i) EXPECT_EQ(status_of(raw("GET /hello HTTP/1.1\r\n\r\n")), 200);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  // They are not forgotten either: who completes its request is served.
  (void)!::send(idle[1], "\r\n", 2, MSG_NOSIGNAL);
  EXPECT_EQ(status_of(received(idle[1])), 200);
  for (std::size_t i = 0; i < idle.size(); ++i) {
    if (i != 1) ::close(idle[i]);
  }
}

TEST_F(HttpServerTest, AHeadThatDoesNotEndInTimeIsAnswered) {
  start({.max_body_bytes = max_body, .threads = 2, .lobby = {.patience = std::chrono::milliseconds(100)}});
  EXPECT_EQ(problem_of_raw(received(spoken("GET /hello HTTP/1.1\r\n"))).code, api::Code::bad_request);
  EXPECT_EQ(received(spoken("")), "");
}

TEST_F(HttpServerTest, HalfSentBodiesLeaveRoomForWholeOnes) {
  start({.max_body_bytes = max_body, .threads = 12, .max_connections = 8, .receiving_uploads = 8});
  const std::string head = "POST /upload HTTP/1.1\r\nContent-Length: 100\r\n\r\n";
  std::vector<int> half;
  for (int i = 0; i < 7; ++i) half.push_back(spoken(head + "abc"));  // more than the two that may be worked on
  EXPECT_EQ(status_of(raw(head + std::string(100, 'x'))), 200);
  half.push_back(spoken(head + "abc"));
  // Now all places are taken, and that is said rather than waited for.
  int status = 0;
  for (int i = 0; i < 100 && status != 503; ++i) {
    const std::string refused = raw(head + std::string(100, 'x'));
    status = status_of(refused);
    if (status == 503) {
      EXPECT_EQ(problem_of_raw(refused).code, api::Code::overloaded);
    }
  }
  EXPECT_EQ(status, 503);
  EXPECT_EQ(status_of(raw("GET /hello HTTP/1.1\r\n\r\n")), 200);
  for (const int socket : half) ::close(socket);
}

TEST_F(HttpServerTest, BodiesShareTheirMemory) {
  start({.max_body_bytes = max_body, .threads = 8, .upload_memory = 150'000});
  const std::string head = "POST /upload HTTP/1.1\r\nContent-Length: 120000\r\n\r\n";
  EXPECT_EQ(status_of(raw(head + std::string(120'000, 'x'))), 200);
  const int half = spoken(head + std::string(100'000, 'x'));
  int status = 0;
  for (int i = 0; i < 100 && status != 503; ++i) status = status_of(raw(head + std::string(120'000, 'x')));
  EXPECT_EQ(status, 503);
  ::close(half);
  for (int i = 0; i < 500 && status != 200; ++i) {
    status = status_of(raw(head + std::string(120'000, 'x')));
    std::this_thread::sleep_for(std::chrono::milliseconds(10));
  }
  EXPECT_EQ(status, 200);  // given back
}

TEST_F(HttpServerTest, StoppingDoesNotWaitForIdleConnections) {
  start();
  const int silent = connected();
  const int slow = connected();
  const std::string half = "POST /upload HTTP/1.1\r\nContent-Length: 100\r\n\r\nabc";
  (void)!::send(slow, half.data(), half.size(), 0);
  std::this_thread::sleep_for(std::chrono::milliseconds(100));
  const auto start = std::chrono::steady_clock::now();
  stop();
  EXPECT_LT(std::chrono::steady_clock::now() - start, std::chrono::seconds(2));
  ::close(silent);
  ::close(slow);
}

TEST_F(HttpServerTest, AStopAtAnyMomentEndsIt) {
  for (int i = 0; i < 200; ++i) {
    start();
    if (i % 2 != 0) std::this_thread::sleep_for(std::chrono::microseconds(i));
    stop();
    server.reset();
  }
}

TEST_F(HttpServerTest, EveryAnswerIsReportedWithItsPattern) {
  std::mutex mutex;
  std::vector<std::string> reports;
  HttpServerSettings settings{.max_body_bytes = max_body, .threads = 4, .max_connections = 8};
  settings.on_request = [&](const FinishedRequest& request) {
    EXPECT_GE(request.seconds, 0);
    EXPECT_LT(request.seconds, 10);
    const std::lock_guard lock(mutex);
    reports.push_back(std::string(request.method) + " " + std::string(request.route) + " " + std::to_string(request.status));
  };
  start(settings);
  EXPECT_TRUE(client().Get("/hello"));
  EXPECT_TRUE(client().Delete("/things/secret"));
  EXPECT_TRUE(client().Get("/nowhere"));
  EXPECT_EQ(status_of(raw("POST /upload HTTP/1.1\r\n\r\n")), 411);
  stop();
  std::sort(reports.begin(), reports.end());  // an answer is reported after it is sent, by whichever thread sent it
  EXPECT_EQ(reports, (std::vector<std::string>{"DELETE /things/{id} 204", "GET - 404", "GET /hello 200", "POST /upload 411"}));
}

TEST_F(HttpServerTest, AGuardRefusesBeforeTheBody) {
  router.set_guard([](const HttpRequest& request, std::string_view pattern) {
    if (pattern == "/upload" && request.header("x-api-key") != "right") throw ProblemError(api::Code::unauthorized, "no");
  });
  start();
  const auto ask = [this](const std::string& headers) { return raw("POST /upload HTTP/1.1\r\n" + headers + "\r\n"); };
  EXPECT_EQ(status_of(ask("Content-Length: 100\r\n")), 401);
  EXPECT_EQ(status_of(ask("Content-Length: 100\r\nExpect: 100-continue\r\n")), 401);
  EXPECT_EQ(status_of(ask("Content-Length: 99999999\r\n")), 401);
  EXPECT_EQ(status_of(ask("")), 401);
  EXPECT_EQ(status_of(ask("X-API-Key: right\r\n")), 411);
  const auto answer = client().Post("/upload", httplib::Headers{{"X-API-Key", "right"}}, "body", "text/plain");
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->status, 200);
}

TEST_F(HttpServerTest, APortIsNotShared) {
  start();
  HttpServer second(router, uploads, {});
  EXPECT_THROW(second.bind("127.0.0.1", port), std::runtime_error);
}

}  // namespace
}  // namespace spherematch
