// Who may do what: the keys of a file, and which scope a request needs.
#pragma once

#include <filesystem>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "server/http_message.h"
#include "server/key_file.h"

namespace spherematch {

/// The scope that a request needs; nothing where none. `pattern` is the route's (server/router.h), or "-" where no route fits.
[[nodiscard]] std::optional<Scope> needed_scope(std::string_view method, std::string_view pattern);

/// Thread-safe. Reads the file again as soon as it has changed. A file that is then missing or broken is logged, and the keys before it
/// stay valid.
class Access {
 public:
  /// Without a file everybody may do everything. @throws KeyFileError
  explicit Access(const std::optional<std::filesystem::path>& file);

  /// The name of the key that comes with the request; empty where none does, or none that is known.
  [[nodiscard]] std::string caller(std::string_view authorization, std::string_view api_key);

  /// @throws ProblemError(unauthorized, forbidden)
  void check(const HttpRequest& request, std::string_view pattern);

 private:
  using Keys = std::shared_ptr<const std::vector<Key>>;
  /// What changes with the file's content, as far as the file system knows.
  struct Stamp {
    std::uint64_t inode = 0;
    std::int64_t size = -1;
    std::int64_t seconds = 0;
    std::int64_t nanoseconds = 0;
    bool operator==(const Stamp&) const = default;
  };

  [[nodiscard]] Stamp stamp() const;
  [[nodiscard]] Keys keys();
  [[nodiscard]] std::optional<Key> find(std::string_view authorization, std::string_view api_key);

  const std::optional<std::filesystem::path> file_;
  std::mutex mutex_;
  Stamp read_stamp_;
  Keys keys_;
};

}  // namespace spherematch
