// SPDX-License-Identifier: MIT
// Reads of a register whose only use is the value written back to it, `IFS0bits.T2IF = 0` and the like: one
// call instead of two. Nothing lies between the two on the chip either, and both halves are done at the same
// instant as before. After costs are counted, so they know nothing of it.
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Transforms/Utils/Local.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

constexpr unsigned kWord = 16;
constexpr std::uint64_t kWordMask = 0xFFFF;

/// What is written as (read & keep) ^ flip, 64 bits each.
struct Change {
  Value* keep;
  Value* flip;
};

/// The operations between a read and `value`, outermost first; false unless each has no other use and is one
/// that a Change can say.
bool find_chain(Value* value, const CallBase* read, SmallVectorImpl<Instruction*>& chain) {
  while (value != read) {
    auto* i = dyn_cast<Instruction>(value);
    if (!i || i->getParent() != read->getParent() || !i->hasOneUse()) return false;
    if (i->getType()->getScalarSizeInBits() < kWord) return false;
    chain.push_back(i);
    if (isa<TruncInst>(i) || isa<ZExtInst>(i)) {
      value = i->getOperand(0);
      continue;
    }
    if (i->getOpcode() != Instruction::And && i->getOpcode() != Instruction::Or &&
        i->getOpcode() != Instruction::Xor)
      return false;
    // the side on which the read lies, found by looking for it on both
    SmallVector<Instruction*, 8> left;
    if (find_chain(i->getOperand(0), read, left)) {
      chain.append(left);
      return true;
    }
    value = i->getOperand(1);
  }
  return read->hasOneUse();
}

/// The operand of a two-sided operation that is not the chain's.
Value* other_operand(Instruction* i, Value* inner) {
  return i->getOperand(0) == inner ? i->getOperand(1) : i->getOperand(0);
}

Change change_of(IRBuilder<>& b, ArrayRef<Instruction*> chain, Value* read) {
  Value* word = b.getInt64(kWordMask);
  Change c{word, b.getInt64(0)};
  for (std::size_t n = chain.size(); n-- > 0;) {
    Instruction* i = chain[n];
    if (isa<CastInst>(i)) continue;  // to 16 bits or more: the word stays
    Value* inner = n + 1 < chain.size() ? chain[n + 1] : read;
    Value* operand = b.CreateAnd(b.CreateZExtOrTrunc(other_operand(i, inner), b.getInt64Ty()), word);
    if (i->getOpcode() == Instruction::Xor) {
      c.flip = b.CreateXor(c.flip, operand);
      continue;
    }
    Value* stays = i->getOpcode() == Instruction::And ? operand : b.CreateXor(operand, word);
    c.keep = b.CreateAnd(c.keep, stays);
    c.flip = b.CreateAnd(c.flip, stays);
    if (i->getOpcode() == Instruction::Or) c.flip = b.CreateXor(c.flip, operand);
  }
  return c;
}

/// The read of the same word before a write, if nothing in between writes memory, calls, or takes time.
CallBase* read_before(CallBase* write) {
  for (Instruction* i = write->getPrevNode(); i; i = i->getPrevNode()) {
    if (isa<DbgInfoIntrinsic>(i)) continue;
    if (calls(*i, "tp_sfr_read")) {
      auto* read = cast<CallBase>(i);
      const bool same = read->getArgOperand(0) == write->getArgOperand(0) &&
                        read->getArgOperand(1) == write->getArgOperand(2);
      return same ? read : nullptr;
    }
    if (i->mayWriteToMemory() || isa<CallBase>(i)) return nullptr;
  }
  return nullptr;
}

}  // namespace

void fuse_registers(Unit& unit) {
  Type* i64 = Type::getInt64Ty(unit.module.getContext());
  for (Function& f : unit.module)
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      if (!calls(i, "tp_sfr_write")) continue;
      auto* write = cast<CallBase>(&i);
      auto* bits = dyn_cast<ConstantInt>(write->getArgOperand(2));
      if (!bits || bits->getZExtValue() != kWord) continue;
      CallBase* read = read_before(write);
      SmallVector<Instruction*, 8> chain;
      if (!read || !find_chain(write->getArgOperand(1), read, chain)) continue;
      IRBuilder<> b(write);
      const Change c = change_of(b, chain, read);
      auto modify = host_function(unit.module, "tp_sfr_modify", b.getVoidTy(), {i64, i64, i64});
      b.CreateCall(modify, {write->getArgOperand(0), c.keep, c.flip});
      write->eraseFromParent();
      for (Instruction* dead : chain) dead->eraseFromParent();
      read->eraseFromParent();
    }
}

}  // namespace cc
