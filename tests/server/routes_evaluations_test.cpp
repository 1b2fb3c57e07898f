#include <optional>
#include <thread>

#include "tests/server/test_service.h"

namespace spherematch {
namespace {

/// The stub's shapes have five uploaded vertices; what it answers says what it was asked.
class RoutesEvaluations : public testing::TestService {
 protected:
  void SetUp() override {
    src = ready("sphere 1");
    tgt = ready("sphere 2");
  }
  HttpResponse ask(const std::string& members, std::multimap<std::string, std::string> query = {},
                   std::map<std::string, std::string> headers = {}) {
    return call({.method = "POST",
                 .path = "/evaluations",
                 .query = std::move(query),
                 .body = R"({"src": ")" + src + R"(", "tgt": ")" + tgt + "\"" + (members.empty() ? "" : ", ") + members + "}",
                 .file_name = {},
                 .headers = std::move(headers)});
  }
  api::Evaluation answer(const std::string& members) {
    const HttpResponse response = ask(members);
    EXPECT_EQ(response.status, 200) << response.body;
    return api::from_text<api::Evaluation>(response.body);
  }
  void refused(const std::string& members, api::Code code, const std::string& text) {
    const HttpResponse response = ask(members);
    EXPECT_EQ(problem_code(response), code);
    EXPECT_NE(response.body.find(text), std::string::npos) << response.body;
  }

