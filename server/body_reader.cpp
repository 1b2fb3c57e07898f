#include "server/body_reader.h"

#include <charconv>
#include <optional>
#include <utility>

namespace spherematch {

namespace {

std::optional<std::size_t> declared_length(const httplib::Request& request) {
  const std::string text = request.get_header_value("Content-Length");
  std::size_t length = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return length;
}

/// What stays with a body while its bytes live.
struct Permit {
  explicit Permit(ByteBudget& memory) : share(memory) {}
  ByteBudget::Share share;
  std::optional<Gate::Permit> reading;
};

/// Takes bytes as long as there is room for them.
class Collector {
 public:
  Collector(std::string& bytes, ByteBudget::Share& share) : bytes_(bytes), share_(share) {}

  bool take(const char* data, std::size_t size) {
    has_room_ = share_.grow(size);
    if (has_room_) bytes_.append(data, size);
    return has_room_;
  }
  void require_room() const {
    if (!has_room_) throw ProblemError(api::Code::overloaded, "too many request bodies at once; try again");
  }

 private:
  std::string& bytes_;
  ByteBudget::Share& share_;
  bool has_room_ = true;
};

void read_raw(const httplib::ContentReader& reader, Collector& collector) {
  const bool complete = reader([&collector](const char* data, size_t size) { return collector.take(data, size); });
  collector.require_room();
  if (!complete) throw ProblemError(api::Code::bad_request, "the body ended, or stopped coming, before its Content-Length");
}

void read_multipart(const httplib::ContentReader& reader, RequestBody& body, Collector& collector) {
  int files = 0;
  std::string refusal;
  const bool complete = reader(
      [&](const httplib::MultipartFormData& part) {
        if (part.name != "file") {
          refusal = "unknown field '" + part.name.substr(0, 64) + "'; the only field is file, parameters stand in the query";
        } else if (++files > 1) {
          refusal = "file: given more than once";
        }
        body.file_name = part.filename;
        return refusal.empty();
      },
      [&collector](const char* data, size_t size) { return collector.take(data, size); });
  collector.require_room();
  if (!refusal.empty()) throw ProblemError(api::Code::invalid_parameter, refusal);
  if (!complete) throw ProblemError(api::Code::bad_request, "the multipart body is malformed or ended early");
  if (files == 0) throw ProblemError(api::Code::invalid_parameter, "file: the multipart body has no such field");
}

}  // namespace

std::optional<ProblemError> refuse_body(const httplib::Request& request, Body kind, std::size_t max_bytes) {
  if (request.has_header("Transfer-Encoding")) {
    return ProblemError(api::Code::length_required, "chunked bodies are not accepted; send a Content-Length");
  }
  if (!request.has_header("Content-Length")) return ProblemError(api::Code::length_required, "send a Content-Length");
  const auto length = declared_length(request);
  if (!length || request.get_header_value_count("Content-Length") > 1) {
    return ProblemError(api::Code::bad_request, "Content-Length is not one number");
  }
  if (*length > max_bytes) {
    api::Problem problem;
    problem.code = api::Code::payload_too_large;
    problem.detail = "the body has " + std::to_string(*length) + " bytes, the limit is " + std::to_string(max_bytes);
    problem.limit = static_cast<std::int64_t>(max_bytes);
    problem.actual = static_cast<std::int64_t>(std::min<std::size_t>(*length, std::numeric_limits<std::int64_t>::max()));
    return ProblemError(problem);
  }
  const std::string encoding = request.get_header_value("Content-Encoding");
  if (!encoding.empty() && encoding != "identity") {
    return ProblemError(api::Code::content_encoding, "send the body as it is, without Content-Encoding");
  }
  const std::string type = request.get_header_value("Content-Type");
  if (type.starts_with("multipart/") && (kind != Body::upload || !request.is_multipart_form_data())) {
    return ProblemError(api::Code::unsupported_media_type, kind == Body::upload
                                                               ? "of the multipart types only multipart/form-data is accepted"
                                                               : "send the body as it is, not in parts");
  }
  return std::nullopt;
}

RequestBody read_body(const httplib::Request& request, const httplib::ContentReader& reader, Body kind, const BodyBounds& bounds) {
  auto permit = std::make_shared<Permit>(bounds.memory);
  RequestBody body;
  {
    const Gate::Permit receiving = bounds.receiving.enter();
    // Reserved memory is not touched before bytes arrive, so a false promise costs nothing.
    body.bytes.reserve(declared_length(request).value_or(0));
    Collector collector(body.bytes, permit->share);
    if (request.is_multipart_form_data()) {
      read_multipart(reader, body, collector);
    } else {
      read_raw(reader, collector);
    }
  }
  if (kind == Body::upload) permit->reading.emplace(bounds.reading.enter());
  body.permit = std::move(permit);
  return body;
}

}  // namespace spherematch
