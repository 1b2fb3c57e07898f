#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesShapes : public testing::TestService {};

TEST_F(RoutesShapes, AnUploadIsCreatedThenKnown) {
  const HttpResponse first = post("sphere 1", {{"name", "one"}, {"wait", "10"}});
  EXPECT_EQ(first.status, 201);
  EXPECT_EQ(first.content_type, "application/json");
  const api::Shape shape_one = shape(first);
  EXPECT_EQ(header(first, "Location"), "/shapes/" + shape_one.id);
  EXPECT_EQ(shape_one.name, "one");
  EXPECT_EQ(shape_one.state, api::ShapeState::ready);
  EXPECT_EQ(shape_one.vertices, 5);
  EXPECT_EQ(shape_one.repair.dropped_vertices, 1);

  const HttpResponse again = post("sphere 1", {{"name", "other"}, {"wait", "10"}});
  EXPECT_EQ(again.status, 200);
  EXPECT_EQ(shape(again), shape_one);
  EXPECT_EQ(engine.reads, 1);
  EXPECT_EQ(engine.preparations, 1);
}

TEST_F(RoutesShapes, RepairIsPartOfTheIdentity) {
  const std::string fill = shape(post("sphere 1", {{"repair", "fill"}})).id;
  const HttpResponse none = post("sphere 1", {{"repair", "none"}, {"wait", "10"}});
  EXPECT_EQ(none.status, 201);
  EXPECT_NE(shape(none).id, fill);
  EXPECT_EQ(shape(none).repair.mode, "none");
}

TEST_F(RoutesShapes, SimplifyIsPartOfTheIdentity) {
  const api::Shape whole = shape(post("sphere 1", {{"wait", "10"}}));
  EXPECT_EQ(whole.simplified, std::nullopt);
  const HttpResponse response = post("sphere 1", {{"simplify", "500"}, {"wait", "10"}});
  EXPECT_EQ(response.status, 201);
  EXPECT_NE(shape(response).id, whole.id);
  EXPECT_EQ(shape(response).simplified, 4);
  EXPECT_NE(shape(post("sphere 1", {{"simplify", "501"}})).id, shape(response).id);
  for (const char* wrong : {"499", "0", "-1", "", "many", "3000000000"})
    EXPECT_EQ(problem_code(post("sphere 1", {{"simplify", wrong}})), api::Code::invalid_parameter) << wrong;
}

TEST_F(RoutesShapes, WithoutWaitingItIsAcceptedAndShowsItsProgress) {
  engine.hold_preparation = true;
  const HttpResponse response = post("sphere 1", {});
  EXPECT_EQ(response.status, 202);
  const std::string id = shape(response).id;
  wait_for_preparations(1);
  const api::Shape running = shape(get("/shapes/" + id));
  EXPECT_EQ(running.state, api::ShapeState::processing);
  EXPECT_EQ(running.stage, "conformal");
  EXPECT_EQ(running.progress, 0.25);
  EXPECT_EQ(shape(post("sphere 2", {})).state, api::ShapeState::queued);
  engine.hold_preparation = false;
  EXPECT_EQ(post("sphere 1").status, 200);
  EXPECT_EQ(shape(get("/shapes/" + id)).state, api::ShapeState::ready);
}

TEST_F(RoutesShapes, UnusableMeshesAreRefusedAndNotStored) {
  const HttpResponse torus = post("torus");
  EXPECT_EQ(problem_code(torus), api::Code::wrong_genus);
  EXPECT_EQ(torus.status, 422);
  const auto problem = api::from_text<api::Problem>(torus.body);
  EXPECT_EQ(problem.elements, (std::vector<api::Element>{api::EdgeElement{{1, 2}}, api::FaceElement{7}}));
  EXPECT_EQ(problem_code(post("?")), api::Code::unsupported_format);
  EXPECT_EQ(problem_code(post("crowd")), api::Code::too_many_vertices);
  EXPECT_TRUE(api::from_text<api::ShapePage>(get("/shapes").body).items.empty());
}

TEST_F(RoutesShapes, AFailedPreparationIsReportedAndRetriedByAnotherUpload) {
  const HttpResponse first = post("sphere hopeless");
  EXPECT_EQ(first.status, 202);
  ASSERT_EQ(shape(first).state, api::ShapeState::failed);
  EXPECT_EQ(shape(first).error->code, api::Code::parametrization_failed);
  EXPECT_EQ(post("sphere hopeless").status, 202);
  EXPECT_EQ(engine.preparations, 2);
  EXPECT_EQ(engine.reads, 1);
}

