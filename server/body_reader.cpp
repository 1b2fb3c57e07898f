#include "server/body_reader.h"

#include <charconv>

namespace spherematch {

namespace {

std::optional<std::size_t> declared_length(const httplib::Request& request) {
  const std::string text = request.get_header_value("Content-Length");
  std::size_t length = 0;
  const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), length);
  if (text.empty() || error != std::errc() || stop != text.data() + text.size()) return std::nullopt;
  return length;
}

void read_raw(const httplib::ContentReader& reader, Upload& upload) {
  const bool complete = reader([&upload](const char* data, size_t size) {
    upload.bytes.append(data, size);
    return true;
  });
  if (!complete) throw ProblemError(api::Code::bad_request, "the body ended before its Content-Length");
}

void read_multipart(const httplib::ContentReader& reader, Upload& upload) {
  int files = 0;
  std::string refusal;
  const bool complete = reader(
      [&](const httplib::MultipartFormData& part) {
        if (part.name != "file") {
          refusal = "unknown field '" + part.name.substr(0, 64) + "'; the only field is file, parameters stand in the query";
        } else if (++files > 1) {
          refusal = "file: given more than once";
        }
        upload.file_name = part.filename;
        return refusal.empty();
      },
      [&upload](const char* data, size_t size) {
        upload.bytes.append(data, size);
        return true;
      });
  if (!refusal.empty()) throw ProblemError(api::Code::invalid_parameter, refusal);
  if (!complete) throw ProblemError(api::Code::bad_request, "the multipart body is malformed or ended early");
  if (files == 0) throw ProblemError(api::Code::invalid_parameter, "file: the multipart body has no such field");
}

}  // namespace

std::optional<ProblemError> refuse_body(const httplib::Request& request, std::size_t max_bytes) {
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
    return ProblemError(api::Code::content_encoding, "send the mesh as it is, without Content-Encoding");
  }
  const std::string type = request.get_header_value("Content-Type");
  if (type.starts_with("multipart/") && !request.is_multipart_form_data()) {
    return ProblemError(api::Code::unsupported_media_type, "of the multipart types only multipart/form-data is accepted");
  }
  return std::nullopt;
}

Upload read_upload(const httplib::Request& request, const httplib::ContentReader& reader, Gate& uploads) {
  Upload upload;
  upload.permit = std::make_shared<Gate::Permit>(uploads.enter());
  if (request.is_multipart_form_data()) {
    read_multipart(reader, upload);
  } else {
    // Reserved memory is not touched before bytes arrive, so a false promise costs nothing.
    upload.bytes.reserve(declared_length(request).value_or(0));
    read_raw(reader, upload);
  }
  return upload;
}

}  // namespace spherematch
