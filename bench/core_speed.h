// SPDX-License-Identifier: MIT
#pragma once

namespace bench {

/// Instructions a second of the chip's core, interpreted and translated, and of simavr's on the same kind of
/// loop, in turn, `rounds` times, printed with what is promised. False: a promise was missed.
bool measure_core(int rounds);

}  // namespace bench
