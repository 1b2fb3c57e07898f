#include "server/access.h"

#include <sys/stat.h>

#include <algorithm>
#include <array>

#include "server/event_log.h"
#include "server/problem.h"

namespace spherematch {

namespace {

struct Rule {
  std::string_view method;   ///< "*" for any
  std::string_view pattern;  ///< "*" for any
  std::optional<Scope> scope;
};

/// The first that fits counts. HEAD is GET.
constexpr auto rules = std::to_array<Rule>({
    {"GET", "/", std::nullopt},
    {"GET", "/healthz", std::nullopt},
    {"GET", "/readyz", std::nullopt},
    {"GET", "/version", std::nullopt},
    {"GET", "/openapi.json", std::nullopt},
    {"GET", "/docs", std::nullopt},
    {"GET", "/page/{id}", std::nullopt},
    {"GET", "/metrics", Scope::admin},
    {"POST", "/match", Scope::read},
    {"POST", "/evaluations", Scope::read},
    {"POST", "/transfer", Scope::read},
    {"GET", "*", Scope::read},
    {"*", "*", Scope::write},
});

constexpr std::string_view bearer = "bearer ";
constexpr const char* challenge_header = "WWW-Authenticate";
constexpr std::string_view challenge = "Bearer realm=\"spherematch\"";

bool begins_with_bearer(std::string_view authorization) {
  return authorization.size() >= bearer.size() && std::equal(bearer.begin(), bearer.end(), authorization.begin(), [](char a, char b) {
           return a == static_cast<char>(std::tolower(static_cast<unsigned char>(b)));
         });
}

/// The key's text; empty where there is none.
std::string_view key_text(std::string_view authorization, std::string_view api_key) {
  if (!begins_with_bearer(authorization)) return api_key;
  authorization.remove_prefix(std::min(authorization.find_first_not_of(' ', bearer.size()), authorization.size()));
  return authorization;
}

ProblemError problem(api::Code code, const std::string& detail, const std::string& addition) {
  api::Problem problem;
  problem.code = code;
  problem.detail = detail;
  return ProblemError(problem, {{challenge_header, std::string(challenge).append(addition)}});
}

ProblemError unauthorized(bool has_key) {
  if (has_key) return problem(api::Code::unauthorized, "this server does not know the key", ", error=\"invalid_token\"");
  return problem(api::Code::unauthorized, "send a key: Authorization: Bearer KEY, or X-API-Key: KEY", "");
}

ProblemError forbidden(const Key& key, Scope needed) {
  const std::string scope(to_string(needed));
  return problem(api::Code::forbidden,
                 "key '" + key.name + "' has the scope " + std::string(to_string(key.scope)) + "; this takes " + scope,
                 ", error=\"insufficient_scope\", scope=\"" + scope + "\"");
}

}  // namespace

std::optional<Scope> needed_scope(std::string_view method, std::string_view pattern) {
  if (method == "HEAD") method = "GET";
  const auto fits = [&](const Rule& rule) {
    return (rule.method == "*" || rule.method == method) && (rule.pattern == "*" || rule.pattern == pattern);
  };
  return std::find_if(rules.begin(), rules.end(), fits)->scope;
}

Access::Access(const std::optional<std::filesystem::path>& file) : file_(file) {
  if (!file_) return;
  read_stamp_ = stamp();
  keys_ = std::make_shared<const std::vector<Key>>(read_key_file(*file_));
}

std::string Access::caller(std::string_view authorization, std::string_view api_key) {
  const auto key = find(authorization, api_key);
  return key ? key->name : std::string();
}

void Access::check(const HttpRequest& request, std::string_view pattern) {
  const auto needed = needed_scope(request.method, pattern);
  if (!file_ || !needed) return;
  const std::string authorization = request.header("authorization");
  const std::string api_key = request.header("x-api-key");
  const auto key = find(authorization, api_key);
  if (!key) throw unauthorized(!key_text(authorization, api_key).empty());
  if (key->scope < *needed) throw forbidden(*key, *needed);
}

Access::Stamp Access::stamp() const {
  struct stat status {};
  if (::stat(file_->c_str(), &status) != 0) return {};
  return {status.st_ino, status.st_size, status.st_mtim.tv_sec, status.st_mtim.tv_nsec};
}

Access::Keys Access::keys() {
  const std::lock_guard lock(mutex_);
  const Stamp now = stamp();
  if (now == read_stamp_) return keys_;
  read_stamp_ = now;
  try {
    keys_ = std::make_shared<const std::vector<Key>>(read_key_file(*file_));
    log_info("keys_read", {{"file", file_->native()}, {"keys", keys_->size()}});
  } catch (const KeyFileError& error) {
    log_error("keys_not_read", {{"detail", error.what()}});
  }
  return keys_;
}

std::optional<Key> Access::find(std::string_view authorization, std::string_view api_key) {
  const std::string_view text = key_text(authorization, api_key);
  if (!file_ || text.empty()) return std::nullopt;
  const std::string digest = sha256_of(text);
  std::optional<Key> found;
  // To the end in any case, so that the time does not tell which one it is.
  for (const Key& key : *keys()) {
    if (equal_in_constant_time(key.sha256, digest)) found = key;
  }
  return found;
}

}  // namespace spherematch
