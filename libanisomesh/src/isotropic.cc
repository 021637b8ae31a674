#include "anisomesh/lines.hh"
