#include "anisomesh/compare.hh"
