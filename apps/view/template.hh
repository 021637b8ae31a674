// The page as view/ builds it, without data; generated. Empty in a build without ANISOMESH_VIEW.
#pragma once

#include <string>

namespace view {

const std::string& page_template();

}  // namespace view
