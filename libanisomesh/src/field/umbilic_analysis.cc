#include "field/umbilic_analysis.hh"

#include <algorithm>

#include "numerics/tensor2d.hh"

namespace anisomesh::detail {

// The winding number of the deviators around 0, by crossings of the positive alpha axis. Ties are those of a
// zero moved by an infinitesimal amount, first along alpha, then along beta; the cross product is always
// taken from the lower to the upper end, so that both directions of an edge agree to the last bit.
int doubled_index_of_edge(const Vec2d& a, const Vec2d& b) {
  const bool a_up = a[1] > 0, b_up = b[1] > 0;
  if (a_up == b_up) return 0;
  const Vec2d &low = a_up ? b : a, &high = a_up ? a : b;
  if (!(cross2(low, high) > 0)) return 0;
  return b_up ? 1 : -1;
}

int doubled_index(const std::array<Vec2d, 3>& deviators) {
  return doubled_index_of_edge(deviators[0], deviators[1]) +
         doubled_index_of_edge(deviators[1], deviators[2]) +
         doubled_index_of_edge(deviators[2], deviators[0]);
}

Vec3d degenerate_point(const std::array<Vec2d, 3>& deviators) {
  Vec3d weights(cross2(deviators[1], deviators[2]), cross2(deviators[2], deviators[0]),
                cross2(deviators[0], deviators[1]));
  if (weights[0] + weights[1] + weights[2] < 0) weights = -weights;
  for (size_t i = 0; i < 3; ++i) weights[i] = std::max(weights[i], 0.0);
  const double sum = weights[0] + weights[1] + weights[2];
  return sum > 0 ? weights / sum : Vec3d(1.0 / 3, 1.0 / 3, 1.0 / 3);
}

}  // namespace anisomesh::detail
