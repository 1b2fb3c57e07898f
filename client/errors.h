// SPDX-License-Identifier: MIT
// What a call of the client can throw.
#pragma once

#include <stdexcept>
#include <string>

#include "api/types.h"

namespace spherematch::client {

/// Every error of the client.
class Error : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// No answer came: the server cannot be reached, was too slow, or broke off.
class TransportError : public Error {
 public:
  using Error::Error;
};

/// The server refused the request. Branch on problem().code.
class ProblemError : public Error {
 public:
  ProblemError(int status, api::Problem problem) : Error(problem.detail), status_(status), problem_(std::move(problem)) {}

  [[nodiscard]] int status() const { return status_; }
  [[nodiscard]] const api::Problem& problem() const { return problem_; }

 private:
  int status_;
  api::Problem problem_;
};

/// The answer is not what the interface promises, as when something else than a Spherematch server answered.
class FormatError : public Error {
 public:
  using Error::Error;
};

}  // namespace spherematch::client
