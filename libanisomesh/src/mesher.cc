#include "anisomesh/mesher.hh"
