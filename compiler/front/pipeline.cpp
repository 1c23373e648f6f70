// SPDX-License-Identifier: MIT
// The optimiser's passes for the chip, in our own order. Absent is what costs more here than it brings:
// merging the stores of two branches (they are single BSET and BCLR), turning branches into selects (the chip
// has none), unrolling.
#include "chip.h"
#include "llvm/Analysis/TargetLibraryInfo.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/PatternMatch.h"
#include "llvm/Passes/PassBuilder.h"
#include "llvm/Support/CommandLine.h"
#include "llvm/Target/TargetMachine.h"
#include "llvm/Transforms/IPO/AlwaysInliner.h"
#include "llvm/Transforms/IPO/GlobalDCE.h"
#include "llvm/Transforms/IPO/GlobalOpt.h"
#include "llvm/Transforms/IPO/Inliner.h"
#include "llvm/Transforms/IPO/SCCP.h"
#include "llvm/Transforms/InstCombine/InstCombine.h"
#include "llvm/Transforms/Scalar/ADCE.h"
#include "llvm/Transforms/Scalar/DeadStoreElimination.h"
#include "llvm/Transforms/Scalar/EarlyCSE.h"
#include "llvm/Transforms/Scalar/GVN.h"
#include "llvm/Transforms/Scalar/IndVarSimplify.h"
#include "llvm/Transforms/Scalar/LICM.h"
#include "llvm/Transforms/Scalar/LoopPassManager.h"
#include "llvm/Transforms/Scalar/LoopRotation.h"
#include "llvm/Transforms/Scalar/LoopUnrollPass.h"
#include "llvm/Transforms/Scalar/SROA.h"
#include "llvm/Transforms/Scalar/Scalarizer.h"
#include "llvm/Transforms/Utils/EntryExitInstrumenter.h"
#include "llvm/Transforms/Utils/LCSSA.h"
#include "llvm/Transforms/Utils/LoopSimplify.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// The inliner copies a struct passed by value as if its bytes lay anywhere; a struct that is not packed lies
/// at an even address, and is copied by words.
struct AlignCopiesPass : PassInfoMixin<AlignCopiesPass> {
  PreservedAnalyses run(Function& f, FunctionAnalysisManager&) {
    const DataLayout& layout = f.getParent()->getDataLayout();
    for (Instruction& i : instructions(f)) {
      auto* copy = dyn_cast<MemCpyInst>(&i);
      auto* to = copy ? dyn_cast<AllocaInst>(copy->getRawDest()->stripPointerCasts()) : nullptr;
      auto* bytes = copy ? dyn_cast<ConstantInt>(copy->getLength()) : nullptr;
      if (!to || !bytes || copy->getRawSource()->stripPointerCasts()->getType() != to->getType()) continue;
      Type* type = to->getAllocatedType();
      if (!type->isStructTy() || bytes->getZExtValue() != layout.getTypeAllocSize(type)) continue;
      copy->setSourceAlignment(std::max(copy->getSourceAlign().valueOrOne(), layout.getABITypeAlign(type)));
      copy->setDestAlignment(std::max(copy->getDestAlign().valueOrOne(), to->getAlign()));
    }
    return PreservedAnalyses::all();
  }
};

/// LATAbits.LATA6 ^= 1 reads the register twice, once for the bit and once for the rest, and writes it. Where
/// nothing lies between, one reading serves both, and all of it becomes one BTG.
struct MergeFieldReadsPass : PassInfoMixin<MergeFieldReadsPass> {
  PreservedAnalyses run(Function& f, FunctionAnalysisManager&) {
    LoadInst* last = nullptr;
    SmallVector<LoadInst*, 4> merged;
    for (Instruction& i : instructions(f)) {
      auto* load = dyn_cast<LoadInst>(&i);
      const bool same = load && last && load->getParent() == last->getParent() && load->isVolatile() &&
                        load->getPointerOperand() == last->getPointerOperand() &&
                        load->getType() == last->getType() && is_modified(*load, *last);
      if (same) {
        load->replaceAllUsesWith(last);
        merged.push_back(load);
      } else if (load && load->isVolatile()) {
        last = load;
      } else if (i.mayReadOrWriteMemory() && !isa<DbgInfoIntrinsic>(i)) {
        last = nullptr;
      }
    }
    for (LoadInst* load : merged) load->eraseFromParent();
    return merged.empty() ? PreservedAnalyses::all() : PreservedAnalyses::none();
  }

 private:
  /// The next access is the store of a value made of both readings, each masked to bits the
  /// other does not take.
  static bool is_modified(LoadInst& rest, LoadInst& bit) {
    using namespace PatternMatch;
    for (Instruction* i = rest.getNextNode(); i; i = i->getNextNode()) {
      if (!i->mayReadOrWriteMemory() || isa<DbgInfoIntrinsic>(i)) continue;
      auto* store = dyn_cast<StoreInst>(i);
      if (!store || store->getPointerOperand() != rest.getPointerOperand()) return false;
      Value* value = store->getValueOperand();
      const APInt *toggled, *kept;
      match(value,
            m_Xor(m_Value(value), m_APInt(toggled)));  // the toggled bits, if instcombine moved them out
      Value *a, *b;
      if (!match(value, m_Or(m_Value(a), m_Value(b)))) return false;
      const auto is_rest = [&](Value* v) { return match(v, m_And(m_Specific(&rest), m_APInt(kept))); };
      return (is_rest(a) || is_rest(b)) && comes_from(is_rest(a) ? b : a, bit);
    }
    return false;
  }
  static bool comes_from(Value* v, LoadInst& load) {
    constexpr int kLongestChain = 6;  // shifts and masks of one field
    for (int n = 0; n < kLongestChain; ++n) {
      if (v == &load) return true;
      auto* i = dyn_cast<Instruction>(v);
      if (!i || !(isa<BinaryOperator>(i) || isa<CastInst>(i)) ||
          (i->getNumOperands() == 2 && !isa<Constant>(i->getOperand(1))))
        return false;
      v = i->getOperand(0);
    }
    return false;
  }
};

