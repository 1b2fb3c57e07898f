#include "server/preparation_messages.h"

#include <sys/socket.h>

#include <algorithm>
#include <array>
#include <cerrno>

#include "storage/blob_frame.h"
#include "storage/byte_stream.h"

namespace spherematch {

namespace {

constexpr std::size_t header_size = 9;
constexpr std::size_t piece_size = std::size_t{1} << 20;

bool send_all(int socket, std::span<const std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t sent = ::send(socket, bytes.data(), bytes.size(), MSG_NOSIGNAL);
    if (sent < 0 && errno != EINTR) return false;
    if (sent > 0) bytes = bytes.subspan(static_cast<std::size_t>(sent));
  }
  return true;
}

bool receive_all(int socket, std::span<std::byte> bytes) {
  while (!bytes.empty()) {
    const ssize_t received = ::recv(socket, bytes.data(), bytes.size(), 0);
    if (received == 0 || (received < 0 && errno != EINTR)) return false;
    if (received > 0) bytes = bytes.subspan(static_cast<std::size_t>(received));
  }
  return true;
}

}  // namespace

bool send_message(int socket, MessageKind kind, std::span<const std::byte> body) {
  std::array<std::byte, header_size> header{};
  store_little_endian(static_cast<std::uint8_t>(kind), header.data());
  store_little_endian(std::uint64_t{body.size()}, header.data() + 1);
  return send_all(socket, header) && send_all(socket, body);
}

std::optional<Message> receive_message(int socket) {
  std::array<std::byte, header_size> header{};
  if (!receive_all(socket, header)) return std::nullopt;
  const auto kind = load_little_endian<std::uint8_t>(header.data());
  const auto size = load_little_endian<std::uint64_t>(header.data() + 1);
  if (kind < static_cast<std::uint8_t>(MessageKind::surface) || kind > static_cast<std::uint8_t>(MessageKind::broken)) {
    throw StorageError(StorageErrorCode::corrupt_blob, "a message of no known kind");
  }
  Message message{static_cast<MessageKind>(kind), {}};
  // Address space for all of it, so that growing copies nothing; memory as it comes, so that a size written by a process gone wild takes
  // none.
  message.body.reserve(static_cast<std::size_t>(std::min<std::uint64_t>(size, max_blob_size)));
  while (message.body.size() < size) {
    const std::size_t begin = message.body.size();
    message.body.resize(begin + static_cast<std::size_t>(std::min<std::uint64_t>(piece_size, size - begin)));
    if (!receive_all(socket, std::span(message.body).subspan(begin))) return std::nullopt;
  }
  return message;
}

std::vector<std::byte> encode_report(std::string_view stage, double fraction) {
  std::vector<std::byte> body;
  ByteWriter writer(body);
  writer.text(stage);
  writer.number(fraction);
  return body;
}

ProgressReport decode_report(std::span<const std::byte> body) {
  ByteReader reader(body);
  ProgressReport report;
  report.stage = reader.text();
  report.fraction = reader.number<double>();
  reader.finish();
  return report;
}

std::vector<std::byte> encode_summary(const PreprocessedShape& shape) {
  std::vector<std::byte> body;
  ByteWriter writer(body);
  writer.number(shape.sphere_quality.flipped);
  writer.number(shape.sphere_quality.solid_angle_defect);
  writer.number(shape.sphere_quality.area_distortion);
  writer.text(shape.engine);
  writer.number(static_cast<std::uint32_t>(shape.seconds.size()));
  for (const auto& [stage, seconds] : shape.seconds) {
    writer.text(stage);
    writer.number(seconds);
  }
  return body;
}

void decode_summary(std::span<const std::byte> body, PreprocessedShape& shape) {
  ByteReader reader(body);
  shape.sphere_quality.flipped = reader.number<std::int32_t>();
  shape.sphere_quality.solid_angle_defect = reader.number<double>();
  shape.sphere_quality.area_distortion = reader.number<double>();
  shape.engine = reader.text();
  const auto stages = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < stages; ++i) {
    std::string stage = reader.text();
    shape.seconds.emplace_back(std::move(stage), reader.number<double>());
  }
  reader.finish();
}

std::vector<std::byte> encode_refusal(const EngineError& error) {
  std::vector<std::byte> body;
  ByteWriter writer(body);
  writer.number(static_cast<std::uint32_t>(error.code()));
  writer.text(error.what());
  return body;
}

EngineError decode_refusal(std::span<const std::byte> body) {
  ByteReader reader(body);
  const auto code = reader.number<std::uint32_t>();
  const std::string detail = reader.text();
  reader.finish();
  if (code > static_cast<std::uint32_t>(ErrorCode::invalid_parameter)) {
    throw StorageError(StorageErrorCode::corrupt_blob, "an error of no known code");
  }
  return {static_cast<ErrorCode>(code), detail};
}

}  // namespace spherematch
