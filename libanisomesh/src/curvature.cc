#include "anisomesh/curvature.hh"