TEST_F(RoutesShapes, NamesAndParametersAreChecked) {
  const auto refused = [&](const std::multimap<std::string, std::string>& query) { return problem_code(post("sphere 1", query)); };
  EXPECT_EQ(refused({{"name", std::string(201, 'x')}}), api::Code::invalid_parameter);
  EXPECT_EQ(refused({{"name", "a\nb"}}), api::Code::invalid_parameter);
  EXPECT_EQ(refused({{"repair", "safe"}}), api::Code::invalid_parameter);
  EXPECT_EQ(refused({{"wait", "61"}}), api::Code::invalid_parameter);
  EXPECT_EQ(refused({{"colour", "red"}}), api::Code::invalid_parameter);
  EXPECT_EQ(engine.reads, 0);
}

TEST_F(RoutesShapes, TheFileNameServesAsNameWhereItFits) {
  const auto name = [&](const std::string& body, const std::string& file_name) {
    return shape(call({.method = "POST", .path = "/shapes", .query = {}, .body = body, .file_name = file_name, .headers = {}})).name;
  };
  EXPECT_EQ(name("sphere 1", "cat.off"), "cat.off");
  EXPECT_EQ(name("sphere 2", "../../etc/c\nat.off"), "cat.off");
  EXPECT_EQ(name("sphere 3", "C:\\meshes\\cat.off"), "cat.off");
  EXPECT_EQ(name("sphere 4", std::string(500, 'x')).size(), 200U);
}

