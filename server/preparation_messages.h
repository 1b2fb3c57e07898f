// What a server and the process that prepares a shape for it say to each other, over a stream socket (server/preparation_process.h).
//
// Each message is its kind (one byte), the size of its body (eight bytes, little-endian) and the body.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "engine/data/error.h"
#include "engine/data/preprocessed_shape.h"

namespace spherematch {

enum class MessageKind : std::uint8_t {
  surface = 1,     ///< to the worker: what to prepare, as storage/blob_codec.h encodes it
  progress = 2,    ///< from the worker: encode_report()
  sphere = 3,      ///< from the worker, each once: the arrays, as storage/blob_codec.h encodes them
  signals = 4,     ///<
  eigenbasis = 5,  ///<
  finished = 6,    ///< the last word: encode_summary()
  refused = 7,     ///< the last word: encode_refusal()
  broken = 8,      ///< the last word: a sentence, where the worker failed for other reasons than the shape
};

struct Message {
  MessageKind kind{};
  std::vector<std::byte> body;
};

/// Blocks until everything is written. False when the peer is gone.
[[nodiscard]] bool send_message(int socket, MessageKind kind, std::span<const std::byte> body);

/// Blocks until a whole message is there. Nothing when the peer is gone, also in the middle of a message.
/// @throws StorageError(corrupt_blob) when what comes is no message
[[nodiscard]] std::optional<Message> receive_message(int socket);

struct ProgressReport {
  std::string stage;
  double fraction = 0;
};
[[nodiscard]] std::vector<std::byte> encode_report(std::string_view stage, double fraction);
[[nodiscard]] ProgressReport decode_report(std::span<const std::byte> body);

/// Everything of a prepared shape but its surface and its arrays.
[[nodiscard]] std::vector<std::byte> encode_summary(const PreprocessedShape& shape);
void decode_summary(std::span<const std::byte> body, PreprocessedShape& shape);

/// Code and text of an error; preparations name no offending elements.
[[nodiscard]] std::vector<std::byte> encode_refusal(const EngineError& error);
[[nodiscard]] EngineError decode_refusal(std::span<const std::byte> body);

}  // namespace spherematch
