// What every result must be, as the ruler sees it.
#pragma once

#include "anisomesh/compare.hh"
#include "catch.hh"

inline void check_sound(const anisomesh::Comparison& c) {
  CHECK(c.same_topology);
  CHECK(c.non_manifold_edges == 0);
  CHECK(c.non_manifold_vertices == 0);
  CHECK(c.t_junctions == 0);
  CHECK(c.concave_faces == 0);
  CHECK(c.degenerate_faces == 0);
  CHECK(c.folded_faces == 0);
}
