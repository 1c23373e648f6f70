// SPDX-License-Identifier: MIT
// See cost_values.h.
#include "cost_values.h"

#include "llvm/ADT/STLExtras.h"
#include "llvm/IR/Operator.h"
#include "llvm/Support/MathExtras.h"
#include "passes.h"

namespace cc {

using namespace llvm;

int type_words(Type* t) {
  if (t->isVoidTy()) return 0;
  if (t->isPointerTy() || t->isIntegerTy(1)) return 1;
  if (t->isFloatTy()) return 2;
  if (t->isDoubleTy()) return 4;
  if (auto* i = dyn_cast<IntegerType>(t)) return std::max(1u, (i->getBitWidth() + 15) / 16);
  return std::max<int>(1, int(t->getPrimitiveSizeInBits()) / 16);
}

bool is_pointer_arithmetic(const Value* v) {
  if (!v->getType()->isIntegerTy(64)) return false;
  if (isa<PtrToIntInst>(v)) return true;
  if (auto* op = dyn_cast<BinaryOperator>(v))
    if (op->isIntDivRem()) return false;
  if (auto* cast_from = dyn_cast<CastInst>(v)) {
    if (cast_from->getOperand(0)->getType()->getScalarSizeInBits() > 16) return false;
    for (const User* u : v->users())
      if (isa<GetElementPtrInst>(u)) return true;
  }
  if (auto* op = dyn_cast<BinaryOperator>(v))
    return is_pointer_arithmetic(op->getOperand(0)) || is_pointer_arithmetic(op->getOperand(1));
  return false;
}

bool is_register_value(const Value* v, int depth) {
  constexpr int kDeepest = 8;
  if (depth > kDeepest || !v->getType()->isIntegerTy(64)) return false;
  if (auto* call = dyn_cast<CallBase>(v)) return calls(*call, "tp_sfr_read");
  const auto* op = dyn_cast<BinaryOperator>(v);
  if (op && any_of(op->operands(), [&](const Value* o) { return is_register_value(o, depth + 1); }))
    return true;
  if (!op && !isa<CastInst>(v)) return false;
  return !v->use_empty() && all_of(v->users(), [&](const User* u) {
    auto* i = dyn_cast<Instruction>(u);
    if (!i) return false;
    if (calls(*i, "tp_sfr_write")) return true;
    return isa<BinaryOperator>(i) && is_register_value(i, depth + 1);
  });
}

const Value* without_word_mask(const Value* v) {
  while (auto* op = dyn_cast<BinaryOperator>(v)) {
    auto* mask = op->getOpcode() == Instruction::And ? dyn_cast<ConstantInt>(op->getOperand(1)) : nullptr;
    if (!mask || !mask->equalsInt(0xFFFF)) break;
    v = op->getOperand(0);
  }
  return v;
}

bool is_single_bit(const Value* constant, bool all_but_one) {
  auto* c = dyn_cast<ConstantInt>(constant);
  if (!c) return false;
  const uint64_t word = c->getZExtValue() & 0xFFFF;
  return isPowerOf2_64(all_but_one ? ~word & 0xFFFF : word);
}

int words_of(const Value* v) { return is_pointer_arithmetic(v) ? 1 : type_words(v->getType()); }

bool holds_register(const Value* v) {
  if (isa<AllocaInst>(v) || v->getType()->isVoidTy() || (isa<CmpInst>(v) && v->hasOneUse())) return false;
  if (auto* i = dyn_cast<Instruction>(v)) {
    if (is_free(*i)) return false;
    if (isa<GetElementPtrInst>(i) && cast<GetElementPtrInst>(i)->hasAllConstantIndices()) return false;
    if (v->getType()->isIntegerTy(64) && is_pointer_arithmetic(v)) return false;
  }
  return true;
}

bool is_program_memory(const GlobalVariable& g) {
  if (g.isConstant()) return true;
  if (!g.hasLocalLinkage() || !g.getValueType()->isAggregateType() || g.getName().startswith("tp"))
    return false;
  SmallVector<const User*, 16> work(g.user_begin(), g.user_end());
  while (!work.empty()) {
    const User* u = work.pop_back_val();
    if (isa<LoadInst>(u)) continue;
    if (!isa<GEPOperator>(u) && !isa<BitCastOperator>(u)) return false;
    work.append(u->user_begin(), u->user_end());
  }
  return true;
}

bool narrow_operand(const Value* v) {
  auto* e = dyn_cast<CastInst>(v);
  return (e && e->isIntegerCast() && e->getSrcTy()->getScalarSizeInBits() <= 16) ||
         (isa<ConstantInt>(v) && cast<ConstantInt>(v)->getValue().getMinSignedBits() <= 16);
}

bool is_narrow_division(const Value* v) {
  auto* op = dyn_cast<BinaryOperator>(v);
  return op && (op->getOpcode() == Instruction::SDiv || op->getOpcode() == Instruction::SRem) &&
         op->getType()->isIntegerTy(32) && narrow_operand(op->getOperand(0)) &&
         narrow_operand(op->getOperand(1));
}

Value* undo_widening(Value* v) {
  auto* e = dyn_cast<SExtInst>(v);
  return e && e->getType()->isIntegerTy(64) ? e->getOperand(0) : v;
}

bool is_long_division(const Value* v) {
  auto* op = dyn_cast<BinaryOperator>(v);
  if (op && op->isIntDivRem() && op->getType()->isIntegerTy(32))
    if (auto* by = dyn_cast<ConstantInt>(op->getOperand(1)); by && by->getValue().isPowerOf2()) return false;
  return op && op->isIntDivRem() && op->getType()->getIntegerBitWidth() > 16 && !is_narrow_division(v);
}

bool steps_alone(const GetElementPtrInst& gep) {
  auto* phi = dyn_cast<PHINode>(gep.getPointerOperand());
  if (!phi || !gep.hasAllConstantIndices() || !is_contained(phi->incoming_values(), &gep)) return false;
  for (const User* u : phi->users()) {
    auto* access = dyn_cast<Instruction>(u);
    if (access && access->getParent() != gep.getParent()) return true;  // the old value lives on
  }
  for (const User* u : phi->users()) {
    auto* access = dyn_cast<Instruction>(u);
    if (access && access->getParent() == gep.getParent() && getLoadStorePointerOperand(access) == phi)
      return false;
  }
  return true;
}

bool only_for_select(const Instruction& i) {
  if (!isa<BinaryOperator>(i) || !i.hasOneUse()) return false;
  auto* select = dyn_cast<SelectInst>(i.user_back());
  return select && select->getCondition() != &i && select->getParent() == i.getParent();
}

bool is_byte_wrap(const Instruction& i) {
  auto* mask = i.getOpcode() == Instruction::And ? dyn_cast<ConstantInt>(i.getOperand(1)) : nullptr;
  auto* op = mask && mask->equalsInt(255) ? dyn_cast<BinaryOperator>(i.getOperand(0)) : nullptr;
  return op && any_of(op->operands(), [&](const Value* v) {
           auto* phi = dyn_cast<PHINode>(v);
           return phi && is_contained(phi->incoming_values(), &i);
         });
}

bool is_induction(const Value* v, const Loop& loop) {
  for (int steps = 0; steps < 4; ++steps) {
    auto* wide = dyn_cast<CastInst>(v);
    auto* op = dyn_cast<BinaryOperator>(v);
    if (wide && wide->isIntegerCast())
      v = wide->getOperand(0);
    else if (op && op->getOpcode() == Instruction::Add && isa<Constant>(op->getOperand(1)))
      v = op->getOperand(0);
    else
      break;
  }
  auto* phi = dyn_cast<PHINode>(v);
  if (!phi || phi->getParent() != loop.getHeader()) return false;
  for (unsigned n = 0; n < phi->getNumIncomingValues(); ++n) {
    if (!loop.contains(phi->getIncomingBlock(n))) continue;
    auto* step = dyn_cast<BinaryOperator>(phi->getIncomingValue(n));
    if (!step || step->getOpcode() != Instruction::Add || step->getOperand(0) != phi ||
        !isa<Constant>(step->getOperand(1)))
      return false;
  }
  return true;
}

}  // namespace cc
