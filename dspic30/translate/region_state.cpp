// SPDX-License-Identifier: MIT
// What of the core's state a stretch keeps to itself, where it is put back and taken again; and the function
// made good and moved to a module of its own.
#include <llvm/ADT/MapVector.h>
#include <llvm/ADT/PostOrderIterator.h>
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

// false: something is not understood
bool Maker::find_accesses(Hot& hot) {
  const auto ram = static_cast<std::int64_t>(offset_of(cpu_, &cpu_.ram));
  std::map<const BasicBlock*, const Item*> begins;
  // Every load and store of the function, and the instruction of the program that it belongs to.
  for (const Item& item : items_) begins[blocks_[index_of(item)]] = &item;
  const Item* current = nullptr;
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
      const Hot::Fields touched =
          hot.touch(static_cast<std::uint64_t>(offset), layout_.getTypeStoreSize(type),
                    isa<StoreInst>(i) ? current : nullptr);
      if (isa<StoreInst>(i)) writes_[&i] = touched;
      accesses_.emplace_back(&i, operand);
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
  return true;
}

// what is called may look at these
bool Maker::sees(const Hot& hot, const Effect& effect, const Hot::Field& f) const {
  switch (effect.scope) {
    case Effect::All:
      return true;
    case Effect::HostCall:
    case Effect::LookAtCall:
      return hot.is_of_call(f) || hot.is_clock(f);
    case Effect::Routine:
      return !hot.is_flag(f) || effect.item->routine->function || effect.item->routine->keeps_flags;
    default:
      return hot.is_clock(f);
  }
}

// ... and may change these; a routine keeps what C's callees keep, and an action leaves all flags anew
bool Maker::changes(const Hot& hot, const Effect& effect, const Hot::Field& f) const {
  if (effect.is_look()) return false;
  if (effect.scope == Effect::Routine) return hot.is_of_call(f) || hot.is_flag(f) || hot.is_clock(f);
  return sees(hot, effect, f);
}

// forward through the function, until nothing is added
void Maker::find_unsaved() {
  const ReversePostOrderTraversal<Function*> order(function_);
  for (bool changed = true; changed;) {
    changed = false;
    for (const BasicBlock* block : order) {
      Hot::Fields fields = unsaved_[block];
      for (const Instruction& i : *block) {
        if (const auto written = writes_.find(&i); written != writes_.end()) fields |= written->second;
        if (const auto settled = settles_.find(&i); settled != settles_.end()) {
          unsaved_before_[&i] = fields;
          fields &= ~settled->second;
        }
      }
      for (const BasicBlock* next : successors(block)) {
        Hot::Fields& there = unsaved_[next];
        changed |= (fields & ~there) != 0;
        there |= fields;
      }
    }
  }
}

bool Maker::keep_state() {
  Hot hot(cpu_);
  if (!find_accesses(hot)) return false;
  // What calls may see or change has to be in the Cpu before them, and is taken anew behind them.
  std::set<const Item*> callers;
  for (const Effect& effect : effects_) {
    const auto* const what = cast_or_null<Instruction>(static_cast<Value*>(effect.what));
    if (!what || !is_real_call(*what)) continue;
    callers.insert(effect.item);
    for (const Hot::Field& f : hot.fields)
      if (sees(hot, effect, f) || changes(hot, effect, f)) settles_[what] |= hot.bit(f);
  }
  find_unsaved();
  // The state's own place on the stack, and both ways between it and the Cpu.
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
  // It is taken at the beginning, and every access goes to the copy.
  for (const Hot::Field& f : hot.fields)
    if (f.is_used) take(f);
  for (const auto& [access, operand] : accesses_) {
    ir_.SetInsertPoint(access);
    Value* const pointer = access->getOperand(operand);
    const std::int64_t offset = split(pointer).second;
    access->setOperand(operand,
                       ir_.CreateBitCast(ir_.CreateConstInBoundsGEP1_64(
                                             byte_, bytes, static_cast<std::uint64_t>(offset) - hot.begin),
                                         pointer->getType()));
  }
  // Around calls: what they may look at is put back, what they may have changed is taken anew.
  for (const Effect& effect : effects_) {
    auto* const what = cast_or_null<Instruction>(static_cast<Value*>(effect.what));
    if (!what) continue;
    if (is_real_call(*what)) {
      ir_.SetInsertPoint(what);
      for (const Hot::Field& f : hot.fields)
        if ((unsaved_before_[what] & hot.bit(f)) && sees(hot, effect, f)) put_back(f);
      ir_.CreateStore(place(effect.item->place), field(&cpu_.at, byte_->getPointerTo()));
      if (effect.is_look()) continue;
      ir_.SetInsertPoint(what->getNextNode());
      for (const Hot::Field& f : hot.fields)
        if (f.is_used && changes(hot, effect, f)) take(f);
    }
    ir_.SetInsertPoint(what->getNextNode());
    ir_.CreateStore(ir_.getTrue(), left_);
  }
  // At the ends: whatever was written on any way there.
  for (BasicBlock* block : exits()) {
    if (!live_.count(block)) continue;
    ir_.SetInsertPoint(block, block->getFirstInsertionPt());
    for (const Hot::Field& f : hot.fields)
      if (unsaved_[block] & hot.bit(f)) put_back(f);
  }
  // as it is where the instruction begins
  for (const Aside& aside : asides_) {
    if (!live_.count(aside.block)) continue;
    for (const Hot::Field& f : hot.fields) {
      const bool is_own = std::count(f.writers.begin(), f.writers.end(), aside.item) > 0;
      if (!(unsaved_[aside.first] & hot.bit(f)) && !(is_own && callers.count(aside.item))) continue;
      Type* const type = ir_.getIntNTy(8 * f.bytes);
      ir_.SetInsertPoint(is_own ? &*aside.first->getFirstInsertionPt() : aside.block->getTerminator());
      Value* const value = ir_.CreateLoad(type, inner(f));
      ir_.SetInsertPoint(aside.block->getTerminator());
      ir_.CreateStore(value, outer(f));
    }
  }
  return true;
}

// --- the end

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
