// The client against a server that answers as the test wants.
#include "client/client.h"

#include <gtest/gtest.h>
#include <httplib.h>

#include <atomic>
#include <thread>

#include "api/json.h"

namespace spherematch::client {
namespace {

class ClientTest : public ::testing::Test {
 protected:
  void start() {
    port = server.bind_to_any_port("127.0.0.1");
    thread = std::jthread([this] { server.listen_after_bind(); });
    while (!server.is_running()) std::this_thread::yield();
  }
  ~ClientTest() override { server.stop(); }

  [[nodiscard]] Client client(Settings settings = {}) const {
    settings.first_pause = std::chrono::milliseconds(1);
    return Client("http://127.0.0.1:" + std::to_string(port), settings);
  }
  static void refuse(httplib::Response& response, api::Code code) {
    api::Problem problem;
    problem.code = code;
    problem.detail = "because";
    response.status = api::entry_of(code).status;
    response.set_content(api::to_text(api::to_json(problem)), "application/problem+json");
  }
  static std::string health() { return api::to_text(api::to_json(api::Health{})); }

  httplib::Server server;
  std::atomic<int> calls = 0;
  int port = 0;
  std::jthread thread;
};

TEST_F(ClientTest, ARefusalIsAnErrorWithItsProblem) {
  server.Get("/shapes/x", [&](const auto&, auto& response) {
    ++calls;
    refuse(response, api::Code::not_found);
  });
  start();
  try {
    (void)client().shape("x");
    ADD_FAILURE() << "no error";
  } catch (const ProblemError& error) {
    EXPECT_EQ(error.status(), 404);
    EXPECT_EQ(error.problem().code, api::Code::not_found);
    EXPECT_STREQ(error.what(), "because");
  }
  EXPECT_EQ(calls, 1);
}

TEST_F(ClientTest, AThumbnailIsAskedForInItsSize) {
  server.Get("/shapes/x/thumbnail.png", [](const auto& request, auto& response) {
    response.set_content("picture of " + request.get_param_value("size"), "image/png");
  });
  start();
  EXPECT_EQ(client().thumbnail("x", 64), "picture of 64");
  EXPECT_EQ(client().thumbnail("x"), "picture of 256");
}

TEST_F(ClientTest, WhatIsCarriedComesAsAFileToo) {
  server.Post("/transfer", [](const auto& request, auto& response) {
    EXPECT_TRUE(request.body.starts_with("\x93NUMPY"));
    EXPECT_NE(request.body.find("(2, 2)"), std::string::npos);
    response.set_content(request.get_param_value("format") + " of " + request.get_param_value("as"), "image/png");
  });
  start();
  EXPECT_EQ(client().transfer_file("a", "b", std::vector<double>{0, 0, 1, 1}, 2, "png", "texture"), "png of texture");
}

TEST_F(ClientTest, RefusalsThatPassAreTriedAgain) {
  server.Get("/healthz", [&](const auto&, auto& response) {
    if (++calls < 3) {
      refuse(response, api::Code::overloaded);
    } else {
      response.set_content(health(), "application/json");
    }
  });
  server.Get("/version", [&](const auto&, auto& response) {
    ++calls;
    refuse(response, api::Code::draining);
  });
  start();
  EXPECT_EQ(client().health().status, "ok");
  EXPECT_EQ(calls, 3);
  calls = 0;
  EXPECT_THROW((void)client({.retries = 2}).version(), ProblemError);
  EXPECT_EQ(calls, 3);
}

TEST_F(ClientTest, OnlyWhatCanBeRepeatedIsRepeated) {
  // Nobody listens on the port of a server that has stopped.
  start();
  server.stop();
  thread.join();
  const auto begin = std::chrono::steady_clock::now();
  EXPECT_THROW((void)client().health(), TransportError);
  EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(5));
  EXPECT_THROW((void)client().start({}), TransportError);
}

TEST_F(ClientTest, ASlowAnswerIsGivenUp) {
  server.Get("/healthz", [&](const auto&, auto& response) {
    ++calls;
    std::this_thread::sleep_for(std::chrono::milliseconds(400));
    response.set_content(health(), "application/json");
  });
  start();
  EXPECT_THROW((void)client({.read_timeout = std::chrono::milliseconds(100), .retries = 1}).health(), TransportError);
  EXPECT_EQ(calls, 2);
}

TEST_F(ClientTest, AnswersOfAnotherServerAreNoCrash) {
  server.Get("/healthz", [](const auto&, auto& response) { response.set_content("<html>", "text/html"); });
  server.Get("/version", [](const auto&, auto& response) {
    response.status = 404;
    response.set_content("<html>", "text/html");
  });
  start();
  EXPECT_THROW((void)client().health(), FormatError);
  EXPECT_THROW((void)client().version(), FormatError);
  EXPECT_THROW(Client("gopher://x"), TransportError);
}

TEST_F(ClientTest, ParametersAndKeysArrive) {
  std::string target, key, body;
  server.Post("/shapes", [&](const httplib::Request& request, httplib::Response& response) {
    target = request.target;
    key = request.get_header_value("Authorization");
    body = request.body;
    refuse(response, api::Code::malformed_mesh);
  });
  start();
  UploadOptions options{.name = "a b&c=\xc3\xa9", .tags = {"x", "y"}, .repair = false, .simplify = 500};
  EXPECT_THROW((void)client({.api_key = "secret"}).upload("mesh", options), ProblemError);
  EXPECT_EQ(target, "/shapes?name=a%20b%26c%3D%C3%A9&repair=none&wait=0.000000&tags=x%2Cy&simplify=500");
  EXPECT_EQ(key, "Bearer secret");
  EXPECT_EQ(body, "mesh");
}

TEST_F(ClientTest, ASymmetryIsAskedForByItsShape) {
  std::string target;
  api::Match match;
  match.src = match.tgt = "s";
  match.quality = {{"involution_mean", 0.25}};
  server.Get("/shapes/s/symmetry", [&](const httplib::Request& request, httplib::Response& response) {
    target = request.target;
    response.set_content(api::to_text(api::to_json(match)), "application/json");
  });
  start();
  MatchOptions options;
  options.hints = {{1, 2}};
  options.cache = false;
  EXPECT_EQ(client().symmetry_info("s", options), match);
  EXPECT_EQ(target, "/shapes/s/symmetry?wait=60.000000&method=default&refine=default&hints=1%3A2&cache=no&format=json&fields=");
  (void)client().symmetry_file("s", "npz", {.fields = "confidence,distortion"});
  EXPECT_TRUE(target.ends_with("&format=npz&fields=confidence%2Cdistortion")) << target;
  (void)client().symmetry_file("s", "ply");
  EXPECT_EQ(target, "/shapes/s/symmetry?wait=60.000000&method=default&refine=default&format=ply");
  EXPECT_THROW((void)client().symmetry("s"), FormatError);  // JSON is no NPZ
}

TEST_F(ClientTest, FieldsAreAskedForWithTheMapAndNotWithItsFigures) {
  std::string target;
  server.Get("/match", [&](const httplib::Request& request, httplib::Response& response) {
    target = request.target;
    response.set_content(api::to_text(api::to_json(api::Match{})), "application/json");
  });
  start();
  const MatchOptions options{.both = true, .fields = "confidence"};
  (void)client().match_file("a", "b", "npz", options);
  EXPECT_TRUE(target.ends_with("&format=npz&fields=confidence&both=yes")) << target;
  (void)client().match_info("a", "b", options);
  EXPECT_TRUE(target.ends_with("&format=json&fields=")) << target;
}

TEST_F(ClientTest, ResultsGoOnWhereTheyBrokeOff) {
  const auto line = [](std::int32_t index) {
    api::PairResult result{index, "a", "b", {}, {}};
    result.match.emplace();
    return api::to_text(api::to_json(result)) + "\n";
  };
  api::Job job;
  job.id = "j";
  job.state = "processing";
  server.Get("/jobs/j", [&](const auto&, auto& response) { response.set_content(api::to_text(api::to_json(job)), "application/json"); });
  std::vector<std::string> asked;
  server.Get("/jobs/j/results", [&](const httplib::Request& request, httplib::Response& response) {
    asked.push_back(request.get_param_value("after"));
    const bool first = asked.size() == 1;
    if (!first) job.state = "succeeded";
    if (request.get_param_value("after") == "3") return;  // there is no more
    response.set_chunked_content_provider("application/x-ndjson", [=, sent = false](std::size_t, httplib::DataSink& sink) mutable {
      if (std::exchange(sent, true)) return false;  // breaks off
      const std::string text = first ? line(2) + line(0).substr(0, 20) : line(0) + line(1);
      sink.write(text.data(), text.size());
      if (!first) sink.done();
      return true;
    });
  });
  start();
  std::vector<std::int32_t> seen;
  client().results("j", [&](const api::PairResult& result) {
    seen.push_back(result.index);
    return true;
  });
  EXPECT_EQ(seen, (std::vector<std::int32_t>{2, 0, 1}));
  ASSERT_GE(asked.size(), 2U);
  EXPECT_EQ(asked[0], "0");
  EXPECT_EQ(asked[1], "1");
}

TEST_F(ClientTest, AnEvaluationIsAskedForAsJson) {
  api::EvaluationRequest asked;
  asked.src = "source";
  asked.tgt = "target";
  asked.truth = api::LandmarkTruth{.source = {1, 2}, .target = {3, 4}, .mirrored = std::nullopt};
  server.Post("/evaluations", [&](const httplib::Request& request, httplib::Response& response) {
    EXPECT_EQ(api::from_text<api::EvaluationRequest>(request.body), asked);
    EXPECT_EQ(request.get_param_value("wait"), "60.000000");
    api::Evaluation evaluation;
    evaluation.geodesic.emplace().scored = 2;
    response.set_content(api::to_text(api::to_json(evaluation)), "application/json");
  });
  start();
  EXPECT_EQ(client().evaluate(asked).geodesic.value().scored, 2);
}

}  // namespace
}  // namespace spherematch::client
