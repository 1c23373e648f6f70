// SPDX-License-Identifier: MIT
#pragma once
#include <ctime>

namespace bench {

/// Processor time that this process has used so far, all threads, s. The clock of an idle machine: what else
/// runs beside moves it little.
inline double processor_s() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

}  // namespace bench
