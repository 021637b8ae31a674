// The network as it was drawn, before anything is taken away, and how to get from it to cells: in the
// parameter plane or on the surface itself. [ACDLD03, section 4.1 to 4.3]
#pragma once

#include <functional>
#include <memory>

#include "mesher/cells.hh"
#include "network/decimation.hh"

namespace anisomesh::detail {

class Drawing {
 public:
  virtual ~Drawing() = default;
  virtual const SurfaceLocator& locator() const = 0;
  virtual const NetworkGraph& network() const = 0;
  /// Draws anew, without lines in some faces of the surface, which become cells as they are.
  /// \param faces of the surface, by face \return false, and nothing changes, where that cannot be done
  virtual bool keep_faces(const std::vector<char>& faces) = 0;
  /// Decimates a copy of the network. \return its cells
  virtual std::vector<Cell> cells(NetworkGraph& network, const DecimationOptions& options, bool probes,
                                  DecimationReport& report) const = 0;
};

/// Draws the lines, samples, features and the border: in the plane if the surface carries uv.
/// \param tolerance model units; what is drawn on the surface itself stays so near to it
/// \param breathe called often meanwhile; it may throw to give up
/// \throw CannotProcess if the drawing would cross itself
std::unique_ptr<Drawing> make_drawing(const SurfaceRef& surface, const SurfaceNormals& normals,
                                      const LineNetwork& lines, double corner_angle_degrees, double tolerance,
                                      const std::function<void()>& breathe);

}  // namespace anisomesh::detail
