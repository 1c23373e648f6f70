// SPDX-License-Identifier: MIT
// Loops that wait. Their back edge asks the host to jump the clock when a whole round changed nothing.
#include "driver_arrays.h"
#include "llvm/Analysis/CaptureTracking.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Support/MD5.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "passes.h"
#include "shared_variables.h"

namespace cc {

using namespace llvm;

namespace {

/// Builds instructions that exist on the PC only.
struct FreeBuilder : IRBuilder<ConstantFolder, IRBuilderCallbackInserter> {
  explicit FreeBuilder(Instruction* before)
      : IRBuilder(before->getContext(), ConstantFolder(),
                  IRBuilderCallbackInserter([](Instruction* i) { mark_free(i); })) {
    SetInsertPoint(before);
  }
};

bool harmless_call(const CallBase& call, const Unit& unit) {
  if (isa<DbgInfoIntrinsic>(call)) return true;
  if (auto* intrinsic = dyn_cast<IntrinsicInst>(&call))
    return !intrinsic->mayWriteToMemory() || intrinsic->isLifetimeStartOrEnd();
  const Function* callee = call.getCalledFunction();
  return callee && is_poll_safe(callee, unit);
}

/// A local variable nobody else can see.
bool is_private(const Value* pointer) {
  auto* a = dyn_cast<AllocaInst>(getUnderlyingObject(pointer));
  return a && !PointerMayBeCaptured(a, true, true);
}

bool safe_body(const Function& f, const Unit& unit, int depth) {
  if (f.isDeclaration() || depth > 8) return false;
  for (const Instruction& i : instructions(f)) {
    if (auto* store = dyn_cast<StoreInst>(&i)) {
      if (!is_private(store->getPointerOperand())) return false;
    } else if (auto* call = dyn_cast<CallBase>(&i)) {
      if (isa<IntrinsicInst>(call) ? !harmless_call(*call, unit) : false) return false;
      const Function* callee = call->getCalledFunction();
      if (!isa<IntrinsicInst>(call)) {
        if (!callee) return false;
        if (callee->isDeclaration() ? !is_poll_safe(callee, unit) : !safe_body(*callee, unit, depth + 1))
          return false;
      }
    } else if (i.mayWriteToMemory() && !isa<LoadInst>(i)) {
      return false;
    }
  }
  return true;
}

/// A loop whose end hangs on a plain variable and that changes no memory itself.
void keep_loop(Unit& unit, Loop* loop) {
  for (BasicBlock* block : loop->blocks())
    for (Instruction& i : *block) {
      if (isa<StoreInst>(i) || isa<AtomicRMWInst>(i)) return;
      if (auto* call = dyn_cast<CallBase>(&i))
        if (!harmless_call(*call, unit)) return;
    }
  SmallVector<BasicBlock*, 4> exits;
  loop->getExitingBlocks(exits);
  SmallVector<Value*, 8> work;
  SmallPtrSet<Value*, 16> seen;
  for (BasicBlock* block : exits) {
    Instruction* t = block->getTerminator();
    if (auto* br = dyn_cast<BranchInst>(t)) work.push_back(br->getCondition());
    if (auto* sw = dyn_cast<SwitchInst>(t)) work.push_back(sw->getCondition());
  }
  while (!work.empty()) {
    auto* i = dyn_cast<Instruction>(work.pop_back_val());
    if (!i || !loop->contains(i) || !seen.insert(i).second) continue;
    if (auto* load = dyn_cast<LoadInst>(i)) {
      auto* g = dyn_cast<GlobalVariable>(getUnderlyingObject(load->getPointerOperand()));
      if (g && !g->isConstant() && !load->isVolatile()) {
        load->setVolatile(true);
        if (unit.options.lint || unit.options.strict)
          unit.warning(load->getDebugLoc(),
                       name_in_c(g->getName().str()) +
                           ": polled in a loop; got a plain variable, expected volatile; "
                           "XC16 reads it once at -O1 and waits for ever");
      }
    }
    for (Value* v : i->operands()) work.push_back(v);
  }
}

struct BackEdge {
  Instruction* terminator;  // of the block on the edge back to the header
  Value* same;              // nothing changed in this round
  Value* id;
  bool rests;  // the loop has no end and nothing in it
};

/// `while (1);`: not even a question.
bool rests(const Loop* loop, const Unit& unit) {
  if (!loop->hasNoExitBlocks() || unit.options.coverage) return false;
  for (const BasicBlock* block : loop->blocks())
    for (const Instruction& i : *block) {
      const auto* branch = dyn_cast<BranchInst>(&i);
      if (!isa<DbgInfoIntrinsic>(i) && !calls(i, kNop) && !calls(i, kRound) &&
          !(branch && branch->isUnconditional()))
        return false;
    }
  return true;
}

bool waits(Loop* loop, DominatorTree& dom, const Unit& unit) {
  BasicBlock* latch = loop->getLoopLatch();
  bool looks = true, reads = false;
  for (BasicBlock* block : loop->blocks())
    for (Instruction& i : *block) {
      if (auto* load = dyn_cast<LoadInst>(&i)) {
        if (load->isVolatile() || isa<GlobalVariable>(getUnderlyingObject(load->getPointerOperand())))
          reads = true;
      } else if (auto* call = dyn_cast<CallBase>(&i)) {
        if (isa<DbgInfoIntrinsic>(call)) continue;
        if (!harmless_call(*call, unit) && !isa<IntrinsicInst>(call)) {
          // certain to happen each round: the round never changes nothing
          if (dom.dominates(block, latch)) looks = false;
        } else if (!isa<IntrinsicInst>(call) && !calls(i, kNop) && !calls(i, kRound)) {
          reads = true;
        }
      }
    }
  return looks && (reads || loop->getExitBlock() == nullptr);
}

void bump_writes(Module& m, FreeBuilder& b, Value* amount) {
  Value* field = control_field(m, 1);
  b.CreateAlignedStore(b.CreateAdd(b.CreateAlignedLoad(b.getInt64Ty(), field, Align(8)), amount), field,
                       Align(8));
}

void instrument(Unit& unit, Function& f, Loop* loop, DominatorTree& dom, int ordinal,
                SmallPtrSetImpl<Instruction*>& marked, std::vector<BackEdge>& back_edges) {
  Module& m = unit.module;
  for (BasicBlock* block : loop->blocks())
    for (Instruction& i : make_early_inc_range(*block)) {
      if (!marked.insert(&i).second) continue;
      if (auto* store = dyn_cast<StoreInst>(&i)) {
        if (is_free(i)) continue;
        FreeBuilder b(store);
        Value* value = store->getValueOperand();
        if (!store->isVolatile() && (value->getType()->isIntegerTy() || value->getType()->isPointerTy())) {
          // storing what is there already changes nothing
          auto* before = b.CreateAlignedLoad(value->getType(), store->getPointerOperand(), store->getAlign());
          bump_writes(m, b, b.CreateZExt(b.CreateICmpNE(before, value), b.getInt64Ty()));
        } else {
          bump_writes(m, b, b.getInt64(1));
        }
      } else if (auto* call = dyn_cast<CallBase>(&i)) {
        bool harmless = harmless_call(*call, unit) || (isa<IntrinsicInst>(call) && !call->mayWriteToMemory());
        if (harmless || calls(i, "tp_trap") || calls(i, "tp_poll") || calls(i, "tp_rest")) continue;
        FreeBuilder b(call);
        bump_writes(m, b, b.getInt64(1));
      }
    }
  const bool resting = rests(loop, unit);
  // the count at the start of this round against the count at its end
  BasicBlock* header = loop->getHeader();
  FreeBuilder start(&*header->getFirstInsertionPt());
  auto* before =
      start.CreateAlignedLoad(start.getInt64Ty(), control_field(m, 1), Align(8), /*volatile*/ true);
  BasicBlock* latch = loop->getLoopLatch();
  // only when there is a next round: on the edge back to the header
  BasicBlock* edge = SplitEdge(latch, header);
  mark_free(edge->getTerminator());
  FreeBuilder b(edge->getTerminator());
  auto* after = b.CreateAlignedLoad(b.getInt64Ty(), control_field(m, 1), Align(8), true);
  Value* same = b.CreateICmpEQ(before, after);
  for (PHINode& phi : header->phis()) {
    Value* next = phi.getIncomingValueForBlock(edge);
    if (next == &phi) continue;
    Value* old = &phi;
    if (next->getType()->isFloatingPointTy()) {
      Type* bits = b.getIntNTy(next->getType()->getPrimitiveSizeInBits());
      old = b.CreateBitCast(old, bits), next = b.CreateBitCast(next, bits);
    } else if (!next->getType()->isIntegerTy() && !next->getType()->isPointerTy()) {
      same = b.getFalse();
      break;
    }
    same = b.CreateAnd(same, b.CreateICmpEQ(old, next));
  }
  MD5 hash;
  hash.update(m.getSourceFileName() + ":" + f.getName().str() + ":" + std::to_string(ordinal));
  MD5::MD5Result result;
  hash.final(result);
  Value* id = b.getInt64(result.low() >> 1);
  back_edges.push_back({edge->getTerminator(), same, id, resting});
}

}  // namespace

bool is_poll_safe(const Function* callee, const Unit& unit) {
  StringRef name = callee->getName();
  if (name == kNop || name == kRound || name == "tp_sfr_read" || name == "tp_delay") return true;
  if (name.startswith(kRefresher)) return true;  // brings up to date what an interrupt has written
  if (unit.facts.poll_safe.count(name.str())) return true;
  return !callee->isDeclaration() && !callee->isInterposable() && safe_body(*callee, unit, 0);
}

void keep_polled_flags(Unit& unit, FunctionAnalysisManager& analyses) {
  for (Function& f : unit.module) {
    if (f.isDeclaration()) continue;
    auto& loops = analyses.getResult<LoopAnalysis>(f);
    for (Loop* loop : loops.getLoopsInPreorder()) keep_loop(unit, loop);
  }
}

void instrument_polls(Unit& unit, FunctionAnalysisManager& analyses) {
  for (Function& f : unit.module) {
    if (f.isDeclaration() || f.getName().startswith("tp_image_")) continue;
    auto& loops = analyses.getResult<LoopAnalysis>(f);
    auto& dom = analyses.getResult<DominatorTreeAnalysis>(f);
    SmallPtrSet<Instruction*, 32> marked;
    std::vector<BackEdge> back_edges;
    int ordinal = 0;
    std::vector<Loop*> chosen;
    for (Loop* loop : loops.getLoopsInPreorder())
      if (loop->getLoopLatch() && waits(loop, dom, unit)) chosen.push_back(loop);
    for (Loop* loop : chosen) instrument(unit, f, loop, dom, ordinal++, marked, back_edges);
    for (auto& [terminator, same, id, rests] : back_edges) {
      Instruction* then = SplitBlockAndInsertIfThen(same, terminator, false);
      mark_free(then->getParent()->getSinglePredecessor()->getTerminator());
      mark_free(then);
      IRBuilder<> b(then);
      b.SetCurrentDebugLocation(terminator->getDebugLoc());
      const char* name = rests ? "tp_rest" : "tp_poll";
      auto* call = b.CreateCall(host_function(unit.module, name, b.getVoidTy(), {b.getInt64Ty()}), {id});
      mark_free(call);
    }
  }
}

}  // namespace cc
