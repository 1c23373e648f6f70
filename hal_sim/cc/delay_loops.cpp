// SPDX-License-Identifier: MIT
// Counting loops that do nothing but pass time: found by their trip count (ScalarEvolution), replaced by one
// call of the host with rounds and cycles per round. Values the loop leaves behind are computed in closed
// form.
#include <cmath>
#include <map>

#include "cost_model.h"
#include "llvm/Analysis/ScalarEvolution.h"
#include "llvm/Analysis/ScalarEvolutionExpressions.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Transforms/Utils/LoopSimplify.h"
#include "llvm/Transforms/Utils/LoopUtils.h"
#include "llvm/Transforms/Utils/PromoteMemToReg.h"
#include "llvm/Transforms/Utils/ScalarEvolutionExpander.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

/// One way round, nothing on it but arithmetic, nops and accesses to `counter`.
bool is_idle(Loop* loop, DominatorTree& dom, const Value* counter = nullptr) {
  BasicBlock* latch = loop->getLoopLatch();
  if (!loop->isLoopSimplifyForm() || loop->getExitingBlock() != latch || !loop->getExitBlock()) return false;
  if (!loop->getSubLoops().empty()) return false;
  for (BasicBlock* block : loop->blocks()) {
    if (!dom.dominates(block, latch)) return false;
    for (Instruction& i : *block) {
      if (isa<DbgInfoIntrinsic>(i) || calls(i, kNop) || calls(i, kRound)) continue;
      if (counter && getLoadStorePointerOperand(&i) == counter) continue;
      if (i.mayReadOrWriteMemory() || i.mayHaveSideEffects() || i.getType()->isFloatingPointTy())
        return false;
      if (auto* op = dyn_cast<BinaryOperator>(&i))
        if (op->isIntDivRem()) return false;
    }
  }
  return true;
}

/// The volatile local variable that alone keeps a loop from being a delay, or null. Nobody else can see it,
/// so its accesses matter for their time only.
AllocaInst* volatile_counter(Loop* loop, DominatorTree& dom) {
  AllocaInst* counter = nullptr;
  bool steps = false;
  for (BasicBlock* block : loop->blocks())
    for (Instruction& i : *block) {
      if (!i.isVolatile()) continue;
      auto* a = dyn_cast_or_null<AllocaInst>(getLoadStorePointerOperand(&i));
      if (!a || (counter && a != counter) || !a->getAllocatedType()->isIntegerTy()) return nullptr;
      counter = a;
      auto* store = dyn_cast<StoreInst>(&i);
      if (!store) continue;
      auto* op = dyn_cast<BinaryOperator>(store->getValueOperand());
      if (steps || !op || op->getOpcode() != Instruction::Add || !isa<ConstantInt>(op->getOperand(1)))
        return nullptr;
      steps = true;
    }
  if (!steps || !is_idle(loop, dom, counter) ||
      loop->getHeader()->getParent()->callsFunctionThatReturnsTwice())
    return nullptr;
  for (User* u : counter->users()) {
    auto* access = cast<Instruction>(u);
    if (auto* pointer = dyn_cast<BitCastInst>(access)) {
      if (!onlyUsedByLifetimeMarkers(pointer)) return nullptr;
    } else if (getLoadStorePointerOperand(access) != counter ||
               getLoadStoreType(access) != counter->getAllocatedType() ||
               (isa<StoreInst>(access) && cast<StoreInst>(access)->getValueOperand() == counter)) {
      return nullptr;
    }
  }
  return counter;
}

double cycles_of(const FunctionCost& cost, const Loop* loop) {
  double cycles = 0;
  for (const Segment& s : cost.segments)
    if (loop->contains(s.first->getParent())) cycles += s.cycles();
  return cycles;
}

/// Puts one volatile counter into a register and nops into its loop for the time of the memory accesses.
bool free_counter(Unit& unit, Function& f, FunctionAnalysisManager& analyses) {
  auto& loops = analyses.getResult<LoopAnalysis>(f);
  auto& dom = analyses.getResult<DominatorTreeAnalysis>(f);
  for (Loop* loop : loops.getLoopsInPreorder()) {
    AllocaInst* counter = volatile_counter(loop, dom);
    if (!counter) continue;
    // other delays may use the same counter; a loop that works with it stays as it is
    std::map<BasicBlock*, double> before;
    FunctionCost cost(f, analyses, unit.options.level);
    bool only_delays = true;
    for (User* u : counter->users()) {
      Loop* around = loops.getLoopFor(cast<Instruction>(u)->getParent());
      if (!around || !around->getSubLoops().empty()) continue;
      if (volatile_counter(around, dom) == counter)
        before[around->getLoopLatch()] = cycles_of(cost, around);
      else
        only_delays = false;
    }
    if (!only_delays) continue;
    for (User* u : counter->users()) {
      if (auto* load = dyn_cast<LoadInst>(u)) load->setVolatile(false);
      if (auto* store = dyn_cast<StoreInst>(u)) store->setVolatile(false);
    }
    if (!isAllocaPromotable(counter)) return true;
    PromoteMemToReg(counter, dom);
    analyses.invalidate(f, PreservedAnalyses::none());
    FunctionCost without(f, analyses, unit.options.level);
    for (auto& [latch, cycles] : before) {
      IRBuilder<> b(latch->getTerminator());
      double missing = cycles - cycles_of(without, analyses.getResult<LoopAnalysis>(f).getLoopFor(latch));
      for (; missing >= 0.5; missing -= 1) b.CreateCall(marker(unit.module, kNop));
    }
    analyses.invalidate(f, PreservedAnalyses::none());
    return true;
  }
  return false;
}

