// What flattening, smoothing and umbilics make of the nine discs of libcgal-demo.
//
//   ANISOMESH_DATA=FOLDER plane_stages
//
// Prints two markdown tables with all options at their defaults. "turned": mean angle, by area, between the
// directions before and after smoothing, where the anisotropy was over 0.3 before. Exits 77 if the meshes are
// not there.
#include <algorithm>
#include <cmath>
#include <vector>

#include "anisomesh/flatten.hh"
#include "anisomesh/properties.hh"
#include "anisomesh/smoothing.hh"
#include "anisomesh/umbilics.hh"
#include "bench.hh"

using namespace anisomesh;

namespace {

/// Twice the angle of the direction of k_max, and the anisotropy by magnitude.
struct Direction {
  double doubled_angle, anisotropy;
};

Direction direction(const Vec3d& tensor) {
  const double alpha = 0.5 * (tensor[0] - tensor[2]), beta = tensor[1];
  const double mean = 0.5 * (tensor[0] + tensor[2]), radius = std::hypot(alpha, beta);
  const double a = std::abs(mean + radius), b = std::abs(mean - radius);
  return {std::atan2(beta, alpha), a + b > 0 ? std::abs(a - b) / (a + b) : 0};
}

double mean_turn_degrees(const OpenMesh::TriMesh& mesh, const std::vector<Vec3d>& before) {
  const auto tensor2d = require_property(mesh, property::tensor2d);
  double sum = 0, weights = 0;
  for (const auto v : mesh.vertices()) {
    double area = 0;
    for (const auto f : v.faces()) area += mesh.calc_face_area(f);
    const auto a = direction(before[static_cast<size_t>(v.idx())]), b = direction(mesh.property(tensor2d, v));
    if (a.anisotropy <= 0.3) continue;
    sum += area * 0.5 * std::abs(std::remainder(a.doubled_angle - b.doubled_angle, 2 * std::acos(-1.0)));
    weights += area;
  }
  return weights > 0 ? sum / weights * 180 / std::acos(-1.0) : 0;
}

std::vector<Vec3d> tensors_of(const OpenMesh::TriMesh& mesh) {
  const auto tensor2d = require_property(mesh, property::tensor2d);
  std::vector<Vec3d> tensors;
  for (const auto v : mesh.vertices()) tensors.push_back(mesh.property(tensor2d, v));
  return tensors;
}

}  // namespace

int main() {
  std::string second =
      "\n| mesh | smoothing changes | turned | umbilics before | after | sum of indices | turning of the "
      "border | "
      "smoothing s | umbilics s |\n|---|---|---|---|---|---|---|---|---|\n";
  std::printf(
      "| mesh | triangles | distortion mean | max | stretch min | max | repaired | s |\n"
      "|---|---|---|---|---|---|---|---|\n");
  for (const auto& name : demo_discs()) {
    const auto path = demo_mesh(name);
    if (!path) {
      skip(name);
      return 77;
    }
    auto mesh = read_surface(*path);
    estimate_curvature(mesh);
    const auto flat = flatten(mesh);
    std::printf("| %s | %zu | %.3f | %.2f | %.2g | %.3g | %zu%s | %.3f |\n", name.c_str(), mesh.n_faces(),
                flat.mean_conformal_distortion, flat.max_conformal_distortion, flat.min_area_stretch,
                flat.max_area_stretch, flat.repaired_triangles, flat.free_boundary ? "" : ", disc",
                flat.seconds);
    const auto before = tensors_of(mesh);
    const auto noisy = find_umbilics(mesh);
    const auto smooth = smooth_tensors(mesh);
    const auto umbilics = find_umbilics(mesh);
    char row[256];
    std::snprintf(row, sizeof row,
                  "| %s | %.1f %% | %.1f | %zu + %zu | %zu + %zu | %.1f | %.6f | %.3f | %.3f |\n",
                  name.c_str(), 100 * smooth.mean_change, mean_turn_degrees(mesh, before), noisy.wedges,
                  noisy.trisectors, umbilics.wedges, umbilics.trisectors, umbilics.index_sum,
                  umbilics.border_turning, smooth.seconds, umbilics.seconds);
    second += row;
  }
  std::printf("%s", second.c_str());
}
