// The meshes of data folders, by class, and what is known of their correspondence.
#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "engine/data/evaluation.h"
#include "engine/data/surface.h"

namespace spherematch::bench {

/// Files by class, both in the order of their names. A class is the folder's name and the file's without the digits at its end ("tosca/cat"
/// has cat0 to cat10), or with `whole_folders` the folder alone.
using ShapeClasses = std::map<std::string, std::vector<std::filesystem::path>>;

/// The OFF files of the folders; a file is taken as it is. Classes of fewer than `least` shapes are left out.
/// @throws std::runtime_error where nothing is found
[[nodiscard]] ShapeClasses classes_in(const std::vector<std::string>& places, bool whole_folders, std::size_t least);

[[nodiscard]] Surface read_shape(const std::filesystem::path& file);

/// By the landmark lists NAME.vts and NAME.sym.vts beside the files, numbers from 1; or else the identity where the files have equally many
/// vertices. Nothing where neither says anything.
[[nodiscard]] std::optional<GroundTruth> truth_between(const std::filesystem::path& source, const std::filesystem::path& target,
                                                       const Surface& source_surface, const Surface& target_surface);

/// Of those that are part of the surface, with a fixed seed; a vertex may occur again.
[[nodiscard]] std::vector<std::int32_t> vertices_drawn_by_area(const Surface& surface, int count);

/// Vertices and their mirror images on the same shape, by NAME.vts and NAME.sym.vts; nothing without them.
[[nodiscard]] std::optional<std::vector<Landmark>> listed_symmetry(const std::filesystem::path& file);

/// The paper's way (section 5.2): of `count` vertices, drawn by area with a fixed seed, the vertices nearest to their mirror images in the
/// yz plane through the middle of the shape. Nothing where these are farther than a hundredth of the square root of the area in the mean:
/// then the shape is not symmetric as it stands.
[[nodiscard]] std::optional<std::vector<Landmark>> extrinsic_symmetry(const Surface& surface, int count);

}  // namespace spherematch::bench