/// Values and control flow made plain; with `memory` loads and stores as well.
void add_tidying(FunctionPassManager& passes, bool memory) {
  passes.addPass(SROAPass());
  passes.addPass(KeepDivisionsPass());
  passes.addPass(KeepConstantStoresPass());
  passes.addPass(EarlyCSEPass(true));
  passes.addPass(PlainCfgPass());
  passes.addPass(InstCombinePass());
  passes.addPass(PlainCfgPass());
  if (!memory) return;
  passes.addPass(GVNPass());
  passes.addPass(DSEPass());
}

void add_loops(FunctionPassManager& passes) {
  constexpr int kUnrollCheapest = 1;
  passes.addPass(LoopSimplifyPass());
  passes.addPass(LCSSAPass());
  LoopPassManager shape, unroll;
  shape.addPass(LoopRotatePass());
  shape.addPass(KeepEndlessStoresPass());
  shape.addPass(LICMPass());
  shape.addPass(IndVarSimplifyPass());
  passes.addPass(createFunctionToLoopPassAdaptor(std::move(shape), /*UseMemorySSA=*/true));
  passes.addPass(FreeEndlessStoresPass());
  unroll.addPass(LoopFullUnrollPass(kUnrollCheapest));
  passes.addPass(createFunctionToLoopPassAdaptor(std::move(unroll), /*UseMemorySSA=*/false));
}

ModulePassManager passes_for(const Options& options) {
  constexpr int kInlineFew = 10, kInlineMore = 60;  // thresholds of LLVM's inliner, about instructions x 5
  ModulePassManager m;
  m.addPass(createModuleToFunctionPassAdaptor(EntryExitInstrumenterPass(/*PostInlining=*/false)));
  m.addPass(AlwaysInlinerPass());
  m.addPass(createModuleToFunctionPassAdaptor(ScalarizerPass()));  // the chip has no vectors
  if (options.level == 0) {
    m.addPass(createModuleToFunctionPassAdaptor(KeepPlainDivisionsPass()));
    return m;
  }
  // Before functions are inlined: what the loops of XC16 tell, and plain tidying.
  FunctionPassManager first, second;
  if (options.level == 1) {
    // before anything is moved: the form of a loop says what XC16 makes of it
    first.addPass(SROAPass());
    first.addPass(LoopSimplifyPass());
    first.addPass(DelayRoundsPass());
  }
  add_tidying(first, false);
  first.addPass(MergeFieldReadsPass());
  m.addPass(createModuleToFunctionPassAdaptor(std::move(first)));
  // Inlining, and what it shows across functions.
  const bool more = options.level >= 2 && !options.for_size;
  m.addPass(KeepZeroArgumentsPass());
  m.addPass(ModuleInlinerWrapperPass(getInlineParams(more ? kInlineMore : kInlineFew)));
  m.addPass(GlobalOptPass());
  m.addPass(IPSCCPPass());
  // Behind it: copies, loops, and tidying once more; last the loops that count down.
  second.addPass(AlignCopiesPass());
  add_tidying(second, true);
  add_loops(second);
  add_tidying(second, true);
  second.addPass(ADCEPass());
  second.addPass(PlainCfgPass());
  second.addPass(LoopSimplifyPass());
  second.addPass(CountDownPass());
  m.addPass(createModuleToFunctionPassAdaptor(std::move(second)));
  m.addPass(GlobalDCEPass());
  return m;
}

}  // namespace

void optimise_for_chip(Unit& unit, TargetMachine& machine) {
  LoopAnalysisManager lam;
  FunctionAnalysisManager fam;
  CGSCCAnalysisManager cgam;
  ModuleAnalysisManager mam;
  PipelineTuningOptions tuning;
  tuning.LoopUnrolling = tuning.LoopInterleaving = tuning.LoopVectorization = tuning.SLPVectorization = false;
  PassBuilder builder(&machine, tuning);
  // no function of the C library may be "recognised": programs have their own, and int has 16 bits
  fam.registerPass([&] {
    TargetLibraryInfoImpl library(Triple(unit.module.getTargetTriple()));
    library.disableAllFunctions();
    return TargetLibraryAnalysis(library);
  });
  builder.registerModuleAnalyses(mam);
  builder.registerCGSCCAnalyses(cgam);
  builder.registerFunctionAnalyses(fam);
  builder.registerLoopAnalyses(lam);
  builder.crossRegisterProxies(lam, fam, cgam, mam);
  passes_for(unit.options).run(unit.module, mam);
}

}  // namespace cc
