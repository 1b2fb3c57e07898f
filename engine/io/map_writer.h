// Maps out: NPZ, NPY and text. The bytes depend on the arguments alone: no dates, no compression, little-endian.
#pragma once

#include <string>

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/tri_mesh.h"

namespace spherematch {

/// A zip of `vertex.npy` int32 (n,), `corners.npy` int32 (n, 3) and `bary.npy` float32 (n, 3), stored uncompressed; and of
/// `confidence.npy` and `distortion.npy`, float32 (n,), where they are not empty.
[[nodiscard]] std::string encode_npz(const Correspondence& map, const VertexQuality& quality = {});

/// The same, and the arrays of the map in the other direction under `reverse_vertex.npy` and so on.
[[nodiscard]] std::string encode_npz(const Correspondence& map, const Correspondence& reverse, const VertexQuality& quality = {},
                                     const VertexQuality& reverse_quality = {});

/// `vertex` as NPY, int32 (n,).
[[nodiscard]] std::string encode_npy(const Correspondence& map);

/// `vertex` as text, one index per line, from 0 as NumPy and pyFM count; -1 for a dropped vertex.
[[nodiscard]] std::string encode_text(const Correspondence& map);

/// `vertex` as text, one index per line, from 1 as MATLAB counts; 0 for a dropped vertex: the `.map` files of Ren, Poulenard, Wonka and
/// Ovsjanikov (2018), "Continuous and Orientation-preserving Correspondences via Functional Maps".
[[nodiscard]] std::string encode_list_from_one(const Correspondence& map);

/// Points as NPY, float64 (n, 3).
[[nodiscard]] std::string encode_npy(const Points& points);

}  // namespace spherematch
