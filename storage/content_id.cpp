#include "storage/content_id.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <memory>
#include <new>
#include <stdexcept>

namespace spherematch {
namespace {

struct ContextDeleter {
  void operator()(EVP_MD_CTX* context) const { EVP_MD_CTX_free(context); }
};
using Context = std::unique_ptr<EVP_MD_CTX, ContextDeleter>;

constexpr std::size_t digest_size = 32;
constexpr std::size_t id_digits = 32;

void require(int openssl_result) {
  if (openssl_result != 1) throw std::runtime_error("SHA-256 is not available from the system's OpenSSL");
}

Context new_context() {
  Context context(EVP_MD_CTX_new());
  if (context == nullptr) throw std::bad_alloc();
  return context;
}

std::string finish_as_hex(EVP_MD_CTX* context) {
  std::array<unsigned char, digest_size> digest{};
  require(EVP_DigestFinal_ex(context, digest.data(), nullptr));
  constexpr std::string_view digits = "0123456789abcdef";
  std::string hex;
  hex.reserve(2 * digest_size);
  for (const unsigned char byte : digest) {
    hex += digits[byte >> 4];
    hex += digits[byte & 15];
  }
  return hex;
}

}  // namespace

ContentId content_id(std::span<const std::byte> bytes, std::string_view options) {
  const Context with_options = new_context();
  require(EVP_DigestInit_ex(with_options.get(), EVP_sha256(), nullptr));
  require(EVP_DigestUpdate(with_options.get(), bytes.data(), bytes.size()));
  const Context bytes_alone = new_context();
  require(EVP_MD_CTX_copy_ex(bytes_alone.get(), with_options.get()));
  const char separator = '\0';
  require(EVP_DigestUpdate(with_options.get(), &separator, 1));
  require(EVP_DigestUpdate(with_options.get(), options.data(), options.size()));
  return {finish_as_hex(with_options.get()).substr(0, id_digits), finish_as_hex(bytes_alone.get()), std::string(options)};
}

bool is_shape_id(std::string_view text) {
  const auto is_hex = [](char c) { return (c >= '0' && c <= '9') || (c >= 'a' && c <= 'f'); };
  return text.size() == id_digits && std::all_of(text.begin(), text.end(), is_hex);
}

}  // namespace spherematch
