// SPDX-License-Identifier: MIT
// See cost_operations.h.
#include "cost_operations.h"

#include "cost_values.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Support/MathExtras.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// x has one bit, at most or exactly, as `x & (x - 1)` tells.
bool asks_for_one_bit(const CallBase& count) {
  return all_of(count.users(), [](const User* u) {
    auto* compare = dyn_cast<ICmpInst>(u);
    auto* c = compare ? dyn_cast<ConstantInt>(compare->getOperand(1)) : nullptr;
    return c && c->getZExtValue() <= 2;
  });
}

}  // namespace

void charge_intrinsic(const IntrinsicInst& c, Features& f, double& library) {
  const int words = words_of(&c);
  switch (c.getIntrinsicID()) {
    case Intrinsic::fabs:
      f[k_alu] += 1;
      return;
    case Intrinsic::abs:  // btsc w0,#15 over neg
      f[k_alu] += 2 * words;
      return;
    case Intrinsic::memcpy:
    case Intrinsic::memmove:
    case Intrinsic::memset: {
      auto* n = dyn_cast<ConstantInt>(cast<MemIntrinsic>(c).getLength());
      f[k_copy_word] += n ? n->getZExtValue() / 2.0 + 2 : 20;
      return;
    }
    case Intrinsic::bswap:
      f[k_alu] += words;
      return;
    case Intrinsic::fshl:
    case Intrinsic::fshr:
      if (words > 1) {
        f[k_shift32] += 2;
        f[k_logic32] += 1;
      } else {
        f[k_shift16] += 3;
      }
      return;
    case Intrinsic::bitreverse:  // swaps of halves by masks: and, shift, and, shift, or for each width
      f[k_alu] += 5.0 * Log2_32(c.getType()->getScalarSizeInBits()) * words;
      f[k_wide_constant] += 2.0 * words;
      return;
    case Intrinsic::ctpop:
      // x & (x - 1), as the source has it, when only one bit is asked for; else the loop of the library
      if (asks_for_one_bit(c)) {
        f[k_alu] += 2 * words;
        return;
      }
      f[k_call] += 1;
      library += kPopulationCount * words;
      return;
    case Intrinsic::ctlz:
    case Intrinsic::cttz:  // ff1l, ff1r, and one word after the other
      f[k_alu] += 3 * words;
      return;
    case Intrinsic::uadd_sat:
    case Intrinsic::usub_sat:
    case Intrinsic::sadd_sat:
    case Intrinsic::ssub_sat:
      f[words > 1 ? k_alu32 : k_alu] += 1;
      f[words > 1 ? k_compare32 : k_compare] += 1;
      f[k_select] += 1;
      f[k_select_word] += words - 1;
      return;
    case Intrinsic::uadd_with_overflow:
    case Intrinsic::usub_with_overflow:
    case Intrinsic::sadd_with_overflow:
    case Intrinsic::ssub_with_overflow: {
      const bool is_wide = type_words(c.getArgOperand(0)->getType()) > 1;
      f[is_wide ? k_alu32 : k_alu] += 1;
      f[is_wide ? k_compare32 : k_compare] += 1;
      return;
    }
    case Intrinsic::umul_with_overflow:
    case Intrinsic::smul_with_overflow:
      f[type_words(c.getArgOperand(0)->getType()) > 1 ? k_mul32 : k_mul_widening] += 1;
      f[k_compare] += 1;
      return;
    case Intrinsic::copysign:
      f[k_alu] += 3;
      return;
    default:
      // markers, hints and the like have no result
      if (!c.getType()->isVoidTy() && !c.getType()->isPointerTy()) f[k_alu] += words;
      return;
  }
}

bool changes_register(const CallBase& read) {
  if (!calls(read, "tp_sfr_read")) return false;
  for (const Instruction* i = read.getNextNode(); i; i = i->getNextNode()) {
    if (!isa<CallBase>(i) || isa<IntrinsicInst>(i)) continue;
    return calls(*i, "tp_sfr_write") && cast<CallBase>(i)->getArgOperand(0) == read.getArgOperand(0);
  }
  return false;
}

void merge_register_changes(Function& f, SmallPtrSetImpl<const Instruction*>& in_place,
                            SmallPtrSetImpl<const Instruction*>& needs_constant) {
  for (Instruction& i : instructions(f)) {
    if (!calls(i, "tp_sfr_write")) continue;
    auto* op = dyn_cast<BinaryOperator>(without_word_mask(cast<CallBase>(i).getArgOperand(1)));
    if (!op || !(op->isBitwiseLogicOp() || op->getOpcode() == Instruction::Add ||
                 op->getOpcode() == Instruction::Sub))
      continue;
    auto* constant = dyn_cast<ConstantInt>(op->getOperand(1));
    // (x & ~bits) | bits: LLVM clears first what it sets then
    const Value* from = without_word_mask(op->getOperand(0));
    auto* clears = dyn_cast<BinaryOperator>(from);
    if (clears && constant && op->getOpcode() == Instruction::Or && clears->getOpcode() == Instruction::And)
      if (auto* kept = dyn_cast<ConstantInt>(clears->getOperand(1));
          kept && ((kept->getZExtValue() | constant->getZExtValue()) & 0xFFFF) == 0xFFFF)
        from = without_word_mask(clears->getOperand(0));
    auto* read = dyn_cast<CallBase>(from);
    if (!read || !read->hasOneUse() || read->getParent() != i.getParent() || !changes_register(*read))
      continue;
    if (clears) in_place.insert(clears);
    in_place.insert(op);
    in_place.insert(read);
    const bool is_bit =
        op->isBitwiseLogicOp() && is_single_bit(op->getOperand(1), op->getOpcode() == Instruction::And);
    if (constant && !is_bit) needs_constant.insert(&i);
  }
}

}  // namespace cc
