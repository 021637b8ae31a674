// Reports as JSON and as lines for people.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "anisomesh/compare.hh"
#include "anisomesh/holes.hh"
#include "anisomesh/io.hh"
#include "anisomesh/remesh.hh"
#include "support/command.hh"
#include "support/options.hh"

namespace apps {

Json to_json(const anisomesh::ReadReport& report);
Json to_json(const anisomesh::FillReport& report);
Json to_json(const anisomesh::FeatureReport& report);
Json to_json(const anisomesh::CurvatureReport& report);
Json to_json(const anisomesh::FlattenReport& report);
Json to_json(const anisomesh::ChartReport& report);
Json to_json(const anisomesh::SmoothingReport& report);
Json to_json(const anisomesh::UmbilicReport& report);
Json to_json(const anisomesh::TraceReport& report);
Json to_json(const anisomesh::IsotropicReport& report);
Json to_json(const anisomesh::MeshReport& report);
Json to_json(const anisomesh::BalanceReport& report);
Json to_json(const anisomesh::MaxErrorReport& report);
Json to_json(const anisomesh::Comparison& comparison);
/// "plane", "charts" or "surface".
std::string name_of(anisomesh::Domain domain);
/// The domain and, in the plane or in charts, the flattening, into `json`.
void add_json(Json& json, const anisomesh::DomainReport& report);
/// epsilon, attempts, and the reports of the last three stages, into `json`.
void add_json(Json& json, const anisomesh::TraceAndMeshReport& report);

/// What a comparison says to people: label and value, in order; an indented label belongs to the one above.
std::vector<std::pair<std::string, std::string>> comparison_lines(const anisomesh::Comparison& comparison);

/// Reads a surface for an app: reports what reading did, and warns where the file was not sound.
OpenMesh::TriMesh read_surface(Command& command, const std::string& path,
                               anisomesh::ReadReport* report = nullptr,
                               const anisomesh::ReadOptions& options = {});

/// Closes holes if they are to be closed, says so, and carries the vertex numbers in `read` along.
void fill_holes(Command& command, OpenMesh::TriMesh& mesh, anisomesh::ReadReport& read,
                const anisomesh::FillOptions& options);

/// Divides long, thin triangles if there are any, and says so.
/// \param features of the mesh, tagged
void refine(Command& command, OpenMesh::TriMesh& mesh, const RefineFlags& flags,
            const anisomesh::FeatureReport& features);

/// "2013 vertices, 2001 faces: 1820 quads (91 %), 150 triangles, 31 others"
std::string mesh_summary(const OpenMesh::PolyMesh& mesh);
/// Faces and vertices of the result into the report.
Json mesh_json(const OpenMesh::PolyMesh& mesh);
std::string seconds(double value);

}  // namespace apps
