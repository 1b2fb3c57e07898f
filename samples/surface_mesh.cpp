#include "samples/surface_mesh.h"

#include <algorithm>
#include <stdexcept>
#include <tuple>

namespace spherematch::samples {

SurfaceMesh::SurfaceMesh(const Mesh& mesh) : position_(mesh.vertices), halfedge_of_(mesh.vertices.size(), -1) {
  std::vector<std::tuple<int, int, int>> edges;  // lower vertex, higher vertex, half-edge
  for (const Triangle& t : mesh.triangles) {
    const int h = add_face();
    set_face(h, t[0], t[1], t[2]);
    for (int i = 0; i < 3; ++i) edges.emplace_back(std::min(origin(h + i), target(h + i)), std::max(origin(h + i), target(h + i)), h + i);
  }
  std::sort(edges.begin(), edges.end());
  for (std::size_t i = 0; i < edges.size(); i += 2) {
    const bool two =
        i + 1 < edges.size() && std::get<0>(edges[i]) == std::get<0>(edges[i + 1]) && std::get<1>(edges[i]) == std::get<1>(edges[i + 1]);
    if (!two || origin(std::get<2>(edges[i])) == origin(std::get<2>(edges[i + 1])))
      throw std::invalid_argument("an edge without exactly two faces on opposite sides");
    pair(std::get<2>(edges[i]), std::get<2>(edges[i + 1]));
  }
}

std::vector<int> SurfaceMesh::outgoing(int v) const {
  std::vector<int> around;
  int h = halfedge_of_[at(v)];
  do {
    around.push_back(h);
    h = next(twin(h));
  } while (h != around.front());
  return around;
}

Vec3 SurfaceMesh::area_vector(int h) const {
  return cross(position(target(h)) - position(origin(h)), position(apex(h)) - position(origin(h)));
}

void SurfaceMesh::pair(int h, int g) {
  twin_[at(h)] = g;
  twin_[at(g)] = h;
}

void SurfaceMesh::set_face(int h, int a, int b, int c) {
  for (const int v : {a, b, c}) {
    origin_[at(h)] = v;
    halfedge_of_[at(v)] = h;
    h = next(h);
  }
}

int SurfaceMesh::add_face() {
  origin_.resize(origin_.size() + 3, -1);
  twin_.resize(origin_.size(), -1);
  return halfedge_count() - 3;
}

int SurfaceMesh::split(int h, const Vec3& p) {
  const int g = twin(h);
  const int a = origin(h), b = origin(g), c = apex(h), d = apex(g);
  const int beyond_c = twin(next(h)), beyond_d = twin(next(g));  // across b-c and a-d
  const int m = vertex_count();
  position_.push_back(p);
  halfedge_of_.push_back(-1);
  const int at_b = add_face(), at_a = add_face();
  set_face(h, a, m, c);
  set_face(g, b, m, d);
  set_face(at_b, m, b, c);
  set_face(at_a, m, a, d);
  pair(h, at_a);
  pair(g, at_b);
  pair(next(h), previous(at_b));
  pair(next(g), previous(at_a));
  pair(next(at_b), beyond_c);
  pair(next(at_a), beyond_d);
  return m;
}

bool SurfaceMesh::flip(int h) {
  const int g = twin(h);
  const int a = origin(h), b = origin(g), c = apex(h), d = apex(g);
  for (const int out : outgoing(c))
    if (target(out) == d) return false;
  const int bc = twin(next(h)), ca = twin(previous(h)), ad = twin(next(g)), db = twin(previous(g));
  set_face(h, d, c, a);
  set_face(g, c, d, b);
  pair(next(h), ca);
  pair(previous(h), ad);
  pair(next(g), db);
  pair(previous(g), bc);
  return true;
}

bool SurfaceMesh::can_collapse(int h) const {
  const int a = origin(h), b = target(h);
  if (valence(apex(h)) <= 3 || valence(apex(twin(h))) <= 3) return false;
  std::vector<int> near_a, near_b, common;
  for (const int out : outgoing(a)) near_a.push_back(target(out));
  for (const int out : outgoing(b)) near_b.push_back(target(out));
  std::sort(near_a.begin(), near_a.end());
  std::sort(near_b.begin(), near_b.end());
  std::set_intersection(near_a.begin(), near_a.end(), near_b.begin(), near_b.end(), std::back_inserter(common));
  return common.size() == 2;
}

void SurfaceMesh::collapse(int h) {
  const int g = twin(h);
  const int a = origin(h), b = target(h), c = apex(h), d = apex(g);
  const int bc = twin(next(h)), ca = twin(previous(h)), ad = twin(next(g)), db = twin(previous(g));
  for (const int out : outgoing(a)) origin_[at(out)] = b;
  pair(bc, ca);
  pair(ad, db);
  halfedge_of_[at(a)] = -1;
  halfedge_of_[at(b)] = db;
  halfedge_of_[at(c)] = bc;
  halfedge_of_[at(d)] = ad;
  for (const int dead : {h, next(h), previous(h), g, next(g), previous(g)}) origin_[at(dead)] = -1;
}

Mesh SurfaceMesh::compact(std::vector<int>* new_index) const {
  Mesh mesh;
  std::vector<int> number(position_.size(), -1);
  for (int v = 0; v < vertex_count(); ++v) {
    if (!vertex_alive(v)) continue;
    number[at(v)] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.push_back(position(v));
  }
  for (int h = 0; h < halfedge_count(); h += 3)
    if (halfedge_alive(h)) mesh.triangles.push_back({number[at(origin(h))], number[at(origin(h + 1))], number[at(origin(h + 2))]});
  if (new_index != nullptr) *new_index = std::move(number);
  return mesh;
}

}  // namespace spherematch::samples
