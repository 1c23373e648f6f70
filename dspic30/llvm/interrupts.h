// SPDX-License-Identifier: MIT
// What the attributes of XC16 say about an interrupt handler. The front end hands them on as attributes of
// the IR function, by these names.
#pragma once
#include "llvm/IR/Function.h"

namespace llvm {

inline constexpr const char* kInterrupt = "interrupt";      // ends in RETFIE, keeps all registers
inline constexpr const char* kShadow = "shadow";            // PUSH.S and POP.S keep W0 to W3
inline constexpr const char* kAutoPsv = "auto_psv";         // sets the constants' page
inline constexpr const char* kSave = "save";                // "_a,_b": pushed and popped as well
inline constexpr const char* kPreprologue = "preprologue";  // assembler that comes first

inline bool is_interrupt(const Function& f) { return f.hasFnAttribute(kInterrupt); }
inline bool has_shadow(const Function& f) { return f.hasFnAttribute(kShadow); }

}  // namespace llvm
