// Remeshes a surface: 00_remesh [IN OUT].
#include <anisomesh/io.hh>
#include <anisomesh/remesh.hh>
#include <anisomesh/shapes.hh>

int main(int argc, char* argv[]) {
  OpenMesh::TriMesh mesh = argc > 1 ? anisomesh::read_surface(argv[1]) : anisomesh::make_shape("octa-flower");
  anisomesh::RemeshOptions options;
  options.target_faces = 1000;
  const OpenMesh::PolyMesh result = anisomesh::remesh(mesh, options);
  anisomesh::write_mesh(result, argc > 2 ? argv[2] : "remeshed.obj");
}