TEST_F(RoutesShapes, ListsPagesNewestFirst) {
  for (int i = 0; i < 5; ++i) ready("sphere " + std::to_string(i));
  std::vector<std::string> seen;
  std::multimap<std::string, std::string> query{{"limit", "2"}};
  while (true) {
    const HttpResponse response = get("/shapes", query);
    const auto page = api::from_text<api::ShapePage>(response.body);
    EXPECT_LE(page.items.size(), 2U);
    for (const api::Shape& item : page.items) seen.push_back(item.id);
    EXPECT_EQ(header(response, "Link").empty(), !page.next_cursor.has_value());
    if (!page.next_cursor) break;
    query = {{"limit", "2"}, {"cursor", *page.next_cursor}};
  }
  ASSERT_EQ(seen.size(), 5U);
  EXPECT_EQ(seen.front(), ready("sphere 4"));
  EXPECT_EQ(seen.back(), ready("sphere 0"));
  EXPECT_EQ(problem_code(get("/shapes", {{"cursor", "bogus"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get("/shapes", {{"limit", "0"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get("/shapes", {{"limit", "201"}})), api::Code::invalid_parameter);
}

TEST_F(RoutesShapes, TagsComeWithTheFirstUpload) {
  const HttpResponse first = post("sphere 1", {{"tags", "cat,animal,cat"}, {"wait", "10"}});
  EXPECT_EQ(shape(first).tags, (std::vector<std::string>{"animal", "cat"}));
  EXPECT_EQ(shape(post("sphere 1", {{"tags", "dog"}})).tags, shape(first).tags);
  EXPECT_EQ(problem_code(post("sphere 2", {{"tags", "a b"}})), api::Code::invalid_parameter);
  EXPECT_EQ(engine.reads, 1);
}

TEST_F(RoutesShapes, FiltersSelectAndTheirPagesKeepThem) {
  for (int i = 0; i < 6; ++i) {
    post("sphere " + std::to_string(i),
         {{"name", "Shape & " + std::to_string(i)}, {"tags", i % 2 == 0 ? "even,all" : "all"}, {"wait", "10"}});
  }
  post("sphere hopeless");
  const auto names = [&](const HttpResponse& response) {
    std::vector<std::string> result;
    for (const api::Shape& item : api::from_text<api::ShapePage>(response.body).items) result.push_back(item.name);
    return result;
  };
  const HttpResponse page = get("/shapes", {{"limit", "2"}, {"tag", "even"}, {"q", "shape &"}, {"state", "ready"}});
  EXPECT_EQ(names(page), (std::vector<std::string>{"Shape & 4", "Shape & 2"}));
  const std::string cursor = api::from_text<api::ShapePage>(page.body).next_cursor.value_or("");
  EXPECT_EQ(header(page, "Link"), "</shapes?limit=2&cursor=" + cursor + "&state=ready&tag=even&q=shape%20%26>; rel=\"next\"");
  EXPECT_EQ(names(get("/shapes", {{"cursor", cursor}, {"tag", "even"}})), std::vector<std::string>{"Shape & 0"});

  EXPECT_EQ(names(get("/shapes", {{"state", "failed"}})).size(), 1U);
  EXPECT_EQ(names(get("/shapes", {{"state", "queued"}})).size(), 0U);
  const std::string sha256 = shape(post("sphere 3")).sha256;
  std::string capitals = sha256;
  for (char& c : capitals) c = c >= 'a' ? static_cast<char>(c - 'a' + 'A') : c;
  EXPECT_EQ(names(get("/shapes", {{"sha256", sha256}})), std::vector<std::string>{"Shape & 3"});
  EXPECT_EQ(names(get("/shapes", {{"sha256", capitals}})), std::vector<std::string>{"Shape & 3"});
  EXPECT_EQ(names(get("/shapes", {{"state", ""}, {"tag", ""}, {"q", ""}, {"sha256", ""}})).size(), 7U);
  for (const auto& [name, value] :
       {std::pair("state", "done"), std::pair("tag", "a b"), std::pair("sha256", "abc"), std::pair("name", "Shape")}) {
    EXPECT_EQ(problem_code(get("/shapes", {{name, value}})), api::Code::invalid_parameter) << name;
  }
}

TEST_F(RoutesShapes, AnUploadIsReadAgainAsWhatItWasRecognised) {
  // The file name alone tells the format, and the shape has another name.
  const HttpResponse response = call({.method = "POST",
                                      .path = "/shapes",
                                      .query = {{"name", "leg"}, {"wait", "10"}},
                                      .body = "sphere 1",
                                      .file_name = "scan.STL",
                                      .headers = {}});
  (void)shapes->load_mesh(shape(response).id);
  EXPECT_EQ(engine.mesh_name, ".stl");
  EXPECT_EQ(shapes->load_upload(shape(response).id).format, "stl");
}

TEST_F(RoutesShapes, UnknownShapesAreNotFound) {
  for (const std::string& id : {std::string(32, '0'), std::string("x"), std::string(5000, 'a'), std::string("'; drop table")}) {
    EXPECT_EQ(problem_code(get("/shapes/" + id)), api::Code::not_found);
    EXPECT_EQ(problem_code(get("/shapes/" + id + "/sphere")), api::Code::not_found);
    EXPECT_EQ(problem_code(remove(id)), api::Code::not_found);
  }
}

TEST_F(RoutesShapes, ATagSparesTheBody) {
  const std::string id = ready("sphere 1");
  for (const std::string& path : {"/shapes/" + id, "/shapes/" + id + "/sphere"}) {
    const HttpResponse whole = get(path);
    const std::string tag = header(whole, "ETag");
    ASSERT_FALSE(tag.empty());
    const HttpResponse spared =
        call({.method = "GET", .path = path, .query = {}, .body = {}, .file_name = {}, .headers = {{"if-none-match", tag}}});
    EXPECT_EQ(spared.status, 304);
    EXPECT_EQ(spared.body, "");
    EXPECT_EQ(header(spared, "ETag"), tag);
  }
}

TEST_F(RoutesShapes, TheTagOfAShapeFollowsItsState) {
  engine.hold_preparation = true;
  const std::string id = shape(post("sphere 1", {})).id;
  wait_for_preparations(1);
  const std::string before = header(get("/shapes/" + id), "ETag");
  engine.hold_preparation = false;
  post("sphere 1");
  EXPECT_NE(header(get("/shapes/" + id), "ETag"), before);
}

TEST_F(RoutesShapes, DeletingRemovesAndCancels) {
  const std::string done = ready("sphere 1");
  EXPECT_EQ(remove(done).status, 204);
  EXPECT_EQ(problem_code(get("/shapes/" + done)), api::Code::not_found);
  EXPECT_EQ(problem_code(remove(done)), api::Code::not_found);

  engine.hold_preparation = true;
  const std::string running = shape(post("sphere 2", {})).id;
  wait_for_preparations(2);
  EXPECT_EQ(remove(running).status, 204);
  while (engine.cancellations < 1) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  engine.hold_preparation = false;
  EXPECT_EQ(post("sphere 2").status, 201);
  EXPECT_EQ(engine.preparations, 3);
}

}  // namespace
}  // namespace spherematch
