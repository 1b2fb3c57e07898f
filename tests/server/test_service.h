// A store in a directory of its own, a stub engine, and the services and routes above them, without HTTP.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <memory>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <system_error>

#include "api/json.h"
#include "server/server_context.h"
#include "tests/server/stub_engine.h"

namespace spherematch::testing {

class TestService : public ::testing::Test {
 protected:
  TestService() {
    std::string pattern = (std::filesystem::temp_directory_path() / "spherematch-server-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) throw std::system_error(errno, std::generic_category(), "mkdtemp");
    directory = pattern;
    start();
  }
  ~TestService() override {
    engine.hold_matches = false;
    stop();
    std::error_code ignored;
    std::filesystem::remove_all(directory, ignored);
  }

  void start(ShapeServiceSettings settings = {}) {
    settings.pause_after_loss = std::chrono::milliseconds(0);
    stop_source = std::stop_source();
    store = std::make_unique<ShapeStore>(directory / "store.db");
    shapes = std::make_unique<ShapeService>(*store, engine, settings);
    matches = std::make_unique<Gate>("matches", 1, 1);
    match_store = std::make_unique<MatchStore>(*store, match_store_bytes);
    match_service = std::make_unique<MatchService>(*shapes, *match_store, engine, *matches, stop_source.get_token(), match_settings);
    jobs = std::make_unique<JobStore>(*store);
    match_jobs = std::make_unique<MatchJobs>(*jobs, *shapes, *match_service, job_settings);
    context = std::make_unique<ServerContext>(
        ServerContext{options, "1.2.3", engine, *shapes, *matches, *match_service, *match_jobs, *jobs, stop_source.get_token()});
    router = std::make_unique<Router>();
    add_shape_routes(*router, *context);
    add_derived_routes(*router, *context);
    add_thumbnail_routes(*router, *context);
    add_match_routes(*router, *context);
    add_match_post_routes(*router, *context);
    add_evaluation_routes(*router, *context);
    add_transfer_routes(*router, *context);
    add_scene_routes(*router, *context);
    add_job_routes(*router, *context);
    add_page_routes(*router);
    add_docs_routes(*router);
    add_system_routes(*router, *context);
  }
  void stop() {
    stop_source.request_stop();
    if (matches) matches->close();
    if (match_jobs) match_jobs->stop();
    if (shapes) shapes->stop();
    router.reset();
    context.reset();
    match_jobs.reset();
    jobs.reset();
    match_service.reset();
    match_store.reset();
    matches.reset();
    shapes.reset();
    store.reset();
  }

  struct Call {
    std::string method = "GET";
    std::string path;
    std::multimap<std::string, std::string> query;
    std::string body;
    std::string file_name;
    std::map<std::string, std::string> headers;
  };
  HttpResponse call(const Call& call) {
    HttpRequest request;
    request.method = call.method;
    request.path = call.path;
    request.query = call.query;
    request.headers = call.headers;
    request.request_id = "test";
    return router->handle(request, [&](HttpRequest& r, Body) {
      r.body.bytes = call.body;
      r.body.file_name = call.file_name;
    });
  }
  HttpResponse get(const std::string& path, const std::multimap<std::string, std::string>& query = {}) {
    return call({.method = "GET", .path = path, .query = query, .body = {}, .file_name = {}, .headers = {}});
  }
  HttpResponse post(const std::string& body, std::multimap<std::string, std::string> query = {{"wait", "10"}}) {
    return call({.method = "POST", .path = "/shapes", .query = std::move(query), .body = body, .file_name = {}, .headers = {}});
  }
  HttpResponse post_json(const std::string& path, const std::string& body) {
    return call({.method = "POST", .path = path, .query = {}, .body = body, .file_name = {}, .headers = {}});
  }
  HttpResponse remove(const std::string& id) {
    return call({.method = "DELETE", .path = "/shapes/" + id, .query = {}, .body = {}, .file_name = {}, .headers = {}});
  }
  /// Uploads, expects it to be ready, returns the id.
  std::string ready(const std::string& body) {
    const HttpResponse response = post(body);
    EXPECT_LT(response.status, 202) << response.body;
    return api::from_text<api::Shape>(response.body).id;
  }
  void wait_for_preparations(int count) const {
    while (engine.preparations < count) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  }

  static api::Shape shape(const HttpResponse& response) { return api::from_text<api::Shape>(response.body); }
  static api::Code problem_code(const HttpResponse& response) {
    const auto problem = api::from_text<api::Problem>(response.body);
    EXPECT_EQ(api::entry_of(problem.code).status, response.status);
    return problem.code;
  }
  static std::string header(const HttpResponse& response, const std::string& name) {
    for (const auto& [key, value] : response.headers) {
      if (key == name) return value;
    }
    return {};
  }

  std::filesystem::path directory;
  ServerOptions options;
  StubEngine engine;
  std::stop_source stop_source;
  std::unique_ptr<ShapeStore> store;
  std::unique_ptr<ShapeService> shapes;
  std::unique_ptr<Gate> matches;
  std::size_t match_store_bytes = std::size_t{1} << 20;
  MatchServiceSettings match_settings;
  MatchJobsSettings job_settings{.workers = 1, .retry_after = std::chrono::milliseconds(20)};
  std::unique_ptr<MatchStore> match_store;
  std::unique_ptr<MatchService> match_service;
  std::unique_ptr<JobStore> jobs;
  std::unique_ptr<MatchJobs> match_jobs;
  std::unique_ptr<ServerContext> context;
  std::unique_ptr<Router> router;
};

}  // namespace spherematch::testing
