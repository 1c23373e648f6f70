// SPDX-License-Identifier: MIT
// Last stage before the back end, after costs are counted: the same operations, spelled so that x86 neither
// traps (INT16_MIN / -1) nor takes shift counts modulo 32.
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

/// Narrow signed division in the next width: no overflow there, and truncation wraps as on the chip.
void widen_division(BinaryOperator* op) {
  unsigned bits = op->getType()->getIntegerBitWidth();
  IRBuilder<> b(op);
  auto* by = dyn_cast<ConstantInt>(op->getOperand(1));
  if (by && !by->isMinusOne()) return;
  if (auto* right = dyn_cast<SExtInst>(op->getOperand(1)))
    if (right->getSrcTy()->getIntegerBitWidth() < bits) return;  // widened in the first stage
  bool remainder = op->getOpcode() == Instruction::SRem;
  Value* result;
  if (bits < 64) {
    Type* wide = b.getIntNTy(bits <= 16 ? 32 : 64);
    Value* left = b.CreateSExt(op->getOperand(0), wide);
    Value* right = b.CreateSExt(op->getOperand(1), wide);
    result = b.CreateTrunc(remainder ? b.CreateSRem(left, right) : b.CreateSDiv(left, right), op->getType());
  } else {
    // divide by 1 instead of -1, then choose
    Value* minus_one = b.CreateICmpEQ(op->getOperand(1), ConstantInt::get(op->getType(), -1, true));
    Value* safe = b.CreateSelect(minus_one, ConstantInt::get(op->getType(), 1), op->getOperand(1));
    Value* normal = remainder ? b.CreateSRem(op->getOperand(0), safe) : b.CreateSDiv(op->getOperand(0), safe);
    Value* special = remainder ? ConstantInt::get(op->getType(), 0) : b.CreateNeg(op->getOperand(0));
    result = b.CreateSelect(minus_one, special, normal);
  }
  op->replaceAllUsesWith(result);
  op->eraseFromParent();
}

/// A count of 16 (32) or more empties the word or fills it with the sign.
void define_shift(BinaryOperator* op) {
  if (isa<ConstantInt>(op->getOperand(1))) return;
  unsigned bits = op->getType()->getIntegerBitWidth();
  IRBuilder<> b(op);
  Value* count = b.CreateFreeze(op->getOperand(1));
  Value* wide = b.CreateICmpUGE(count, ConstantInt::get(op->getType(), bits));
  Value* last = ConstantInt::get(op->getType(), bits - 1);
  if (op->getOpcode() == Instruction::AShr) {
    op->setOperand(1, b.CreateSelect(wide, last, count));
    return;
  }
  op->setOperand(1, b.CreateSelect(wide, ConstantInt::get(op->getType(), 0), count));
  b.SetInsertPoint(op->getNextNode());
  auto* result = cast<Instruction>(b.CreateSelect(wide, ConstantInt::get(op->getType(), 0), op));
  op->replaceUsesWithIf(result, [&](Use& use) { return use.getUser() != result; });
}

}  // namespace

void lower_late(Unit& unit) {
  for (Function& f : unit.module)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      if (calls(i, kNop) || calls(i, kRound)) {
        i.eraseFromParent();
        continue;
      }
      auto* op = dyn_cast<BinaryOperator>(&i);
      if (!op || !op->getType()->isIntegerTy()) continue;
      if (op->getOpcode() == Instruction::SDiv || op->getOpcode() == Instruction::SRem)
        widen_division(op);
      else if (op->isShift())
        define_shift(op);
    }
}

}  // namespace cc
