#include "anisomesh/curvature.hh"

#include "anisomesh/properties.hh"
#include "catch.hh"
#include "curvature_error.hh"

using namespace anisomesh;

TEST_CASE("curvature of closed forms, irregular meshes included, stays within the bars", "[curvature]") {
  const bool irregular = GENERATE(false, true);
  for (const auto& form : shapes::curved()) {
    INFO(form.name << (irregular ? ", irregular" : ""));
    auto sampled = shapes::sample(form, 20000, irregular);
    estimate_curvature(sampled.mesh);
    const auto e = shapes::curvature_error(sampled);
    CHECK(e.direction_degrees <= 2);
    CHECK(e.curvature <= 0.05);
  }
}

TEST_CASE("a sphere of radius r with outward normals has curvature 1/r, turned inside out -1/r",
          "[curvature]") {
  for (const auto estimator :
       {CurvatureEstimator::normal_cycle, CurvatureEstimator::corrected_normal_current}) {
    auto sampled = shapes::sample(shapes::sphere(2), 5000);
    CurvatureOptions options;
    options.estimator = estimator;
    options.radius_fraction = 0.1;
    estimate_curvature(sampled.mesh, options);
    const auto low = require_property(sampled.mesh, property::k_min),
               high = require_property(sampled.mesh, property::k_max);
    for (const auto v : sampled.mesh.vertices()) {
      if (v.is_boundary()) continue;
      CHECK(sampled.mesh.property(low, v) <= sampled.mesh.property(high, v));
      CHECK(sampled.mesh.property(low, v) == Approx(0.5).epsilon(0.25));
      CHECK(sampled.mesh.property(high, v) == Approx(0.5).epsilon(0.25));
    }
  }
}
