// All samples, as files.
#pragma once

#include <string>
#include <vector>

#include "samples/creature.h"
#include "samples/remesh.h"

namespace spherematch::samples {

/// The meshes of a creature at rest. The landmarks are vertices of both, exactly.
struct RestMeshes {
  Landmarks landmarks;
  PinnedMesh shared, independent;
};

[[nodiscard]] RestMeshes rest_meshes(const Creature& creature);

struct File {
  std::string path;  ///< from the samples' folder, "hound/bow.off"
  std::string bytes;
};

/// The mesh of a pose and its two landmark lists.
[[nodiscard]] std::vector<File> pose_files(const Creature& creature, const RestMeshes& rest, const Pose& pose);

/// The pairs of shapes to be matched, in the form that the scoring program reads.
[[nodiscard]] File pairs_file();

/// Every file of the data set.
[[nodiscard]] std::vector<File> sample_set();

}  // namespace spherematch::samples
