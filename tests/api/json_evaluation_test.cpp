#include <gtest/gtest.h>

#include "api/json.h"

namespace spherematch::api {
namespace {

TEST(JsonEvaluation, RequestsSurviveTheJourney) {
  EvaluationRequest request;
  request.src = "a";
  request.tgt = "b";
  const std::vector<Truth> truths{std::monostate{}, IdentityTruth{}, IndexTruth{{3, -1, 2}},
                                  LandmarkTruth{.source = {1, 2}, .target = {3, 4}, .mirrored = std::nullopt},
                                  LandmarkTruth{.source = {1}, .target = {3}, .mirrored = std::vector<std::int32_t>{5}}};
  for (const Truth& truth : truths) {
    request.truth = truth;
    EXPECT_EQ(from_text<EvaluationRequest>(to_text(to_json(request))), request);
    request.base = 1;
    request.both = !request.both;
    request.biharmonic = false;
    request.hints = {{1, 2}};
    request.method = "paper";
    request.refine = "none";
    request.orientation = "any";
    request.candidate = 1;
  }
}

TEST(JsonEvaluation, AnswersSurviveTheJourney) {
  Evaluation answer;
  answer.src = "a";
  EXPECT_EQ(from_text<Evaluation>(to_text(to_json(answer))), answer);
  answer.geodesic =
      MapError{.mean = 1, .median = 2, .p95 = 3, .max = 4, .auc = 0.5, .area_mean = 1.5, .scored = 6, .unscored = 7, .curve = {0, 0.5, 1}};
  answer.mirrored = answer.biharmonic = answer.bijectivity = answer.bijectivity_biharmonic = MapError{};
  answer.flipped = false;
  answer.symmetric_integral = 0.25;
  answer.continuity = {1, 2, 3, 4, 5, 6, 7, 0.5};
  answer.coverage = {0.5, 0.25};
  answer.thresholds = {0, 0.125, 0.25};
  answer.seconds = {{"errors", 1}, {"total", 2}};
  answer.cached = true;
  answer.engine.append("engine-5");
  EXPECT_EQ(from_text<Evaluation>(to_text(to_json(answer))), answer);
}

TEST(JsonEvaluation, StrictReadingNamesWhatIsWrong) {
  const auto complains = [](const std::string& text, const std::string& about) {
    try {
      (void)from_text<EvaluationRequest>(text);
      ADD_FAILURE() << "no error: " << text;
    } catch (const JsonError& error) {
      EXPECT_NE(std::string(error.what()).find(about), std::string::npos) << error.what();
    }
  };
  complains(R"({"src": "a"})", "tgt");
  complains(R"({"src": "a", "tgt": "b", "x": 1})", "x");
  complains(R"({"src": "a", "tgt": "b", "truth": [1.5]})", "truth[0]");
  complains(R"({"src": "a", "tgt": "b", "truth": {"source": [], "target": [], "sym": []}})", "truth.sym");
  complains(R"({"src": "a", "tgt": "b", "truth": {"source": [1], "target": []}})", "truth.target");
  complains(R"({"src": "a", "tgt": "b", "hints": [[1]]})", "hints[0]");
}

}  // namespace
}  // namespace spherematch::api
