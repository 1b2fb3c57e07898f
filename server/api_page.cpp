#include <string>

#include "engine/io/markup.h"
#include "server/api_document.h"

namespace spherematch {

namespace {

using api::Json;

constexpr std::string_view head = R"(<!doctype html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<title>Spherematch: the interface</title>
<style>
:root { color-scheme: light dark; --line: #8884; --soft: #8882; }
body { font: 16px/1.5 system-ui, sans-serif; max-width: 60rem; margin: 0 auto; padding: 1rem; }
h2 { margin-top: 2.5rem; border-bottom: 1px solid var(--line); }
h3 { margin: 1.5rem 0 .3rem; }
h3 b { display: inline-block; min-width: 4.5rem; }
table { border-collapse: collapse; width: 100%; margin: .5rem 0; }
th, td { text-align: left; vertical-align: top; padding: .25rem .75rem .25rem 0; border-bottom: 1px solid var(--soft); }
th { font-weight: 600; }
code { background: var(--soft); padding: 0 .25rem; border-radius: .2rem; }
nav a { margin-right: 1rem; white-space: nowrap; }
section { border-left: 3px solid var(--soft); padding-left: 1rem; }
</style>
</head>
<body>
)";

std::string text_of(const Json& object, const char* name) {
  const auto found = object.find(name);
  return found == object.end() ? std::string() : escaped_markup(found->is_string() ? found->get<std::string>() : found->dump());
}

std::string code(const std::string& text) { return "<code>" + text + "</code>"; }

/// What a $ref points to, within the document.
const Json& resolved(const Json& document, const Json& value) {
  const auto reference = value.find("$ref");
  if (reference == value.end()) return value;
  return document.at(Json::json_pointer(reference->get<std::string>().substr(1)));
}

std::string listed(const Json& values) {
  std::string text;
  for (const Json& value : values)
    text += (text.empty() ? "" : ", ") + code(escaped_markup(value.is_string() ? value.get<std::string>() : value.dump()));
  return text;
}

/// A schema in a few words; what has a name of its own becomes a link.
std::string schema_words(const Json& schema) {
  if (const auto reference = schema.find("$ref"); reference != schema.end()) {
    const std::string path = reference->get<std::string>();
    const std::string name = path.substr(path.find_last_of('/') + 1);
    return "<a href=\"#" + name + "\">" + name + "</a>";
  }
  if (schema.contains("enum")) return listed(schema["enum"]);
  if (schema.contains("const")) return code(text_of(schema, "const"));
  if (schema.contains("oneOf")) {
    std::string words;
    for (const Json& choice : schema["oneOf"]) words += (words.empty() ? "" : " or ") + schema_words(choice);
    return words;
  }
  std::string words;
  if (const auto type = schema.find("type"); type != schema.end()) {
    const Json types = type->is_array() ? *type : Json::array({*type});
    for (const Json& name : types) words += (words.empty() ? "" : " or ") + name.get<std::string>();
  }
  if (schema.contains("items")) words += " of " + schema_words(schema["items"]);
  if (const auto range = schema.find("minimum"); range != schema.end()) {
    words += schema.contains("maximum") ? " from " + range->dump() + " to " + schema["maximum"].dump() : " of at least " + range->dump();
  }
  return words;
}

std::string table_row(const std::string& name, const std::string& kind, const std::string& meaning) {
  return "<tr><td>" + code(name) + "</td><td>" + kind + "</td><td>" + meaning + "</td></tr>\n";
}

std::string parameters_of(const Json& document, const Json& item, const Json& operation) {
  std::string rows;
  for (const Json* owner : {&item, &operation}) {
    if (!owner->contains("parameters")) continue;
    for (const Json& entry : (*owner)["parameters"]) {
      const Json& parameter = resolved(document, entry);
      std::string meaning = text_of(parameter, "description");
      if (parameter.value("required", false)) meaning += meaning.empty() ? "required" : "; required";
      const Json& schema = parameter["schema"];
      if (schema.contains("default")) meaning += (meaning.empty() ? "default " : "; default ") + code(text_of(schema, "default"));
      rows += table_row(text_of(parameter, "name"), schema_words(schema), meaning);
    }
  }
  return rows.empty() ? "" : "<table><tr><th>Parameter</th><th>Values</th><th>Meaning</th></tr>\n" + rows + "</table>\n";
}

std::string content_of(const Json& holder) {
  std::string text;
  if (!holder.contains("content")) return text;
  for (const auto& [type, media] : holder["content"].items()) {
    text += (text.empty() ? "" : "<br>") + code(escaped_markup(type));
    const Json& schema = media["schema"];
    if (schema.contains("$ref") || schema.contains("oneOf")) text += " " + schema_words(schema);
  }
  return text;
}

std::string responses_of(const Json& document, const Json& operation) {
  std::string rows;
  for (const auto& [status, entry] : operation["responses"].items()) {
    const Json& response = resolved(document, entry);
    rows += table_row(status, content_of(response), text_of(entry.contains("description") ? entry : response, "description"));
  }
  return "<table><tr><th>Status</th><th>Body</th><th>When</th></tr>\n" + rows + "</table>\n";
}

std::string operation_html(const Json& document, const std::string& path, const std::string& method, const Json& item) {
  const Json& operation = item[method];
  std::string upper = method;
  for (char& c : upper) c = static_cast<char>(c - 'a' + 'A');
  std::string html = "<h3><b>" + upper + "</b> " + code(escaped_markup(path)) + "</h3>\n<section>\n<p>" + text_of(operation, "summary") +
                     ". " + text_of(operation, "description") + "</p>\n" + parameters_of(document, item, operation);
  if (operation.contains("requestBody")) html += "<p>Body: " + content_of(operation["requestBody"]) + "</p>\n";
  return html + responses_of(document, operation) + "</section>\n";
}

std::string operations_of_tag(const Json& document, const std::string& tag) {
  std::string html;
  for (const auto& [path, item] : document["paths"].items()) {
    for (const auto& [method, operation] : item.items()) {
      if (method != "parameters" && operation["tags"][0] == tag) html += operation_html(document, path, method, item);
    }
  }
  return html;
}

std::string schema_html(const std::string& name, const Json& schema) {
  std::string html = "<h3 id=\"" + name + "\">" + name + "</h3>\n<section>\n";
  if (schema.contains("description")) html += "<p>" + text_of(schema, "description") + "</p>\n";
  if (!schema.contains("properties")) return html + "<p>" + schema_words(schema) + "</p></section>\n";
  html += "<table><tr><th>Member</th><th>Values</th><th>Meaning</th></tr>\n";
  for (const auto& [member, type] : schema["properties"].items())
    html += table_row(member, schema_words(type), text_of(type, "description"));
  return html + "</table></section>\n";
}

}  // namespace

std::string api_page(const Json& document) {
  std::string html(head);
  html += "<h1>Spherematch: the interface</h1>\n<p>" + text_of(document["info"], "description") + "</p>\n<nav>";
  for (const Json& tag : document["tags"]) html += "<a href=\"#tag-" + text_of(tag, "name") + "\">" + text_of(tag, "description") + "</a>";
  html += "<a href=\"#schemas\">Schemas</a><a href=\"/openapi.json\">openapi.json</a></nav>\n";
  for (const Json& tag : document["tags"]) {
    const std::string name = tag["name"].get<std::string>();
    html += "<h2 id=\"tag-" + escaped_markup(name) + "\">" + text_of(tag, "description") + "</h2>\n" + operations_of_tag(document, name);
  }
  html += "<h2 id=\"schemas\">Schemas</h2>\n";
  for (const auto& [name, schema] : document["components"]["schemas"].items()) html += schema_html(name, schema);
  return html + "</body>\n</html>\n";
}

}  // namespace spherematch
