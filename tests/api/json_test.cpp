#include "api/json.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>

namespace spherematch::api {
namespace {

Problem sample_problem() {
  Problem problem;
  problem.code = Code::not_closed;
  problem.detail = "the mesh has 2 boundary loops";
  problem.request_id = "abc-1";
  problem.limit = 0;
  problem.actual = 2;
  problem.elements = {EdgeElement{{12, 77}}, VertexElement{3}, FaceElement{4}};
  return problem;
}

Shape sample_shape() {
  Shape shape;
  shape.id = "0123456789abcdef0123456789abcdef";
  shape.name = "a \"quoted\" n\u00e4me\n";
  shape.tags = {"a", "b:1"};
  shape.state = ShapeState::ready;
  shape.progress = 1;
  shape.vertices = 100;
  shape.faces = 196;
  shape.sha256 = std::string(64, 'f');
  shape.repair = {"none", 1, 2, 3, 4, 5, 6, 7, 8, 9};
  shape.simplified = 5000;
  shape.sphere = Sphere{0, 1e-13, 0.25};
  shape.seconds = {{"conformal", 1.5}, {"authalic", 0.1}, {"total", 1.6}};
  shape.engine = "1.0";
  shape.created_at = "2024-01-02T03:04:05Z";
  return shape;
}

Match sample_match() {
  Match match;
  match.src = "a";
  match.tgt = "b";
  match.n_src = 2;
  match.n_tgt = 5;
  match.vertex = {4, -1};
  match.corners = {{{4, 1, 2}, {-1, -1, -1}}};
  match.bary = {{{0.1F, 0.3F, 0.6F}, {0, 0, 0}}};
  match.quality = {{"coverage", 0.5}};
  match.candidate = 1;
  match.candidates = {{{1, 0, 0, 0, 1, 0, 0, 0, 1}, 0.9, -0.1, true}};
  match.seconds = {{"rotation", 0.25}, {"total", 1}};
  match.engine = "1.0";
  return match;
}

/// What from_text says about the value's JSON after `change`.
template <typename T>
std::string complaint(const T& value, const std::function<void(Json&)>& change) {
  Json json = to_json(value);
  change(json);
  try {
    (void)from_text<T>(json.dump());
  } catch (const JsonError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(Json, RoundTrips) {
  EXPECT_EQ(from_text<Problem>(to_text(to_json(sample_problem()))), sample_problem());
  EXPECT_EQ(from_text<Shape>(to_text(to_json(sample_shape()))), sample_shape());
  EXPECT_EQ(from_text<Match>(to_text(to_json(sample_match()))), sample_match());

  Shape failed = sample_shape();
  failed.state = ShapeState::failed;
  failed.sphere.reset();
  failed.engine.clear();
  failed.error = sample_problem();
  failed.error->request_id.clear();
  const ShapePage page{{sample_shape(), failed}, "cursor"};
  EXPECT_EQ(from_text<ShapePage>(to_text(to_json(page))), page);
  EXPECT_EQ(from_text<ShapePage>(to_text(to_json(ShapePage{}))), ShapePage{});

  const Health health{"draining", 1, 2, 3, 4};
  EXPECT_EQ(from_text<Health>(to_text(to_json(health))), health);
  Version version{"0.1", "7", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12}, {"off", "ply"}, {"json"}, Json::object()};
  version.parameters["match"] = {{"max_candidates", 4}};
  EXPECT_EQ(from_text<Version>(to_text(to_json(version))), version);
  const Readiness readiness{{{"store", true, "a write took 1 ms"}, {"disk", true, "9 MiB are free"}}};
  EXPECT_EQ(from_text<Readiness>(to_text(to_json(readiness))), readiness);
  Problem not_ready;
  not_ready.code = Code::not_ready;
  not_ready.detail = "store: it is gone";
  not_ready.checks = {{"store", false, "it is gone"}, {"disk", true, "9 MiB are free"}};
  EXPECT_EQ(from_text<Problem>(to_text(to_json(not_ready))), not_ready);
}

TEST(Json, APatchHoldsWhatIsThere) {
  for (const ShapePatch& patch : {ShapePatch{}, ShapePatch{"a", {}}, ShapePatch{{}, std::vector<std::string>{"x", "y"}}}) {
    EXPECT_EQ(from_text<ShapePatch>(to_text(to_json(patch))), patch);
  }
  EXPECT_EQ(from_text<ShapePatch>(R"({"name":null,"tags":null})"), (ShapePatch{"", std::vector<std::string>{}}));
  for (const char* wrong : {"[]", "null", "", R"({"name":1})", R"({"tags":"a"})", R"({"tags":[1]})", R"({"state":"ready"})"}) {
    EXPECT_THROW((void)from_text<ShapePatch>(wrong), JsonError) << wrong;
  }
}

TEST(Json, ProblemHasTheMembersOfRfc9457AndOurs) {
  const Json json = to_json(sample_problem());
  EXPECT_EQ(json["type"], "/problems/not-closed");
  EXPECT_EQ(json["status"], 422);
  EXPECT_FALSE(json.contains("checks"));
  EXPECT_EQ(json["instance"], "/requests/abc-1");
  EXPECT_EQ(json["code"], "not-closed");
  EXPECT_EQ(json["retryable"], false);
  EXPECT_EQ(json["elements"].dump(), R"([{"edge":[12,77]},{"vertex":3},{"face":4}])");
}

TEST(Json, ProblemListsAtMostTwentyElements) {
  Problem problem = sample_problem();
  problem.elements.assign(30, VertexElement{1});
  EXPECT_EQ(to_json(problem)["elements"].size(), 20U);
}

TEST(Json, MembersAbsentFromAMatchStayAbsent) {
  Match match = sample_match();
  match.corners.reset();
  match.bary.reset();
  const Json json = to_json(match);
  EXPECT_FALSE(json.contains("corners"));
  EXPECT_FALSE(json.contains("bary"));
  EXPECT_EQ(from_text<Match>(to_text(json)), match);
}

TEST(Json, WeightsTravelShortAndExact) {
  Match match = sample_match();
  match.n_src = 1;
  match.vertex.reset();
  match.corners.reset();
  for (const float value : {0.1F, 1.0F / 3, 1e-30F, std::nextafterf(1, 0), std::numeric_limits<float>::denorm_min()}) {
    match.bary = {{{value, 0, 0}}};
    const std::string text = to_text(to_json(match));
    const auto start = text.find("[[") + 2;
    EXPECT_LE(text.find(',', start) - start, 16U) << text.substr(start, 30);
    EXPECT_EQ(from_text<Match>(text).bary->at(0)[0], value);
  }
}

TEST(Json, WhatIsNotFiniteIsNull) {
  Match match = sample_match();
  match.quality = {{"coverage", std::numeric_limits<double>::quiet_NaN()}};
  EXPECT_TRUE(to_json(match)["quality"]["coverage"].is_null() || to_text(to_json(match)).find("\"coverage\":null") != std::string::npos);
  EXPECT_TRUE(std::isnan(from_text<Match>(to_text(to_json(match))).quality.at(0).second));
}

TEST(Json, TextThatIsNotUtf8IsReplacedNotRefused) {
  Shape shape = sample_shape();
  shape.name = "\xff";
  EXPECT_EQ(from_text<Shape>(to_text(to_json(shape))).name, "\uFFFD");
}

TEST(Json, EveryMemberOfAShapeIsRequiredAndChecked) {
  const Json json = to_json(sample_shape());
  for (const auto& [name, value] : json.items()) {
    const std::string missing = complaint(sample_shape(), [&](Json& j) { j.erase(name); });
    EXPECT_EQ(missing, name + ": is missing");
    const std::string wrong = complaint(sample_shape(), [&](Json& j) { j[name] = true; });
    EXPECT_TRUE(wrong.starts_with(name + ": must be")) << name << ": " << wrong;
  }
}

TEST(Json, EveryMemberOfAMatchIsChecked) {
  const Json json = to_json(sample_match());
  for (const auto& [name, value] : json.items()) {
    const std::string wrong = complaint(sample_match(), [&](Json& j) { j[name] = Json::object({{"x", "y"}}); });
    EXPECT_TRUE(wrong.starts_with(name)) << name << ": " << wrong;
  }
}

TEST(Json, RefusalsNameTheMember) {
  const auto shape = [](const std::function<void(Json&)>& change) { return complaint(sample_shape(), change); };
  EXPECT_EQ(shape([](Json& j) { j["colour"] = 1; }), "colour: is not a known member");
  EXPECT_EQ(shape([](Json& j) { j["repair"]["colour"] = 1; }), "repair.colour: is not a known member");
  EXPECT_EQ(shape([](Json& j) { j["repair"]["filled_loops"] = -1; }), "repair.filled_loops: must be in [0, 2147483647]");
  EXPECT_EQ(shape([](Json& j) { j["vertices"] = 2147483648; }), "vertices: must be in [0, 2147483647]");
  EXPECT_EQ(shape([](Json& j) { j["vertices"] = 18446744073709551615U; }), "vertices: must be in [0, 2147483647]");
  EXPECT_EQ(shape([](Json& j) { j["vertices"] = 1.5; }), "vertices: must be an integer");
  EXPECT_EQ(shape([](Json& j) { j["progress"] = 1.1; }), "progress: must be in [0.0, 1.0]");
  EXPECT_EQ(shape([](Json& j) { j["state"] = "done"; }), "state: must be queued, processing, ready or failed");
  EXPECT_EQ(shape([](Json& j) { j["repair"]["mode"] = "safe"; }), "repair.mode: must be fill or none");
  EXPECT_EQ(shape([](Json& j) { j["seconds"]["total"] = "1"; }), "seconds.total: must be a number");
  EXPECT_EQ(shape([](Json& j) { j["sphere"].erase("flipped"); }), "sphere.flipped: is missing");

  const auto match = [](const std::function<void(Json&)>& change) { return complaint(sample_match(), change); };
  EXPECT_EQ(match([](Json& j) { j["vertex"][0] = 5; }), "vertex[0]: must be in [-1, 4]");
  EXPECT_EQ(match([](Json& j) { j["vertex"].push_back(0); }), "vertex: must have 2 elements");
  EXPECT_EQ(match([](Json& j) { j["corners"][1][2] = 9; }), "corners[1][2]: must be in [-1, 4]");
  EXPECT_EQ(match([](Json& j) { j["corners"][1].push_back(0); }), "corners[1]: must have 3 elements");
  EXPECT_EQ(match([](Json& j) { j["bary"][0][1] = nullptr; }), "bary[0][1]: must be a number");
  EXPECT_EQ(match([](Json& j) { j["candidates"][0]["rotation"].erase(0); }), "candidates[0].rotation: must have 9 elements");
  EXPECT_EQ(match([](Json& j) { j["cached"] = 0; }), "cached: must be true or false");
}

TEST(Json, AProblemMustAgreeWithItsCode) {
  const auto problem = [](const std::function<void(Json&)>& change) { return complaint(sample_problem(), change); };
  EXPECT_EQ(problem([](Json& j) { j["code"] = "bogus"; }), "code: 'bogus' is not a known code");
  for (const char* name : {"type", "title", "instance"}) {
    EXPECT_EQ(problem([&](Json& j) { j[name] = "x"; }), std::string(name) + ": does not agree with the code");
  }
  EXPECT_EQ(problem([](Json& j) { j["status"] = 400; }), "status: does not agree with the code");
  EXPECT_EQ(problem([](Json& j) { j["retryable"] = true; }), "retryable: does not agree with the code");
  EXPECT_EQ(problem([](Json& j) { j["elements"] = Json::array({{{"edge", {1}}}}); }), "elements[0].edge: must have 2 elements");
  EXPECT_EQ(problem([](Json& j) { j["elements"] = Json::array({{{"line", 1}}}); }), "elements[0].edge: is missing");
  EXPECT_EQ(problem([](Json& j) { j["elements"] = Json(std::vector<Json>(21, Json{{"vertex", 1}})); }), "elements: more than 20 elements");
}

TEST(Json, ReadinessIsStrict) {
  EXPECT_THROW((void)from_text<Readiness>(R"({"status":"ok","checks":[]})"), JsonError);
  EXPECT_THROW((void)from_text<Readiness>(R"({"status":"ready","checks":[{"name":"a","ok":1,"detail":""}]})"), JsonError);
  EXPECT_THROW((void)from_text<Readiness>(R"({"status":"ready","checks":[{"name":"a","ok":true,"detail":"","x":1}]})"), JsonError);
}

TEST(Json, TextThatIsNotJsonIsRefused) {
  for (const char* text : {"", "{", "[1]", "null", "{\"status\":\"ok\"} x", "\xff", "{'a':1}"}) {
    EXPECT_THROW((void)from_text<Health>(text), JsonError) << text;
  }
}

}  // namespace
}  // namespace spherematch::api
