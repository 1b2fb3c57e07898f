// A preparation in a process of its own, so that a shape which crashes the method or exhausts the memory costs its own
// preparation and not the server, which also learns for certain that it was this shape.
//
// The process is the server's own program, started again: it gets the surface through a socket, answers with progress and the
// result (server/preparation_messages.h), touches neither store nor network, and ends with the server.
#pragma once

#include <string>

#include "engine/data/preprocessed_shape.h"
#include "engine/data/progress.h"
#include "engine/data/surface.h"

namespace spherematch {

/// The first argument by which the program knows that it was started for a preparation; the number of threads follows.
inline constexpr const char* preparation_argument = "--prepare-for-server";

/// Starts `program` and returns what it answers. The process is killed as soon as `progress.stop` is requested. Thread-safe.
/// @throws EngineError as engine/engine.h's preprocess(), PreparationLost (server/engine_port.h) when the process ended without
/// an answer or could not be started
[[nodiscard]] PreprocessedShape preprocess_apart(const std::string& program, int threads, Surface surface, const Progress& progress);

/// The other side: prepares the one surface that comes through the socket. Returns the exit code. Ends the whole process at once
/// when the socket is closed from the other side.
[[nodiscard]] int prepare_for_server(int socket, int threads);

}  // namespace spherematch
