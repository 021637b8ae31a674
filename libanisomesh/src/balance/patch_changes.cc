#include "balance/patch_changes.hh"

#include <algorithm>

namespace anisomesh::detail {

namespace {

size_t at(int i) { return static_cast<size_t>(i); }

}  // namespace

const PatchChanges::Moves& PatchChanges::none() {
  static const Moves empty;
  return empty;
}

PatchChanges::PatchChanges(PatchMesh& mesh, const Moves& refused)
    : mesh_(mesh), refused_(refused), touched_(mesh.polygons().size(), 0) {
  for (const auto& vertex : mesh.vertices())
    if (!vertex.polygons.empty()) places_.insert(key(vertex.point));
}

bool PatchChanges::is_open(const PatchMove& move) const {
  for (const int p : move.patch.polygons)
    if (touched_[at(p)]) return false;
  if (refused_.count(&move) > 0) return false;
  if (move.adds && places_.count(key(move.place)) > 0) return false;
  return mesh_.may_replace(move.patch, move.pieces);
}

void PatchChanges::apply(const PatchMove& move) {
  auto pieces = move.pieces;
  if (move.adds) {
    places_.insert(key(move.place));
    const int middle = move.between[0] < 0 ? mesh_.add_vertex(move.place, move.source)
                                           : mesh_.add_vertex_on_curve(move.place, move.source, move.between);
    for (auto& piece : pieces)
      for (int& v : piece)
        if (v < 0) v = middle;
  }
  for (const int p : move.patch.polygons) touched_[at(p)] = 1;
  taken_.push_back({&move, move.patch.polygons, static_cast<int>(mesh_.polygons().size())});
  mesh_.replace(move.patch, pieces, move.on_first_side);
  touched_.resize(mesh_.polygons().size(), 1);
}

PatchChanges::Moves PatchChanges::breaking(const FaceJudge& judge, const OpenMesh::PolyMesh& before) const {
  Moves result;
  const auto& polygons = mesh_.polygons();
  const std::vector<char> broken_faces = judge.broken(mesh_.mesh());
  if (count_marked(broken_faces) == 0) return result;
  const std::vector<char> were_broken = judge.broken(before);
  std::vector<char> broken(polygons.size(), 0);
  for (size_t p = 0, face = 0; p < polygons.size(); ++p)
    if (!polygons[p].empty()) broken[p] = broken_faces[face++];
  std::vector<int> move_of(polygons.size(), -1);
  for (size_t i = 0; i < taken_.size(); ++i) {
    const Taken& taken = taken_[i];
    const auto end = taken.first + static_cast<int>(taken.move->pieces.size());
    std::fill(move_of.begin() + taken.first, move_of.begin() + end, static_cast<int>(i));
    const auto now = std::count(broken.begin() + taken.first, broken.begin() + end, 1),
               then = std::count_if(taken.polygons.begin(), taken.polygons.end(),
                                    [&](int p) { return were_broken[at(p)] != 0; });
    if (now > then) result.insert(taken.move);
  }
  for (size_t p = 0; p < were_broken.size(); ++p) {
    if (!broken[p] || were_broken[p]) continue;
    for (const int v : polygons[p])
      for (const int q : mesh_.vertices()[at(v)].polygons)
        if (move_of[at(q)] >= 0) result.insert(taken_[at(move_of[at(q)])].move);
  }
  return result;
}

}  // namespace anisomesh::detail
