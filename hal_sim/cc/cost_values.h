// SPDX-License-Identifier: MIT
// What single LLVM values are to the chip: how many words, in a register or not, in which memory.
#pragma once
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/IR/GlobalVariable.h"
#include "llvm/IR/Instructions.h"

namespace cc {

int type_words(llvm::Type* type);
int words_of(const llvm::Value* v);
/// 64-bit numbers that only exist because the PC's pointers are wide.
bool is_pointer_arithmetic(const llvm::Value* v);
/// A special-function register's content, or what becomes one: 64 bits wide for the host's sake, one word on
/// the chip.
bool is_register_value(const llvm::Value* v, int depth = 0);
/// The value without masks of 16 bits, which registers need none of.
const llvm::Value* without_word_mask(const llvm::Value* v);
/// One bit, or all but one, of a word: a constant of bset, bclr, btg and btst.
bool is_single_bit(const llvm::Value* constant, bool all_but_one);
/// False for conditions, address arithmetic and the like, which need no register of their own.
bool holds_register(const llvm::Value* v);
/// const data, and static arrays that nobody writes: XC16 keeps both in program memory.
bool is_program_memory(const llvm::GlobalVariable& g);
/// Extended from 16 bits or fewer, or a small constant.
bool narrow_operand(const llvm::Value* v);
/// A 16-bit signed division that the first stage widened to 32 bits.
bool is_narrow_division(const llvm::Value* v);
/// The operand before the first stage made divisions twice as wide.
llvm::Value* undo_widening(llvm::Value* v);
/// A division by the compiler's library.
bool is_long_division(const llvm::Value* v);
/// p++ that no access takes along: [w0++] needs the access before the step.
bool steps_alone(const llvm::GetElementPtrInst& gep);
/// x & 255 that only exists because LLVM widened a byte carried round a loop.
bool is_byte_wrap(const llvm::Instruction& i);
/// A number that advances by a constant in each round of the loop, widened to an index or not.
bool is_induction(const llvm::Value* v, const llvm::Loop& loop);
/// Arithmetic for one arm of a choice: the chip's compiler branches round it.
bool only_for_select(const llvm::Instruction& i);

}  // namespace cc
