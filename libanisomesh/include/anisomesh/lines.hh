// Lines of curvature and isotropic samples: what they are, how they are kept on a mesh, and the two stages
// that make them.
#pragma once

#include <optional>
#include <vector>

#include "anisomesh/density.hh"
#include "anisomesh/progress.hh"
#include "anisomesh/surface.hh"

namespace anisomesh {

enum class LineKind { min = 0, max = 1 };  ///< a min line runs along gamma_min

/// Why a line ended.
enum class LineEnd { umbilic = 0, feature = 1, border = 2, loop = 3, too_close = 4, step_limit = 5 };

/// A polyline on the surface. Where it crosses from one face to the next there is no point: consecutive
/// points may lie some faces apart, but always a small fraction of the spacing.
struct Line {
  LineKind kind = LineKind::min;
  bool closed = false;  ///< the last point joins the first
  LineEnd begin_reason = LineEnd::border, end_reason = LineEnd::border;
  std::vector<SurfacePoint> points;
};

/// All lines and isotropic samples of a surface.
struct LineNetwork {
  std::vector<Line> lines;
  std::vector<SurfacePoint> isotropic_samples;
};

/// Reads the network from the mesh's properties. \throw InvalidInput if it is missing or does not fit the
/// mesh
LineNetwork read_lines(const SurfaceRef& surface);
/// Writes the network to the mesh's properties (line_table, line_faces, line_barycentrics, isotropic_*).
void write_lines(const SurfaceRef& surface, const LineNetwork& network);

/// Which directions lines take where the principal curvatures have opposite signs.
enum class Follow {
  curvature,  ///< the principal ones [ACDLD03]
  /// Both kinds are turned counter-clockwise by atan(sqrt(|smaller curvature| / |larger|)), at most 45
  /// degrees: the kind that bends less then follows an asymptotic direction, along which the surface does not
  /// bend. [D'Azevedo 2000]
  min_abs
};

struct TraceOptions {
  DensityOptions density;
  Follow follow = Follow::curvature;
  double stop_fraction =
      0.5;  ///< a line ends when nearer to one of its kind than this fraction of the spacing; (0, 1)
  /// None starts nearer to one of its kind than this fraction of the spacing; [stop_fraction, 1]. 0: 0.7
  /// where epsilon is given, so that no gap is much too wide, and 0.8 where it is found for a target
  double seed_fraction = 0;
  double min_crossings = 1.5;  ///< a shorter line, in spacings of the other kind, is dropped; >= 0
  /// Passes over all lines after they are placed, in which each is moved, shortened or lengthened so that
  /// gaps are within 25 % of what is wanted over most of the surface. 0: lines stay where they were placed.
  /// None given: 5 where epsilon is given and there is no umbilic, else 0; at most 1,000
  std::optional<size_t> relax_passes;
  unsigned seed = 1;      ///< of the random coverage check
  void validate() const;  ///< \throw InvalidOption
};

struct TraceReport {
  size_t min_lines = 0, max_lines = 0;
  size_t closed_lines = 0;
  size_t points = 0;
  size_t coverage_seeds = 0;  ///< lines that the random coverage check started
  size_t ends[6] = {};        ///< how many ends for each LineEnd
  double seconds = 0;
};

/// Traces the network of lines of curvature. [ACDLD03, section 3.1]
/// Reads: uv, area_stretch, tensor2d (without uv: surface_tensor, normal), umbilics, features. Writes: lines
/// (write_lines()). \throw InvalidOption, also where epsilon asks for more than 1e7 crossings; InvalidInput,
/// Cancelled
TraceReport trace_lines(const SurfaceRef& surface, const TraceOptions& options = {},
                        const Progress& progress = {});

struct IsotropicReport {
  size_t from_umbilics = 0, random = 0;
  double seconds = 0;
};

/// Chooses isotropic samples among the umbilics by spacing, and adds random ones where flat or spherical
/// regions stay empty. [ACDLD03, section 3.2] Reads: as trace_lines(), and the lines. Writes: isotropic
/// samples (write_lines()). \throw as trace_lines()
IsotropicReport place_isotropic_samples(const SurfaceRef& surface, const TraceOptions& options = {},
                                        const Progress& progress = {});

}  // namespace anisomesh
