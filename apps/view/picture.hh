// A picture without a display: headless Chromium draws the page's own scene with a software renderer, so that
// a picture is what the page shows, and a bare server needs one package and no node.
#pragma once

#include <functional>
#include <string>

namespace view {

/// The Chromium on this machine: $ANISOMESH_CHROMIUM, or the first of the usual names on the path.
/// \throw anisomesh::CannotProcess naming the package to install
std::string find_chromium();

/// The PNG that a page made with Scene::picture draws. \param cancelled asked now and then
/// \throw anisomesh::CannotProcess where Chromium does not draw it, anisomesh::Cancelled
std::string draw_picture(const std::string& chromium, const std::string& page,
                         const std::function<bool()>& cancelled);

}  // namespace view
