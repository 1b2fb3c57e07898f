// SPDX-License-Identifier: MIT
// Strict conversion between the types and JSON. Reading rejects unknown members, missing members, wrong types and numbers out
// of range, naming the member by its path ("items[3].repair.filled_loops").
#pragma once

#include <stdexcept>
#include <string_view>

#include "api/evaluation.h"
#include "api/types.h"

namespace spherematch::api {

/// what() names the member and says what is wrong with it.
class JsonError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

[[nodiscard]] Json to_json(const Problem& value);
[[nodiscard]] Json to_json(const Shape& value);
[[nodiscard]] Json to_json(const ShapePage& value);
[[nodiscard]] Json to_json(const ShapePatch& value);
[[nodiscard]] Json to_json(const Match& value);
[[nodiscard]] Json to_json(const MatchRequest& value);
[[nodiscard]] Json to_json(const PointMatch& value);
[[nodiscard]] Json to_json(const EvaluationRequest& value);
[[nodiscard]] Json to_json(const Evaluation& value);
[[nodiscard]] Json to_json(const Job& value);
[[nodiscard]] Json to_json(const JobPage& value);
[[nodiscard]] Json to_json(const PairResult& value);
[[nodiscard]] Json to_json(const Health& value);
[[nodiscard]] Json to_json(const Readiness& value);
[[nodiscard]] Json to_json(const Version& value);

/// The bytes that travel. Text that is not UTF-8 gets replacement characters rather than an error.
[[nodiscard]] std::string to_text(const Json& value);

/// Parses text into one of the types above. @throws JsonError also where the text is not JSON or nests deeper than 16
template <typename T>
[[nodiscard]] T from_text(std::string_view text);

template <>
Problem from_text<Problem>(std::string_view text);
template <>
Shape from_text<Shape>(std::string_view text);
template <>
ShapePage from_text<ShapePage>(std::string_view text);
template <>
ShapePatch from_text<ShapePatch>(std::string_view text);
template <>
Match from_text<Match>(std::string_view text);
template <>
MatchRequest from_text<MatchRequest>(std::string_view text);
template <>
PointMatch from_text<PointMatch>(std::string_view text);
template <>
EvaluationRequest from_text<EvaluationRequest>(std::string_view text);
template <>
Evaluation from_text<Evaluation>(std::string_view text);
template <>
Job from_text<Job>(std::string_view text);
template <>
JobPage from_text<JobPage>(std::string_view text);
template <>
PairResult from_text<PairResult>(std::string_view text);
template <>
Health from_text<Health>(std::string_view text);
template <>
Readiness from_text<Readiness>(std::string_view text);
template <>
Version from_text<Version>(std::string_view text);

}  // namespace spherematch::api
