#include "anisomesh/umbilics.hh"
