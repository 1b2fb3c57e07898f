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

/// One line of what GET /readyz reports.
struct ReadinessCheck {
  std::string name;
  bool ok = false;
  std::string detail;
  bool operator==(const ReadinessCheck&) const = default;
};

/// RFC 9457. type, title, status and retryable follow from the code.
struct Problem {
  Code code = Code::internal;
  std::string detail;
  std::string request_id;  ///< empty where no request is meant, as in a stored error
  std::optional<std::int64_t> limit;
  std::optional<std::int64_t> actual;
  std::vector<Element> elements;       ///< at most max_elements
  std::vector<ReadinessCheck> checks;  ///< of Code::not_ready alone; without any, JSON has no such member
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
  std::vector<std::string> tags;  ///< a set: ascending, each once
  ShapeState state = ShapeState::queued;
  std::string stage;    ///< empty unless processing
  double progress = 0;  ///< in [0, 1], never falls during one preparation
  std::int32_t vertices = 0;
  std::int32_t faces = 0;
  std::string sha256;
  Repair repair;
  std::optional<std::int32_t> simplified;  ///< vertices of the decimated copy that was prepared in the surface's place
  std::optional<Sphere> sphere;            ///< once ready
  NamedNumbers seconds;                    ///< once ready
  std::string engine;                      ///< once ready
  std::optional<Problem> error;            ///< once failed
  std::string created_at;
  bool operator==(const Shape&) const = default;
};

