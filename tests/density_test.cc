#include "anisomesh/density.hh"

#include <cmath>

#include "anisomesh/errors.hh"
#include "catch.hh"

using namespace anisomesh;

TEST_CASE("a chord of the spacing is epsilon away from its arc", "[density]") {
  for (const double radius : {0.5, 1.0, 40.0})
    for (const double share : {1e-6, 0.01, 0.3, 1.0}) {
      const double epsilon = share * radius, chord = chord_spacing(1 / radius, epsilon);
      CHECK(radius - std::sqrt(std::max(0.0, radius * radius - chord * chord / 4)) ==
            Approx(epsilon).epsilon(1e-6));
      CHECK(chord_spacing(-1 / radius, epsilon) == chord);
    }
}

TEST_CASE("the spacing has limits at both ends", "[density]") {
  CHECK(std::isinf(chord_spacing(0, 0.1)));
  CHECK(chord_spacing(10, 0.5) == Approx(0.2));  // epsilon beyond the radius: the diameter
  const Density density({}, 2, 2, 1);            // epsilon 0.0025, at most 0.5
  CHECK(density.min_line_spacing(0, 0) == Approx(0.5));
  CHECK(density.min_line_spacing(0, 1e30) == Approx(2 * density.epsilon()));
  CHECK(density.max_line_spacing(-1e30, 0) == Approx(2 * density.epsilon()));
  CHECK(density.isotropic_spacing(0, density.flat_curvature()) == Approx(0.5).epsilon(0.02));
}

TEST_CASE("in the limit the aspect is the root of the ratio of curvatures", "[density]") {
  DensityOptions options;
  options.epsilon_fraction = 1e-8;
  const Density density(options, 1, 1, 1);
  for (const double ratio : {1.0, 4.0, 25.0}) {
    const double aspect =
        density.max_line_spacing(0.4, 0.4 * ratio) / density.min_line_spacing(0.4, 0.4 * ratio);
    CHECK(aspect == Approx(std::sqrt(ratio)).epsilon(1e-6));
  }
}

TEST_CASE("rho makes the spacing isotropic, adaptation makes it uniform", "[density]") {
  DensityOptions options;
  options.rho = 1;
  const Density isotropic(options, 1, 1, 1);
  CHECK(isotropic.min_line_spacing(-1, 3) == Approx(isotropic.max_line_spacing(-1, 3)));
  options.rho = 0;
  options.adaptation = 0;
  const Density uniform(options, 1, 1, 2);
  CHECK(uniform.min_line_spacing(0, 50) == Approx(chord_spacing(2, 0.00125)));
  CHECK(uniform.max_line_spacing(0, 50) == uniform.min_line_spacing(3, 4));
  options.adaptation = 1;
  options.transfer = [](double curvature) { return 4 * curvature; };
  CHECK(Density(options, 1, 1, 1).min_line_spacing(0, 1) == Approx(chord_spacing(4, 0.00125)));
}

TEST_CASE("spacings scale with the model", "[density]") {
  for (const double scale : {0x1p-20, 0x1p20}) {
    const Density one({}, 1, 1, 1), scaled({}, scale, scale, 1 / scale);
    for (const double k : {0.0, 0.3, 7.0, 1e5})
      CHECK(scaled.min_line_spacing(0, k / scale) == scale * one.min_line_spacing(0, k));
  }
}

TEST_CASE("density options out of range are refused", "[density]") {
  const auto refused = [](auto change) {
    DensityOptions options;
    change(options);
    CHECK_THROWS_AS(options.validate(), InvalidOption);
  };
  refused([](DensityOptions& o) { o.epsilon_fraction = -1; });
  refused([](DensityOptions& o) { o.epsilon_fraction = std::nan(""); });
  refused([](DensityOptions& o) { o.rho = 1.1; });
  refused([](DensityOptions& o) { o.adaptation = -0.1; });
  refused([](DensityOptions& o) { o.max_spacing_fraction = 0; });
  refused([](DensityOptions& o) { o.max_slope = 0; });
}
