// SPDX-License-Identifier: MIT
// --sanitize: local variables that can be missed, or read before they are written, stay in memory with
// a gap on both sides, and are told when they come into being; clang's checks of 16-bit arithmetic
// call functions without arguments, whose place says all. What is looked at, and how, is no affair of
// the program's (dspic30/core/memory_check.h).

#include "chip.h"
#include "dspic30/memory/host_places.h"
#include "llvm/IR/DIBuilder.h"
#include "llvm/IR/DebugInfo.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Transforms/Utils/Local.h"
#include "passes.h"

namespace cc {

using namespace llvm;

namespace {

/// Only ever loaded and stored as a whole: its address goes nowhere.
bool is_plain_local(const AllocaInst& local) {
  if (!local.getAllocatedType()->isSingleValueType()) return false;
  for (const User* user : local.users()) {
    const auto* store = dyn_cast<StoreInst>(user);
    if (!isa<LoadInst>(user) && !(store && store->getValueOperand() != &local)) return false;
  }
  return true;
}

/// Is there a way to a load of it round all stores?
bool may_be_read_first(AllocaInst& local) {
  enum class First { None, Load, Store };
  const auto first_in = [&](BasicBlock& block) {
    for (Instruction& i : block) {
      if (auto* load = dyn_cast<LoadInst>(&i); load && load->getPointerOperand() == &local)
        return First::Load;
      if (auto* store = dyn_cast<StoreInst>(&i); store && store->getPointerOperand() == &local)
        return First::Store;
    }
    return First::None;
  };
  SmallPtrSet<BasicBlock*, 16> seen, used;
  for (User* user : local.users()) used.insert(cast<Instruction>(user)->getParent());
  SmallVector<BasicBlock*, 16> todo = {local.getParent()};
  while (!todo.empty()) {
    BasicBlock* block = todo.pop_back_val();
    if (!seen.insert(block).second) continue;
    const First first = used.count(block) ? first_in(*block) : First::None;
    if (first == First::Load) return true;
    if (first == First::None) todo.append(succ_begin(block), succ_end(block));
  }
  return false;
}

/// As the program calls it.
std::string name_of(AllocaInst& local) {
  for (DbgVariableIntrinsic* of_debugger : FindDbgAddrUses(&local))
    return of_debugger->getVariable()->getName().str();
  return local.getName().str();
}

/// Its own bytes between two gaps.
void watch_local(AllocaInst& local, Instruction* behind_locals, FunctionCallee tell) {
  Module& m = *local.getModule();
  LLVMContext& context = m.getContext();
  const DataLayout& layout = m.getDataLayout();
  const std::string name = name_of(local);
  Type* gap = ArrayType::get(Type::getInt8Ty(context), dspic::kLocalGap);
  auto* padded = StructType::get(context, {gap, local.getAllocatedType(), gap});
  const auto offset = layout.getStructLayout(padded)->getElementOffset(1);
  // The variable moves into a wider one, with a gap before and behind it; the debugger follows.
  IRBuilder<> b(&local);
  AllocaInst* wide = b.CreateAlloca(padded, nullptr, local.getName() + ".checked");
  wide->setAlignment(std::max(Align(2), local.getAlign()));
  b.SetInsertPoint(behind_locals);
  Value* inside = b.CreateStructGEP(padded, wide, 1);
  DIBuilder debug(m, false);
  replaceDbgDeclare(&local, wide, debug, DIExpression::ApplyOffset, static_cast<int>(offset));
  // variables that share a place would be told once
  for (User* user : make_early_inc_range(local.users()))
    if (auto* cast = dyn_cast<BitCastInst>(user))
      for (User* life : make_early_inc_range(cast->users()))
        if (auto* of_life = dyn_cast<IntrinsicInst>(life); of_life && of_life->isLifetimeStartOrEnd())
          of_life->eraseFromParent();
  local.replaceAllUsesWith(inside);
  // The checker is told its address, size and name.
  Value* arguments[] = {
      b.CreatePointerCast(inside, b.getInt8PtrTy()),
      ConstantInt::get(b.getInt16Ty(), layout.getTypeAllocSize(local.getAllocatedType()).getFixedValue()),
      b.CreateGlobalStringPtr(name)};
  CallInst* call = b.CreateCall(tell, arguments);
  call->setTailCallKind(CallInst::TCK_NoTail);
  if (DISubprogram* of = local.getFunction()->getSubprogram())
    call->setDebugLoc(DILocation::get(context, of->getLine(), 0, of));
  local.eraseFromParent();
}

void watch_locals(Function& f, FunctionCallee tell) {
  if (f.isDeclaration() || f.hasFnAttribute(Attribute::Naked)) return;
  std::vector<AllocaInst*> locals;
  Instruction* behind = nullptr;
  for (Instruction& i : f.getEntryBlock())
    if (auto* local = dyn_cast<AllocaInst>(&i)) {
      behind = i.getNextNode();
      if (isa<ConstantInt>(local->getArraySize()) && !local->isArrayAllocation() &&
          (!is_plain_local(*local) || may_be_read_first(*local)))
        locals.push_back(local);
    }
  while (behind && isa<DbgInfoIntrinsic>(behind)) behind = behind->getNextNode();  // those are replaced
  for (AllocaInst* local : locals) watch_local(*local, behind, tell);
}

/// clang's checks tell where they stand and what they have met; the place of the call says as much.
void name_failed_checks(Module& m) {
  constexpr const char* kOfClang = "__ubsan_handle_";
  // Each call of clang's gives way to one without arguments, at the same place in the source.
  std::vector<Function*> handlers;
  for (Function& f : m)
    if (f.isDeclaration() && f.getName().startswith(kOfClang)) handlers.push_back(&f);
  for (Function* handler : handlers) {
    StringRef kind = handler->getName();
    kind.consume_front(kOfClang);
    kind.consume_back("_abort");
    auto plain = m.getOrInsertFunction(dspic::kCheckedPrefix + kind.str(), Type::getVoidTy(m.getContext()));
    for (User* user : make_early_inc_range(handler->users())) {
      auto* call = dyn_cast<CallInst>(user);
      if (!call) continue;
      CallInst* told = CallInst::Create(plain, "", call);
      told->setDebugLoc(call->getDebugLoc());
      told->setTailCallKind(CallInst::TCK_NoTail);
      call->eraseFromParent();
    }
    if (handler->use_empty()) handler->eraseFromParent();
  }
  // their descriptions, which would take RAM
  for (bool again = true; again;) {
    again = false;
    for (GlobalVariable& g : make_early_inc_range(m.globals())) {
      g.removeDeadConstantUsers();
      if (g.hasPrivateLinkage() && g.use_empty()) {
        g.eraseFromParent();
        again = true;
      }
    }
  }
}

}  // namespace

void prepare_checks(Unit& unit) {
  Module& m = unit.module;
  LLVMContext& context = m.getContext();
  name_failed_checks(m);
  auto tell =
      m.getOrInsertFunction(dspic::kLocalFunction, Type::getVoidTy(context), Type::getInt8PtrTy(context),
                            Type::getInt16Ty(context), Type::getInt8PtrTy(context));
  for (Function& f : m) watch_locals(f, tell);
}

}  // namespace cc
