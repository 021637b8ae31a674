// The self-contained page.
#pragma once

#include <array>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "support/command.hh"
#include "view/model.hh"

namespace view {

/// How the page begins.
struct Scene {
  std::vector<std::string> layers;           ///< empty: the page chooses from what is there
  std::optional<std::array<double, 3>> eye;  ///< where the eye is, seen from the middle; none: chosen
  std::optional<std::array<double, 3>> up;
  std::optional<std::array<double, 3>> middle;  ///< the point looked at; none: the middle of everything
  double zoom = 1;
  std::optional<std::array<int, 2>> picture;  ///< draw a picture of this size only, see picture.hh
};

/// A table of the page, or nested tables where a value is an object.
struct Table {
  std::string title;
  apps::Json rows;
};

/// Whether this build has the page (ANISOMESH_VIEW).
bool have_page();

/// Looks before the long work whether a page can be made and written there. \throw anisomesh::CannotProcess
/// without have_page(), anisomesh::InvalidInput
void require_page(const std::string& path);

/// Refuses to write into a file that the name calls something else, a mesh for instance; a name without an
/// ending calls it nothing. \throw anisomesh::InvalidInput
void require_ending(const std::string& path, const std::vector<std::string>& endings);

/// The page as HTML: nothing in it is fetched. \throw anisomesh::CannotProcess without have_page()
std::string make_page(const std::string& title, const Frame& frame, const std::vector<Model>& models,
                      const std::vector<Table>& tables, const Scene& scene = {});

/// A direction: front, back, left, right, top, bottom, corner, or x,y,z. \throw anisomesh::InvalidOption
std::array<double, 3> direction_from(const std::string& option, const std::string& text);
/// x,y,z. \throw anisomesh::InvalidOption
std::array<double, 3> point_from(const std::string& option, const std::string& text);
/// 800x600. \throw anisomesh::InvalidOption
std::array<int, 2> size_from(const std::string& text);

}  // namespace view
