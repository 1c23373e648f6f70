// SPDX-License-Identifier: MIT
// Loops that only count, which programs wait by, take as many cycles a round as XC16's.
//
// -O1: each becomes a counter that goes down to 0, 3 cycles a round or 4 with a long, and NOPs stand for the
// comparison where XC16 makes one. -O0: NOPs stand for what XC16 computes with the value of n-- before it
// asks it. Which loops those are was read off what gcc 4.5.1 with XC16's sources makes of them; the rounds
// are those of tests/chip_cc/delay_test.cpp.
#include "chip.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ScalarEvolution.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InlineAsm.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Transforms/Utils/Local.h"
#include "llvm/Transforms/Utils/ScalarEvolutionExpander.h"
#include "passes.h"

namespace cc {

using namespace llvm;

Value* without_casts(Value* v) {
  while (auto* c = dyn_cast<CastInst>(v)) v = c->getOperand(0);
  return v;
}

namespace {

void wait_before(Instruction* at, unsigned cycles) {
  IRBuilder<> b(at);
  auto* type = FunctionType::get(b.getVoidTy(), false);
  for (; cycles; --cycles) b.CreateCall(type, InlineAsm::get(type, "nop", "", /*hasSideEffects=*/true));
}

/// A loop that does nothing but count by one and ask for its end.
struct Delay {
  PHINode* count = nullptr;
  BinaryOperator* next = nullptr;
  ICmpInst* test = nullptr;
  BasicBlock *before, *header, *latch, *asks;
  Value *start, *bound;
  CmpInst::Predicate goes_on;  // count or next, and bound
  bool asks_next, has_text = false, is_counted_before_text = false;
  SmallVector<LoadInst*, 2> loads;  // of bounds
  bool keeps_memory = true;
};

/// Notes an instruction; false: the loop does more than count.
bool note(Instruction& i, Delay& d) {
  if (isa<DbgInfoIntrinsic>(i) || isa<BranchInst>(i) || isa<CastInst>(i)) return true;
  if (auto* call = dyn_cast<CallInst>(&i)) {
    if (call->getIntrinsicID() == Intrinsic::sideeffect) return true;
    auto* text = dyn_cast<InlineAsm>(call->getCalledOperand());
    if (!text || call->arg_size() || !call->getType()->isVoidTy()) return false;
    d.has_text = true;
    d.is_counted_before_text |= d.next && d.next->getParent() == i.getParent() && d.next->comesBefore(&i);
    d.keeps_memory &= !StringRef(text->getConstraintString()).contains("~{memory}");
    return true;
  }
  if (auto* phi = dyn_cast<PHINode>(&i)) {
    if (d.count) return false;
    d.count = phi;
    return phi->getType()->isIntegerTy();
  }
  if (auto* load = dyn_cast<LoadInst>(&i)) {
    d.loads.push_back(load);
    return !load->isVolatile() && isa<GlobalVariable>(load->getPointerOperand());
  }
  if (auto* sum = dyn_cast<BinaryOperator>(&i)) return sum == d.next;
  if (auto* test = dyn_cast<ICmpInst>(&i)) {
    if (d.test) return false;
    d.test = test;
    return true;
  }
  return false;
}

bool find_delay(Loop& loop, Delay& d) {
  d.before = loop.getLoopPreheader(), d.header = loop.getHeader(), d.latch = loop.getLoopLatch();
  d.asks = loop.getExitingBlock();
  if (!loop.isInnermost() || !d.before || !d.latch || !d.asks) return false;
  auto* branch = dyn_cast<BranchInst>(d.asks->getTerminator());
  if (!branch || !branch->isConditional() || d.header->phis().empty()) return false;
  d.next = dyn_cast<BinaryOperator>(d.header->phis().begin()->getIncomingValueForBlock(d.latch));
  if (!d.next || d.next->getOpcode() != Instruction::Add) return false;
  for (BasicBlock* block : loop.blocks())
    for (Instruction& i : *block)
      if (!note(i, d)) return false;
  auto* step = dyn_cast<ConstantInt>(d.next->getOperand(1));
  if (!d.count || d.test != branch->getCondition() || d.next->getOperand(0) != d.count || !step ||
      !(step->isOne() || step->isMinusOne()))
    return false;
  d.start = d.count->getIncomingValueForBlock(d.before);
  d.goes_on = d.test->getPredicate();
  Value* asked = without_casts(d.test->getOperand(0));
  d.bound = d.test->getOperand(1);
  if (asked != d.count && asked != d.next) {
    asked = without_casts(d.test->getOperand(1));
    d.bound = d.test->getOperand(0);
    d.goes_on = d.test->getSwappedPredicate();
  }
  if (asked != d.count && asked != d.next) return false;
  if (!loop.contains(branch->getSuccessor(0))) d.goes_on = CmpInst::getInversePredicate(d.goes_on);
  d.asks_next = asked == d.next;
  return true;
}

/// Cycles a round beside those of the counter.
unsigned cycles_of_comparison(const Delay& d) {
  const unsigned compare = d.count->getType()->isIntegerTy(32) ? 2 : 1;
  const auto* bound = dyn_cast<ConstantInt>(d.bound);
  const bool is_down_to_0 =
      bound && bound->isZero() && cast<ConstantInt>(d.next->getOperand(1))->isMinusOne();
  const bool asks_zero = is_down_to_0 && d.goes_on == CmpInst::ICMP_NE;
  const bool asks_above = is_down_to_0 && (d.goes_on == CmpInst::ICMP_SGT || d.goes_on == CmpInst::ICMP_UGT);
  // while (n--): gone on from the value before
  if (!d.asks_next && d.next->getParent() == d.asks) {
    if (d.has_text) return asks_zero ? 0 : compare;
    return asks_zero || isa<Constant>(d.start) ? compare : compare + 1;
  }
  if (isa<Constant>(d.start) && bound && !(d.asks_next && is_down_to_0 && !asks_zero && !asks_above))
    return d.is_counted_before_text ? compare : 0;
  if (!asks_zero && !asks_above) return compare;
  // while (--n > 0): XC16 clears the flag of an overflow
  if (d.asks_next && asks_above && d.asks == d.header && !d.has_text) return compare;
  return d.is_counted_before_text ? compare : 0;
}

/// The counter becomes one that goes down to 0. False: how often is not known before the loop.
bool count_rounds_down(Loop& loop, Delay& d, ScalarEvolution& evolution) {
  // Nobody may look at the counter behind the loop.
  for (Instruction* i : {static_cast<Instruction*>(d.count), static_cast<Instruction*>(d.next)})
    for (User* u : i->users())
      if (!loop.contains(cast<Instruction>(u))) return false;
  for (LoadInst* load : d.loads)
    if (d.keeps_memory) load->moveBefore(d.before->getTerminator());
  // How often the loop goes round.
  evolution.forgetLoop(&loop);
  const SCEV* rounds = evolution.getExitCount(&loop, d.asks);
  // from n down to 0: the larger of both, and not what LLVM takes from n
  auto* bound = dyn_cast<ConstantInt>(d.bound);
  if (d.goes_on == CmpInst::ICMP_SGT && bound && bound->isZero() && !d.asks_next && !isa<Constant>(d.start) &&
      d.start->getType() == d.bound->getType() && cast<ConstantInt>(d.next->getOperand(1))->isMinusOne())
    rounds = evolution.getSMaxExpr(evolution.getSCEV(d.start), evolution.getZero(d.start->getType()));
  if (isa<SCEVCouldNotCompute>(rounds) || !isSafeToExpand(rounds, evolution)) return false;
  auto& context = d.header->getContext();
  auto* type = evolution.getTypeSizeInBits(rounds->getType()) > 16 ? Type::getInt32Ty(context)
                                                                   : Type::getInt16Ty(context);
  if (evolution.getTypeSizeInBits(rounds->getType()) > 32) return false;
  // That number is worked out before the loop, and counted down to 0 in it.
  SCEVExpander expander(evolution, d.header->getModule()->getDataLayout(), "rounds");
  Value* all =
      expander.expandCodeFor(evolution.getZeroExtendExpr(rounds, type), type, d.before->getTerminator());
  auto* branch = cast<BranchInst>(d.asks->getTerminator());
  const bool stays = loop.contains(branch->getSuccessor(0));
  IRBuilder<> b(d.count);
  auto* left = b.CreatePHI(type, 2);
  b.SetInsertPoint(branch);
  branch->setCondition(
      b.CreateICmp(stays ? CmpInst::ICMP_NE : CmpInst::ICMP_EQ, left, ConstantInt::get(type, 0)));
  b.SetInsertPoint(d.latch->getTerminator());
  left->addIncoming(all, d.before);
  left->addIncoming(b.CreateAdd(left, ConstantInt::getSigned(type, -1)), d.latch);
  // the old counter goes
  RecursivelyDeleteTriviallyDeadInstructions(d.test);
  RecursivelyDeleteDeadPHINode(d.count);
  return true;
}

bool shape(Loop& loop, ScalarEvolution& evolution) {
  Delay d;
  if (!find_delay(loop, d)) return false;
  const unsigned cycles = cycles_of_comparison(d);
  // do ... while: a counter already, with a comparison of its own where it asks for more than 0
  const bool asks_at_end = d.asks == d.latch;
  if (asks_at_end ? !CmpInst::isEquality(d.goes_on) : !count_rounds_down(loop, d, evolution)) return false;
  wait_before(d.latch->getTerminator(), cycles);
  return true;
}

/// n-- of a loop's test, whose value before is asked: the load, and its store.
LoadInst* counted_in_test(BranchInst& branch, const ICmpInst*& test) {
  test = branch.isConditional() ? dyn_cast<ICmpInst>(branch.getCondition()) : nullptr;
  auto* zero = test ? dyn_cast<ConstantInt>(test->getOperand(1)) : nullptr;
  auto* load = zero && zero->isZero() ? dyn_cast<LoadInst>(without_casts(test->getOperand(0))) : nullptr;
  if (!load || load->getParent() != branch.getParent()) return nullptr;
  for (const User* u : load->users()) {
    auto* sum = dyn_cast<BinaryOperator>(u);
    auto* step =
        sum && sum->getOpcode() == Instruction::Add ? dyn_cast<ConstantInt>(sum->getOperand(1)) : nullptr;
    if (!step || !step->isMinusOne() || !sum->hasOneUse()) continue;
    auto* store = dyn_cast<StoreInst>(sum->user_back());
    if (store && store->getPointerOperand() == load->getPointerOperand() &&
        store->getParent() == branch.getParent())
      return load;
  }
  return nullptr;
}

}  // namespace

PreservedAnalyses DelayRoundsPass::run(Function& f, FunctionAnalysisManager& analyses) {
  auto& evolution = analyses.getResult<ScalarEvolutionAnalysis>(f);
  bool changed = false;
  for (Loop* loop : analyses.getResult<LoopAnalysis>(f).getLoopsInPreorder())
    changed |= shape(*loop, evolution);
  return changed ? PreservedAnalyses::none() : PreservedAnalyses::all();
}

void wait_as_unoptimised(Module& m) {
  // cycles that XC16's code of such a test takes beyond a load, a subtraction, a store and a comparison
  constexpr unsigned kOfInt = 4, kOfChar = 1, kAboveZero = 3, kOfLong = 4;
  for (Function& f : m) {
    if (f.isDeclaration()) continue;
    DominatorTree dominators(f);
    LoopInfo loops(dominators);
    for (BasicBlock& block : f) {
      const ICmpInst* test = nullptr;
      auto* branch = dyn_cast<BranchInst>(block.getTerminator());
      LoadInst* load = branch && loops.getLoopFor(&block) ? counted_in_test(*branch, test) : nullptr;
      if (!load) continue;
      const bool is_zero = test->isEquality();
      wait_before(branch, load->getType()->isIntegerTy(32)  ? kOfLong
                          : load->getType()->isIntegerTy(8) ? kOfChar
                          : is_zero                         ? kOfInt
                                                            : kAboveZero);
    }
  }
}

void place_locals_first(Module& m) {
  for (Function& f : m) {
    if (f.isDeclaration()) continue;
    // a parameter's place is what its value is stored to
    SmallVector<AllocaInst*, 8> of_parameters;
    for (Argument& a : f.args())
      for (User* u : a.users())
        if (auto* store = dyn_cast<StoreInst>(u); store && store->getValueOperand() == &a)
          if (auto* place = dyn_cast<AllocaInst>(store->getPointerOperand());
              place && place->isStaticAlloca())
            of_parameters.push_back(place);
    Instruction* behind = nullptr;
    for (Instruction& i : f.getEntryBlock()) {
      if (!isa<AllocaInst>(i)) break;
      behind = &i;
    }
    for (AllocaInst* place : of_parameters)
      if (place != behind && behind) {
        place->moveAfter(behind);
        behind = place;
      }
  }
}

}  // namespace cc
