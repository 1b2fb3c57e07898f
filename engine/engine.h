// The engine's facade: the few verbs that the server, the command line and the benchmarks use.
// All functions are thread-safe and deterministic: the same input and parameters give the same bytes at any thread count.
#pragma once

#include <cstddef>
#include <span>
#include <string_view>

#include "engine/data/correspondence.h"
#include "engine/data/evaluation.h"
#include "engine/data/parameters.h"
#include "engine/data/preprocessed_shape.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"
#include "engine/evaluate/vertex_quality.h"  // confidence and distortion of a map at its vertices
#include "engine/register/match_shape.h"
#include "engine/register/point_images.h"  // where chosen points of the source lie on the target

namespace spherematch {

/// Version of the method and its stored artefacts; a shape prepared by another version is prepared again.
[[nodiscard]] std::string_view engine_version();

/// Reads a mesh file, repairs it and decimates a copy where the options ask for one (engine/io, engine/mesh). `name` is a file name that
/// helps where the content does not tell the format; it may be empty.
/// @throws EngineError with every code up to wrong_genus
[[nodiscard]] Surface read_surface(std::span<const std::byte> bytes, std::string_view name, const ReadOptions& options,
                                   const ReadLimits& limits = {});

/// The part of the method that belongs to one shape: conformal parametrisation, Moebius centering, authalic evolution,
/// eigenbasis and signals. Uses up to `threads` threads.
/// @throws EngineError(cancelled, invalid_parameter, parametrization_failed)
[[nodiscard]] PreprocessedShape preprocess(Surface surface, const PreprocessParameters& parameters = {}, const Progress& progress = {},
                                           int threads = 2);

/// The part that belongs to a pair: rotational alignment, optical flow, candidate selection, composition. A MatchShape is made once of a
/// preprocessed shape and serves any number of matches (engine/register/match_shape.h). A shape matched with its own mirror image, source
/// and target being made of the same object and the orientation reverse, gives its intrinsic bilateral symmetry; the quality then has
/// "involution_mean" and "involution_max" (engine/evaluate/involution.h). [section 5.2]
/// @throws EngineError(cancelled, invalid_parameter)
[[nodiscard]] MatchResult match(const MatchShape& source, const MatchShape& target, const MatchParameters& parameters = {},
                                const Progress& progress = {}, int threads = 2);

/// The same for shapes that are matched once.
[[nodiscard]] MatchResult match(const PreprocessedShape& source, const PreprocessedShape& target, const MatchParameters& parameters = {},
                                const Progress& progress = {}, int threads = 2);

/// How good a map is: errors against the truth where there is one, continuity, coverage, and with `reverse`, the map the other way, how
/// far the two are from each other's inverses (engine/data/evaluation.h, engine/evaluate). Biharmonic figures are those of shapes that come
/// with their eigenbases; of the others only the surface is read. `reverse` may be null.
/// @throws EngineError(cancelled), EngineError(invalid_parameter) when map or truth do not fit the shapes
[[nodiscard]] Evaluation evaluate(const PreprocessedShape& source, const PreprocessedShape& target, const Correspondence& map,
                                  const Correspondence* reverse, const GroundTruth& truth, const Progress& progress = {}, int threads = 2);

}  // namespace spherematch
