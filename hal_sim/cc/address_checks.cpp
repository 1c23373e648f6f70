// SPDX-License-Identifier: MIT
// --sanitize: before each access a check that it falls inside one object that exists. Globals are registered
// in section tpobj with a gap behind each; local variables whose address is used are registered while they
// live; the heap knows its own blocks (runtime/image_sanitize.c). In the firmware's libc the characters are
// checked that it reads and whatever it writes: a string that is too long for the program's array. Its own
// arguments and structures are not the program's doing.
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/DebugInfoMetadata.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/IntrinsicInst.h"
#include "llvm/Support/Path.h"
#include "llvm/Transforms/Utils/ModuleUtils.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

constexpr uint64_t kGapBytes = 32;  // behind each global: a run past its end lands here

Constant* where_text(Module& m, const Instruction& i, bool library) {
  std::string text = m.getSourceFileName();
  const Function& f = *i.getFunction();
  if (library) {
    StringRef name = f.getName();
    name.consume_front("tp_c_");  // what a label of ours stands before
    text = f.hasLocalLinkage() ? "in " + sys::path::filename(text).str() : "in " + name.str() + "()";
  } else if (const DebugLoc& at = i.getDebugLoc())
    text = (cast<DIScope>(at.getScope())->getFilename() + ":" + Twine(at.getLine())).str();
  auto* data = ConstantDataArray::getString(m.getContext(), text);
  auto* g = new GlobalVariable(m, data->getType(), true, GlobalValue::PrivateLinkage, data, "tp.where");
  g->setUnnamedAddr(GlobalValue::UnnamedAddr::Global);
  return ConstantExpr::getBitCast(g, Type::getInt8PtrTy(m.getContext()));
}

/// Behind each global a gap, and its place in the table of objects.
void register_globals(Unit& unit) {
  Module& m = unit.module;
  auto& layout = m.getDataLayout();
  Type* i64 = Type::getInt64Ty(m.getContext());
  Type* bytes = Type::getInt8PtrTy(m.getContext());
  std::vector<GlobalVariable*> all;
  for (GlobalVariable& g : m.globals())
    if (!g.isDeclaration() && !g.getName().startswith("tp") && !g.getName().startswith("llvm.") &&
        !g.hasSection())
      all.push_back(&g);
  std::vector<GlobalValue*> used;
  for (GlobalVariable* g : all) {
    uint64_t size = layout.getTypeAllocSize(g->getValueType());
    GlobalVariable* object = g;
    {
      auto* gap = ArrayType::get(Type::getInt8Ty(m.getContext()), kGapBytes);
      Constant* fields[] = {g->getInitializer(), ConstantAggregateZero::get(gap)};
      auto* type = StructType::get(m.getContext(), {g->getValueType(), gap});
      object = new GlobalVariable(m, type, g->isConstant(), g->getLinkage(),
                                  ConstantStruct::get(type, fields), "", g);
      object->copyAttributesFrom(g);
      object->takeName(g);
      object->copyMetadata(g, 0);
      object->setAlignment(
          std::max(Align(8), layout.getValueOrABITypeAlignment(g->getAlign(), g->getValueType())));
      g->replaceAllUsesWith(ConstantExpr::getBitCast(object, g->getType()));
      g->eraseFromParent();
    }
    auto* label = ConstantDataArray::getString(m.getContext(), object->getName());
    auto* name = new GlobalVariable(m, label->getType(), true, GlobalValue::PrivateLinkage, label, "tp.name");
    Constant* fields[] = {ConstantExpr::getBitCast(object, bytes), ConstantInt::get(i64, size),
                          ConstantExpr::getBitCast(name, bytes)};
    auto* entry =
        new GlobalVariable(m, StructType::get(bytes, i64, bytes), false, GlobalValue::InternalLinkage,
                           ConstantStruct::getAnon(fields), "tpobj.entry");
    entry->setSection("tpobj");
    entry->setAlignment(Align(8));
    used.push_back(entry);
  }
  if (!used.empty()) appendToCompilerUsed(m, used);
}

