// The interface as an OpenAPI 3.1 document, and as a page for people. Both are made of docs/openapi.yaml, which the build puts into the
// program.
#pragma once

#include <string>
#include <string_view>

#include "api/types.h"

namespace spherematch {

/// The text of docs/openapi.yaml.
[[nodiscard]] std::string_view api_document_text();

/// YAML as JSON: mappings in their order, quoted scalars as text, others by their form. @throws std::runtime_error with the line
[[nodiscard]] api::Json json_of_yaml(std::string_view yaml);

/// One HTML page without scripts: every operation with its parameters, bodies and responses, and every schema.
/// `document` follows OpenAPI 3.1 as far as docs/openapi.yaml uses it.
[[nodiscard]] std::string api_page(const api::Json& document);

}  // namespace spherematch
