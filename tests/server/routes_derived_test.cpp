#include <cmath>
#include <cstring>

#include "engine/io/mesh_reader.h"
#include "tests/server/test_service.h"

namespace spherematch {
namespace {

class RoutesDerived : public testing::TestService {
 protected:
  HttpResponse get_accepting(const std::string& path, const std::string& accept) {
    return call({.method = "GET", .path = path, .query = {}, .body = {}, .file_name = {}, .headers = {{"accept", accept}}});
  }
};

TEST_F(RoutesDerived, TheSphereHasOneRowPerUploadedVertex) {
  const HttpResponse response = get("/shapes/" + ready("sphere 1") + "/sphere", {{"format", "npy"}});
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.content_type, "application/x-npy");
  ASSERT_GT(response.body.size(), 15 * sizeof(double));
  EXPECT_NE(response.body.find("(5, 3)"), std::string::npos);
  double rows[5][3];
  std::memcpy(rows, response.body.data() + response.body.size() - sizeof rows, sizeof rows);
  EXPECT_NEAR(rows[1][0], 1 / std::sqrt(3), 1e-15);
  EXPECT_NEAR(rows[1][1], -1 / std::sqrt(3), 1e-15);
  for (const double value : rows[4]) EXPECT_TRUE(std::isnan(value));
  EXPECT_EQ(problem_code(get("/shapes/" + ready("sphere 1") + "/sphere", {{"format", "json"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(call({.method = "GET",
                               .path = "/shapes/" + ready("sphere 1") + "/sphere",
                               .query = {},
                               .body = {},
                               .file_name = {},
                               .headers = {{"accept", "image/png"}}})),
            api::Code::not_acceptable);
}

TEST_F(RoutesDerived, TheSphereOfAnUnfinishedShapeIsAConflict) {
  engine.hold_preparation = true;
  const std::string id = shape(post("sphere 1", {})).id;
  EXPECT_EQ(problem_code(get("/shapes/" + id + "/sphere")), api::Code::shape_not_ready);
  engine.hold_preparation = false;
  EXPECT_EQ(get("/shapes/" + id + "/sphere", {{"wait", "10"}}).status, 200);
}

TEST_F(RoutesDerived, TheSphereAsPlyHasTheUploadedPolygons) {
  const HttpResponse response = get("/shapes/" + ready("sphere 1") + "/sphere", {{"format", "ply"}});
  EXPECT_EQ(response.status, 200);
  EXPECT_EQ(response.content_type, "application/x-ply");
  EXPECT_NE(response.body.find("element vertex 5\nproperty double x"), std::string::npos);
  const std::size_t rows = response.body.find("end_header\n") + 11;
  EXPECT_EQ(response.body.size(), rows + 5 * 24 + 4 * 13);
  double last[3];
  std::memcpy(last, response.body.data() + rows + 4 * 24, sizeof last);
  for (const double value : last) EXPECT_TRUE(std::isnan(value));
}

TEST_F(RoutesDerived, TheOriginalIsTheUploadByteForByte) {
  const std::string body = "sphere \xFF\r\n end";
  const std::string id = ready(body);
  for (const HttpResponse& response : {get("/shapes/" + id + "/mesh"), get("/shapes/" + id + "/mesh", {{"format", "original"}}),
                                       get_accepting("/shapes/" + id + "/mesh", "text/html, */*;q=0.8")}) {
    EXPECT_EQ(response.status, 200);
    EXPECT_EQ(response.body, body);
    EXPECT_EQ(response.content_type, "application/octet-stream");
    EXPECT_EQ(header(response, "Vary"), "Accept");
  }
}

TEST_F(RoutesDerived, TheOriginalHasTheMediaTypeOfItsFormat) {
  const auto type = [&](const std::string& body, const std::string& file_name) {
    const HttpResponse posted =
        call({.method = "POST", .path = "/shapes", .query = {}, .body = body, .file_name = file_name, .headers = {}});
    return get("/shapes/" + shape(posted).id + "/mesh").content_type;
  };
  EXPECT_EQ(type("sphere 1", "a.stl"), "model/stl");
  EXPECT_EQ(type("sphere 2", "a.OBJ"), "model/obj");
  EXPECT_EQ(type("sphere 3", "a.gltf"), "model/gltf+json");
  EXPECT_EQ(type("sphere 4", "a.GLB"), "model/gltf-binary");
  EXPECT_EQ(type("sphere 5", "a"), "application/octet-stream");
}

TEST_F(RoutesDerived, TheMeshComesInEveryFormatAlsoBeforeItIsPrepared) {
  engine.hold_preparation = true;
  const std::string id = shape(post("sphere 1", {})).id;
  for (const auto& [format, type] :
       {std::pair("off", "application/x-off"), std::pair("obj", "model/obj"), std::pair("ply", "application/x-ply"),
        std::pair("stl", "model/stl"), std::pair("glb", "model/gltf-binary")}) {
    const HttpResponse response = get("/shapes/" + id + "/mesh", {{"format", format}});
    EXPECT_EQ(response.status, 200) << response.body;
    EXPECT_EQ(response.content_type, type);
    const PolygonMesh mesh = read_mesh(std::as_bytes(std::span(response.body)), "");
    EXPECT_EQ(mesh.vertex_count(), std::string_view(format) == "stl" ? 4 : 5) << format;  // STL has no vertex without a face
    EXPECT_EQ(mesh.face_count(), 4) << format;
    EXPECT_EQ(get_accepting("/shapes/" + id + "/mesh", type).body, response.body);
  }
  engine.hold_preparation = false;
  EXPECT_EQ(problem_code(get("/shapes/" + id + "/mesh", {{"format", "gltf"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get("/shapes/" + id + "/mesh", {{"wait", "1"}})), api::Code::invalid_parameter);
  EXPECT_EQ(problem_code(get_accepting("/shapes/" + id + "/mesh", "image/png")), api::Code::not_acceptable);
}

TEST_F(RoutesDerived, AFailedShapeStillHasItsMesh) {
  const std::string id = shape(post("sphere hopeless")).id;
  EXPECT_EQ(get("/shapes/" + id + "/mesh").body, "sphere hopeless");
  EXPECT_EQ(problem_code(get("/shapes/" + id + "/hks")), api::Code::shape_failed);
}

TEST_F(RoutesDerived, TheSignalsComeWithTheirTimes) {
  const std::string id = ready("sphere 1");
  const HttpResponse npz = get("/shapes/" + id + "/hks");
  EXPECT_EQ(npz.content_type, "application/x-npz");
  EXPECT_TRUE(npz.body.starts_with("PK"));
  EXPECT_NE(npz.body.find("times.npy"), std::string::npos);
  EXPECT_NE(npz.body.find("grids.npy"), std::string::npos);
  const HttpResponse npy = get("/shapes/" + id + "/hks", {{"format", "npy"}});
  EXPECT_EQ(npy.content_type, "application/x-npy");
  EXPECT_NE(npy.body.find("'<f4', 'fortran_order': False, 'shape': (1, 4, 4)"), std::string::npos);
  engine.hold_preparation = true;
  EXPECT_EQ(problem_code(get("/shapes/" + shape(post("sphere 2", {})).id + "/hks")), api::Code::shape_not_ready);
  engine.hold_preparation = false;
}

TEST_F(RoutesDerived, ATagSparesTheBodyAndNamesTheRepresentation) {
  const std::string id = ready("sphere 1");
  std::set<std::string> tags;
  for (const auto& [part, formats] : std::vector<std::pair<std::string, std::vector<std::string>>>{
           {"mesh", {"original", "off", "obj", "ply", "stl", "glb"}}, {"sphere", {"npy", "ply"}}, {"hks", {"npz", "npy"}}}) {
    for (const std::string& format : formats) {
      const std::string path = "/shapes/" + id + "/" + part;
      const HttpResponse whole = get(path, {{"format", format}});
      const std::string tag = header(whole, "ETag");
      EXPECT_TRUE(tags.insert(tag).second) << path << format;
      const HttpResponse spared = call(
          {.method = "GET", .path = path, .query = {{"format", format}}, .body = {}, .file_name = {}, .headers = {{"if-none-match", tag}}});
      EXPECT_EQ(spared.status, 304);
      EXPECT_EQ(spared.body + spared.content_type, "");
      EXPECT_EQ(header(spared, "ETag"), tag);
      EXPECT_EQ(header(spared, "Cache-Control"), "private, no-cache");
    }
  }
  EXPECT_EQ(tags.size(), 10U);
}

TEST_F(RoutesDerived, UnknownShapesAreNotFound) {
  for (const char* part : {"mesh", "sphere", "hks"}) {
    EXPECT_EQ(problem_code(get("/shapes/" + std::string(32, '0') + "/" + part)), api::Code::not_found);
    EXPECT_EQ(problem_code(get(std::string("/shapes/x/") + part)), api::Code::not_found);
  }
}

}  // namespace
}  // namespace spherematch
