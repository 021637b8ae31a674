#include "network/drawing.hh"

#include <algorithm>

#include "anisomesh/properties.hh"
#include "mesher/plane_cells.hh"
#include "mesher/surface_cells.hh"
#include "network/mesh_embedding.hh"
#include "network/plane_embedding.hh"
#include "network/surface_network.hh"
#include "surface/near_locator.hh"

namespace anisomesh::detail {

namespace {

class PlaneDrawing final : public Drawing {
 public:
  PlaneDrawing(const SurfaceRef& surface, const SurfaceNormals& normals, const LineNetwork& lines,
               double corner_angle)
      : surface_(surface),
        locator_(surface),
        network_(arrange_network(surface, locator_, normals, lines, corner_angle)) {}
  const SurfaceLocator& locator() const override { return locator_; }
  const NetworkGraph& network() const override { return network_; }
  bool keep_faces(const std::vector<char>&) override { return false; }
  std::vector<Cell> cells(NetworkGraph& network, const DecimationOptions& options, bool probes,
                          DecimationReport& report) const override {
    PlaneEmbedding embedding(network);
    report = decimate(network, embedding, options);
    return plane_cells(network, surface_, locator_, probes);
  }

 private:
  const SurfaceRef& surface_;
  UvLocator locator_;
  NetworkGraph network_;
};

class SurfaceDrawing final : public Drawing {
 public:
  SurfaceDrawing(const SurfaceRef& surface, const SurfaceNormals& normals, const LineNetwork& lines,
                 double corner_angle, double tolerance, const std::function<void()>& breathe)
      : surface_(surface),
        normals_(normals),
        lines_(lines),
        corner_angle_(corner_angle),
        locator_(surface),
        tolerance_(tolerance),
        breathe_(breathe) {
    draw();
  }
  const SurfaceLocator& locator() const override { return locator_; }
  const NetworkGraph& network() const override { return network_; }
  bool keep_faces(const std::vector<char>& faces) override {
    kept_faces_ = faces;
    draw();
    return true;
  }
  std::vector<Cell> cells(NetworkGraph& network, const DecimationOptions& options, bool probes,
                          DecimationReport& report) const override {
    MeshEmbedding embedding = embedding_for(network);
    report = decimate(network, embedding, options);
    embedding.coarsen(network, tolerance_, breathe_);
    embedding.flip(network);
    return surface_cells(network, surface_, embedding, probes);
  }

 private:
  void draw() {
    const Overlay overlay = overlay_lines(surface_, lines_, corner_angle_, kept_faces_);
    breathe_();
    network_ = network_of(surface_, normals_, overlay);
    breathe_();
    embedding_ = std::make_unique<MeshEmbedding>(surface_, overlay, network_);
    embedding_->coarsen(network_, tolerance_, breathe_);
  }
  // Coarsened already, but for a network that is to keep vertices which have gone.
  MeshEmbedding embedding_for(const NetworkGraph& network) const {
    const auto is_kept = [](double share) { return share <= kept_share; };
    if (std::none_of(network.share.begin(), network.share.end(), is_kept)) return *embedding_;
    MeshEmbedding embedding(surface_, overlay_lines(surface_, lines_, corner_angle_, kept_faces_), network);
    embedding.coarsen(network, tolerance_, breathe_);
    return embedding;
  }

  const SurfaceRef& surface_;
  const SurfaceNormals& normals_;
  const LineNetwork& lines_;
  double corner_angle_;
  std::vector<char> kept_faces_;
  NearLocator locator_;
  double tolerance_;
  std::function<void()> breathe_;
  NetworkGraph network_;
  std::unique_ptr<MeshEmbedding> embedding_;
};

}  // namespace

std::unique_ptr<Drawing> make_drawing(const SurfaceRef& surface, const SurfaceNormals& normals,
                                      const LineNetwork& lines, double corner_angle_degrees, double tolerance,
                                      const std::function<void()>& breathe) {
  if (has_property(surface.connectivity(), property::uv))
    return std::make_unique<PlaneDrawing>(surface, normals, lines, corner_angle_degrees);
  return std::make_unique<SurfaceDrawing>(surface, normals, lines, corner_angle_degrees, tolerance, breathe);
}

}  // namespace anisomesh::detail
