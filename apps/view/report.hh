// What a page is made of: the meshes, the ruler's figures, the options.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <OpenMesh/Core/Mesh/DefaultTriMesh.hh>
#include <list>
#include <string>
#include <vector>

#include "anisomesh/compare.hh"
#include "view/layers.hh"
#include "view/page.hh"

namespace view {

/// Meshes by name; lists, so that what is drawn stays where it is.
struct Meshes {
  struct Surface {
    std::string name;
    OpenMesh::TriMesh mesh;
  };
  struct Result {
    std::string name;
    OpenMesh::PolyMesh mesh;
  };
  std::list<Surface> surfaces;
  std::list<Result> results;

  /// The first of each.
  Shown shown() const;
};

/// Measures each result against the first surface, which leaves the errors on it, and tables the figures that
/// anisomesh-compare has. No surface or no result: no table.
std::vector<Table> compare_all(Meshes& meshes, const anisomesh::CompareOptions& options,
                               const anisomesh::Progress& progress = {});

/// The page of all of them. \throw as make_page() and surface_model()
std::string make_report(const std::string& title, const Meshes& meshes, const std::vector<Table>& tables,
                        const Scene& scene = {});

}  // namespace view
