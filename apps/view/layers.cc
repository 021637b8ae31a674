#include "view/layers.hh"

#include <algorithm>
#include <string_view>

#include "anisomesh/errors.hh"
#include "anisomesh/properties.hh"

namespace view {

namespace property = anisomesh::property;

const std::vector<Layer>& layers() {
  constexpr const char* estimate = "anisomesh-estimate";
  constexpr const char* flatten = "anisomesh-flatten";
  constexpr const char* trace = "anisomesh-trace";
  constexpr const char* mesh = "anisomesh-mesh";
  static const std::vector<Layer> all = {
      {"surface", "a pane with the input", Needs::surface, nullptr, nullptr},
      {"plane", "a pane with the input in the (u, v) plane", Needs::plane, property::uv.name, flatten},
      {"result", "a pane with the result", Needs::result, nullptr, nullptr},
      {"overlay", "a pane with the result's edges laid over the input", Needs::both, nullptr, nullptr},
      {"k-min", "smaller principal curvature", Needs::surface, property::k_min.name, estimate},
      {"k-max", "larger principal curvature", Needs::surface, property::k_max.name, estimate},
      {"mean", "mean curvature", Needs::surface, property::k_min.name, estimate},
      {"gauss", "Gaussian curvature", Needs::surface, property::k_min.name, estimate},
      {"anisotropy", "how much the principal curvatures differ", Needs::surface, property::k_min.name,
       estimate},
      {"stretch", "area stretch of the parameterization", Needs::surface, property::area_stretch.name,
       flatten},
      {"triangles", "the input's edges", Needs::surface, nullptr, nullptr},
      {"border", "the input's border", Needs::surface, nullptr, nullptr},
      {"features", "feature edges", Needs::surface, nullptr, nullptr},
      {"seams", "edges between charts", Needs::surface, property::chart_uv.name, flatten},
      {"crosses", "principal directions, scaled by curvature", Needs::surface, property::gamma_min.name,
       estimate},
      {"smoothed-crosses", "the same of the smoothed tensors", Needs::surface, property::tensor2d.name,
       flatten, property::surface_tensor.name},
      {"umbilics", "wedges and trisectors", Needs::surface, property::umbilic.name, flatten},
      {"min-lines", "min lines of curvature", Needs::surface, property::line_table.name, trace},
      {"max-lines", "max lines of curvature", Needs::surface, property::line_table.name, trace},
      {"samples", "isotropic samples", Needs::surface, property::isotropic_faces.name, trace},
      {"degree", "polygons by number of corners", Needs::result, nullptr, nullptr},
      {"error", "polygons by distance to the input", Needs::result, property::face_error.name,
       "anisomesh-compare -o"},
      {"bend", "polygons by the angle they are bent by", Needs::result, nullptr, nullptr},
      {"polygons", "edges of the result", Needs::result, nullptr, nullptr},
      {"edge-kinds", "edges of the result by what they are", Needs::result, property::edge_kind.name, mesh},
      {"origins", "vertices of the result by why they are there", Needs::result, property::origin.name, mesh},
      {"plane-polygons", "the result's polygons in the (u, v) plane", Needs::result,
       property::source_face.name, mesh},
  };
  return all;
}

bool carries(const OpenMesh::BaseKernel& mesh, const std::string& name) {
  const auto in = [&](auto begin, auto end) {
    return std::any_of(begin, end, [&](const OpenMesh::BaseProperty* p) { return p && p->name() == name; });
  };
  return in(mesh.vprops_begin(), mesh.vprops_end()) || in(mesh.fprops_begin(), mesh.fprops_end()) ||
         in(mesh.eprops_begin(), mesh.eprops_end()) || in(mesh.mprops_begin(), mesh.mprops_end());
}

void require_layer(const std::string& name, const Shown& shown) {
  const auto& all = layers();
  const auto layer = std::find_if(all.begin(), all.end(), [&](const Layer& l) { return name == l.name; });
  if (layer == all.end()) {
    std::string known;
    for (const auto& l : all) known += (known.empty() ? "" : ", ") + std::string(l.name);
    throw anisomesh::InvalidOption("there is no layer '" + name + "'; the layers are " + known);
  }
  const bool of_result = layer->needs == Needs::result;
  if (!shown.surface && !of_result)
    throw anisomesh::InvalidInput("layer '" + name + "' is of the input surface, and none was given");
  if (!shown.result && (of_result || layer->needs == Needs::both))
    throw anisomesh::InvalidInput("layer '" + name + "' is of a result, and none was given");
  if (!layer->property) return;
  const OpenMesh::BaseKernel& mesh =
      of_result ? static_cast<const OpenMesh::BaseKernel&>(*shown.result) : *shown.surface;
  if (carries(mesh, layer->property) || (layer->instead && carries(mesh, layer->instead))) return;
  if (layer->app == std::string_view("anisomesh-flatten") && carries(mesh, property::surface_tensor.name))
    throw anisomesh::InvalidInput(
        shown.surface_name + ": layer '" + name + "' needs property '" + layer->property +
        "', which a surface that was worked on without a plane does not have; a disc gets "
        "it with --domain plane");
  throw anisomesh::InvalidInput(
      (of_result ? shown.result_name : shown.surface_name) + ": layer '" + name + "' needs property '" +
      layer->property + "', which is not there; run " + layer->app +
      (std::string_view(layer->property) == property::face_error.name ? ", or give the input surface too"
                                                                      : " first, and keep .om files"));
}

}  // namespace view
