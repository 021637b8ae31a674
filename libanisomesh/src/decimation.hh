// From the arrangement of all samples to the graph of those that become vertices. [ACDLD03, section 4.2]
#pragma once

#include "network_graph.hh"

namespace anisomesh::detail {

struct DecimationOptions {
  double chain_tolerance =
      0;  ///< a straightened chain stays this near to its samples, model units; infinite: the paper
  double merge_fraction =
      0;  ///< an edge shorter than this fraction of those it continues is contracted; 0: none
};

struct DecimationReport {
  size_t trimmed = 0, straightened = 0, merged = 0;
};

/// Trims dangling chains, straightens chains, contracts edges that are far shorter than their neighbours.
/// The graph stays planar in (u, v) and the border stays one simple loop.
DecimationReport decimate(NetworkGraph& network, const DecimationOptions& options);

}  // namespace anisomesh::detail
