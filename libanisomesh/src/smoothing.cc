#include "anisomesh/smoothing.hh"
