// usage: write_mesh_seeds FOLDER    one small file of each format, as a start for read_mesh_fuzz
#include <fstream>
#include <iostream>

#include "tests/support/mesh_files.h"
#include "tests/support/meshes.h"

int main(int count, char** arguments) {
  using namespace spherematch::test;
  if (count != 2) {
    std::cerr << "usage: write_mesh_seeds FOLDER\n";
    return 2;
  }
  // The byte before the file chooses its name: none.
  for (const auto& [name, bytes] : in_every_format(fit_for_every_format(tetrahedron())))
    std::ofstream(std::string(arguments[1]) + '/' + name, std::ios::binary) << '\0' << bytes;
}
