// What tracing, seeding and spacing ask of the surface they work on, and nothing more.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <vector>

#include "anisomesh/lines.hh"
#include "numerics/tensor2d.hh"

namespace anisomesh::detail {

/// Vectors at a surface point are in the local frame of the point, and in model units.
struct Reach {
  SurfacePoint point;
  Vec2d rotation{1, 0};  ///< (cos, sin) that turns the frame of the start into that of the end
  bool blocked = false;  ///< stopped at a border or feature edge, on which `point` lies exactly
  bool border = false;   ///< the edge is on the border
  double fraction = 1;   ///< of the vector that was walked
};

/// The part of a way that lies in one face, from place to place: barycentric coordinates of corners 1 and 2.
struct WayPiece {
  int face = -1;
  Vec2d from{0, 0}, to{0, 0};
  double begin = 0, end = 1;  ///< fractions of the vector that is walked
};

/// The nearest point of a line or fence (border or feature), in the frame of the point that was asked about.
struct Neighbour {
  double distance = std::numeric_limits<double>::infinity();
  Vec2d offset{0, 0};     ///< towards it
  Vec2d direction{1, 0};  ///< unit tangent there
  int line = -1;
  double arc = 0;
};

struct Neighbourhood {
  Neighbour line, fence;
};

/// A point of a line and its parameter along it.
struct ArcPoint {
  SurfacePoint point;
  double arc = 0;
};

/// The lines of one kind that are finished, or whose far part is.
class LineIndex {
 public:
  virtual ~LineIndex() = default;
  /// Nearest line within `bound` (model units) and nearest fence nearer than it, leaving out the part of line
  /// `own` with its arc in [from, to].
  virtual Neighbourhood nearest(const SurfacePoint& at, double bound, int own = -1, double from = 0,
                                double to = 0) = 0;
  virtual void enter(int line, const std::vector<ArcPoint>& points) = 0;
  virtual void enter_sample(int id, const SurfacePoint& point) = 0;
};

struct UmbilicPoint {
  SurfacePoint point;
  int index = 1;         ///< 1: wedge, -1: trisector
  double curvature = 0;  ///< larger |curvature|, 1/length
};

constexpr double kOffUmbilic = 0.05;  ///< spacings from an umbilic to the second point of a line from it

struct NearUmbilic {
  int index = -1;  ///< into Domain::umbilics(); -1: none is near
  double distance = std::numeric_limits<double>::infinity();
};

class Domain {
 public:
  virtual ~Domain() = default;

  /// In space; in the plane where the domain is that of a parameterization.
  virtual Vec3d place(const SurfacePoint& at) const = 0;
  /// Curvature tensor in the local frame, (uu, uv, vv), 1/length.
  virtual Vec3d tensor(const SurfacePoint& at) const = 0;
  /// The tensor at the end of a vector, carried back to the frame of its start.
  virtual Vec3d tensor_ahead(const SurfacePoint& from, const Vec2d& vector) const = 0;
  virtual Reach walk(const SurfacePoint& from, const Vec2d& vector) const = 0;
  /// The same, face by face, until the visitor returns false.
  virtual Reach walk_while(const SurfacePoint& from, const Vec2d& vector,
                           const std::function<bool(const WayPiece&)>& visit) const = 0;
  /// The same place on the other side of the feature edge that a point lies on exactly; no face if there is
  /// none.
  virtual SurfacePoint beyond_feature(const SurfacePoint& at) const = 0;

  /// Wanted distance between neighbouring lines of a kind here, graded: model units.
  virtual double spacing(LineKind kind, const SurfacePoint& at) const = 0;
  virtual double isotropic_spacing(const SurfacePoint& at) const = 0;
  /// Whether the surface is flat or spherical here as far as the wanted spacing can tell.
  virtual bool isotropic(const SurfacePoint& at) const = 0;
  /// Length over which the direction field can turn by about one radian: |deviator| / |its gradient|.
  virtual double turning_length(const SurfacePoint& at) const = 0;

  /// Unit directions in which the lines of a kind leave an umbilic.
  virtual std::vector<Vec2d> separatrices(const UmbilicPoint& umbilic, LineKind kind) const = 0;
  virtual const std::vector<UmbilicPoint>& umbilics() const = 0;
  /// The nearest umbilic within a third of the spacing of a kind, if there is one.
  virtual NearUmbilic umbilic_near(LineKind kind, const SurfacePoint& at) const = 0;

  /// Marks the faces that a disc reaches without crossing a border or feature; more do no harm.
  virtual void mark_within(const SurfacePoint& at, double radius, std::vector<char>& marks) const = 0;
  virtual size_t n_faces() const = 0;
  virtual double area(OpenMesh::FaceHandle face) const = 0;
  /// Distance of its middle from that of the surface.
  virtual double away(OpenMesh::FaceHandle face) const = 0;
  /// Length of the side opposite a corner.
  virtual double side(OpenMesh::FaceHandle face, int corner) const = 0;
  /// \param reach how far a line or sample at a place needs to be seen, at least
  virtual std::unique_ptr<LineIndex> make_index(
      const std::function<double(const SurfacePoint&)>& reach) const = 0;
};

/// Twice the mean curvature: tells places apart that are the same to the spacing, whatever the frame and the
/// numbering.
inline double landmark(const Vec3d& tensor) { return tensor[0] + tensor[2]; }

}  // namespace anisomesh::detail
