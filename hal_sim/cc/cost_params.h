// SPDX-License-Identifier: MIT
// Cycles of the dsPIC30F per rule of the cost model. [DS] follows from the instruction set's cycle rules;
// [xc16-cycles: fit] was fitted to exact counts of real XC16 v1.22 code (docs/cycles.md tells how); [vendor]
// are published figures of the compiler's run-time library.
#pragma once
#include <array>

namespace cc {

// name, cycles per occurrence, source
#define TP_COST_RULES(R)                                                                                 \
  R(alu, 1.0, "[DS]")                               /* one 16-bit word through the ALU */                \
  R(wide_constant, 1.0, "[DS]")                     /* mov #lit16: constant beyond a 5-bit literal */    \
  R(wide_constant_loop, 0.05, "[xc16-cycles: fit]") /* same inside a loop: mostly hoisted */             \
  R(alu32, 2.1, "[xc16-cycles: fit]")               /* add, subtract longs: two halves, some copies */   \
  R(logic32, 5.5, "[xc16-cycles: fit]")             /* and, or, xor of longs: split late, many copies */ \
  R(folded_load, 0.05, "[xc16-cycles: fit]")        /* operand of an ALU instruction */                  \
  R(compare32, 2.0, "[DS]")                         /* cp, cpb */                                        \
  R(compare32_zero, 3.0, "[xc16-cycles: fit]")                                                           \
  R(mul16, 1.0, "[DS]") /* mul.ss, result in a register pair */                                          \
  R(mul16_constant, 1.4, "[xc16-cycles: fit]")                                                           \
  R(mul_widening, 5.2, "[xc16-cycles: fit]")                                                             \
  R(mul32, 12.2, "[xc16-cycles: fit]")                                                                   \
  R(div16, 20.0, "[DS]") /* REPEAT 1 + 18, result moved */                                               \
  R(call, 2.0, "[DS]")                                                                                   \
  R(call_indirect, 0.1, "[xc16-cycles: fit]")                                                            \
  R(argument_word, 0.45, "[xc16-cycles: fit]")                                                           \
  R(return_, 3.0, "[DS]")                                                                                \
  R(saved_word, 2.0, "[DS]") /* push and pop of w8..w14 */                                               \
  R(frame, 2.0, "[DS]")      /* lnk, ulnk */                                                             \
  R(compare, 1.0, "[DS]")                                                                                \
  R(branch, 1.0, "[DS]")                                                                                 \
  R(taken, 1.0, "[DS]")                                                                                  \
  R(jump, 2.0, "[DS]")                                                                                   \
  R(flag_value, 2.2, "[xc16-cycles: fit]") /* comparison result as a number */                           \
  R(select, 2.2, "[xc16-cycles: fit]")                                                                   \
  R(select_word, 0.7, "[xc16-cycles: fit]")                                                              \
  R(shift16, 1.0, "[DS]")                                                                                \
  R(shift32_one, 2.0, "[DS]")                                                                            \
  R(shift32, 5.3, "[xc16-cycles: fit]")                                                                  \
  R(shift32_words, 2.0, "[xc16-cycles: fit]") /* by 16 and more */                                       \
  R(shift32_count, 4.5, "[xc16-cycles: fit]") /* each place of a variable shift */                       \
  R(extend8, 1.0, "[DS]")                                                                                \
  R(extend32, 1.0, "[DS]")                                                                               \
  R(load_word, 1.0, "[DS]")                                                                              \
  R(store_word, 1.0, "[DS]")                                                                             \
  R(load_byte, 1.0, "[DS]")                                                                              \
  R(store_byte, 1.0, "[DS]")                                                                             \
  R(global_byte, 0.6, "[xc16-cycles: fit]")  /* byte or long global: address in a register */            \
  R(address, 0.55, "[xc16-cycles: fit]")     /* address of an array formed */                            \
  R(address_loop, 0.5, "[xc16-cycles: fit]") /* same inside a loop: mostly hoisted */                    \
  R(index, 0.85, "[xc16-cycles: fit]")       /* index added to a base */                                 \
  R(index_scale, 1.0, "[DS]")                /* index times element size */                              \
  R(walk, 0.15, "[xc16-cycles: fit]")        /* pointer that advances with the loop */                   \
  R(constant_memory, 1.0, "[DS]")            /* read through the PSV window */                           \
  R(float_call, 2.0, "[DS]")                                                                             \
  R(float_word, 1.55, "[xc16-cycles: fit]")    /* operand placed for a library call */                   \
  R(float_constant, 1.0, "[xc16-cycles: fit]") /* constant operand */                                    \
  R(kept_word, 0.3, "[xc16-cycles: fit]")      /* value moved to where calls leave it alone */           \
  R(pointer_step, 0.95, "[xc16-cycles: fit]")  /* p++ that is not part of an access */                   \
  R(select_again, 0.5, "[xc16-cycles: fit]")   /* second choice on the same condition */                 \
  R(phi_constant, 1.0, "[xc16-cycles: fit]")   /* paths join: constant loaded on one of them */          \
  R(phi_move, 1.4, "[xc16-cycles: fit]")       /* paths join: value copied, as it lives on */            \
  R(return_move, 0.9, "[xc16-cycles: fit]")    /* result moved to w0 */                                  \
  R(switch_table, 7.2, "[xc16-cycles: fit]")                                                             \
  R(switch_case, 2.0, "[xc16-cycles: fit]")                                                              \
  R(copy_word, 1.0, "[xc16-cycles: fit]") /* struct copies */                                            \
  R(nop, 1.0, "[DS]")

enum Rule {
#define R(name, cycles, source) k_##name,
  TP_COST_RULES(R)
#undef R
      kRuleCount
};

inline constexpr std::array<double, kRuleCount> kRuleCycles = {
#define R(name, cycles, source) cycles,
    TP_COST_RULES(R)
#undef R
};

inline constexpr std::array<const char*, kRuleCount> kRuleNames = {
#define R(name, cycles, source) #name,
    TP_COST_RULES(R)
#undef R
};

// Arithmetic that only one arm of a choice needs counts with this share, since the chip branches round it.
inline constexpr double kArmShare = 0.6;  // [assumed: about every second time, plus a jump]

// Saving and restoring that the host takes for every handler: w0 to w7 pushed and popped [DS: 2 a word; the
// same in both ways: host_params.h, register_params.h].
inline constexpr double kHandlerContext = 16;  // [DS]

// A straight run of code is charged in parts of at most about this many cycles, so an interrupt waits no
// longer.
inline constexpr double kSegmentCycles = 100;  // [assumed: 7 us at 14.7456 MHz]

// Library routines, first instruction to return [vendor: XC16 libraries manual; divisions: xc16-cycles].
inline constexpr double kFloatAdd = 122, kFloatSub = 124, kFloatMul = 109, kFloatDiv = 361;  // [vendor]
inline constexpr double kFloatCompare = 60;  // [assumed: half of the generic routine's 107-134]
inline constexpr double kIntToFloat =
    80;  // [assumed: share of the generic 297 as add 122 of 272, rounded down]
inline constexpr double kFloatToInt = 70;                                // [assumed: as above, generic 240]
inline constexpr double kLongDivide = 130, kUnsignedLongDivide = 118;    // [xc16-cycles: library_cost.csv]
inline constexpr double kLongLongMultiply = 60, kLongLongDivide = 1100;  // [assumed: never measured]
inline constexpr double kPopulationCount = 30;  // [assumed: a table of 256, a byte at a time]
inline constexpr double kDoubleFactor = 2.5;    // [assumed] 64-bit long double against float

}  // namespace cc
