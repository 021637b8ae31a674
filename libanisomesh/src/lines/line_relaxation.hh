// Lines of one kind, placed one after the other, brought to even gaps as a whole.
#pragma once

#include "anisomesh/surface.hh"
#include "lines/line_tracer.hh"

namespace anisomesh::detail {

/// Takes each line out in turn and puts the parts of the line in that gap back that leave the fewest cells
/// whose width is not what is wanted; then starts lines in what gaps are too wide. Lines that close, end at
/// an umbilic or a feature stay as they are. \param passes over all lines
std::vector<TracedLine> relax_lines(const SurfaceRef& surface, const Domain& domain, LineKind kind,
                                    const TraceOptions& options, std::vector<TracedLine> lines,
                                    const std::function<bool(double)>& going_on);

}  // namespace anisomesh::detail
