#include "anisomesh/features.hh"
