// SPDX-License-Identifier: MIT
// Uploads two meshes, matches them, and writes where each vertex of the first lies on the second.
#include <spherematch/client/client.h>

#include <cstdlib>
#include <fstream>
#include <iostream>

namespace sm = spherematch;

/// Uploads a mesh and waits until it is prepared. Exits with the reason where that fails.
sm::api::Shape prepared(const sm::client::Client& client, const char* file) {
  const sm::api::Shape uploaded = client.upload_file(file);
  sm::api::Shape shape = client.wait(uploaded.id, std::chrono::minutes(10));
  if (shape.state != sm::api::ShapeState::ready) {
    std::cerr << file << ": " << (shape.error ? shape.error->detail : "not ready in time") << "\n";
    std::exit(1);
  }
  std::cout << file << ": " << shape.vertices << " vertices, shape " << shape.id << "\n";
  return shape;
}

int main(int argc, char** argv) {
  if (argc != 5) {
    std::cerr << "usage: match SERVER SOURCE TARGET OUTPUT     for example match http://127.0.0.1:8080 a.off b.off map.txt\n";
    return 2;
  }
  try {
    const sm::client::Client client(argv[1]);
    const sm::api::Shape source = prepared(client, argv[2]);
    const sm::api::Shape target = prepared(client, argv[3]);
    const sm::client::Map map = client.match(source.id, target.id);
    std::ofstream file(argv[4]);
    for (const std::int32_t vertex : map.vertex) file << vertex << "\n";
    std::cout << map.vertex.size() << " vertices matched, written to " << argv[4] << "\n";
    return file ? 0 : 1;
  } catch (const sm::client::ProblemError& error) {
    std::cerr << "the server refused with " << error.status() << ": " << error.what() << "\n";
  } catch (const sm::client::Error& error) {
    std::cerr << error.what() << "\n";
  }
  return 1;
}
