// SPDX-License-Identifier: MIT
// Charges every segment to the budget, writes the function table, and counts lines for --coverage.
#include <cmath>
#include <map>

#include "cost_model.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/IR/MDBuilder.h"
#include "llvm/Support/FileSystem.h"
#include "llvm/Support/raw_ostream.h"
#include "llvm/Transforms/Utils/BasicBlockUtils.h"
#include "llvm/Transforms/Utils/ModuleUtils.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

Constant* text(Module& m, StringRef s) {
  IRBuilder<> b(m.getContext());
  auto* data = ConstantDataArray::getString(m.getContext(), s);
  auto* g = new GlobalVariable(m, data->getType(), true, GlobalValue::PrivateLinkage, data, "tp.text");
  g->setUnnamedAddr(GlobalValue::UnnamedAddr::Global);
  return ConstantExpr::getBitCast(g, b.getInt8PtrTy());
}

void add_to_section(Module& m, StringRef section, Constant* value, std::vector<GlobalValue*>& used) {
  auto* g = new GlobalVariable(m, value->getType(), false, GlobalValue::InternalLinkage, value, section + ".entry");
  g->setSection(section);
  g->setAlignment(Align(8));
  used.push_back(g);
}

/// budget -= cycles; if (budget < 0) tp_event();
void charge(Module& m, Instruction* before, int64_t cycles) {
  IRBuilder<> b(before);
  b.SetCurrentDebugLocation(before->getDebugLoc());
  Value* field = control_field(m, 0);
  Value* left = b.CreateSub(b.CreateAlignedLoad(b.getInt64Ty(), field, Align(8)), b.getInt64(cycles));
  b.CreateAlignedStore(left, field, Align(8));
  Value* spent = b.CreateICmpSLT(left, b.getInt64(0));
  auto* rarely = MDBuilder(m.getContext()).createBranchWeights(1, 100000);
  Instruction* then = SplitBlockAndInsertIfThen(spent, before, false, rarely);
  IRBuilder<> slow(then);
  slow.SetCurrentDebugLocation(before->getDebugLoc());
  auto event = host_function(m, "tp_image_event", b.getVoidTy(), {});
  auto* f = cast<Function>(event.getCallee());
  // saves every register itself, so the fast path keeps its values where they are
  f->setCallingConv(CallingConv::PreserveMost);
  f->setVisibility(GlobalValue::HiddenVisibility);
  slow.CreateCall(event)->setCallingConv(CallingConv::PreserveMost);
}

void count_lines(Function& f, std::vector<GlobalValue*>& used) {
  Module& m = *f.getParent();
  Type* i64 = Type::getInt64Ty(m.getContext());
  std::vector<BasicBlock*> blocks;
  for (BasicBlock& block : f) blocks.push_back(&block);
  for (BasicBlock* block : blocks) {
    std::map<unsigned, StringRef> lines;
    for (Instruction& i : *block)
      if (!isa<DbgInfoIntrinsic>(i) && !isa<PHINode>(i) && i.getDebugLoc() && i.getDebugLoc().getLine())
        lines.emplace(i.getDebugLoc().getLine(), cast<DIScope>(i.getDebugLoc().getScope())->getFilename());
    if (lines.empty()) continue;
    auto* counter = new GlobalVariable(m, i64, false, GlobalValue::InternalLinkage, ConstantInt::get(i64, 0), "tp.count");
    counter->setSection("tpcov");
    counter->setAlignment(Align(8));
    for (auto& [line, file] : lines) {
      Constant* fields[] = {text(m, file), ConstantInt::get(i64, line), counter};
      add_to_section(m, "tpcovmap", ConstantStruct::getAnon(fields), used);
    }
    IRBuilder<> b(&*block->getFirstInsertionPt());
    b.CreateAlignedStore(b.CreateAdd(b.CreateAlignedLoad(i64, counter, Align(8)), b.getInt64(1)), counter, Align(8));
  }
}

}  // namespace

void account(Unit& unit, FunctionAnalysisManager& analyses) {
  Module& m = unit.module;
  std::vector<GlobalValue*> used;
  std::vector<Function*> all;
  for (Function& f : m)
    if (!f.isDeclaration() && !f.getName().startswith("tp_image_") && !f.hasFnAttribute("tp-uncounted")) all.push_back(&f);
  std::vector<std::pair<Instruction*, double>> charges;
  std::unique_ptr<raw_fd_ostream> dump;
  std::error_code ec;
  if (!unit.options.cost_dump.empty()) dump = std::make_unique<raw_fd_ostream>(unit.options.cost_dump, ec);
  for (Function* f : all) {
    FunctionCost cost(*f, analyses, unit.options.level);
    double straight = 0;
    for (Segment& s : cost.segments) {
      charges.emplace_back(s.first, s.cycles());
      straight += s.cycles();
    }
    if (auto* where = f->getSubprogram()) {
      Type* i64 = Type::getInt64Ty(m.getContext());
      Constant* fields[] = {text(m, f->getName()), text(m, where->getFilename()), ConstantInt::get(i64, where->getLine()),
                            ConstantExpr::getBitCast(f, Type::getInt8PtrTy(m.getContext())), ConstantInt::get(i64, -1),
                            ConstantInt::get(i64, std::llround(straight))};
      add_to_section(m, "tpfunc", ConstantStruct::getAnon(fields), used);
    }
  }
  for (auto& [before, cycles] : charges)
    if (std::llround(cycles) > 0) charge(m, before, std::llround(cycles));
  if (unit.options.coverage)
    for (Function* f : all) count_lines(*f, used);
  if (!used.empty()) appendToCompilerUsed(m, used);
}

}  // namespace cc
