#include <anisomesh/remesh.hh>
#include <anisomesh/shapes.hh>
#include <cstdio>

int main() {
  auto mesh = anisomesh::make_shape("dome", {500});
  const auto result = anisomesh::remesh(mesh);
  std::printf("%zu faces\n", result.n_faces());
  return result.n_faces() > 0 ? 0 : 1;
}
