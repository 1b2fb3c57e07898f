#include <cstring>

#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesMatch : public testing::TestService {
 protected:
  std::string src = ready("sphere a");
  std::string tgt = ready("sphere b");

  HttpResponse match(std::multimap<std::string, std::string> query = {}, std::map<std::string, std::string> headers = {}) {
    query.emplace("src", src);
    query.emplace("tgt", tgt);
    return call({.method = "GET", .path = "/match", .query = std::move(query), .body = {}, .file_name = {}, .headers = std::move(headers)});
  }
};

TEST_F(RoutesMatch, JsonCarriesTheSelectedFields) {
  const HttpResponse plain = match();
  EXPECT_EQ(plain.status, 200);
  EXPECT_EQ(plain.content_type, "application/json");
  EXPECT_EQ(header(plain, "Server-Timing"), "cache;desc=computed, rotation;dur=125.0, total;dur=125.0");
  const auto result = api::from_text<api::Match>(plain.body);
  EXPECT_EQ(result.src, src);
  EXPECT_EQ(result.tgt, tgt);
  EXPECT_EQ(result.n_src, 5);
  EXPECT_EQ(result.n_tgt, 5);
  EXPECT_EQ(*result.vertex, (std::vector<std::int32_t>{1, 2, 3, 0, -1}));
  EXPECT_FALSE(result.corners || result.bary);
  EXPECT_FALSE(result.cached);
  EXPECT_EQ(result.engine, "stub-1");

  const auto whole = api::from_text<api::Match>(match({{"fields", "vertex,corners,bary"}}).body);
  EXPECT_EQ(whole.corners->at(0), (std::array<std::int32_t, 3>{1, 0, 1}));
  EXPECT_EQ(whole.bary->at(3), (std::array<float, 3>{0.5F, 0.3F, 0.2F}));
  EXPECT_TRUE(whole.cached);
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(RoutesMatch, BothDirectionsOfOneRegistration) {
  const auto judged = api::from_text<api::Match>(match({{"both", "yes"}, {"fields", "confidence"}}).body);
  EXPECT_EQ(judged.confidence->size(), 5U);
  EXPECT_EQ(judged.reverse->confidence->size(), 5U);
  EXPECT_FALSE(judged.distortion || judged.vertex);

  const auto both = api::from_text<api::Match>(match({{"both", "yes"}, {"fields", "vertex"}}).body);
  ASSERT_TRUE(both.reverse);
  EXPECT_EQ(both.reverse->n_src, 5);
  EXPECT_EQ(both.reverse->vertex->size(), 5U);
  const std::string npz = match({{"both", "yes"}, {"format", "npz"}}).body;
  for (const char* name : {"vertex.npy", "reverse_vertex.npy", "reverse_corners.npy", "reverse_bary.npy"}) {
    EXPECT_NE(npz.find(name), std::string::npos) << name;
  }
  EXPECT_EQ(engine.matches, 1);
  EXPECT_EQ(match({{"format", "npz"}}).body.find("reverse_"), std::string::npos);
  for (const char* format : {"npy", "txt", "ply", "png"})
    EXPECT_EQ(problem_code(match({{"both", "yes"}, {"format", format}})), api::Code::invalid_parameter);
  EXPECT_NE(header(match({{"both", "yes"}}), "ETag"), header(match(), "ETag"));
}

TEST_F(RoutesMatch, FilesTakeConfidenceAndDistortionBesideTheMap) {
  const auto has = [](const HttpResponse& response, const char* name) { return response.body.find(name) != std::string::npos; };
  for (const char* format : {"npz", "ply"}) {
    const HttpResponse plain = match({{"format", format}});
    EXPECT_FALSE(has(plain, "confidence") || has(plain, "distortion"));
    const HttpResponse one = match({{"format", format}, {"fields", "distortion"}});
    EXPECT_TRUE(has(one, "distortion") && !has(one, "confidence"));
    const HttpResponse two = match({{"format", format}, {"fields", "distortion,confidence"}});
    EXPECT_TRUE(has(two, "distortion") && has(two, "confidence"));
    EXPECT_EQ(two.body, match({{"format", format}, {"fields", "confidence,distortion"}}).body);

    // A variant each, of one result.
    EXPECT_NE(header(one, "ETag"), header(plain, "ETag"));
    EXPECT_NE(header(two, "ETag"), header(one, "ETag"));
    EXPECT_EQ(match({{"format", format}, {"fields", "confidence,distortion"}}, {{"if-none-match", header(two, "ETag")}}).status, 304);
    EXPECT_EQ(match({{"format", format}, {"fields", "confidence"}}, {{"if-none-match", header(two, "ETag")}}).status, 200);

    const HttpResponse symmetry = get("/shapes/" + src + "/symmetry", {{"format", format}, {"fields", "confidence"}});
    EXPECT_TRUE(has(symmetry, "confidence") && !has(symmetry, "distortion"));
    const HttpResponse named = match({{"format", format}, {"fields", "vertex,confidence"}});
    EXPECT_EQ(problem_code(named), api::Code::invalid_parameter);
    EXPECT_TRUE(has(named, "have their map whole"));
  }
  EXPECT_EQ(engine.matches, 2);  // and the symmetry

  const HttpResponse both = match({{"format", "npz"}, {"fields", "confidence"}, {"both", "yes"}});
  EXPECT_TRUE(has(both, "reverse_confidence.npy"));
  EXPECT_FALSE(has(both, "distortion"));
  for (const char* format : {"npy", "txt", "map", "glb", "obj", "png"}) {
    const HttpResponse refused = match({{"format", format}, {"fields", "confidence"}});
    EXPECT_EQ(problem_code(refused), api::Code::invalid_parameter);
    EXPECT_TRUE(has(refused, "json, npz and ply only"));
  }
}

TEST_F(RoutesMatch, EveryRepresentationByParameterAndByHeader) {
  (void)match();  // so that "cached" is true in what follows
  for (const auto& [format, type] : {std::pair{"json", "application/json"},
                                     {"npz", "application/x-npz"},
                                     {"npy", "application/x-npy"},
                                     {"txt", "text/plain"},
                                     {"ply", "application/x-ply"},
                                     {"glb", "model/gltf-binary"},
                                     {"obj", "model/obj"},
                                     {"png", "image/png"}}) {
    const HttpResponse by_parameter = match({{"format", format}});
    const HttpResponse by_header = match({}, {{"accept", type}});
    EXPECT_EQ(by_parameter.content_type, type);
    EXPECT_EQ(by_parameter.body, by_header.body);
    EXPECT_EQ(by_parameter.status, 200) << format;
    EXPECT_EQ(header(by_parameter, "ETag"), header(by_header, "ETag"));
    EXPECT_EQ(header(by_parameter, "Vary"), "Accept");
  }
  EXPECT_EQ(match({{"format", "txt"}}).body, "1\n2\n3\n0\n-1\n");
  EXPECT_EQ(match({{"format", "map"}}).body, "2\n3\n4\n1\n0\n");
  EXPECT_EQ(match({{"format", "map"}}).content_type, "text/plain");
  EXPECT_NE(header(match({{"format", "map"}}), "ETag"), header(match({{"format", "txt"}}), "ETag"));
  EXPECT_EQ(match({{"format", "npz"}}).body.substr(0, 2), "PK");
  std::int32_t vertex[5];
  const std::string npy = match({{"format", "npy"}}).body;
  std::memcpy(vertex, npy.data() + npy.size() - sizeof vertex, sizeof vertex);
  EXPECT_EQ(vertex[2], 3);
}

TEST_F(RoutesMatch, MeshesAreTheUploadedSourceInTheColorsOfItsImages) {
  const std::string obj = match({{"format", "obj"}}).body;
  // Vertex 0 goes to 0.5 v1 + 0.3 v0 + 0.2 v1 of the tetrahedron, vertex 4 was dropped.
  EXPECT_NE(obj.find("\nv 1 1 1 1.0000 0.3020 0.3020\n"), std::string::npos) << obj;
  EXPECT_NE(obj.find("\nv 0 0 0 0.5020 0.5020 0.5020\n"), std::string::npos) << obj;
  EXPECT_NE(obj.find("\nf 2 4 3\n"), std::string::npos) << obj;
  EXPECT_TRUE(match({{"format", "ply"}}).body.starts_with("ply\n"));
  EXPECT_TRUE(match({{"format", "glb"}}).body.starts_with("glTF"));
  EXPECT_TRUE(match({{"format", "png"}}).body.starts_with("\x89PNG"));
}

TEST_F(RoutesMatch, AShapeRemovedDuringTheMatchDoesNotSpoilItsMesh) {
  engine.hold_matches = true;
  std::jthread client([this] { EXPECT_EQ(match({{"format", "ply"}}).status, 200); });
  while (engine.matches < 1) std::this_thread::yield();
  EXPECT_EQ(remove(src).status, 204);
  engine.hold_matches = false;
}

TEST_F(RoutesMatch, ParametersAreChecked) {
  EXPECT_EQ(problem_code(match({{"bogus", "1"}})), api::Code::invalid_parameter);
  EXPECT_NE(match({{"bogus", "1"}}).body.find("src, tgt, format, fields, wait, cache, method, refine, orientation, hints, both"),
            std::string::npos);
  EXPECT_EQ(problem_code(match({{"format", "exe"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(match({{"fields", "faces"}})), api::Code::invalid_parameter);
  EXPECT_NE(match({{"format", "exe"}}).body.find("json, npz, npy, txt, map, ply, glb, obj, png"), std::string::npos);
  for (const char* format : {"npz", "ply", "glb", "obj", "png"})
    EXPECT_EQ(problem_code(match({{"fields", "vertex"}, {"format", format}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(match({{"cache", "maybe"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(match({{"method", "best"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(match({{"refine", "more"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(match({{"wait", "-1"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(match({}, {{"accept", "image/gif"}})), api::Code::not_acceptable);
  EXPECT_EQ(problem_code(get("/match", {{"src", src}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get("/match", {{"src", src}, {"tgt", std::string(32, '0')}})), api::Code::not_found);
  EXPECT_EQ(engine.matches, 0);
  EXPECT_EQ(match({{"cache", "no"}}).status, 200);
}

TEST_F(RoutesMatch, MethodSelectsTheParameters) {
  const auto scored = [&](const std::string& method) {
    return api::from_text<api::Match>(match({{"method", method}}).body).candidates.at(0).score;
  };
  EXPECT_EQ(scored("default"), 0);
  EXPECT_EQ(scored("paper"), 1);
  EXPECT_NE(header(match({{"method", "paper"}}), "ETag"), header(match(), "ETag"));
}

TEST_F(RoutesMatch, AnUnrefinedMapIsAnotherResult) {
  const std::string tag = header(match(), "ETag");
  EXPECT_EQ(header(match({{"refine", "default"}}), "ETag"), tag);
  EXPECT_EQ(engine.matches, 1);
  EXPECT_NE(header(match({{"refine", "none"}}), "ETag"), tag);
  EXPECT_EQ(engine.matches, 2);
  // The paper's method has no refinement.
  EXPECT_EQ(header(match({{"method", "paper"}, {"refine", "none"}}), "ETag"), header(match({{"method", "paper"}}), "ETag"));
  EXPECT_EQ(engine.matches, 3);
}

TEST_F(RoutesMatch, AnotherCandidateIsAnotherResult) {
  const auto best = api::from_text<api::Match>(match().body), next = api::from_text<api::Match>(match({{"candidate", "1"}}).body);
  EXPECT_EQ(best.candidate, 0);
  EXPECT_EQ(next.candidate, 1);
  EXPECT_EQ(engine.matches, 2);
  EXPECT_EQ(header(match({{"candidate", "0"}}), "ETag"), header(match(), "ETag"));
  EXPECT_NE(header(match({{"candidate", "1"}}), "ETag"), header(match(), "ETag"));
  // The engine alone knows how many there are.
  const HttpResponse missing = match({{"candidate", "2"}});
  EXPECT_EQ(problem_code(missing), api::Code::invalid_parameter);
  EXPECT_NE(missing.body.find("candidate: there is no candidate 2"), std::string::npos) << missing.body;
  EXPECT_EQ(problem_code(match({{"candidate", "8"}})), api::Code::invalid_parameter);
  EXPECT_EQ(get("/shapes/" + src + "/symmetry", {{"candidate", "1"}}).status, 200);
}

TEST_F(RoutesMatch, TheSymmetryIsTheMatchWithTheMirrorImage) {
  const std::string path = "/shapes/" + src + "/symmetry";
  const auto symmetry = api::from_text<api::Match>(get(path, {{"fields", "vertex,bary"}}).body);
  EXPECT_EQ(symmetry.src, src);
  EXPECT_EQ(symmetry.tgt, src);
  EXPECT_EQ(symmetry.n_tgt, 5);
  EXPECT_EQ(symmetry.orientation, "reverse");
  EXPECT_EQ(symmetry.vertex->size(), 5U);
  EXPECT_TRUE(symmetry.bary && !symmetry.corners);
  EXPECT_FALSE(symmetry.cached);
  EXPECT_TRUE(engine.same_shape);

  // One result, under either name, in every format.
  const std::multimap<std::string, std::string> as_match{{"src", src}, {"tgt", src}, {"orientation", "reverse"}};
  for (const char* format : {"json", "npz", "npy", "txt", "map", "ply", "glb", "obj", "png"}) {
    auto query = as_match;
    query.emplace("format", format);
    const HttpResponse by_name = get(path, {{"format", format}}), by_match = get("/match", query);
    EXPECT_EQ(by_name.status, 200) << by_name.body;
    EXPECT_EQ(by_name.body, by_match.body) << format;
    EXPECT_EQ(header(by_name, "ETag"), header(by_match, "ETag"));
  }
  EXPECT_EQ(engine.matches, 1);
  const std::string tag = header(get(path), "ETag");
  EXPECT_EQ(call({.method = "GET", .path = path, .query = {}, .body = {}, .file_name = {}, .headers = {{"if-none-match", tag}}}).status,
            304);
  EXPECT_EQ(get(path, {{"cache", "no"}}).status, 200);
  EXPECT_EQ(engine.matches, 2);
  EXPECT_EQ(get(path, {{"hints", "0:1"}}).status, 200);
  EXPECT_EQ(get(path, {{"method", "paper"}}).status, 200);
  EXPECT_EQ(get(path, {{"refine", "none"}}).status, 200);
  EXPECT_EQ(engine.matches, 5);
}

TEST_F(RoutesMatch, ASymmetryIsRefusedLikeAMatch) {
  const std::string path = "/shapes/" + src + "/symmetry";
  for (const auto& [name, value] : {std::pair("bogus", "1"), std::pair("src", "x"), std::pair("orientation", "any"),
                                    std::pair("both", "yes"), std::pair("format", "exe"), std::pair("hints", "1")}) {
    EXPECT_EQ(problem_code(get(path, {{name, value}})), api::Code::invalid_parameter) << name;
  }
  EXPECT_EQ(problem_code(get(path, {{"format", "npz"}, {"fields", "bary"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get("/shapes/" + std::string(32, '0') + "/symmetry")), api::Code::not_found);
  EXPECT_EQ(problem_code(get("/shapes/" + shape(post("sphere hopeless")).id + "/symmetry")), api::Code::shape_failed);
  engine.hold_preparation = true;
  const std::string unfinished = shape(post("sphere c", {})).id;
  EXPECT_EQ(problem_code(get("/shapes/" + unfinished + "/symmetry", {{"wait", "0"}})), api::Code::shape_not_ready);
  engine.hold_preparation = false;
  EXPECT_EQ(get("/shapes/" + unfinished + "/symmetry").status, 200);
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(RoutesMatch, ATagSparesTheComputation) {
  const std::string tag = header(match({{"format", "npz"}}), "ETag");
  EXPECT_EQ(engine.matches, 1);
  const HttpResponse spared = match({{"format", "npz"}}, {{"if-none-match", tag}});
  EXPECT_EQ(spared.status, 304);
  EXPECT_EQ(spared.body, "");
  EXPECT_EQ(header(spared, "ETag"), tag);
  EXPECT_EQ(engine.matches, 1);
}

TEST_F(RoutesMatch, TheTagTellsResultsApart) {
  const std::string plain = header(match(), "ETag");
  EXPECT_EQ(header(match({{"wait", "3"}}), "ETag"), plain);
  EXPECT_EQ(header(match({{"cache", "no"}}), "ETag"), plain);
  EXPECT_EQ(header(match({{"fields", "vertex"}}), "ETag"), plain);
  EXPECT_NE(header(match({{"fields", "bary"}}), "ETag"), plain);
  EXPECT_NE(header(match({{"format", "npz"}}), "ETag"), plain);
  std::swap(src, tgt);
  EXPECT_NE(header(match(), "ETag"), plain);
  std::swap(src, tgt);
  engine.version_text = "stub-2";
  EXPECT_NE(header(match(), "ETag"), plain);
}

TEST_F(RoutesMatch, WaitsForAPreparationThenGivesUp) {
  engine.hold_preparation = true;
  tgt = shape(post("sphere c", {})).id;
  const HttpResponse early = match({{"wait", "0.05"}});
  EXPECT_EQ(problem_code(early), api::Code::shape_not_ready);
  EXPECT_EQ(header(early, "Retry-After"), "1");
  std::jthread opener([this] {
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
    engine.hold_preparation = false;
  });
  EXPECT_EQ(match({{"wait", "10"}}).status, 200);
}

TEST_F(RoutesMatch, AFailedShapeCannotBeMatched) {
  tgt = shape(post("sphere hopeless")).id;
  const HttpResponse response = match();
  EXPECT_EQ(problem_code(response), api::Code::shape_failed);
  EXPECT_NE(response.body.find("three flipped triangles remain"), std::string::npos);
}

TEST_F(RoutesMatch, ShapesOfAnOlderEngineArePreparedAgain) {
  EXPECT_EQ(engine.preparations, 2);
  engine.version_text = "stub-2";
  const HttpResponse response = match({{"wait", "10"}});
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(api::from_text<api::Match>(response.body).engine, "stub-2");
  EXPECT_EQ(engine.preparations, 4);
  EXPECT_EQ(shape(get("/shapes/" + src)).engine, "stub-2");
}

TEST_F(RoutesMatch, TooManyAtOnceAreTurnedAway) {
  engine.hold_matches = true;  // one slot, one place to wait
  std::jthread first([this] { EXPECT_EQ(match().status, 200); });
  while (matches->counts().inside < 1) std::this_thread::yield();
  std::jthread second([this] { EXPECT_EQ(get("/match", {{"src", tgt}, {"tgt", src}}).status, 200); });
  while (matches->counts().waiting < 1) std::this_thread::yield();
  const HttpResponse third = get("/match", {{"src", src}, {"tgt", src}});
  EXPECT_EQ(problem_code(third), api::Code::overloaded);
  EXPECT_EQ(header(third, "Retry-After"), "2");
  const auto health = api::from_text<api::Health>(get("/healthz").body);
  EXPECT_EQ(health.matches_running, 1);
  EXPECT_EQ(health.matches_waiting, 1);
  engine.hold_matches = false;
}

TEST_F(RoutesMatch, StoppingCancelsWhatRuns) {
  engine.hold_matches = true;
  std::jthread first([this] { EXPECT_EQ(problem_code(match()), api::Code::cancelled); });
  while (engine.matches < 1) std::this_thread::yield();
  stop_source.request_stop();
}

}  // namespace
}  // namespace spherematch
