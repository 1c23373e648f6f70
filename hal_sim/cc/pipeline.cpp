// SPDX-License-Identifier: MIT
// The optimiser's passes in our own order. Everything that would turn a loop into something else (idioms,
// deletion, unrolling, vectors) is absent: the chip's compiler has none of it, and a delay loop must stay a
// delay.
#include "driver_arrays.h"
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/Analysis/TargetLibraryInfo.h"
#include "llvm/Analysis/TargetTransformInfo.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/Passes/PassBuilder.h"
#include "llvm/Support/CommandLine.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/Transforms/IPO/AlwaysInliner.h"
#include "llvm/Transforms/IPO/GlobalDCE.h"
#include "llvm/Transforms/IPO/Inliner.h"
#include "llvm/Transforms/InstCombine/InstCombine.h"
#include "llvm/Transforms/Scalar/ADCE.h"
#include "llvm/Transforms/Scalar/DeadStoreElimination.h"
#include "llvm/Transforms/Scalar/EarlyCSE.h"
#include "llvm/Transforms/Scalar/GVN.h"
#include "llvm/Transforms/Scalar/LICM.h"
#include "llvm/Transforms/Scalar/LoopPassManager.h"
#include "llvm/Transforms/Scalar/LoopRotation.h"
#include "llvm/Transforms/Scalar/Reassociate.h"
#include "llvm/Transforms/Scalar/SROA.h"
#include "llvm/Transforms/Utils/LCSSA.h"
#include "llvm/Transforms/Utils/LoopSimplify.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

void print_message(const Unit& unit, const char* kind, const DebugLoc& where, const Twine& text) {
  if (where) {
    auto* scope = cast<DIScope>(where.getScope());
    errs() << scope->getFilename() << ":" << where.getLine() << ":" << where.getCol() << ": ";
  } else {
    errs() << unit.options.input << ": ";
  }
  errs() << kind << ": " << text << "\n";
}

FunctionPassManager tidy() {
  FunctionPassManager f;
  f.addPass(SROAPass());
  f.addPass(EarlyCSEPass(true));
  f.addPass(PlainCfgPass());
  f.addPass(InstCombinePass());
  f.addPass(PlainCfgPass());
  return f;
}

FunctionPassManager loops(bool more) {
  FunctionPassManager f;
  f.addPass(SROAPass());
  f.addPass(EarlyCSEPass(true));
  f.addPass(InstCombinePass());
  f.addPass(PlainCfgPass());
  if (more) {
    f.addPass(GVNPass());
    f.addPass(DSEPass());
  }
  f.addPass(LoopSimplifyPass());
  f.addPass(LCSSAPass());
  LoopPassManager l;
  l.addPass(LoopRotatePass(/*EnableHeaderDuplication=*/true));
  l.addPass(LICMPass());
  f.addPass(createFunctionToLoopPassAdaptor(std::move(l), /*UseMemorySSA=*/true));
  f.addPass(EarlyCSEPass(true));
  f.addPass(InstCombinePass());
  f.addPass(ADCEPass());
  f.addPass(PlainCfgPass());
  return f;
}

/// Options that only exist as command-line flags of LLVM.
void set_llvm_flags() {
  const char* argv[] = {"twinpuck-cc", "-disable-auto-upgrade-debug-info=false"};
  cl::ParseCommandLineOptions(1, argv);
}

// In a loop without an exit every store to a global may be seen by an interrupt or a debugger, though the
// optimiser sees no reader. A call that might read anything keeps it from sinking stores to an exit that
// never comes.
constexpr const char* kObserve = "tp.observe";

void keep_endless_loops_visible(Unit& unit, FunctionAnalysisManager& analyses) {
  Module& m = unit.module;
  FunctionCallee observe = host_function(m, kObserve, Type::getVoidTy(m.getContext()), {});
  auto* function = cast<Function>(observe.getCallee());
  function->setOnlyReadsMemory();
  for (Function& f : m) {
    if (f.isDeclaration()) continue;
    for (Loop* loop : analyses.getResult<LoopAnalysis>(f).getLoopsInPreorder())
      if (loop->hasNoExitBlocks())
        mark_free(CallInst::Create(observe, "", &*loop->getHeader()->getFirstInsertionPt()));
    analyses.invalidate(f, PreservedAnalyses::none());
  }
  if (function->use_empty()) function->eraseFromParent();
}

void forget_endless_loops(Unit& unit) {
  Function* function = unit.module.getFunction(kObserve);
  if (!function) return;
  while (!function->use_empty()) cast<Instruction>(function->user_back())->eraseFromParent();
  function->eraseFromParent();
}

void make_weak(Unit& unit) {
  auto soften = [](GlobalValue& g) {
    if (!g.isDeclaration() && g.hasExternalLinkage() && !g.getName().startswith("tp_"))
      g.setLinkage(GlobalValue::WeakAnyLinkage);
  };
  for (Function& f : unit.module) soften(f);
  for (GlobalVariable& g : unit.module.globals()) soften(g);
}

}  // namespace

