// SPDX-License-Identifier: MIT
// What travels between client and server; docs/http.md explains every member. Plain values, no behaviour.
#pragma once

#include <array>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <utility>
#include <variant>
#include <vector>

#include "api/error_table.h"

namespace spherematch::api {

/// Keeps the members in the documented order, so that equal values are equal bytes.
using Json = nlohmann::ordered_json;

/// Named numbers in a meaningful order, for example stage seconds.
using NamedNumbers = std::vector<std::pair<std::string, double>>;

/// An element of the uploaded mesh that an error speaks of.
struct VertexElement {
  std::int32_t vertex = 0;
  bool operator==(const VertexElement&) const = default;
};
struct FaceElement {
  std::int32_t face = 0;
  bool operator==(const FaceElement&) const = default;
};
struct EdgeElement {
  std::array<std::int32_t, 2> edge{};
  bool operator==(const EdgeElement&) const = default;
};
using Element = std::variant<VertexElement, FaceElement, EdgeElement>;

inline constexpr std::size_t max_elements = 20;

/// RFC 9457. type, title, status and retryable follow from the code.
struct Problem {
  Code code = Code::internal;
  std::string detail;
  std::string request_id;  ///< empty where no request is meant, as in a stored error
  std::optional<std::int64_t> limit;
  std::optional<std::int64_t> actual;
  std::vector<Element> elements;  ///< at most max_elements
  bool operator==(const Problem&) const = default;
};

enum class ShapeState { queued, processing, ready, failed };

struct Repair {
  std::string mode = "fill";
  std::int32_t filled_loops = 0;
  std::int32_t added_vertices = 0;
  std::int32_t added_faces = 0;
  std::int32_t dropped_vertices = 0;
  std::int32_t welded_vertices = 0;
  std::int32_t split_vertices = 0;
  std::int32_t flipped_faces = 0;
  std::int32_t removed_faces = 0;
  std::int32_t dropped_components = 0;
  bool operator==(const Repair&) const = default;
};

struct Sphere {
  std::int32_t flipped = 0;
  double solid_angle_defect = 0;
  double area_distortion = 0;
  bool operator==(const Sphere&) const = default;
};

struct Shape {
  std::string id;
  std::string name;
  ShapeState state = ShapeState::queued;
  std::string stage;    ///< empty unless processing
  double progress = 0;  ///< in [0, 1], never falls during one preparation
  std::int32_t vertices = 0;
  std::int32_t faces = 0;
  std::string sha256;
  Repair repair;
  std::optional<Sphere> sphere;  ///< once ready
  NamedNumbers seconds;          ///< once ready
  std::string engine;            ///< once ready
  std::optional<Problem> error;  ///< once failed
  std::string created_at;
  bool operator==(const Shape&) const = default;
};

struct ShapePage {
  std::vector<Shape> items;
  std::optional<std::string> next_cursor;
  bool operator==(const ShapePage&) const = default;
};

struct Candidate {
  std::array<double, 9> rotation{};  ///< row-major
  double correlation = 0;
  double score = 0;
  bool chosen = false;
  bool operator==(const Candidate&) const = default;
};

struct Match {
  std::string src;
  std::string tgt;
  std::int32_t n_src = 0;
  std::int32_t n_tgt = 0;
  std::optional<std::vector<std::int32_t>> vertex;                  ///< n_src, if asked for
  std::optional<std::vector<std::array<std::int32_t, 3>>> corners;  ///< n_src, if asked for
  std::optional<std::vector<std::array<float, 3>>> bary;            ///< n_src, if asked for
  NamedNumbers quality;                                             ///< a figure that is not finite is null in JSON
  std::vector<Candidate> candidates;
  NamedNumbers seconds;
  bool cached = false;
  std::string engine;
  bool operator==(const Match&) const = default;
};

struct Health {
  std::string status = "ok";  ///< "ok" or "draining"
  std::int64_t jobs_queued = 0;
  std::int64_t jobs_processing = 0;
  std::int64_t matches_running = 0;
  std::int64_t matches_waiting = 0;
  bool operator==(const Health&) const = default;
};

struct Limits {
  std::int64_t body_bytes = 0;
  std::int64_t vertices = 0;
  std::int64_t queued_jobs = 0;
  std::int64_t concurrent_matches = 0;
  std::int64_t waiting_matches = 0;
  std::int64_t wait_seconds = 0;
  bool operator==(const Limits&) const = default;
};

struct Version {
  std::string version;
  std::string engine;
  Limits limits;
  Json parameters = Json::object();  ///< the engine's, by group and field; clients show it, nothing depends on it
  bool operator==(const Version&) const = default;
};

}  // namespace spherematch::api