bool lower(Unit& unit, Function& f, Loop* loop, ScalarEvolution& se, DominatorTree& dom, LoopInfo& loops,
           double cycles) {
  if (!is_idle(loop, dom)) return false;
  const SCEV* again = se.getBackedgeTakenCount(loop);
  if (isa<SCEVCouldNotCompute>(again)) return false;
  BasicBlock* exit = loop->getExitBlock();
  Loop* outside = loop->getParentLoop();
  Instruction* at = loop->getLoopPreheader()->getTerminator();
  SCEVExpander expander(se, unit.module.getDataLayout(), "delay");
  std::vector<std::pair<PHINode*, const SCEV*>> left_behind;
  for (PHINode& phi : exit->phis()) {
    Value* v = phi.getIncomingValueForBlock(loop->getLoopLatch());
    auto* i = dyn_cast<Instruction>(v);
    if (!i || !loop->contains(i)) continue;
    if (!se.isSCEVable(v->getType())) return false;
    const SCEV* last = se.getSCEVAtScope(v, outside);
    if (isa<SCEVCouldNotCompute>(last) || !se.isLoopInvariant(last, loop) || !isSafeToExpandAt(last, at, se))
      return false;
    left_behind.emplace_back(&phi, last);
  }
  if (!isSafeToExpandAt(again, at, se)) return false;
  // values used outside other than through a phi of the exit block: not in closed form
  for (BasicBlock* block : loop->blocks())
    for (Instruction& i : *block)
      for (User* u : i.users()) {
        auto* user = cast<Instruction>(u);
        if (!loop->contains(user) && user->getParent() != exit) return false;
        if (!loop->contains(user) && !isa<PHINode>(user)) return false;
      }
  DebugLoc where = loop->getStartLoc();
  Value* count = expander.expandCodeFor(again, again->getType(), at);
  for (auto& [phi, last] : left_behind) {
    Value* v = expander.expandCodeFor(last, phi->getType(), at);
    phi->setIncomingValueForBlock(loop->getLoopLatch(), v);
  }
  IRBuilder<> b(at);
  b.SetCurrentDebugLocation(where);
  Value* wide = b.CreateZExtOrTrunc(count, b.getInt64Ty());
  if (auto* i = dyn_cast<Instruction>(wide)) mark_free(i);
  Value* rounds = b.CreateAdd(wide, b.getInt64(1));
  if (auto* i = dyn_cast<Instruction>(rounds)) mark_free(i);
  for (Instruction* i : expander.getAllInsertedInstructions()) mark_free(i);
  auto delay = host_function(unit.module, "tp_delay", b.getVoidTy(), {b.getInt64Ty(), b.getInt64Ty()});
  b.CreateCall(delay, {rounds, b.getInt64(std::max<int64_t>(1, std::llround(cycles)))});
  expander.clear();
  se.forgetLoop(loop);
  deleteDeadLoop(loop, &dom, &se, &loops);
  return true;
}

}  // namespace

void lower_delay_loops(Unit& unit, FunctionAnalysisManager& analyses) {
  for (Function& f : unit.module) {
    if (f.isDeclaration()) continue;
    for (bool again = true; again;) {
      again = false;
      auto& loops = analyses.getResult<LoopAnalysis>(f);
      auto& dom = analyses.getResult<DominatorTreeAnalysis>(f);
      if (loops.empty()) break;
      for (Loop* loop : loops.getLoopsInPreorder()) formLCSSA(*loop, dom, &loops, nullptr);
      for (Loop* loop : loops.getLoopsInPreorder())
        simplifyLoop(loop, &dom, &loops, nullptr, nullptr, nullptr, true);
      analyses.invalidate(f, PreservedAnalyses::none());
      if (free_counter(unit, f, analyses)) {
        again = true;  // new values need their phis at the exit
        continue;
      }
      auto& fresh_loops = analyses.getResult<LoopAnalysis>(f);
      auto& fresh_dom = analyses.getResult<DominatorTreeAnalysis>(f);
      auto& se = analyses.getResult<ScalarEvolutionAnalysis>(f);
      FunctionCost cost(f, analyses, unit.options.level);
      for (Loop* loop : fresh_loops.getLoopsInPreorder()) {
        if (lower(unit, f, loop, se, fresh_dom, fresh_loops, cycles_of(cost, loop))) {
          again = true;
          break;
        }
      }
      analyses.invalidate(f, PreservedAnalyses::none());
    }
  }
}

}  // namespace cc
