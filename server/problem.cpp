#include "server/problem.h"

#include <new>

#include "api/json.h"
#include "server/event_log.h"

namespace spherematch {

namespace {

api::Problem make_problem(api::Code code, std::string detail) {
  api::Problem problem;
  problem.code = code;
  problem.detail = std::move(detail);
  return problem;
}

api::Problem describe(const EngineError& error) {
  api::Problem problem = make_problem(code_of(error.code()), error.what());
  const auto add = [&problem](api::Element element) {
    if (problem.elements.size() < api::max_elements) problem.elements.push_back(element);
  };
  for (const auto& edge : error.elements().edges) add(api::EdgeElement{edge});
  for (const auto vertex : error.elements().vertices) add(api::VertexElement{vertex});
  for (const auto face : error.elements().faces) add(api::FaceElement{face});
  return problem;
}

api::Problem describe(const StorageError& error) {
  const api::Code code = code_of(error.code());
  if (code == api::Code::internal) {
    log_error("storage_error", {{"detail", error.what()}});
    return make_problem(code, "the store failed; the server's log says more");
  }
  return make_problem(code, error.what());
}

int retry_after_seconds(api::Code code) {
  switch (code) {
    case api::Code::shape_not_ready:
      return 1;
    case api::Code::overloaded:
    case api::Code::cancelled:
      return 2;
    case api::Code::draining:
    case api::Code::not_ready:
      return 5;
    default:
      return 0;
  }
}

}  // namespace

ProblemError::ProblemError(api::Code code, std::string detail) : problem_(make_problem(code, std::move(detail))) {}

api::Code code_of(ErrorCode code) {
  switch (code) {
    case ErrorCode::malformed_mesh:
      return api::Code::malformed_mesh;
    case ErrorCode::unsupported_format:
      return api::Code::unsupported_format;
    case ErrorCode::compressed_geometry:
      return api::Code::compressed_geometry;
    case ErrorCode::external_reference:
      return api::Code::external_reference;
    case ErrorCode::too_many_vertices:
      return api::Code::too_many_vertices;
    case ErrorCode::degenerate:
      return api::Code::degenerate;
    case ErrorCode::non_manifold:
      return api::Code::non_manifold;
    case ErrorCode::inconsistent_orientation:
      return api::Code::inconsistent_orientation;
    case ErrorCode::not_closed:
      return api::Code::not_closed;
    case ErrorCode::disconnected:
      return api::Code::disconnected;
    case ErrorCode::wrong_genus:
      return api::Code::wrong_genus;
    case ErrorCode::parametrization_failed:
      return api::Code::parametrization_failed;
    case ErrorCode::malformed_array:
      return api::Code::malformed_array;
    case ErrorCode::cancelled:
      return api::Code::cancelled;
    case ErrorCode::invalid_parameter:
      return api::Code::invalid_parameter;
  }
  return api::Code::internal;
}

api::Code code_of(StorageErrorCode code) {
  switch (code) {
    case StorageErrorCode::not_found:
      return api::Code::not_found;
    case StorageErrorCode::invalid_cursor:
      return api::Code::invalid_parameter;
    case StorageErrorCode::too_large:
      return api::Code::payload_too_large;
    case StorageErrorCode::busy:
      return api::Code::overloaded;
    case StorageErrorCode::full:
      return api::Code::insufficient_storage;
    case StorageErrorCode::not_a_store:
    case StorageErrorCode::newer_schema:
    case StorageErrorCode::corrupt_blob:
    case StorageErrorCode::unknown_version:
    case StorageErrorCode::io:
      return api::Code::internal;
  }
  return api::Code::internal;
}

ProblemError problem_of(const std::exception_ptr& exception) {
  try {
    std::rethrow_exception(exception);
  } catch (const ProblemError& error) {
    return error;
  } catch (const EngineError& error) {
    return ProblemError(describe(error));
  } catch (const StorageError& error) {
    return ProblemError(describe(error));
  } catch (const std::bad_alloc&) {
    log_error("out_of_memory");
    return {api::Code::overloaded, "not enough memory for this request now"};
  } catch (const std::exception& error) {
    log_error("unforeseen_error", {{"detail", error.what()}});
  } catch (...) {
    log_error("unforeseen_error");
  }
  return {api::Code::internal, "the server failed; its log says more"};
}

HttpResponse problem_response(const ProblemError& error, std::string_view request_id) {
  api::Problem problem = error.problem();
  problem.request_id = request_id;
  HttpResponse response{.status = api::entry_of(problem.code).status,
                        .content_type = "application/problem+json",
                        .body = api::to_text(api::to_json(problem)) + "\n",
                        .headers = error.headers()};
  if (const int seconds = retry_after_seconds(problem.code); seconds > 0) {
    response.headers.emplace_back("Retry-After", std::to_string(seconds));
  }
  return response;
}

}  // namespace spherematch