/// Local arrays and structs, known to the runtime from entry to return.
void register_locals(Unit& unit, Function& f) {
  Module& m = unit.module;
  IRBuilder<> b(m.getContext());
  Type* bytes = b.getInt8PtrTy();
  std::vector<AllocaInst*> locals;
  for (Instruction& i : f.getEntryBlock())
    if (auto* a = dyn_cast<AllocaInst>(&i))
      if (isa<ConstantInt>(a->getArraySize())) locals.push_back(a);
  if (locals.empty()) return;
  // each stands in a frame of its own: a gap on both sides comes from a padded type
  auto enter = m.getOrInsertFunction("tp_image_local_enter", b.getVoidTy(), bytes, b.getInt64Ty());
  auto leave = m.getOrInsertFunction("tp_image_local_leave", b.getVoidTy(), b.getInt64Ty());
  for (AllocaInst* a : locals) {
    uint64_t size = m.getDataLayout().getTypeAllocSize(a->getAllocatedType()) *
                    cast<ConstantInt>(a->getArraySize())->getZExtValue();
    auto* padded = StructType::get(a->getAllocatedType(), ArrayType::get(b.getInt8Ty(), kGapBytes));
    b.SetInsertPoint(a);
    auto* wide = b.CreateAlloca(padded);
    wide->setAlignment(std::max(Align(8), a->getAlign()));
    auto* inside = cast<Instruction>(b.CreateBitCast(wide, a->getType()));
    a->replaceAllUsesWith(inside);
    a->eraseFromParent();
    b.SetInsertPoint(inside->getNextNode());
    b.CreateCall(enter, {b.CreateBitCast(inside, bytes), b.getInt64(size)});
  }
  for (Instruction& i : make_early_inc_range(instructions(f)))
    if (isa<ReturnInst>(i)) {
      b.SetInsertPoint(&i);
      b.CreateCall(leave, {b.getInt64(locals.size())});
    } else if (auto* life = dyn_cast<IntrinsicInst>(&i); life && life->isLifetimeStartOrEnd()) {
      life->eraseFromParent();
    }
}

}  // namespace

void check_addresses(Unit& unit) {
  const bool library = unit.options.library;
  Module& m = unit.module;
  std::vector<std::pair<Instruction*, Value*>> accesses;
  for (Function& f : m)
    for (Instruction& i : instructions(f)) {
      Value* pointer = nullptr;
      if (auto* load = dyn_cast<LoadInst>(&i); load && (!library || load->getType()->isIntegerTy(8)))
        pointer = load->getPointerOperand();
      if (auto* store = dyn_cast<StoreInst>(&i)) pointer = store->getPointerOperand();
      if (auto* copy = dyn_cast<MemTransferInst>(&i)) accesses.emplace_back(&i, copy->getRawSource());
      if (auto* mem = dyn_cast<MemIntrinsic>(&i)) pointer = mem->getRawDest();
      if (!pointer) continue;
      // plain variables accessed by their name cannot miss
      const Value* bare = pointer->stripPointerCasts();
      bool whole = isa<AllocaInst>(bare) || isa<GlobalVariable>(bare);
      if (!whole || isa<MemIntrinsic>(i)) accesses.emplace_back(&i, pointer);
    }
  IRBuilder<> b(m.getContext());
  Type* bytes = b.getInt8PtrTy();
  auto check =
      m.getOrInsertFunction("tp_image_check", b.getVoidTy(), bytes, b.getInt64Ty(), b.getInt64Ty(), bytes);
  for (auto& [i, pointer] : accesses) {
    const Value* base = getUnderlyingObject(pointer);
    if (base->getName().startswith("tp")) continue;
    if (auto* g = dyn_cast<GlobalVariable>(base); g && g->hasSection()) continue;
    b.SetInsertPoint(i);
    b.SetCurrentDebugLocation(i->getDebugLoc());
    Value* size;
    if (auto* mem = dyn_cast<MemIntrinsic>(i))
      size = b.CreateZExtOrTrunc(mem->getLength(), b.getInt64Ty());
    else
      size = b.getInt64(m.getDataLayout().getTypeStoreSize(
          isa<LoadInst>(i) ? i->getType() : cast<StoreInst>(i)->getValueOperand()->getType()));
    bool writes =
        isa<StoreInst>(i) || (isa<MemIntrinsic>(i) && cast<MemIntrinsic>(i)->getRawDest() == pointer);
    b.CreateCall(check,
                 {b.CreateBitCast(pointer, bytes), size, b.getInt64(writes), where_text(m, *i, library)});
  }
  for (Function& f : m)
    if (!f.isDeclaration()) register_locals(unit, f);
  if (!library) register_globals(unit);
}

}  // namespace cc