void Unit::error(const DebugLoc& where, const Twine& text) {
  print_message(*this, "error", where, text);
  failed = true;
}

void Unit::warning(const DebugLoc& where, const Twine& text) { print_message(*this, "warning", where, text); }

FunctionCallee host_function(Module& m, const char* name, Type* result, ArrayRef<Type*> parameters) {
  auto callee = m.getOrInsertFunction(name, FunctionType::get(result, parameters, false));
  if (auto* f = dyn_cast<Function>(callee.getCallee())) f->setDoesNotThrow();
  return callee;
}

void mark_free(Instruction* i) { i->setMetadata(kFree, MDNode::get(i->getContext(), {})); }

bool calls(const Instruction& i, StringRef name) {
  auto* call = dyn_cast<CallBase>(&i);
  auto* callee = call ? call->getCalledFunction() : nullptr;
  return callee && callee->getName() == name;
}

Value* control_field(Module& m, unsigned index) {
  auto& c = m.getContext();
  auto* type = StructType::get(Type::getInt64Ty(c), Type::getInt64Ty(c), Type::getInt64Ty(c));
  auto* g = m.getGlobalVariable("tp_ctl");
  if (!g) {
    g = new GlobalVariable(m, type, false, GlobalValue::ExternalLinkage, nullptr, "tp_ctl");
    g->setAlignment(Align(8));
    g->setVisibility(GlobalValue::HiddenVisibility);
    g->setDSOLocal(true);
  }
  Constant* zero = ConstantInt::get(Type::getInt32Ty(c), 0);
  auto* address = ConstantExpr::getBitCast(g, type->getPointerTo());
  return ConstantExpr::getInBoundsGetElementPtr(
      type, address, ArrayRef<Constant*>{zero, ConstantInt::get(Type::getInt32Ty(c), index)});
}

bool run_pipeline(Unit& unit) {
  set_llvm_flags();
  LoopAnalysisManager lam;
  FunctionAnalysisManager fam;
  CGSCCAnalysisManager cgam;
  ModuleAnalysisManager mam;
  PassBuilder pb;
  // no function of the C library may be "recognised": ours count cycles, and int has 16 bits
  fam.registerPass([&] {
    TargetLibraryInfoImpl impl(Triple(unit.module.getTargetTriple()));
    impl.disableAllFunctions();
    return TargetLibraryAnalysis(impl);
  });
  pb.registerModuleAnalyses(mam);
  pb.registerCGSCCAnalyses(cgam);
  pb.registerFunctionAnalyses(fam);
  pb.registerLoopAnalyses(lam);
  pb.crossRegisterProxies(lam, fam, cgam, mam);

  auto run = [&](ModulePassManager& passes) {
    mam.clear();
    fam.clear();
    cgam.clear();
    lam.clear();
    passes.run(unit.module, mam);
    fam.clear();
  };
  lower_early(unit);
  if (unit.failed) return false;
  refresh_driver_arrays(unit);
  bool optimise = unit.options.level > 0;
  if (optimise) {
    ModulePassManager first;
    first.addPass(createModuleToFunctionPassAdaptor(tidy()));
    run(first);
  }
  lower_registers(unit);
  if (unit.failed) return false;
  refresh_driver_arrays(unit);
  if (optimise) {
    keep_polled_flags(unit, fam);
    keep_endless_loops_visible(unit, fam);
    ModulePassManager second;
    // -O1 of gcc 4.5: functions called once and inline ones; -O2 small ones as well
    InlineParams inlining = getInlineParams(unit.options.level >= 2 ? 40 : 5);
    inlining.HintThreshold = 200;
    second.addPass(AlwaysInlinerPass());
    second.addPass(ModuleInlinerWrapperPass(inlining));
    second.addPass(createModuleToFunctionPassAdaptor(loops(unit.options.level >= 2)));
    second.addPass(GlobalDCEPass());
    run(second);
    forget_endless_loops(unit);
    keep_polled_flags(unit, fam);
    if (unit.options.cost_dump.empty()) lower_delay_loops(unit, fam);
    fam.clear();
  } else {
    ModulePassManager only;
    only.addPass(AlwaysInlinerPass());
    only.addPass(GlobalDCEPass());
    run(only);
  }
  if (!unit.options.uncounted) {
    CostPlan costs = plan_costs(unit, fam);
    fam.clear();
    instrument_polls(unit, fam);
    fam.clear();
    account(unit, costs);
  }
  fuse_registers(unit);
  lower_late(unit);
  if (unit.options.sanitize) check_addresses(unit);
  if (!unit.options.library && !unit.options.uncounted) fill_locals(unit);
  if (unit.options.library || unit.options.weak) make_weak(unit);
  return !unit.failed;
}

}  // namespace cc
