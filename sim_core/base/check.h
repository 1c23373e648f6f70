// SPDX-License-Identifier: MIT
// CHECK is for our own mistakes only: it prints where and why, then aborts. User input never reaches it.
#pragma once
#include <cstdio>
#include <cstdlib>

namespace sim {
[[noreturn]] inline void check_failed(const char* file, int line, const char* condition, const char* why) {
  std::fprintf(stderr, "%s:%d: internal error: %s (%s)\n", file, line, why, condition);
  std::abort();
}
}  // namespace sim

#ifndef CHECK
/// Aborts with `why` unless `condition` holds. Never compiled out.
#define CHECK(condition, why) \
  ((condition) ? static_cast<void>(0) : ::sim::check_failed(__FILE__, __LINE__, #condition, why))
#endif
