// SPDX-License-Identifier: MIT
// What C leaves undefined, LLVM takes for something that never happens: a store by a pointer that was never
// set ends its function without a RETURN, so that the program runs on into the next one; a store to a constant
// vanishes. XC16 compiles both as written, and the robot resets. Here the program stops there, and the store
// stays, which traps. Not seen: what stands behind a condition, of which LLVM concludes that it never holds.
#include "chip.h"
#include "dspic30/memory/host_places.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

bool is_constant(const Value* pointer) {
  auto* variable = dyn_cast<GlobalVariable>(getUnderlyingObject(pointer));
  return variable && variable->isConstant();
}

}  // namespace

PreservedAnalyses KeepConstantStoresPass::run(Function& f, FunctionAnalysisManager&) {
  for (Instruction& i : instructions(f)) {
    if (auto* store = dyn_cast<StoreInst>(&i); store && is_constant(store->getPointerOperand()))
      store->setVolatile(true);
    if (auto* copy = dyn_cast<MemIntrinsic>(&i); copy && is_constant(copy->getRawDest()))
      copy->setVolatile(ConstantInt::getTrue(f.getContext()));
  }
  return PreservedAnalyses::all();
}

/// An illegal opcode stands where the course cannot come. Not behind what never returns, and not in functions
/// that are assembler alone.
void stop_where_undefined(Module& m) {
  auto* stop = InlineAsm::get(FunctionType::get(Type::getVoidTy(m.getContext()), false),
                              ".pword " + std::to_string(dspic::kUndefinedWord), "", /*hasSideEffects=*/true);
  for (Function& f : m) {
    if (f.hasFnAttribute(Attribute::Naked)) continue;
    for (Instruction& i : make_early_inc_range(instructions(f))) {
      if (!isa<UnreachableInst>(i)) continue;
      const Instruction* const before = i.getPrevNonDebugInstruction();
      const auto* const call = dyn_cast_or_null<CallBase>(before);
      if (call && call->doesNotReturn()) continue;
      IRBuilder<> b(&i);
      DebugLoc where = i.getDebugLoc() ? i.getDebugLoc() : before ? before->getDebugLoc() : DebugLoc();
      if (DISubprogram* of = f.getSubprogram(); of && !where)
        where = DILocation::get(m.getContext(), of->getLine(), 0, of);
      b.SetCurrentDebugLocation(where);
      b.CreateCall(stop);
    }
  }
}

}  // namespace cc
