// From the arrangement of all samples to the graph of those that become vertices. [ACDLD03, section 4.2]
#pragma once

#include "network/embedding.hh"
#include "network/network_graph.hh"

namespace anisomesh::detail {

struct DecimationOptions {
  double chain_tolerance =
      0;  ///< a straightened chain stays this near to its samples, model units; infinite: the paper
  double finite_tolerance = 0;   ///< the same where only a share of it holds, see NetworkGraph::share
  double feature_tolerance = 0;  ///< a feature stays this near to its samples, model units
  double merge_fraction =
      0;  ///< an edge shorter than this fraction of those it continues is contracted; 0: none
  double least_length = 0;  ///< on the surface an edge shorter than this is contracted as well, model units
};

struct DecimationReport {
  size_t trimmed = 0, straightened = 0, merged = 0;
};

/// Trims dangling chains, straightens chains, contracts edges that are far shorter than their neighbours.
/// The graph stays embedded, and border loops stay simple.
DecimationReport decimate(NetworkGraph& network, Embedding& embedding, const DecimationOptions& options);

}  // namespace anisomesh::detail
