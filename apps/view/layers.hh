// The layers of a view by name: what the page can switch on, and what a mesh must carry for each.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>
#include <string>
#include <vector>

#include "anisomesh/surface.hh"

namespace view {

/// What a layer is drawn from.
enum class Needs { surface, plane, result, both };

struct Layer {
  const char* name;
  const char* help;
  Needs needs;
  const char* property;           ///< the mesh must carry it; nullptr: none
  const char* app;                ///< that writes it
  const char* instead = nullptr;  ///< or this one, which a surface that was not flattened carries
};

/// All layers, in the order of the page.
const std::vector<Layer>& layers();

/// What is there to be drawn; nullptr: none. The names are for messages.
struct Shown {
  const OpenMesh::TriConnectivity* surface = nullptr;
  std::string surface_name;
  const OpenMesh::PolyMesh* result = nullptr;
  std::string result_name;
};

/// \throw anisomesh::InvalidOption where no layer is called so; anisomesh::InvalidInput where what it is
/// drawn from is missing, naming the app to run
void require_layer(const std::string& name, const Shown& shown);

/// Whether the mesh has a property of this name, on whatever elements.
bool carries(const OpenMesh::BaseKernel& mesh, const std::string& property);

}  // namespace view
