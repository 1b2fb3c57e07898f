// Entity tags and If-None-Match (RFC 9110, section 13.1.2).
#pragma once

#include <functional>
#include <initializer_list>
#include <string>
#include <string_view>

#include "server/http_message.h"

namespace spherematch {

/// A tag over everything that determines the bytes of a result. Weak, because the HTTP library compresses under the same tag.
[[nodiscard]] std::string weak_etag(std::initializer_list<std::string_view> parts);

/// Whether an If-None-Match header names the tag, by weak comparison. An empty header names nothing.
[[nodiscard]] bool names_etag(std::string_view if_none_match, std::string_view etag);

/// What GET answers for something derived: 304 where the request names the tag already, else what `make` makes, with the tag and the
/// headers that let it be kept and asked for again. The representation was chosen by `format` or Accept.
[[nodiscard]] HttpResponse answer_unless_known(const HttpRequest& request, const std::string& etag,
                                               const std::function<HttpResponse()>& make);

}  // namespace spherematch
