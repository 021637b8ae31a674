// What others reach with as many vertices: their programs, told to, and their results read back.
#pragma once

#include <fstream>
#include <optional>

#include "bench.hh"
#include "programs.hh"

namespace bench {

/// OpenMesh-commandlineDecimater with its quadrics; nothing where it is not installed (libopenmesh-apps).
inline std::optional<OpenMesh::PolyMesh> decimated(const std::string& input, size_t vertices,
                                                   const Folder& folder) {
  if (!is_installed("OpenMesh-commandlineDecimater")) return {};
  const std::string output = folder / "decimated.off";
  // A number of vertices is given with a minus.
  run({"OpenMesh-commandlineDecimater", "-M", "Q", "-n", "-" + std::to_string(vertices), "-i", input, "-o",
       output});
  return anisomesh::read_polygons(output);
}

/// The filter of meshlabserver 2020.09, with its own defaults but for the number of faces.
inline std::string meshlab_script(size_t faces) {
  const auto parameter = [](const char* type, const std::string& value, const char* name) {
    return std::string("<Param type=\"") + type + "\" value=\"" + value + "\" name=\"" + name + "\"/>\n";
  };
  return "<!DOCTYPE FilterScript>\n<FilterScript>\n"
         "<filter name=\"Simplification: Quadric Edge Collapse Decimation\">\n" +
         parameter("RichInt", std::to_string(faces), "TargetFaceNum") +
         parameter("RichFloat", "0", "TargetPerc") + parameter("RichFloat", "0.3", "QualityThr") +
         parameter("RichBool", "false", "PreserveBoundary") + parameter("RichFloat", "1", "BoundaryWeight") +
         parameter("RichBool", "false", "PreserveNormal") +
         parameter("RichBool", "false", "PreserveTopology") +
         parameter("RichBool", "true", "OptimalPlacement") + parameter("RichBool", "false", "PlanarQuadric") +
         parameter("RichFloat", "0.001", "PlanarWeight") + parameter("RichBool", "false", "QualityWeight") +
         parameter("RichBool", "true", "AutoClean") + parameter("RichBool", "false", "Selected") +
         "</filter>\n</FilterScript>\n";
}

/// MeshLab's quadric edge collapse with its best placement, within 1 % of so many vertices; nothing where
/// meshlabserver or xvfb-run is not installed.
inline std::optional<OpenMesh::PolyMesh> collapsed_by_meshlab(const std::string& input, size_t vertices,
                                                              const Folder& folder) {
  if (!is_installed("meshlabserver") || !is_installed("xvfb-run")) return {};
  const std::string script = folder / "script.mlx", output = folder / "meshlab.off";
  size_t faces = 2 * vertices;
  for (int attempt = 0;; ++attempt) {
    std::ofstream(script) << meshlab_script(faces);
    run({"xvfb-run", "-a", "meshlabserver", "-i", input, "-o", output, "-s", script});
    auto result = anisomesh::read_polygons(output);
    const double off = static_cast<double>(vertices) / static_cast<double>(result.n_vertices());
    if (attempt == 2 || std::abs(off - 1) < 0.01) return result;
    faces = static_cast<size_t>(static_cast<double>(faces) * off);
  }
}

}  // namespace bench
