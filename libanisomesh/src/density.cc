#include "anisomesh/density.hh"
