#include "anisomesh/flatten.hh"
