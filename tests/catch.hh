// Catch2 2 (Debian 12) and 3 (Debian 13) under one name.
#pragma once

#ifdef ANISOMESH_CATCH2_V3
#include <catch2/catch_all.hpp>
#include <string>
using Catch::Approx;
namespace Catch {
inline auto Contains(const std::string& text) { return Matchers::ContainsSubstring(text); }
}  // namespace Catch
#else
#include <catch2/catch.hpp>
#endif
