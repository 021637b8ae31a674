// Tags sharp edges and walks the skeleton of creases and corners that they make.
#include <anisomesh/features.hh>
#include <anisomesh/shapes.hh>
#include <cstdio>

int main() {
  OpenMesh::TriMesh mesh = anisomesh::make_shape("octa-flower");  // or anisomesh::read_surface("scan.obj")

  anisomesh::FeatureOptions options;
  options.angle_degrees = 40;     // edges whose two faces turn by more than this
  options.keep_existing = false;  // forget the tags that came with the mesh
  const auto report = anisomesh::tag_features(mesh, options);
  std::printf("%zu feature edges\n", report.feature_edges);

  // The tags are OpenMesh's own, so its decimater and its subdividers respect them too.
  size_t tagged = 0;
  for (const auto edge : mesh.edges()) tagged += mesh.status(edge).feature() && !edge.is_boundary();

  const auto skeleton = anisomesh::feature_skeleton(mesh);
  for (const auto& curve : skeleton.curves)
    std::printf("%s of %zu edges, from vertex %d to vertex %d\n", curve.border ? "border" : "crease",
                curve.halfedges.size(), mesh.from_vertex_handle(curve.halfedges.front()).idx(),
                mesh.to_vertex_handle(curve.halfedges.back()).idx());
  std::printf("%zu corners\n", skeleton.corners.size());
  return tagged == report.feature_edges && !skeleton.corners.empty() ? 0 : 1;
}
