#include "anisomesh/shapes.hh"
