#include "server/key_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <openssl/crypto.h>
#include <openssl/evp.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <set>
#include <span>
#include <sstream>

#include "server/descriptor.h"

namespace spherematch {

namespace {

constexpr std::size_t max_name = 64;
constexpr std::uintmax_t max_file = 1 << 20;
constexpr std::size_t key_bytes = 32;
/// By which people and scanners for lost secrets know a key.
constexpr std::string_view key_prefix = "sm_";
constexpr std::string_view heading = "# Keys of a Spherematch server: name scope sha256-of-the-key made\n";

std::string hex(std::span<const unsigned char> bytes) {
  std::string text;
  for (const unsigned char byte : bytes) text += fmt::format("{:02x}", byte);
  return text;
}

bool is_name(std::string_view text) {
  return !text.empty() && text.size() <= max_name &&
         std::all_of(text.begin(), text.end(), [](unsigned char c) { return std::isalnum(c) != 0 || c == '.' || c == '_' || c == '-'; });
}

bool is_digest(std::string_view text) { return text.size() == 64 && text.find_first_not_of("0123456789abcdef") == std::string_view::npos; }

std::vector<std::string> words_of(const std::string& line) {
  std::istringstream in(line);
  std::vector<std::string> words;
  for (std::string word; in >> word;) words.push_back(word);
  return words;
}

/// Nothing for a line without a key. @throws KeyFileError
std::optional<Key> key_of(const std::string& line) {
  const std::vector<std::string> words = words_of(line);
  if (words.empty() || words[0].starts_with('#')) return std::nullopt;
  if (words.size() != 4) throw KeyFileError("not of the form: name scope sha256 made");
  const auto scope = scope_of(words[1]);
  if (!is_name(words[0])) throw KeyFileError("the name is not 1 to 64 letters, digits, '.', '_', '-'");
  if (!scope) throw KeyFileError("the scope is not read, write or admin");
  if (!is_digest(words[2])) throw KeyFileError("the third word is not 64 lower-case hex digits");
  return Key{words[0], *scope, words[2], words[3]};
}

[[noreturn]] void fail(const std::filesystem::path& file, const std::string& what) {
  throw KeyFileError(file.string() + ": " + what + ": " + std::strerror(errno));
}

std::string text_of(const std::filesystem::path& file) {
  std::error_code error;
  const std::uintmax_t size = std::filesystem::file_size(file, error);
  if (error) throw KeyFileError(file.string() + ": " + error.message());
  if (size > max_file) throw KeyFileError(file.string() + ": too large for a file of keys");
  std::ifstream in(file);
  std::string text(std::istreambuf_iterator<char>(in), {});
  if (!in) fail(file, "cannot be read");
  return text;
}

std::string new_key() {
  std::array<unsigned char, key_bytes> bytes{};
  if (::getrandom(bytes.data(), bytes.size(), 0) != static_cast<ssize_t>(bytes.size())) throw KeyFileError("no random numbers");
  return std::string(key_prefix).append(hex(bytes));
}

std::string today() {
  const std::chrono::year_month_day day(std::chrono::floor<std::chrono::days>(std::chrono::system_clock::now()));
  return fmt::format("{:04}-{:02}-{:02}", static_cast<int>(day.year()), static_cast<unsigned>(day.month()),
                     static_cast<unsigned>(day.day()));
}

void write_all(int file, std::string_view text, const std::filesystem::path& name) {
  while (!text.empty()) {
    const ssize_t count = ::write(file, text.data(), text.size());
    if (count < 0 && errno != EINTR) fail(name, "cannot be written");
    if (count > 0) text.remove_prefix(static_cast<std::size_t>(count));
  }
  if (::fsync(file) != 0) fail(name, "cannot be written");
}

/// In one step: whoever reads sees the old file or the new one. The owner stays, so that the server can still read what root has changed.
void replace(const std::filesystem::path& file, std::string_view text) {
  const std::filesystem::path next = file.string() + ".new";
  struct stat old {};
  const bool is_there = ::stat(file.c_str(), &old) == 0;
  const Descriptor out(::open(next.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC | O_NOFOLLOW, S_IRUSR | S_IWUSR));
  if (out.get() < 0 || ::fchmod(out.get(), S_IRUSR | S_IWUSR) != 0) fail(next, "cannot be made");
  if (is_there && (old.st_uid != ::geteuid() || old.st_gid != ::getegid()) && ::fchown(out.get(), old.st_uid, old.st_gid) != 0) {
    fail(next, "cannot be given to the owner of the old file");
  }
  write_all(out.get(), text, next);
  if (::rename(next.c_str(), file.c_str()) != 0) fail(file, "cannot be replaced");
}

/// Changes the file under a lock on its directory, which ends with the process.
void edit(std::filesystem::path file, const std::function<std::string(const std::string&)>& change) {
  std::error_code ignored;
  if (std::filesystem::exists(file, ignored)) file = std::filesystem::canonical(file);
  const std::filesystem::path directory = file.has_parent_path() ? file.parent_path() : ".";
  const Descriptor lock(::open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC));
  if (lock.get() < 0 || ::flock(lock.get(), LOCK_EX) != 0) fail(directory, "cannot be opened");
  replace(file, change(std::filesystem::exists(file, ignored) ? text_of(file) : std::string(heading)));
  ::fsync(lock.get());
}

}  // namespace