/// Changes to a shape, a merge patch of RFC 7396: what is absent stays, and null in its JSON stands for empty.
struct ShapePatch {
  std::optional<std::string> name;
  std::optional<std::vector<std::string>> tags;
  bool operator==(const ShapePatch&) const = default;
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

/// The map from tgt to src, of the same registration; the members are those of Match.
struct ReverseMap {
  std::int32_t n_src = 0;  ///< vertices of the match's tgt, whose images these are
  std::int32_t n_tgt = 0;
  std::optional<std::vector<std::int32_t>> vertex;
  std::optional<std::vector<std::array<std::int32_t, 3>>> corners;
  std::optional<std::vector<std::array<float, 3>>> bary;
  std::optional<std::vector<float>> confidence;
  std::optional<std::vector<float>> distortion;
  bool operator==(const ReverseMap&) const = default;
};

struct Match {
  std::string src;
  std::string tgt;
  std::int32_t n_src = 0;
  std::int32_t n_tgt = 0;
  std::optional<std::vector<std::int32_t>> vertex;                  ///< n_src, if asked for
  std::optional<std::vector<std::array<std::int32_t, 3>>> corners;  ///< n_src, if asked for
  std::optional<std::vector<std::array<float, 3>>> bary;            ///< n_src, if asked for
  std::optional<std::vector<float>> confidence;                     ///< n_src, 0 to 1, if asked for
  std::optional<std::vector<float>> distortion;                     ///< n_src, 0 for an isometry, if asked for
  std::optional<ReverseMap> reverse;                                ///< if asked for
  std::string orientation = "preserve";                             ///< or "reverse": the mirror image of src was matched
  std::int32_t candidate = 0;                                       ///< 0: of the best rotation, 1: of the next best
  NamedNumbers quality;                                             ///< a figure that is not finite is null in JSON
  std::vector<Candidate> candidates;
  NamedNumbers seconds;
  bool cached = false;
  std::string engine;
  bool operator==(const Match&) const = default;
};

/// A point of a surface: a vertex, a point of a face by its corners and weights, or the nearest point to a position.
struct CornersPoint {
  std::array<std::int32_t, 3> corners{};
  std::array<double, 3> bary{};  ///< non-negative, sum 1
  bool operator==(const CornersPoint&) const = default;
};
struct PositionPoint {
  std::array<double, 3> position{};
  bool operator==(const PositionPoint&) const = default;
};
using SurfacePoint = std::variant<std::int32_t, CornersPoint, PositionPoint>;
using Landmarks = std::vector<std::pair<std::string, SurfacePoint>>;

inline constexpr std::size_t max_points = 100'000;
inline constexpr std::size_t max_pairs = 1000;

/// The body of POST /match, in one of two forms: some points of one pair, or many pairs.
struct MatchRequest {
  std::string src;  ///< of one pair
  std::string tgt;
  std::optional<std::vector<SurfacePoint>> points;  ///< of src, at most max_points
  std::optional<Landmarks> landmarks;               ///< of src by name, at most 2000
  std::vector<std::array<std::int32_t, 2>> hints;   ///< of one pair: vertices of src and tgt
  std::vector<std::array<std::string, 2>> pairs;    ///< src and tgt of each of many pairs, at most max_pairs
  std::string fields = "vertex";                    ///< of many pairs
  bool both = false;                                ///< of many pairs
  std::string method = "default";
  std::string refine = "default";  ///< or "none": without the elastic flow
  std::string orientation = "preserve";
  bool operator==(const MatchRequest&) const = default;
};

/// Where a point lies on tgt.
struct PointImage {
  std::int32_t vertex = -1;
  std::array<std::int32_t, 3> corners{};
  std::array<double, 3> bary{};
  std::array<double, 3> position{};
  bool operator==(const PointImage&) const = default;
};

/// The answer to POST /match for points and landmarks. An image is missing where its point was dropped by repair.
struct PointMatch {
  std::string src;
  std::string tgt;
  std::optional<std::vector<std::optional<PointImage>>> points;
  std::optional<std::vector<std::pair<std::string, std::optional<PointImage>>>> landmarks;
  std::string orientation = "preserve";
  NamedNumbers quality;
  NamedNumbers seconds;
  bool cached = false;
  std::string engine;
  bool operator==(const PointMatch&) const = default;
};

struct PairCounts {
  std::int32_t total = 0;
  std::int32_t succeeded = 0;
  std::int32_t failed = 0;
  bool operator==(const PairCounts&) const = default;
};

struct Job {
  std::string id;
  std::string kind = "match";    ///< or "preprocess"
  std::string state = "queued";  ///< or "processing", "succeeded", "failed", "cancelled"
  std::string stage;             ///< empty unless processing
  double progress = 0;           ///< in [0, 1]
  std::int32_t position = 0;     ///< how many are in front of it; 0 unless queued
  std::string created_at;
  std::string started_at;           ///< empty before
  std::string finished_at;          ///< empty before
  std::optional<Problem> error;     ///< once failed
  std::string shape;                ///< of a preparation
  std::optional<PairCounts> pairs;  ///< of a match job
  std::string results;              ///< of a match job: the path of its results
  bool operator==(const Job&) const = default;
};

struct JobPage {
  std::vector<Job> items;
  std::optional<std::string> next_cursor;
  bool operator==(const JobPage&) const = default;
};

/// One line of a match job's results.
struct PairResult {
  std::int32_t index = 0;  ///< in the request, from 0
  std::string src;
  std::string tgt;
  std::optional<Match> match;    ///< unless it failed
  std::optional<Problem> error;  ///< if it failed
  bool operator==(const PairResult&) const = default;
};

struct Health {
  std::string status = "ok";  ///< "ok" or "draining"
  std::int64_t jobs_queued = 0;
  std::int64_t jobs_processing = 0;
  std::int64_t matches_running = 0;
  std::int64_t matches_waiting = 0;
  bool operator==(const Health&) const = default;
};

/// GET /readyz of a server that is ready; of another it is a Problem.
struct Readiness {
  std::vector<ReadinessCheck> checks;
  bool operator==(const Readiness&) const = default;
};

struct Limits {
  std::int64_t body_bytes = 0;
  std::int64_t vertices = 0;
  std::int64_t queued_jobs = 0;
  std::int64_t concurrent_matches = 0;
  std::int64_t waiting_matches = 0;
  std::int64_t concurrent_uploads = 0;
  std::int64_t workers = 0;
  std::int64_t threads = 0;
  std::int64_t shape_cache_bytes = 0;
  std::int64_t match_cache_bytes = 0;
  std::int64_t match_store_bytes = 0;
  std::int64_t wait_seconds = 0;
  bool operator==(const Limits&) const = default;
};

struct Version {
  std::string version;
  std::string engine;
  Limits limits;
  std::vector<std::string> mesh_formats;   ///< that an upload may have
  std::vector<std::string> match_formats;  ///< values of `format` of GET /match
  Json parameters = Json::object();        ///< the engine's, by group and field; clients show it, nothing depends on it
  bool operator==(const Version&) const = default;
};

}  // namespace spherematch::api
