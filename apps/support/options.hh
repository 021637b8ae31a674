// The options of the stages, with the same names in every app that has the stage.
#pragma once

#include <string>

#include "anisomesh/holes.hh"
#include "anisomesh/io.hh"
#include "anisomesh/refine.hh"
#include "anisomesh/remesh.hh"
#include "support/command.hh"

namespace apps {

/// What the command line says, where the library wants it resolved against the mesh.
struct FeatureFlags {
  double angle_degrees = 0;
  bool automatic = true;
  std::string file;
  bool only_new = false;
};
struct EpsilonFlags {
  double epsilon = 0;
  bool absolute = false;
};

/// --weld.
void add_weld_option(Command& command, anisomesh::ReadOptions& options);
/// --fill-holes.
void add_fill_option(Command& command, anisomesh::FillOptions& options);
/// What --refine says.
struct RefineFlags {
  anisomesh::RefineOptions options;
  bool automatic = true;  ///< only parts
};
/// --refine.
void add_refine_option(Command& command, RefineFlags& flags);
void add_feature_options(Command& command, FeatureFlags& flags);
void add_curvature_options(Command& command, anisomesh::CurvatureOptions& options);
/// --domain, and how charts are cut.
void add_domain_options(Command& command, anisomesh::Domain& domain, anisomesh::ChartOptions& charts);
void add_smoothing_options(Command& command, anisomesh::SmoothingOptions& options);
void add_density_options(Command& command, EpsilonFlags& epsilon, anisomesh::TraceOptions& options);
void add_target_options(Command& command, anisomesh::TargetOptions& options);
/// \param heading of the group in --help
void add_mesh_options(Command& command, anisomesh::MeshOptions& options,
                      const std::string& heading = "Polygons");

/// --fit and --balance.
void add_fit_options(Command& command, anisomesh::FitOptions& fit, anisomesh::BalanceOptions& balance);

/// --max-error.
void add_max_error_option(Command& command, anisomesh::MaxErrorOptions& options);

/// Warns where options of charts were given and none will be cut.
void warn_of_charts(const Command& command, anisomesh::Domain domain);
/// Warns where epsilon was given and is looked for, too.
void warn_of_epsilon(const Command& command, const anisomesh::TargetOptions& target);
/// Says so where features were found that nobody asked for.
void tell_of_features(Command& command, const anisomesh::FeatureReport& report);
/// Reads --feature-file; its vertices are those of the file, before anything was dropped on reading.
/// \throw InvalidInput
anisomesh::FeatureOptions resolve(const FeatureFlags& flags, const anisomesh::ReadReport& read);
/// The fraction of the diagonal; 0 where none is given.
double resolve(const EpsilonFlags& flags, const anisomesh::SurfaceRef& surface);

}  // namespace apps
