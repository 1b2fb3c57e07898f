// A request and a response as the routes see them, free of the HTTP library.
#pragma once

#include <functional>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace spherematch {

/// The body of an upload and the right to hold it in memory.
struct Upload {
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

  std::string id;  ///< what stands for {id} in the route; filled by the router
  Upload upload;   ///< filled for a route that takes a body; the handler should let go of it as soon as it can

  /// The header's value, or empty.
  [[nodiscard]] std::string header(const std::string& lower_case_name) const {
    const auto found = headers.find(lower_case_name);
    return found == headers.end() ? std::string() : found->second;
  }
};

struct HttpResponse {
  int status = 200;
  std::string content_type;
  std::string body;
  std::vector<std::pair<std::string, std::string>> headers;
};

using Handler = std::function<HttpResponse(HttpRequest&)>;

}  // namespace spherematch