  std::string src;
  std::string tgt;
};

TEST_F(RoutesEvaluations, MeasuresEverythingThatCanBe) {
  const api::Evaluation result = answer(R"("truth": "identity")");
  EXPECT_EQ(result.src, src);
  EXPECT_EQ(result.tgt, tgt);
  EXPECT_EQ(result.geodesic.value().scored, 5);
  EXPECT_EQ(result.geodesic->curve, (std::vector<double>{0, 1}));
  EXPECT_EQ(result.biharmonic.value().scored, 5);
  EXPECT_EQ(result.bijectivity.value().scored, 5);
  EXPECT_EQ(result.symmetric_integral, 0.5);
  EXPECT_FALSE(result.mirrored);
  EXPECT_FALSE(result.flipped);
  EXPECT_EQ(result.continuity.dirichlet, 1.5);
  EXPECT_EQ(result.coverage.area, 0.75);
  EXPECT_EQ(result.thresholds.size(), 101U);
  EXPECT_EQ(result.engine, "stub-1");
  EXPECT_FALSE(result.cached);
  EXPECT_TRUE(answer("").cached) << "the match is kept";
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(RoutesEvaluations, WhatIsNotWantedIsNotMeasured) {
  const api::Evaluation result = answer(R"("truth": "identity", "both": false, "biharmonic": false)");
  EXPECT_TRUE(result.geodesic);
  EXPECT_FALSE(result.biharmonic);
  EXPECT_FALSE(result.bijectivity);
  EXPECT_FALSE(result.symmetric_integral);
  for (const char* none : {"", R"("truth": null)"}) EXPECT_FALSE(answer(none).geodesic);
}

TEST_F(RoutesEvaluations, TruthIsAListOrLandmarksFromEitherBase) {
  EXPECT_EQ(answer(R"("truth": [4, -1, 2, 0, 1])").geodesic.value().scored, 4);
  EXPECT_TRUE(engine.last_truth.dense);
  EXPECT_EQ(engine.last_truth.direct.at(1).source, 2);
  EXPECT_EQ(answer(R"("base": 1, "truth": [5, -1, 1, 1, 1])").geodesic.value().scored, 4);
  EXPECT_EQ(engine.last_truth.direct.at(0).target, 4);
  const api::Evaluation flipped = answer(R"("base": 1, "truth": {"source": [1, 5], "target": [2, 3], "mirrored": [4, 5]})");
  EXPECT_EQ(flipped.geodesic.value().scored, 2);
  EXPECT_EQ(flipped.mirrored.value().scored, 2);
  EXPECT_EQ(flipped.flipped, true);
  EXPECT_FALSE(flipped.symmetric_integral) << "landmarks are not dense";
  EXPECT_EQ(engine.last_truth.direct.at(1).source, 4);
  EXPECT_EQ(engine.last_truth.mirrored.at(1).target, 4);
}

TEST_F(RoutesEvaluations, TruthThatDoesNotFitIsRefusedBeforeAnythingIsComputed) {
  refused(R"("truth": [0, 1])", api::Code::length_mismatch, "truth has 2 elements, src has 5 uploaded vertices");
  refused(R"("truth": [0, 1, 2, 3, 5])", api::Code::invalid_parameter, "truth[4]: 5 is no vertex");
  refused(R"("truth": {"source": [5], "target": [0]})", api::Code::invalid_parameter, "truth.source[0]");
  refused(R"("truth": {"source": [0], "target": [5]})", api::Code::invalid_parameter, "truth.target[0]");
  refused(R"("truth": {"source": [0], "target": [0], "mirrored": [9]})", api::Code::invalid_parameter, "truth.mirrored[0]");
  refused(R"("truth": {"source": [0, 1], "target": [0]})", api::Code::invalid_parameter, "as many elements as truth.source");
  refused(R"("truth": {"source": [0]})", api::Code::invalid_parameter, "truth.target");
  refused(R"("truth": {"source": [-1], "target": [0]})", api::Code::invalid_parameter, "truth.source[0]");
  refused(R"("truth": [-2, 1, 2, 3, 4])", api::Code::invalid_parameter, "truth[0]");
  refused(R"("base": 1, "truth": [0, 1, 2, 3, 4])", api::Code::invalid_parameter, "truth[0]");
  refused(R"("base": 2)", api::Code::invalid_parameter, "base");
  refused(R"("truth": "mirror")", api::Code::invalid_parameter, "truth");
  refused(R"("truth": 7)", api::Code::invalid_parameter, "truth");
  refused(R"("both": "yes")", api::Code::invalid_parameter, "both");
  refused(R"("refinement": 1)", api::Code::invalid_parameter, "refinement");
  refused(R"("candidate": 8)", api::Code::invalid_parameter, "candidate: must be in [0, 7]");
  refused(R"("candidate": -1)", api::Code::invalid_parameter, "candidate");
  refused(R"("method": "x")", api::Code::invalid_parameter, "method");
  refused(R"("refine": "x")", api::Code::invalid_parameter, "refine");
  EXPECT_EQ(engine.matches, 0);
}

TEST_F(RoutesEvaluations, MatchParametersCount) {
  answer("");
  answer(R"("orientation": "any")");
  answer(R"("method": "paper")");
  answer(R"("refine": "none")");
  answer(R"("hints": [[0, 1]])");
  answer(R"("candidate": 1)");
  EXPECT_EQ(engine.matches, 6);
  EXPECT_EQ(ask("", {{"cache", "no"}}).status, 200);
  EXPECT_EQ(engine.matches, 7);
  for (const auto& [name, value] : {std::pair("format", "png"), std::pair("cache", "x"), std::pair("wait", "x"), std::pair("src", "x")})
    EXPECT_EQ(problem_code(ask("", {{name, value}})), api::Code::invalid_parameter) << name;
}

TEST_F(RoutesEvaluations, ThePictureIsAskedForByFormatOrAccept) {
  const HttpResponse picture = ask(R"("truth": "identity")", {{"format", "svg"}});
  EXPECT_EQ(picture.content_type, "image/svg+xml");
  EXPECT_NE(picture.body.find(src + " to " + tgt), std::string::npos) << "the shapes have no names";
  EXPECT_NE(picture.body.find("<polyline"), std::string::npos);
  EXPECT_EQ(ask("", {}, {{"accept", "image/svg+xml"}}).content_type, "image/svg+xml");
  EXPECT_EQ(problem_code(ask("", {}, {{"accept", "video/mp4"}})), api::Code::not_acceptable);
}

TEST_F(RoutesEvaluations, ShapesMustBeThereAndReady) {
  tgt = std::string(32, '0');
  EXPECT_EQ(problem_code(ask("")), api::Code::not_found);
  engine.hold_preparation = true;
  tgt = shape(post("sphere 3", {})).id;
  EXPECT_EQ(problem_code(ask("", {{"wait", "0"}})), api::Code::shape_not_ready);
  engine.hold_preparation = false;
  EXPECT_EQ(ask("", {{"wait", "10"}}).status, 200);
}

TEST_F(RoutesEvaluations, WithoutRoomItIsTurnedAwayAtOnce) {
  std::optional<Gate::Permit> inside(matches->enter());
  std::jthread waiting([this] { (void)matches->enter(); });
  while (matches->counts().waiting == 0) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  EXPECT_EQ(problem_code(ask("")), api::Code::overloaded);
  EXPECT_EQ(engine.matches, 0);
  inside.reset();
  waiting.join();
  EXPECT_EQ(ask("").status, 200);
}

TEST_F(RoutesEvaluations, AServerThatStopsCancels) {
  answer("");
  stop_source.request_stop();
  EXPECT_EQ(problem_code(ask("")), api::Code::cancelled);
}

}  // namespace
}  // namespace spherematch
