#include "anisomesh/density.hh"

#include <algorithm>
#include <cmath>
#include <string>

#include "anisomesh/errors.hh"

namespace anisomesh {

namespace {

constexpr double kDefaultEpsilon = 0.00125;  // of the extent

void require(bool fine, const char* option, const char* range, double value) {
  if (!fine)
    throw InvalidOption(std::string(option) + " must be " + range + ", but is " + std::to_string(value));
}

}  // namespace

void DensityOptions::validate() const {
  require(std::isfinite(epsilon_fraction) && epsilon_fraction >= 0, "epsilon_fraction",
          "finite and above 0, or 0 for the default", epsilon_fraction);
  require(rho >= 0 && rho <= 1, "rho", "in [0, 1]", rho);
  require(adaptation >= 0 && adaptation <= 1, "adaptation", "in [0, 1]", adaptation);
  require(std::isfinite(max_spacing_fraction) && max_spacing_fraction > 0, "max_spacing_fraction",
          "finite and above 0", max_spacing_fraction);
  require(std::isfinite(max_slope) && max_slope > 0, "max_slope", "finite and above 0", max_slope);
}

double DensityOptions::epsilon(double diagonal, double extent) const {
  return epsilon_fraction > 0 ? epsilon_fraction * diagonal : kDefaultEpsilon * extent;
}

double chord_spacing(double curvature, double epsilon) {
  const double radius = 1 / std::abs(curvature);
  // From epsilon = radius on, the chord would shrink again on the far side of the circle: the diameter is the
  // longest chord there is.
  const double height = std::min(epsilon, radius);
  return std::isinf(radius) ? radius : 2 * std::sqrt(height * (2 * radius - height));
}

Density::Density(const DensityOptions& options, double diagonal, double extent, double mean_curvature)
    : options_(options),
      epsilon_(options.epsilon(diagonal, extent)),
      mean_curvature_(mean_curvature),
      max_spacing_(options.max_spacing_fraction * extent) {
  options.validate();
}

double Density::min_line_spacing(double k_min, double k_max) const {
  const double half = options_.rho / 2;
  return spacing(half * std::abs(k_min) + (1 - half) * std::abs(k_max));
}

double Density::max_line_spacing(double k_min, double k_max) const {
  const double half = options_.rho / 2;
  return spacing(half * std::abs(k_max) + (1 - half) * std::abs(k_min));
}

double Density::isotropic_spacing(double k_min, double k_max) const {
  return spacing(std::max(std::abs(k_min), std::abs(k_max)));
}

double Density::flat_curvature() const {
  // Small angles: spacing^2 = 8 epsilon / curvature.
  return std::min(8 * epsilon_ / (max_spacing_ * max_spacing_), 1 / epsilon_);
}

double Density::spacing(double curvature) const {
  const double wanted = options_.transfer
                            ? std::abs(options_.transfer(curvature))
                            : options_.adaptation * curvature + (1 - options_.adaptation) * mean_curvature_;
  // What bends tighter than epsilon stays within epsilon of a chord of 2 epsilon anyhow.
  const double bounded = std::min(wanted, 1 / epsilon_);
  return std::min(chord_spacing(bounded, epsilon_), max_spacing_);
}

}  // namespace anisomesh
