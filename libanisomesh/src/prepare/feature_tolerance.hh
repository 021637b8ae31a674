// How nearly features are followed, as fractions of the extent.
#pragma once

namespace anisomesh::detail {

/// Those that somebody asked for, whatever epsilon is.
constexpr double asked_feature_tolerance = 4.8e-4;
/// Those that were found: no bound but epsilon.
constexpr double found_feature_tolerance = 1;

}  // namespace anisomesh::detail
