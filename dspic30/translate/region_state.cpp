// SPDX-License-Identifier: MIT
// What of the core's state a stretch keeps to itself, where it is put back and taken again; and the function
// made good and moved to a module of its own.
#include <llvm/ADT/MapVector.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/Pass.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar.h>
#include <llvm/Transforms/Utils/Cloning.h>

#include "dspic30/translate/maker.h"
#include "dspic30/translate/outside_values.h"

namespace dspic::translate {

bool Maker::keep_state() {
  Hot hot(cpu_);
  const auto ram = static_cast<std::int64_t>(offset_of(cpu_, &cpu_.ram));
  std::map<const BasicBlock*, const Item*> begins;
  for (const Item& item : items_) begins[blocks_[index_of(item)]] = &item;
  const Item* current = nullptr;
  std::vector<std::pair<Instruction*, unsigned>> accesses;  // and which operand is the pointer
  for (Instruction& i : instructions(*function_)) {
    if (&i == &i.getParent()->front())
      if (const auto found = begins.find(i.getParent()); found != begins.end()) current = found->second;
    if (!isa<LoadInst>(i) && !isa<StoreInst>(i)) continue;
    const unsigned operand = isa<StoreInst>(i) ? 1 : 0;
    Value* const pointer = i.getOperand(operand);
    const auto [base, offset] = split(pointer);
    if (base == cpu_arg_) {
      if (!hot.holds(static_cast<std::uint64_t>(offset))) continue;
      Type* const type = isa<StoreInst>(i) ? i.getOperand(0)->getType() : i.getType();
      hot.touch(static_cast<std::uint64_t>(offset), layout_.getTypeStoreSize(type),
                isa<StoreInst>(i) ? current : nullptr);
      accesses.emplace_back(&i, operand);
      continue;
    }
    // RAM is where a computed place may lie; anything else computed within the Cpu is not understood
    SmallVector<const Value*, 4> objects;
    getUnderlyingObjects(pointer, objects);
    if (std::find(objects.begin(), objects.end(), cpu_arg_) == objects.end()) continue;
    const auto* const step = dyn_cast<GEPOperator>(base);
    MapVector<Value*, APInt> variable;
    APInt constant(64, 0);
    if (!step || !step->collectOffset(layout_, 64, variable, constant)) return false;
    const auto [begin, before] = split(const_cast<Value*>(step->getPointerOperand()));
    if (begin != cpu_arg_ || before + constant.getSExtValue() < ram) return false;
  }
  BasicBlock& entry = function_->getEntryBlock();
  ir_.SetInsertPoint(&entry, entry.begin());
  AllocaInst* const own = ir_.CreateAlloca(ArrayType::get(byte_, hot.end - hot.begin));
  own->setAlignment(Align(8));
  Value* const bytes = ir_.CreateBitCast(own, byte_->getPointerTo());
  const auto inner = [&](const Hot::Field& f) {
    return ir_.CreateBitCast(ir_.CreateConstInBoundsGEP1_64(byte_, bytes, f.offset - hot.begin),
                             ir_.getIntNTy(8 * f.bytes)->getPointerTo());
  };
  const auto outer = [&](const Hot::Field& f) {
    return ir_.CreateBitCast(ir_.CreateConstInBoundsGEP1_64(byte_, cpu_arg_, f.offset),
                             ir_.getIntNTy(8 * f.bytes)->getPointerTo());
  };
  const auto put_back = [&](const Hot::Field& f) {
    ir_.CreateStore(ir_.CreateLoad(ir_.getIntNTy(8 * f.bytes), inner(f)), outer(f));
  };
  const auto take = [&](const Hot::Field& f) {
    ir_.CreateStore(ir_.CreateLoad(ir_.getIntNTy(8 * f.bytes), outer(f)), inner(f));
  };
  const auto put_back_all = [&] {
    for (const Hot::Field& f : hot.fields)
      if (!f.writers.empty()) put_back(f);
  };
  const auto take_all = [&] {
    for (const Hot::Field& f : hot.fields)
      if (f.is_used) take(f);
  };
  take_all();
  for (const auto& [access, operand] : accesses) {
    ir_.SetInsertPoint(access);
    Value* const pointer = access->getOperand(operand);
    const std::int64_t offset = split(pointer).second;
    access->setOperand(operand,
                       ir_.CreateBitCast(ir_.CreateConstInBoundsGEP1_64(
                                             byte_, bytes, static_cast<std::uint64_t>(offset) - hot.begin),
                                         pointer->getType()));
  }
  for (const Effect& effect : effects_) {
    auto* const what = cast_or_null<Instruction>(static_cast<Value*>(effect.what));
    if (!what) continue;
    if (is_real_call(*what)) {
      ir_.SetInsertPoint(what);
      const Hot::Field& clock = hot.fields.back();
      const auto sees = [&](const Hot::Field& f) {
        return effect.scope == Effect::All || &f == &clock ||
               ((effect.scope == Effect::HostCall || effect.scope == Effect::LookAtCall) &&
                hot.is_of_call(f)) ||
               (effect.scope == Effect::Routine && !hot.is_flag(f));
      };
      for (const Hot::Field& f : hot.fields)
        if (!f.writers.empty() && sees(f)) put_back(f);
      ir_.CreateStore(place(effect.item->place), field(&cpu_.at, byte_->getPointerTo()));
      if (effect.is_look()) continue;
      ir_.SetInsertPoint(what->getNextNode());
      for (const Hot::Field& f : hot.fields)
        if (f.is_used && (sees(f) || effect.scope == Effect::Routine)) take(f);
    }
    ir_.SetInsertPoint(what->getNextNode());
    ir_.CreateStore(ir_.getTrue(), left_);
  }
  for (BasicBlock* block : exits()) {
    if (!live_.count(block)) continue;
    ir_.SetInsertPoint(block, block->getFirstInsertionPt());
    put_back_all();
  }
  for (const Aside& aside : asides_) {
    if (!live_.count(aside.block)) continue;
    for (const Hot::Field& f : hot.fields) {
      const bool is_old = goes_back_ ? !f.writers.empty()
                                     : std::any_of(f.writers.begin(), f.writers.end(),
                                                   [&](const Item* i) { return i < aside.item; });
      if (!is_old) continue;  // where it was when the stretch began, it still is
      const bool is_own = std::count(f.writers.begin(), f.writers.end(), aside.item) > 0;
      Type* const type = ir_.getIntNTy(8 * f.bytes);
      ir_.SetInsertPoint(is_own ? &*aside.first->getFirstInsertionPt() : aside.block->getTerminator());
      Value* const value = ir_.CreateLoad(type, inner(f));
      ir_.SetInsertPoint(aside.block->getTerminator());
      ir_.CreateStore(value, outer(f));
    }
  }
  return true;
}

// --- the end --------------------------------------------------------------------------------------------

void Maker::optimise() {
  legacy::FunctionPassManager passes(semantics_.module.get());
  passes.add(createSROAPass());
  passes.add(createEarlyCSEPass());
  passes.add(createInstructionCombiningPass());
  passes.add(createCFGSimplificationPass());
  passes.add(createEarlyCSEPass());
  passes.add(createSinkingPass());
  passes.doInitialization();
  passes.run(*function_);
}

std::unique_ptr<Module> Maker::moved_out() {
  auto module = std::make_unique<Module>(function_->getName(), context_);
  module->setDataLayout(layout_);
  module->setTargetTriple(semantics_.module->getTargetTriple());
  Function* const moved = Function::Create(function_->getFunctionType(), GlobalValue::ExternalLinkage,
                                           function_->getName(), *module);
  moved->setDoesNotThrow();
  ValueToValueMapTy map;
  for (unsigned i = 0; i < 2; ++i) map[function_->getArg(i)] = moved->getArg(i);
  SmallVector<ReturnInst*, 2> returns;
  OutsideValues outside(*module);
  CloneFunctionInto(moved, function_, map, CloneFunctionChangeType::DifferentModule, returns, "", nullptr,
                    nullptr, &outside);
  return module;
}

}  // namespace dspic::translate
