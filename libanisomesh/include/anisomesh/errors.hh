// The typed exceptions of the library. The library never prints and never exits: it throws one of these.
#pragma once

#include <stdexcept>

namespace anisomesh {

/// The mesh or file handed in is not what the function asks for; the message names the file, the element and
/// the way out.
struct InvalidInput : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// An option lies outside its documented range.
struct InvalidOption : std::invalid_argument {
  using std::invalid_argument::invalid_argument;
};

/// The input is a proper mesh, but not one that this stage can process (for example a patch that is no disc).
struct CannotProcess : std::domain_error {
  using std::domain_error::domain_error;
};

/// A numerical solver did not converge or the system was singular.
struct SolverFailure : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The progress callback returned false.
struct Cancelled : std::runtime_error {
  Cancelled() : std::runtime_error("cancelled by the caller") {}
};

}  // namespace anisomesh
