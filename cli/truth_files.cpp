#include "cli/truth_files.h"

#include <algorithm>
#include <set>
#include <string_view>

#include "cli/files.h"
#include "engine/data/error.h"
#include "engine/io/map_reader.h"

namespace spherematch {

namespace {

template <typename Read>
std::vector<std::int32_t> numbers_in(const std::string& file, const Read& read) {
  const std::vector<std::byte> bytes = read_file(file);
  return read(std::string_view(reinterpret_cast<const char*>(bytes.data()), bytes.size()));
}

GroundTruth read_index_truth(const std::string& file, std::int32_t source_vertices) {
  const std::vector<std::int32_t> targets = numbers_in(file, file.ends_with(".map") ? read_list_from_one : read_indices);
  if (targets.size() == static_cast<std::size_t>(source_vertices)) return index_truth(targets);
  throw EngineError(ErrorCode::invalid_parameter, file + " has " + std::to_string(targets.size()) + " entries, the source has " +
                                                      std::to_string(source_vertices) + " vertices");
}

GroundTruth identity(std::int32_t source_vertices, std::int32_t target_vertices) {
  if (source_vertices == target_vertices) return identity_truth(source_vertices, target_vertices);
  throw EngineError(ErrorCode::invalid_parameter, "the meshes have " + std::to_string(source_vertices) + " and " +
                                                      std::to_string(target_vertices) +
                                                      " vertices, so the truth is not the identity: give --landmarks or --truth");
}

void keep_points(std::vector<Landmark>& landmarks, const std::set<std::int32_t>& points) {
  std::erase_if(landmarks, [&points](const Landmark& landmark) { return !points.contains(landmark.source); });
}

}  // namespace

GroundTruth read_truth(const TruthFiles& files, std::int32_t source_vertices, std::int32_t target_vertices) {
  GroundTruth truth;
  if (!files.landmarks.empty()) {
    const std::vector<std::int32_t> source = numbers_in(files.landmarks.at(0), read_landmarks);
    truth.direct = paired(source, numbers_in(files.landmarks.at(1), read_landmarks));
    if (!files.mirrored.empty()) truth.mirrored = paired(source, numbers_in(files.mirrored, read_landmarks));
  } else if (files.truth.empty() || files.truth == "identity") {
    truth = identity(source_vertices, target_vertices);
  } else if (files.truth != "none") {
    truth = read_index_truth(files.truth, source_vertices);
  }
  if (files.points.empty()) return truth;
  const std::vector<std::int32_t> listed = numbers_in(files.points, read_landmarks);
  const std::set<std::int32_t> points(listed.begin(), listed.end());
  keep_points(truth.direct, points);
  keep_points(truth.mirrored, points);
  return truth;
}

}  // namespace spherematch
