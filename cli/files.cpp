#include "cli/files.h"

#include <cerrno>
#include <fstream>
#include <system_error>

#include "cli/exit_code.h"

namespace spherematch {

std::vector<std::byte> read_file(const std::filesystem::path& file) {
  // Opening a directory succeeds and reading it fails late, with a message that helps nobody.
  if (std::filesystem::is_directory(file)) throw FileError(file.string() + ": is a directory");
  std::ifstream in(file, std::ios::binary | std::ios::ate);
  if (!in) throw FileError(file.string() + ": " + std::generic_category().message(errno));
  std::vector<std::byte> bytes(static_cast<std::size_t>(in.tellg()));
  in.seekg(0);
  in.read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  if (!in) throw FileError(file.string() + ": cannot be read");
  return bytes;
}

void write_file(const std::filesystem::path& file, const std::string& bytes) {
  std::ofstream out(file, std::ios::binary | std::ios::trunc);
  out.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  out.close();
  if (!out) throw FileError(file.string() + ": cannot be written");
}

}  // namespace spherematch
