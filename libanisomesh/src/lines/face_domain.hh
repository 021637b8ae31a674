// What all domains made of triangles share: nodes, fences, graded spacings, and the umbilics near each face.
#pragma once

#include <array>
#include <functional>

#include "lines/domain.hh"

namespace anisomesh::detail {

constexpr int kFeature = -1, kBorder = -2;  ///< what lies across an edge, where it is no face

/// A triangle of a domain. A node is a vertex as seen from one side of the features through it. The edge
/// `across[i]` is opposite corner i; corners are in the order of SurfaceRef::corners().
struct DomainFace {
  int node[3] = {0, 0, 0};
  int across[3] = {0, 0, 0};  ///< a face, kFeature or kBorder
  int beyond[3] = {-1, -1,
                   -1};  ///< where across is kFeature: 3 times the face there plus its corner opposite
  double away = 0;       ///< distance of its middle from that of the surface
};

/// Fills in `across`, `beyond` and `away`. Reads: edge feature status.
void set_across(const SurfaceRef& surface, std::vector<DomainFace>& faces);

/// The larger |principal curvature|.
double larger_curvature(const Vec3d& tensor);

/// Area-weighted mean over the surface of the larger |principal curvature| at the corners of its faces.
double mean_curvature(const SurfaceRef& surface, const std::vector<std::array<Vec3d, 3>>& corner_tensors);

/// The umbilics that find_umbilics() wrote, with the curvature that these tensors have there.
std::vector<UmbilicPoint> read_umbilics(const SurfaceRef& surface,
                                        const std::vector<std::array<Vec3d, 3>>& corner_tensors);

class FaceDomain : public Domain {
 public:
  double spacing(LineKind kind, const SurfacePoint& at) const final;
  double isotropic_spacing(const SurfacePoint& at) const final;
  bool isotropic(const SurfacePoint& at) const final;
  const std::vector<UmbilicPoint>& umbilics() const final { return umbilics_; }
  SurfacePoint beyond_feature(const SurfacePoint& at) const final;
  NearUmbilic umbilic_near(LineKind kind, const SurfacePoint& at) const final;
  size_t n_faces() const final { return faces_.size(); }
  double away(OpenMesh::FaceHandle handle) const final { return face(handle).away; }
  /// The epsilon of the density, model units.
  double epsilon() const { return density_.epsilon(); }

 protected:
  FaceDomain(size_t n_faces, std::vector<UmbilicPoint> umbilics, const DensityOptions& options,
             const Density& density, Follow follow)
      : faces_(n_faces),
        umbilics_(std::move(umbilics)),
        max_slope_(options.max_slope),
        density_(density),
        follow_(follow) {}

  Follow follow() const { return follow_; }
  /// Length of the first, straight step of a line from an umbilic, model units.
  double first_step(const UmbilicPoint& umbilic, LineKind kind) const {
    return kOffUmbilic * spacing(kind, umbilic.point);
  }

  /// Spacings at the nodes, by their tensors, graded along the edges.
  /// \param length of the edge of a face from corner i to corner i + 1, model units
  void make_spacing(const std::vector<Vec3d>& node_tensors,
                    const std::function<double(size_t face, int i)>& length);

  /// A face near an umbilic.
  struct NearFace {
    int face = -1;
    Vec2d place{0, 0};    ///< of the umbilic, as seen from there
    double farthest = 0;  ///< from there to a corner of the face
  };
  /// Whether an umbilic so far from a face counts for none of its points, since another one is nearer to all.
  using IsHidden = std::function<bool(int face, double distance)>;
  /// \param faces_near the faces within a distance of a point, but those where it is hidden and what lies
  /// behind them
  void register_umbilics(
      const std::function<std::vector<NearFace>(const SurfacePoint&, double, const IsHidden&)>& faces_near);
  /// Distance of a point to a place as its face sees it.
  virtual double distance(const SurfacePoint& at, const Vec2d& place) const = 0;

  const DomainFace& face(OpenMesh::FaceHandle handle) const {
    return faces_[static_cast<size_t>(handle.idx())];
  }

  std::vector<DomainFace> faces_;

 private:
  struct NearEntry {
    int face = 0, umbilic = 0;
    Vec2d place{0, 0};
    bool operator<(const NearEntry& o) const { return face != o.face ? face < o.face : umbilic < o.umbilic; }
  };

  std::vector<std::array<double, 2>> spacing_;  // of each node, by LineKind
  std::vector<UmbilicPoint> umbilics_;
  std::vector<NearEntry> near_umbilics_;  // ascending
  double max_slope_;
  Density density_;
  Follow follow_;
};

}  // namespace anisomesh::detail
