// Stands in for the generated page where the build has none.
#include "view/template.hh"

namespace view {

const std::string& page_template() {
  static const std::string none;
  return none;
}

}  // namespace view
