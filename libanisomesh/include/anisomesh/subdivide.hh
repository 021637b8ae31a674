// The smooth surface that a mesh of quads and triangles stands for.
#pragma once

#include <OpenMesh/Core/Mesh/DefaultPolyMesh.hh>

namespace anisomesh {

/// A finer mesh near the limit surface: `levels` times every face is divided in four (a polygon of more than
/// four corners into as many quads as it has corners), and every vertex replaced by a weighted mean of its
/// neighbours: Catmull and Clark's surface where all are quads, Loop's where all are triangles.
/// [Stam and Loop 2003; ACDLD03, section 5, figure 10] Reads: points, edge feature status and origin where
/// they are there. Borders and features become cubic B-splines; where a number of them other than two meets,
/// and at vertices of Origin::corner, nothing moves. The result carries edge feature status.
/// \throw InvalidOption if levels is not from 0 to 8 or would make more than 100,000,000 faces,
/// InvalidInput if the mesh has no faces or deleted elements
OpenMesh::PolyMesh subdivide(const OpenMesh::PolyMesh& mesh, int levels = 3);

}  // namespace anisomesh