std::string_view to_string(Scope scope) {
  switch (scope) {
    case Scope::read:
      return "read";
    case Scope::write:
      return "write";
    case Scope::admin:
      break;
  }
  return "admin";
}

std::optional<Scope> scope_of(std::string_view text) {
  for (const Scope scope : {Scope::read, Scope::write, Scope::admin}) {
    if (text == to_string(scope)) return scope;
  }
  return std::nullopt;
}

std::vector<Key> parse_keys(std::string_view text) {
  std::vector<Key> keys;
  std::set<std::string> names;
  std::istringstream in{std::string(text)};
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    try {
      const auto key = key_of(line);
      if (!key) continue;
      if (!names.insert(key->name).second) throw KeyFileError("there is another key of this name");
      keys.push_back(*key);
    } catch (const KeyFileError& error) {
      throw KeyFileError("line " + std::to_string(number) + ": " + error.what());
    }
  }
  return keys;
}

std::vector<Key> read_key_file(const std::filesystem::path& file) {
  const std::string text = text_of(file);
  try {
    return parse_keys(text);
  } catch (const KeyFileError& error) {
    throw KeyFileError(file.string() + ": " + error.what());
  }
}

std::string add_key(const std::filesystem::path& file, const std::string& name, Scope scope) {
  if (!is_name(name)) throw KeyFileError("a key's name is 1 to 64 letters, digits, '.', '_', '-'");
  std::string key = new_key();
  edit(file, [&](std::string text) {
    const std::vector<Key> keys = parse_keys(text);
    const bool taken = std::any_of(keys.begin(), keys.end(), [&](const Key& other) { return other.name == name; });
    if (taken) throw KeyFileError("there is a key named " + name + " already");
    if (!text.empty() && text.back() != '\n') text += '\n';
    return text + fmt::format("{} {} {} {}\n", name, to_string(scope), sha256_of(key), today());
  });
  return key;
}

void remove_key(const std::filesystem::path& file, const std::string& name) {
  edit(file, [&](const std::string& text) {
    std::istringstream in(text);
    std::string line;
    std::string rest;
    bool found = false;
    while (std::getline(in, line)) {
      const std::vector<std::string> words = words_of(line);
      const bool is_it = !words.empty() && words[0] == name;
      found = found || is_it;
      if (!is_it) rest += line + "\n";
    }
    if (!found) throw KeyFileError("there is no key named " + name);
    return rest;
  });
}

std::string sha256_of(std::string_view text) {
  std::array<unsigned char, 32> digest{};
  if (EVP_Digest(text.data(), text.size(), digest.data(), nullptr, EVP_sha256(), nullptr) != 1) {
    throw std::runtime_error("SHA-256 is not available from the system's OpenSSL");
  }
  return hex(digest);
}

bool equal_in_constant_time(std::string_view a, std::string_view b) {
  return a.size() == b.size() && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

}  // namespace spherematch
