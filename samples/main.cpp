// make-samples OUTDIR: writes the sample creatures with their ground truth.
#include <exception>
#include <filesystem>
#include <fstream>
#include <iostream>

#include "samples/sample_set.h"

int main(int argc, char** argv) {
  if (argc != 2) {
    std::cerr << "usage: make-samples OUTDIR\n";
    return 2;
  }
  try {
    std::size_t bytes = 0;
    const std::vector<spherematch::samples::File> files = spherematch::samples::sample_set();
    for (const spherematch::samples::File& file : files) {
      const std::filesystem::path path = std::filesystem::path(argv[1]) / file.path;
      std::filesystem::create_directories(path.parent_path());
      std::ofstream out(path, std::ios::binary);
      out << file.bytes;
      out.close();
      if (!out) throw std::runtime_error("cannot write " + path.string());
      bytes += file.bytes.size();
    }
    std::cout << files.size() << " files, " << bytes << " bytes\n";
    return 0;
  } catch (const std::exception& e) {
    std::cerr << e.what() << '\n';
    return 1;
  }
}
