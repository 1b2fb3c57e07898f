#include "server/conditional.h"

#include <span>

#include "storage/content_id.h"

namespace spherematch {

namespace {

std::string_view opaque(std::string_view tag) { return tag.starts_with("W/") ? tag.substr(2) : tag; }

}  // namespace

std::string weak_etag(std::initializer_list<std::string_view> parts) {
  std::string text;
  // The length in front keeps ("ab", "c") apart from ("a", "bc").
  for (const std::string_view part : parts) text.append(std::to_string(part.size())).append(":").append(part);
  return "W/\"" + content_id(std::as_bytes(std::span(text)), "etag").id + "\"";
}

bool names_etag(std::string_view if_none_match, std::string_view etag) {
  while (!if_none_match.empty()) {
    const auto comma = if_none_match.find(',');
    std::string_view item = if_none_match.substr(0, comma);
    if_none_match = comma == std::string_view::npos ? std::string_view() : if_none_match.substr(comma + 1);
    const auto first = item.find_first_not_of(" \t");
    if (first == std::string_view::npos) continue;
    item = item.substr(first, item.find_last_not_of(" \t") - first + 1);
    if (item == "*" || opaque(item) == opaque(etag)) return true;
  }
  return false;
}

HttpResponse answer_unless_known(const HttpRequest& request, const std::string& etag, const std::function<HttpResponse()>& make) {
  HttpResponse response{.status = 304, .content_type = {}, .body = {}, .headers = {}};
  if (!names_etag(request.header("if-none-match"), etag)) response = make();
  for (const auto& [name, value] :
       {std::pair("ETag", etag.c_str()), std::pair("Cache-Control", "private, no-cache"), std::pair("Vary", "Accept")}) {
    response.headers.emplace_back(name, value);
  }
  return response;
}

}  // namespace spherematch
