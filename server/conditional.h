// Entity tags and If-None-Match (RFC 9110, section 13.1.2).
#pragma once

#include <initializer_list>
#include <string>
#include <string_view>

namespace spherematch {

/// A tag over everything that determines the bytes of a result. Weak, because the HTTP library compresses under the same tag.
[[nodiscard]] std::string weak_etag(std::initializer_list<std::string_view> parts);

/// Whether an If-None-Match header names the tag, by weak comparison. An empty header names nothing.
[[nodiscard]] bool names_etag(std::string_view if_none_match, std::string_view etag);

}  // namespace spherematch
