// From whatever went wrong to a problem response: the one place where exceptions become HTTP.
#pragma once

#include <exception>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/types.h"
#include "engine/data/error.h"
#include "server/http_message.h"
#include "storage/error.h"

namespace spherematch {

/// Thrown by handlers and services to answer with a problem.
class ProblemError : public std::exception {
 public:
  ProblemError(api::Code code, std::string detail);
  explicit ProblemError(api::Problem problem, std::vector<std::pair<std::string, std::string>> headers = {})
      : problem_(std::move(problem)), headers_(std::move(headers)) {}

  [[nodiscard]] const char* what() const noexcept override { return problem_.detail.c_str(); }
  [[nodiscard]] const api::Problem& problem() const { return problem_; }
  [[nodiscard]] const std::vector<std::pair<std::string, std::string>>& headers() const { return headers_; }

 private:
  api::Problem problem_;
  std::vector<std::pair<std::string, std::string>> headers_;
};

[[nodiscard]] api::Code code_of(ErrorCode code);
[[nodiscard]] api::Code code_of(StorageErrorCode code);

/// What to tell the client of an exception. The text of an unforeseen one goes to the log, not to the client.
[[nodiscard]] ProblemError problem_of(const std::exception_ptr& exception);

/// Adds Retry-After where the code is worth another try.
[[nodiscard]] HttpResponse problem_response(const ProblemError& error, std::string_view request_id);

}  // namespace spherematch
