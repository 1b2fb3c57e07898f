#include "server/problem.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "api/json.h"

namespace spherematch {
namespace {

template <typename Error>
ProblemError described(const Error& error) {
  return problem_of(std::make_exception_ptr(error));
}

constexpr std::array<std::pair<ErrorCode, std::string_view>, 15> engine_codes{{
    {ErrorCode::malformed_mesh, "malformed-mesh"},
    {ErrorCode::unsupported_format, "unsupported-format"},
    {ErrorCode::compressed_geometry, "compressed-geometry"},
    {ErrorCode::external_reference, "external-reference"},
    {ErrorCode::too_many_vertices, "too-many-vertices"},
    {ErrorCode::degenerate, "degenerate"},
    {ErrorCode::non_manifold, "non-manifold"},
    {ErrorCode::inconsistent_orientation, "inconsistent-orientation"},
    {ErrorCode::not_closed, "not-closed"},
    {ErrorCode::disconnected, "disconnected"},
    {ErrorCode::wrong_genus, "wrong-genus"},
    {ErrorCode::parametrization_failed, "parametrization-failed"},
    {ErrorCode::malformed_array, "malformed-array"},
    {ErrorCode::cancelled, "cancelled"},
    {ErrorCode::invalid_parameter, "invalid-parameter"},
}};

TEST(Problem, EveryEngineErrorHasItsWireString) {
  for (const auto& [code, wire] : engine_codes) {
    const api::Problem problem = described(EngineError(code, "because")).problem();
    EXPECT_EQ(api::entry_of(problem.code).wire, wire);
    EXPECT_EQ(problem.detail, "because");
  }
}

TEST(Problem, OffendingElementsAreCarriedUpToTwenty) {
  OffendingElements elements;
  elements.edges = {{1, 2}};
  elements.vertices = {3};
  elements.faces.assign(30, 4);
  const api::Problem problem = described(EngineError(ErrorCode::not_closed, "x", elements)).problem();
  ASSERT_EQ(problem.elements.size(), 20U);
  EXPECT_EQ(problem.elements[0], api::Element(api::EdgeElement{{1, 2}}));
  EXPECT_EQ(problem.elements[1], api::Element(api::VertexElement{3}));
  EXPECT_EQ(problem.elements[2], api::Element(api::FaceElement{4}));
}

TEST(Problem, StorageErrorsAreToldApart) {
  const auto code = [](StorageErrorCode from) { return described(StorageError(from, "secret path")).problem().code; };
  EXPECT_EQ(code(StorageErrorCode::not_found), api::Code::not_found);
  EXPECT_EQ(code(StorageErrorCode::invalid_cursor), api::Code::invalid_parameter);
  EXPECT_EQ(code(StorageErrorCode::too_large), api::Code::payload_too_large);
  EXPECT_EQ(code(StorageErrorCode::busy), api::Code::overloaded);
  EXPECT_EQ(code(StorageErrorCode::full), api::Code::insufficient_storage);
  for (const StorageErrorCode from : {StorageErrorCode::not_a_store, StorageErrorCode::newer_schema, StorageErrorCode::corrupt_blob,
                                      StorageErrorCode::unknown_version, StorageErrorCode::io}) {
    EXPECT_EQ(code(from), api::Code::internal);
  }
}

TEST(Problem, InternalErrorsKeepTheirTextToThemselves) {
  for (const ProblemError& error : {described(StorageError(StorageErrorCode::io, "secret path")),
                                    described(std::runtime_error("secret path")), problem_of(std::make_exception_ptr(7))}) {
    EXPECT_EQ(error.problem().code, api::Code::internal);
    EXPECT_EQ(error.problem().detail.find("secret"), std::string::npos);
  }
  EXPECT_EQ(described(std::bad_alloc()).problem().code, api::Code::overloaded);
}

TEST(Problem, TheResponseCarriesStatusIdAndHeaders) {
  api::Problem problem;
  problem.code = api::Code::method_not_allowed;
  problem.detail = "no";
  const HttpResponse response = problem_response(ProblemError(problem, {{"Allow", "GET"}}), "id-7");
  EXPECT_EQ(response.status, 405);
  EXPECT_EQ(response.content_type, "application/problem+json");
  EXPECT_EQ(response.headers, (std::vector<std::pair<std::string, std::string>>{{"Allow", "GET"}}));
  const auto parsed = api::from_text<api::Problem>(response.body);
  EXPECT_EQ(parsed.request_id, "id-7");
  EXPECT_EQ(parsed.code, api::Code::method_not_allowed);
}

TEST(Problem, WhatMayBeRetriedSaysWhen) {
  for (const api::ErrorEntry& entry : api::error_table()) {
    const HttpResponse response = problem_response({entry.code, "x"}, "i");
    const bool says_when =
        std::any_of(response.headers.begin(), response.headers.end(), [](const auto& h) { return h.first == "Retry-After"; });
    const bool should = entry.status == 503 || entry.code == api::Code::shape_not_ready;
    EXPECT_EQ(says_when, should) << entry.wire;
  }
}

}  // namespace
}  // namespace spherematch
