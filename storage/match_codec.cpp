#include "storage/match_codec.h"

#include <utility>

#include "storage/blob_frame.h"
#include "storage/byte_stream.h"

namespace spherematch {
namespace {

constexpr std::size_t bytes_per_row = 7 * 4;  // vertex, three corners, three weights

void write_map(ByteWriter& writer, const Correspondence& map) {
  writer.number(static_cast<std::uint32_t>(map.vertex.size()));
  writer.array(map.vertex.data(), map.vertex.size());
  writer.array(map.corners.data(), 3 * map.vertex.size());
  writer.array(map.bary.data(), 3 * map.vertex.size());
}

Correspondence read_map(ByteReader& reader) {
  const auto rows = reader.number<std::uint32_t>();
  reader.require<std::uint8_t>(std::uint64_t{rows} * bytes_per_row);
  Correspondence map;
  map.vertex.resize(rows);
  map.corners.resize(static_cast<Eigen::Index>(rows), 3);
  map.bary.resize(static_cast<Eigen::Index>(rows), 3);
  reader.array(map.vertex.data(), rows);
  reader.array(map.corners.data(), std::size_t{3} * rows);
  reader.array(map.bary.data(), std::size_t{3} * rows);
  return map;
}

void write_named(ByteWriter& writer, const std::vector<std::pair<std::string, double>>& numbers) {
  writer.number(static_cast<std::uint32_t>(numbers.size()));
  for (const auto& [name, value] : numbers) {
    writer.text(name);
    writer.number(value);
  }
}

std::vector<std::pair<std::string, double>> read_named(ByteReader& reader) {
  std::vector<std::pair<std::string, double>> numbers;
  const auto count = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < count; ++i) {  // a false count ends with the blob
    std::string name = reader.text();
    numbers.emplace_back(std::move(name), reader.number<double>());
  }
  return numbers;
}

void write_candidate(ByteWriter& writer, const CandidateSummary& candidate) {
  writer.array(candidate.rotation.data(), candidate.rotation.size());
  writer.number(candidate.correlation);
  writer.number(candidate.score);
  writer.number(std::uint8_t{candidate.chosen});
}

CandidateSummary read_candidate(ByteReader& reader) {
  CandidateSummary candidate;
  reader.array(candidate.rotation.data(), candidate.rotation.size());
  candidate.correlation = reader.number<double>();
  candidate.score = reader.number<double>();
  candidate.chosen = reader.number<std::uint8_t>() != 0;
  return candidate;
}

}  // namespace

std::vector<std::byte> encode_match(const MatchResult& result) {
  std::vector<std::byte> blob(blob_header_size);
  blob.reserve(blob_header_size + bytes_per_row * (result.map.vertex.size() + result.reverse.vertex.size()) + 4096);
  ByteWriter writer(blob);
  write_map(writer, result.map);
  write_map(writer, result.reverse);
  writer.number(std::uint8_t{result.reversed});
  writer.number(static_cast<std::uint32_t>(result.candidates.size()));
  for (const CandidateSummary& candidate : result.candidates) write_candidate(writer, candidate);
  write_named(writer, result.quality);
  write_named(writer, result.seconds);
  seal_blob(blob, BlobKind::match, BlobCompression::where_it_helps);
  return blob;
}

MatchResult decode_match(std::span<const std::byte> blob) {
  std::vector<std::byte> buffer;
  ByteReader reader(open_blob(blob, BlobKind::match, buffer));
  MatchResult result;
  result.map = read_map(reader);
  result.reverse = read_map(reader);
  result.reversed = reader.number<std::uint8_t>() != 0;
  const auto candidates = reader.number<std::uint32_t>();
  for (std::uint32_t i = 0; i < candidates; ++i) result.candidates.push_back(read_candidate(reader));
  result.quality = read_named(reader);
  result.seconds = read_named(reader);
  reader.finish();
  return result;
}

}  // namespace spherematch
