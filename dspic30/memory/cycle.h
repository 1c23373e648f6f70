// SPDX-License-Identifier: MIT
// The chip's time: instruction cycles (TCY) since power-up, never going back.
//
// Conventions of the whole room, for an access by the instruction that executes in cycle `now`:
//   a read sees the state of cycle `now`; what a write changes is seen from cycle now + 1 by whatever runs by
//   itself (a timer switched on in cycle 100 counts from cycle 101), and at once by later reads;
//   a flag "set at cycle f" is 1 for reads in cycle f and later;
//   an interval "until u" ends before u.
#pragma once
#include <cstdint>

namespace dspic {

using Cycle = std::int64_t;

/// An instant that never comes: after 155 years. Neither its sum with a few periods nor 64
/// times it overflows.
inline constexpr Cycle kNever = INT64_MAX >> 7;

}  // namespace dspic
