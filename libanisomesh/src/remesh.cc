#include "anisomesh/remesh.hh"
