// SPDX-License-Identifier: MIT
// A unit's messages, and what the stages share.
#include "llvm/Analysis/LoopInfo.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/Dominators.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Support/Path.h"
#include "llvm/Support/raw_ostream.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

void print_message(const Unit& unit, const char* kind, const DebugLoc& where, const Twine& text) {
  if (where) {
    errs() << file_of(where) << ":" << where.getLine() << ":";
    if (where.getCol() > 0) errs() << where.getCol() << ":";
    errs() << " ";
  } else {
    errs() << unit.options.input << ": ";
  }
  errs() << kind << ": " << text << "\n";
}

/// A whole variable, local or global.
bool is_variable(const Value* pointer) { return isa<AllocaInst>(pointer) || isa<GlobalVariable>(pointer); }

}  // namespace

// clang names a file from the folder that it shares with the unit's
std::string file_of(const DebugLoc& where) {
  const auto* scope = cast<DILocalScope>(where.getScope());
  const StringRef name = scope->getFilename(), folder = scope->getDirectory();
  if (folder == scope->getSubprogram()->getUnit()->getDirectory() || sys::path::is_absolute(name))
    return name.str();
  SmallString<128> whole(folder);
  sys::path::append(whole, name);
  return whole.str().str();
}

void Unit::error(const DebugLoc& where, const Twine& text) {
  print_message(*this, "error", where, text);
  failed = true;
}

void Unit::warning(const DebugLoc& where, const Twine& text) { print_message(*this, "warning", where, text); }

void define_configuration(Unit& unit, function_ref<void(GlobalVariable&, StringRef)> dress) {
  for (const auto& [word, value] : unit.facts.configuration) {
    const std::string name = "tp_config_" + word;
    if (unit.module.getNamedGlobal(name)) continue;
    Type* type = Type::getInt16Ty(unit.module.getContext());
    dress(*new GlobalVariable(unit.module, type, true, GlobalValue::WeakAnyLinkage,
                              ConstantInt::get(type, value), name),
          word);
  }
}

void keep_empty_loops(Module& m, Function& mark) {
  for (Function& f : m) {
    if (f.isDeclaration()) continue;
    DominatorTree dom(f);
    LoopInfo loops(dom);
    for (Loop* loop : loops.getLoopsInPreorder()) {
      bool counts_only = loop->getSubLoops().empty() && loop->getLoopLatch();
      for (BasicBlock* block : loop->blocks())
        for (Instruction& i : *block) {
          if (auto* store = dyn_cast<StoreInst>(&i))
            counts_only &= is_variable(store->getPointerOperand()) && !store->isVolatile();
          else if (auto* load = dyn_cast<LoadInst>(&i))
            counts_only &= is_variable(load->getPointerOperand()) && !load->isVolatile();
          else if (isa<CallBase>(i) && !isa<DbgInfoIntrinsic>(i))
            counts_only = false;
        }
      if (!counts_only) continue;
      IRBuilder<> b(loop->getLoopLatch()->getTerminator());
      b.CreateCall(&mark);
    }
  }
}

}  // namespace cc
