// SPDX-License-Identifier: MIT
// A local variable that the program reads before it writes it holds what the stack or a register held: on the
// PC addresses that differ from run to run. Those in memory are filled with the robot's own byte when they
// come into being (tp_control.fill), those in registers get a constant. After the accounting: the chip does
// nothing of it.
#include "llvm/IR/Constants.h"
#include "llvm/IR/DataLayout.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Module.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// A number nobody expects; a pointer to nowhere. An open question is answered with yes.
Constant* unwritten(Type* type) {
  auto* integer = dyn_cast<IntegerType>(type);
  if (integer && integer->getBitWidth() < 8) return ConstantInt::getAllOnesValue(type);
  if (integer) return ConstantInt::get(type, APInt::getSplat(integer->getBitWidth(), APInt(8, 0xA5)));
  return Constant::getNullValue(type);
}

void settle_undefined(Instruction& i) {
  // vectors and structures are put together from nothing, element by element
  if (isa<InsertElementInst, ShuffleVectorInst, InsertValueInst>(i)) return;
  auto* call = dyn_cast<CallBase>(&i);
  if (call && call->getCalledFunction() && call->getCalledFunction()->isIntrinsic()) return;
  for (Use& use : i.operands())
    if (isa<UndefValue>(use) && use->getType()->isSingleValueType()) use.set(unwritten(use->getType()));
}

void fill(AllocaInst& variable, Unit& unit) {
  const DataLayout& layout = unit.module.getDataLayout();
  IRBuilder<> b(variable.getNextNode());
  Value* byte = b.CreateTrunc(b.CreateLoad(b.getInt64Ty(), control_field(unit.module, 2)), b.getInt8Ty());
  Value* bytes =
      b.CreateMul(b.CreateZExtOrTrunc(variable.getArraySize(), b.getInt64Ty()),
                  b.getInt64(layout.getTypeAllocSize(variable.getAllocatedType()).getFixedValue()));
  b.CreateMemSet(&variable, byte, bytes, variable.getAlign());
}

}  // namespace

void fill_locals(Unit& unit) {
  for (Function& f : unit.module) {
    std::vector<AllocaInst*> variables;
    for (Instruction& i : instructions(f)) {
      settle_undefined(i);
      if (auto* variable = dyn_cast<AllocaInst>(&i)) variables.push_back(variable);
    }
    for (AllocaInst* variable : variables) fill(*variable, unit);
  }
}

}  // namespace cc
