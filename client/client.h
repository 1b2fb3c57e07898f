// SPDX-License-Identifier: MIT
// A Spherematch server as typed calls.
#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "api/evaluation.h"
#include "api/types.h"
#include "client/arrays.h"
#include "client/errors.h"

namespace spherematch::client {

struct Settings {
  std::chrono::milliseconds connect_timeout{5'000};
  std::chrono::milliseconds read_timeout{60'000};  ///< between two pieces of an answer, beyond what a call asks the server to wait
  int retries = 3;                                 ///< of calls that may be repeated without harm, and of refusals that pass
  std::chrono::milliseconds first_pause{200};      ///< before the first retry; doubles with each, unless the server names one
  std::string api_key{};                           ///< sent as a bearer token unless empty
};

struct UploadOptions {
  std::string name{};
  std::vector<std::string> tags{};
  bool repair = true;
  std::int32_t simplify = 0;         ///< vertices of the decimated copy to compute on; 0 for the mesh itself
  std::chrono::milliseconds wait{};  ///< for the preparation, at most a minute; see Client::wait()
};

struct ShapeFilter {
  std::optional<std::string> state{}, tag{}, q{}, sha256{};
};

struct MatchOptions {
  std::string method = "default";
  std::string refine = "default";  ///< "none": without the elastic flow
  std::string orientation = "preserve";
  std::vector<std::pair<std::int32_t, std::int32_t>> hints{};  ///< vertices of source and target
  bool both = false;
  bool cache = true;
  int candidate = 0;     ///< 1 for the next best map; of matches and symmetries alone
  std::string fields{};  ///< "confidence,distortion" or one of them, beside the map; of matches and symmetries alone, not of their infos
};

/// Thread-safe: every call has a connection of its own. Calls throw ProblemError where the server refuses, TransportError where no
/// answer comes, and FormatError where the answer is not what it should be (client/errors.h).
class Client {
 public:
  /// "http://127.0.0.1:8080"; https where cpp-httplib was built with OpenSSL. @throws TransportError for what is no address
  explicit Client(const std::string& url, Settings settings = {});

  // Shapes

  /// The mesh file's bytes. The same bytes with the same options are the same shape.
  [[nodiscard]] api::Shape upload(std::string_view bytes, const UploadOptions& options = {}) const;
  /// @throws TransportError where the file cannot be read. The file's name is taken where the options have none.
  [[nodiscard]] api::Shape upload_file(const std::filesystem::path& file, UploadOptions options = {}) const;
  [[nodiscard]] api::Shape shape(const std::string& id) const;
  /// The shape once its preparation has ended (ready or failed), or as it is when the time is over.
  [[nodiscard]] api::Shape wait(const std::string& id, std::chrono::milliseconds timeout) const;
  [[nodiscard]] api::ShapePage shapes(const ShapeFilter& filter = {}, int limit = 50, const std::optional<std::string>& cursor = {}) const;
  [[nodiscard]] api::Shape rename(const std::string& id, const std::string& name) const;
  [[nodiscard]] api::Shape tag(const std::string& id, const std::vector<std::string>& tags) const;
  void remove(const std::string& id) const;
  /// "original", "off", "obj", "ply", "stl" or "glb".
  [[nodiscard]] std::string mesh(const std::string& id, const std::string& format = "original") const;
  /// A picture of the uploaded mesh, size x size pixels: the bytes of a PNG file.
  [[nodiscard]] std::string thumbnail(const std::string& id, int size = 256) const;

  // Matches

  /// The whole map.
  [[nodiscard]] Map match(const std::string& src, const std::string& tgt, const MatchOptions& options = {}) const;
  /// What there is to know of a match besides its arrays.
  [[nodiscard]] api::Match match_info(const std::string& src, const std::string& tgt, const MatchOptions& options = {}) const;
  /// The bytes of a file: "npz", "npy", "txt", "map", "ply", "glb", "obj" or "png".
  [[nodiscard]] std::string match_file(const std::string& src, const std::string& tgt, const std::string& format,
                                       const MatchOptions& options = {}) const;
  /// The intrinsic bilateral symmetry of a shape, a map to itself, in the same three forms. Of the options, orientation and both have no
  /// meaning here.
  [[nodiscard]] Map symmetry(const std::string& id, const MatchOptions& options = {}) const;
  [[nodiscard]] api::Match symmetry_info(const std::string& id, const MatchOptions& options = {}) const;
  [[nodiscard]] std::string symmetry_file(const std::string& id, const std::string& format, const MatchOptions& options = {}) const;
  [[nodiscard]] api::PointMatch match_points(const api::MatchRequest& request) const;
  /// How good a match is: against the truth where that is known, and by itself.
  [[nodiscard]] api::Evaluation evaluate(const api::EvaluationRequest& request) const;
  /// Rows of `columns` numbers for each vertex of tgt, row after row, become rows for each vertex of src.
  /// `interpolation` is "linear" or "nearest". @throws std::invalid_argument when the values are no whole rows
  [[nodiscard]] std::vector<double> transfer(const std::string& src, const std::string& tgt, std::span<const double> values,
                                             std::size_t columns = 1, const std::string& interpolation = "linear",
                                             const MatchOptions& options = {}) const;
  /// The same as the bytes of a file: "ply" or "glb", the source's mesh with what was carried, or "png", a picture of both shapes.
  /// `meaning` says what the columns are: "color" from 0 to 1, "texture", "value" or "weights".
  [[nodiscard]] std::string transfer_file(const std::string& src, const std::string& tgt, std::span<const double> values,
                                          std::size_t columns, const std::string& format, const std::string& meaning,
                                          const MatchOptions& options = {}) const;
  /// Both meshes in corresponding colours: one GLB file.
  [[nodiscard]] std::string scene(const std::string& src, const std::string& tgt, const MatchOptions& options = {}) const;

  // Jobs

  /// A job of many pairs; not repeated when the connection breaks, since the job may have been made.
  [[nodiscard]] api::Job start(const api::MatchRequest& request) const;
  [[nodiscard]] api::Job job(const std::string& id, std::chrono::milliseconds wait = {}) const;
  [[nodiscard]] api::JobPage jobs(int limit = 50, const std::optional<std::string>& cursor = {}) const;
  /// Cancels a job, or forgets one that has ended.
  void cancel(const std::string& id) const;
  /// Hands over each line as its pair finishes, until the job ends or `take` returns false. A lost connection is taken up where it was.
  void results(const std::string& id, const std::function<bool(const api::PairResult&)>& take, std::int32_t after = 0) const;

  // The server

  [[nodiscard]] api::Health health() const;
  [[nodiscard]] api::Version version() const;

 private:
  class Transport;
  std::shared_ptr<const Transport> transport_;
};

}  // namespace spherematch::client
