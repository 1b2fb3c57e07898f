// The bytes in which the store keeps each artefact of a shape: the same on every machine, checked on reading.
//
// A blob is a frame (storage/blob_frame.h) around little-endian arrays. encode_x() and decode_x() are inverse bit for bit,
// not-a-number and negative zero included. Decoding trusts nothing: every size and index is checked before it is used.
// All functions are thread-safe and throw StorageError(corrupt_blob, unknown_version) on decoding, (too_large) on encoding.
#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <span>
#include <vector>

#include "engine/data/preprocessed_shape.h"

namespace spherematch {

using Blob = std::vector<std::byte>;
using BlobView = std::span<const std::byte>;

struct StoredEigenbasis {
  Eigen::VectorXd eigenvalues;   ///< (k)
  Eigen::MatrixXf eigenvectors;  ///< (V, k)
};

[[nodiscard]] Blob encode_upload(BlobView bytes);
[[nodiscard]] Blob decode_upload(BlobView blob);

[[nodiscard]] Blob encode_surface(const Surface& surface);
[[nodiscard]] Surface decode_surface(BlobView blob);

[[nodiscard]] Blob encode_sphere(const Points& sphere);
[[nodiscard]] Points decode_sphere(BlobView blob);

[[nodiscard]] Blob encode_signals(const std::vector<SignalGrid>& signals);
[[nodiscard]] std::vector<SignalGrid> decode_signals(BlobView blob);

/// The matrix is taken as it lies in memory rather than in an StoredEigenbasis, to spare a copy of some ten megabytes.
[[nodiscard]] Blob encode_eigenbasis(const Eigen::VectorXd& eigenvalues, const Eigen::MatrixXf& eigenvectors);
[[nodiscard]] StoredEigenbasis decode_eigenbasis(BlobView blob);

}  // namespace spherematch
