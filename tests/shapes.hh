// Closed-form surfaces with exact normals, principal curvatures and directions, for the tests of every stage.
#pragma once

#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include "anisomesh/shapes.hh"

namespace shapes {

using anisomesh::ParametricPatch;
using anisomesh::ShapeOptions;
using anisomesh::Vec2d;
using anisomesh::Vec3d;

constexpr double pi = 3.14159265358979323846;

/// What is known at a point. Curvature is positive where convex seen along the normal.
struct Exact {
  Vec3d point, normal;
  double k_min = 0, k_max = 0;
  Vec3d gamma_min, gamma_max;
  /// |k_max - k_min| / (|k_max| + |k_min|), 0 where flat.
  double anisotropy() const {
    const double sum = std::abs(k_max) + std::abs(k_min);
    return sum > 0 ? (k_max - k_min) / sum : 0;
  }
};

/// A position and its derivatives by the parameters.
struct Jet {
  Vec3d x, x_u, x_v, x_uu, x_uv, x_vv;
};

struct ClosedForm {
  std::string name;
  ParametricPatch patch;
  std::function<Jet(double, double)> jet;
};

/// The curvature data that a jet has, by the fundamental forms. The normal is x_u cross x_v.
inline Exact exact(const Jet& jet) {
  Exact result;
  result.point = jet.x;
  result.normal = (jet.x_u % jet.x_v).normalized();
  const Vec3d e = jet.x_u.normalized(), f = result.normal % e;
  // The parameters' derivatives along the orthonormal tangent vectors e and f.
  const double eu = 1 / jet.x_u.norm(), fv = 1 / (jet.x_v | f), fu = -(jet.x_v | e) * fv * eu;
  const double l = -(jet.x_uu | result.normal), m = -(jet.x_uv | result.normal),
               n = -(jet.x_vv | result.normal);
  const double a = eu * eu * l, b = eu * (fu * l + fv * m), c = fu * fu * l + 2 * fu * fv * m + fv * fv * n;
  const double mean = (a + c) / 2, radius = std::hypot((a - c) / 2, b),
               angle = std::atan2(b, (a - c) / 2) / 2;
  result.k_min = mean - radius;
  result.k_max = mean + radius;
  result.gamma_max = std::cos(angle) * e + std::sin(angle) * f;
  result.gamma_min = result.normal % result.gamma_max;
  return result;
}

inline ClosedForm closed_form(std::string name, const Vec2d& low, const Vec2d& high,
                              std::function<Jet(double, double)> jet) {
  ClosedForm form;
  form.name = std::move(name);
  form.patch.u_min = low[0];
  form.patch.v_min = low[1];
  form.patch.u_max = high[0];
  form.patch.v_max = high[1];
  form.patch.position = [jet](double u, double v) { return jet(u, v).x; };
  form.jet = std::move(jet);
  return form;
}

/// A piece of a torus: `around` the ring (from 0) by `tube` (from -tube/2, 0 outermost), angles in radians.
inline ClosedForm torus(double ring = 1, double radius = 0.4, double around = pi,
                        double tube = 340 * pi / 180) {
  return closed_form("torus", {0, -tube / 2}, {around, tube / 2}, [=](double u, double v) {
    const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v),
                 d = ring + radius * cv;
    return Jet{{d * cu, d * su, radius * sv},
               {-d * su, d * cu, 0},
               {-radius * sv * cu, -radius * sv * su, radius * cv},
               {-d * cu, -d * su, 0},
               {radius * sv * su, -radius * sv * cu, 0},
               {-radius * cv * cu, -radius * cv * su, -radius * sv}};
  });
}

/// The side of an ellipsoid: longitudes 0 to 180 degrees, latitudes -60 to 60 degrees.
inline ClosedForm ellipsoid(double a = 1, double b = 0.8, double c = 0.6) {
  return closed_form("ellipsoid", {0, -pi / 3}, {pi, pi / 3}, [=](double u, double v) {
    const double cu = std::cos(u), su = std::sin(u), cv = std::cos(v), sv = std::sin(v);
    return Jet{{a * cu * cv, b * su * cv, c * sv},   {-a * su * cv, b * cu * cv, 0},
               {-a * cu * sv, -b * su * sv, c * cv}, {-a * cu * cv, -b * su * cv, 0},
               {a * su * sv, -b * cu * sv, 0},       {-a * cu * cv, -b * su * cv, -c * sv}};
  });
}

inline ClosedForm sphere(double radius = 1) {
  auto form = ellipsoid(radius, radius, radius);
  form.name = "sphere";
  return form;
}

/// Half a cylinder around the z axis.
inline ClosedForm cylinder(double radius = 1, double height = 2) {
  return closed_form("cylinder", {0, 0}, {pi, height}, [=](double u, double v) {
    const double c = radius * std::cos(u), s = radius * std::sin(u);
    return Jet{{c, s, v}, {-s, c, 0}, {0, 0, 1}, {-c, -s, 0}, {0, 0, 0}, {0, 0, 0}};
  });
}

/// z = -(a x^2 + b y^2) / 2 over the square [-1, 1]^2, seen from above: k = (a, b) or (b, a) at the origin.
inline ClosedForm quadric(std::string name, double a, double b) {
  return closed_form(std::move(name), {-1, -1}, {1, 1}, [=](double x, double y) {
    return Jet{{x, y, -(a * x * x + b * y * y) / 2},
               {1, 0, -a * x},
               {0, 1, -b * y},
               {0, 0, -a},
               {0, 0, 0},
               {0, 0, -b}};
  });
}

inline ClosedForm paraboloid() { return quadric("paraboloid", 1, 1); }
inline ClosedForm saddle() { return quadric("saddle", -1, 1); }
inline ClosedForm plane() { return quadric("plane", 0, 0); }

/// The five that the accuracy bars are about.
inline std::vector<ClosedForm> curved() { return {torus(), ellipsoid(), cylinder(), paraboloid(), saddle()}; }

/// A mesh of a closed form together with the truth at each of its vertices (noise moves the vertex, not the
/// truth).
struct Sampled {
  OpenMesh::TriMesh mesh;
  std::vector<Vec2d> parameters;
  std::vector<Exact> truth;
};

inline Sampled sample(const ClosedForm& form, const ShapeOptions& options) {
  Sampled result;
  result.mesh = anisomesh::mesh_patch(form.patch, options, &result.parameters);
  for (const auto& p : result.parameters) result.truth.push_back(exact(form.jet(p[0], p[1])));
  return result;
}

inline Sampled sample(const ClosedForm& form, int vertices, bool irregular = false, double noise = 0) {
  ShapeOptions options;
  options.vertices = vertices;
  options.irregular = irregular;
  options.noise = noise;
  return sample(form, options);
}

/// A third of the area of the faces around each vertex.
inline std::vector<double> vertex_areas(const OpenMesh::TriMesh& mesh) {
  std::vector<double> areas(mesh.n_vertices(), 0);
  for (const auto f : mesh.faces()) {
    const auto h = f.halfedge();
    const auto a = mesh.point(h.from()), b = mesh.point(h.to()), c = mesh.point(h.next().to());
    const double third = ((b - a) % (c - a)).norm() / 6;
    for (const auto v : {h.from(), h.to(), h.next().to()}) areas[static_cast<size_t>(v.idx())] += third;
  }
  return areas;
}

}  // namespace shapes
