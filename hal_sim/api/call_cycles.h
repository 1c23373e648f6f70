// SPDX-License-Identifier: MIT
// What the library's functions and handlers take that hal_sim knows by heart: processor cycles of hal_dspic's
// own code, path by path, at each level of optimisation that it can be compiled at. call_cycles.inc is
// written by `twinpuck-dev timings` [measured: hal_dspic on the chip] and held by `make check`.
#pragma once
#include <cstdint>

#include "hal_sim/board/cycle.h"

namespace api {

using board::Cycle;

/// Of the library in an image.
enum class Level : std::uint8_t { O0, O1, O2, Os };

/// All from behind a call to behind its RETURN, or of a handler from behind its entry to before its RETFIE;
/// what a part takes more is its difference.
struct CallCycles {
#define CALL_CYCLES(name, what, o0, o1, o2, os) Cycle name;
#include "hal_sim/api/call_cycles.inc"
#undef CALL_CYCLES
};

const CallCycles& call_cycles(Level level);

}  // namespace api
