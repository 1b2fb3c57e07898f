#include "engine/io/byte_reader.h"

#include "engine/data/error.h"

namespace spherematch {

std::string ByteReader::place() const { return "byte " + std::to_string(offset_ + position_) + ": "; }

void ByteReader::fail(const std::string& message) const { throw EngineError(ErrorCode::malformed_mesh, place() + message); }

void ByteReader::fail_at_end(std::string_view what) const { fail("the file ends where " + std::string(what) + " should be"); }

}  // namespace spherematch
