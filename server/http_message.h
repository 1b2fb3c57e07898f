// A request and a response as the routes see them, free of the HTTP library.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace spherematch {

/// The body of a request and the right to hold it in memory.
struct RequestBody {
  std::string bytes;
  std::string file_name;         ///< of a multipart upload, else empty
  std::shared_ptr<void> permit;  ///< released with the bytes
};

struct HttpRequest {
  std::string method;
  std::string path;                               ///< percent-decoded, without the query
  std::multimap<std::string, std::string> query;  ///< percent-decoded
  std::map<std::string, std::string> headers;     ///< names in lower case; the first value of each
  std::string request_id;

  std::string id;    ///< what stands for {id} in the route; filled by the router
  RequestBody body;  ///< filled for a route that takes a body; the handler should let go of it as soon as it can

  /// The header's value, or empty.
  [[nodiscard]] std::string header(const std::string& lower_case_name) const {
    const auto found = headers.find(lower_case_name);
    return found == headers.end() ? std::string() : found->second;
  }
};

/// A body that is sent as it comes to be: each call gives the next piece, nothing at the end. It may wait for about a second and then
/// give an empty piece, so that a server that stops and a client that went away are noticed. Called by one thread.
using BodyStream = std::function<std::optional<std::string>()>;

struct HttpResponse {
  int status = 200;
  std::string content_type;
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
  BodyStream stream = {};  ///< where it is set, `body` is not sent
};

using Handler = std::function<HttpResponse(HttpRequest&)>;

}  // namespace spherematch
