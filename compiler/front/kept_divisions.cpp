// SPDX-License-Identifier: MIT
// A division by 0 leads to the chip's MathError, which XC16's programs see. LLVM takes it for something that
// never happens and computes anything: x / 0 vanishes, 1 / x becomes two comparisons. Here the division
// stays, behind a value that the optimiser cannot see through; one whose result nobody wants goes, as with
// XC16. Not seen: a divisor that becomes 0 when a loop is written out.
#include "chip.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// The constant, as a value that is not known.
Value* hidden(IRBuilder<>& b, const ConstantInt& value) {
  Type* word = b.getInt16Ty();
  auto* empty = InlineAsm::get(FunctionType::get(word, {word}, false), "", "=r,0", /*hasSideEffects=*/false);
  Value* known = b.CreateCall(empty, {ConstantInt::get(word, value.getValue().sextOrTrunc(16))});
  return b.CreateSExtOrTrunc(known, value.getType());
}

bool divides(const Instruction& i) {
  const unsigned code = i.getOpcode();
  return code == Instruction::SDiv || code == Instruction::UDiv || code == Instruction::SRem ||
         code == Instruction::URem;
}

}  // namespace

/// Functions are about to be inlined: a 0 that is handed over as a divisor is hidden first.
PreservedAnalyses KeepZeroArgumentsPass::run(Module& m, ModuleAnalysisManager&) {
  bool any = false;
  for (Function& f : m)
    for (Instruction& i : instructions(f)) {
      const auto* divisor = divides(i) ? dyn_cast<Argument>(without_casts(i.getOperand(1))) : nullptr;
      if (!divisor) continue;
      for (User* user : f.users()) {
        auto* call = dyn_cast<CallInst>(user);
        if (!call || call->getCalledFunction() != &f || divisor->getArgNo() >= call->arg_size()) continue;
        auto* zero = dyn_cast<ConstantInt>(call->getArgOperand(divisor->getArgNo()));
        if (!zero || !zero->isZero()) continue;
        IRBuilder<> b(call);
        call->setArgOperand(divisor->getArgNo(), hidden(b, *zero));
        any = true;
      }
    }
  return any ? PreservedAnalyses::none() : PreservedAnalyses::all();
}

/// Without the optimiser it is the code generator that looks for what was stored last.
PreservedAnalyses KeepPlainDivisionsPass::run(Function& f, FunctionAnalysisManager& analyses) {
  for (Instruction& i : instructions(f))
    if (divides(i))
      if (auto* load = dyn_cast<LoadInst>(const_cast<Value*>(without_casts(i.getOperand(1)))))
        load->setVolatile(true);
  return KeepDivisionsPass().run(f, analyses);
}

PreservedAnalyses KeepDivisionsPass::run(Function& f, FunctionAnalysisManager&) {
  bool any = false;
  for (Instruction& i : instructions(f)) {
    if (!divides(i)) continue;
    auto *dividend = dyn_cast<ConstantInt>(i.getOperand(0)),
         *divisor = dyn_cast<ConstantInt>(i.getOperand(1));
    IRBuilder<> b(&i);
    if (divisor && divisor->isZero())
      i.setOperand(1, hidden(b, *divisor));
    else if (!divisor && dividend && (dividend->isOne() || dividend->isMinusOne()))
      i.setOperand(0, hidden(b, *dividend));
    else
      continue;
    any = true;
  }
  return any ? PreservedAnalyses::none() : PreservedAnalyses::all();
}

}  // namespace cc
