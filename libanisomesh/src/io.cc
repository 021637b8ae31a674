#include "anisomesh/io.hh"
