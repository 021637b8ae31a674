// How far apart lines and samples are to lie.
#pragma once

#include <functional>

namespace anisomesh {

struct DensityOptions {
  /// Tolerated distance of a chord from the surface, fraction of the diagonal; >= 0. 0: 0.00125 of the
  /// extent, which is the same however the surface is turned
  double epsilon_fraction = 0;
  double rho = 0;         ///< 0: anisotropic, 1: isotropic; [0, 1] [ACDLD03, section 3.1.4]
  double adaptation = 1;  ///< 0: uniform density, 1: density by curvature; [0, 1]
  std::function<double(double)>
      transfer;  ///< F: curvature (1/length, >= 0) to curvature; applied instead of `adaptation`
  double max_spacing_fraction = 0.25;  ///< no spacing above this fraction of the extent; > 0
  double max_slope = 0.5;  ///< spacings change by at most this much of a length over that length; > 0

  /// What epsilon_fraction stands for on a surface of this SurfaceRef::diagonal() and extent(), model units.
  double epsilon(double diagonal, double extent) const;
  void validate() const;  ///< \throw InvalidOption
};

/// [ACDLD03, section 3.1.3, equation 6]: the distance of two points on a circle of curvature |curvature|
/// whose chord is epsilon away from the arc. Infinite at curvature 0; never above the diameter's chord, also
/// where epsilon exceeds the radius. Model units.
double chord_spacing(double curvature, double epsilon);

/// Spacing on one surface: the options with lengths resolved against its size and mean curvature.
/// A spacing lies between 2 epsilon (what bends tighter than epsilon needs no more) and the upper bound.
class Density {
 public:
  /// \param diagonal, extent SurfaceRef::diagonal() and extent(), model units
  /// \param mean_curvature area-weighted mean of the larger |principal curvature|; what `adaptation` = 0 uses
  /// everywhere
  Density(const DensityOptions& options, double diagonal, double extent, double mean_curvature);

  /// Distance between neighbouring min lines: d(rho/2 |k_min| + (1 - rho/2) |k_max|). Model units, bounded.
  double min_line_spacing(double k_min, double k_max) const;
  /// Distance between neighbouring max lines: d(rho/2 |k_max| + (1 - rho/2) |k_min|). Model units, bounded.
  double max_line_spacing(double k_min, double k_max) const;
  /// Distance between isotropic samples: d of the larger |curvature|. Model units, bounded.
  double isotropic_spacing(double k_min, double k_max) const;

  /// The curvature below which every spacing is at its upper bound: what bends less is flat for this density.
  double flat_curvature() const;

  double epsilon() const { return epsilon_; }

 private:
  double spacing(double curvature) const;
  DensityOptions options_;
  double epsilon_;
  double mean_curvature_;
  double max_spacing_;
};

}  // namespace anisomesh
