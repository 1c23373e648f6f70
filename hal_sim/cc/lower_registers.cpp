// SPDX-License-Identifier: MIT
// Special-function registers are globals named tp_sfr_XXXX (XXXX: byte address on the chip). Each load and
// store of such a global becomes a call, so reading U1RXREG or writing LATA has its true side effect.
#include "llvm/ADT/SmallPtrSet.h"
#include "llvm/Analysis/ValueTracking.h"
#include "llvm/IR/IRBuilder.h"
#include "llvm/IR/InstIterator.h"
#include "llvm/IR/Operator.h"
#include "llvm/Transforms/Utils/Local.h"
#include "passes.h"

namespace cc {
namespace {

using namespace llvm;

/// Byte address of the register a global stands for, or -1.
int register_address(const Value* v) {
  auto* g = dyn_cast<GlobalVariable>(v);
  if (!g) return -1;
  StringRef name = g->getName();
  name.consume_front("\1");
  unsigned address;
  if (!name.consume_front("tp_sfr_") || name.getAsInteger(16, address)) return -1;
  return int(address);
}

/// The global at the bottom of a chain of address arithmetic.
const Value* base_of(const Value* pointer) {
  while (auto* op = dyn_cast<Operator>(pointer)) {
    if (op->getOpcode() != Instruction::GetElementPtr && op->getOpcode() != Instruction::BitCast) break;
    pointer = op->getOperand(0);
  }
  return pointer;
}

/// Address on the chip as an i64 value.
Value* chip_address(IRBuilder<>& b, const DataLayout& layout, Value* pointer) {
  Value* offset = b.getInt64(0);
  while (auto* op = dyn_cast<Operator>(pointer)) {
    if (op->getOpcode() == Instruction::GetElementPtr)
      offset = b.CreateAdd(offset, EmitGEPOffset(&b, layout, op));
    else if (op->getOpcode() != Instruction::BitCast)
      break;
    pointer = op->getOperand(0);
  }
  return b.CreateAdd(offset, b.getInt64(register_address(pointer)));
}

void lower_access(Unit& unit, Instruction* i, Value* pointer) {
  Module& m = unit.module;
  IRBuilder<> b(i);
  Type* i64 = b.getInt64Ty();
  auto read = host_function(m, "tp_sfr_read", i64, {i64, i64});
  auto write = host_function(m, "tp_sfr_write", b.getVoidTy(), {i64, i64, i64});
  auto* load = dyn_cast<LoadInst>(i);
  Type* type = load ? load->getType() : cast<StoreInst>(i)->getValueOperand()->getType();
  unsigned bits = m.getDataLayout().getTypeSizeInBits(type);
  Value* address = chip_address(b, m.getDataLayout(), pointer);
  Type* whole = b.getIntNTy((bits + 7) / 8 * 8);
  if (load) {
    // wider than a register: low word first, as the compiler of the chip does
    Value* value = nullptr;
    for (unsigned at = 0; at < bits; at += 16) {
      unsigned part = bits - at >= 16 ? 16 : 8;
      Value* word = b.CreateCall(read, {b.CreateAdd(address, b.getInt64(at / 8)), b.getInt64(part)});
      word = b.CreateShl(b.CreateZExtOrTrunc(b.CreateTrunc(word, b.getIntNTy(part)), whole), at);
      value = value ? b.CreateOr(value, word) : word;
    }
    if (type->isIntegerTy())
      value = b.CreateZExtOrTrunc(value, type);
    else
      value = type->isPointerTy() ? b.CreateIntToPtr(value, type) : b.CreateBitCast(value, type);
    load->replaceAllUsesWith(value);
  } else {
    Value* value = cast<StoreInst>(i)->getValueOperand();
    if (type->isPointerTy())
      value = b.CreatePtrToInt(value, whole);
    else
      value = type->isIntegerTy() ? b.CreateZExtOrTrunc(value, whole) : b.CreateBitCast(value, whole);
    for (unsigned at = 0; at < bits; at += 16) {
      unsigned part = bits - at >= 16 ? 16 : 8;
      Value* word = b.CreateZExt(b.CreateTrunc(b.CreateLShr(value, at), b.getIntNTy(part)), i64);
      b.CreateCall(write, {b.CreateAdd(address, b.getInt64(at / 8)), word, b.getInt64(part)});
    }
  }
  i->eraseFromParent();
}

/// Where the address of a register goes anywhere but into an access.
const Instruction* escape_of(const Value* v, SmallPtrSetImpl<const Value*>& seen) {
  if (!seen.insert(v).second) return nullptr;
  for (const User* user : v->users()) {
    auto* op = dyn_cast<Operator>(user);
    if (op && (op->getOpcode() == Instruction::GetElementPtr || op->getOpcode() == Instruction::BitCast)) {
      if (const Instruction* found = escape_of(user, seen)) return found;
    } else if (auto* i = dyn_cast<Instruction>(user)) {
      return i;
    }
  }
  return nullptr;
}

}  // namespace

void lower_register_accesses(Unit& unit) {
  for (Function& f : unit.module) {
    std::vector<std::pair<Instruction*, Value*>> accesses;
    for (Instruction& i : instructions(f)) {
      Value* pointer = nullptr;
      if (auto* load = dyn_cast<LoadInst>(&i)) pointer = load->getPointerOperand();
      if (auto* store = dyn_cast<StoreInst>(&i)) pointer = store->getPointerOperand();
      if (pointer && register_address(base_of(pointer)) >= 0) accesses.emplace_back(&i, pointer);
    }
    for (auto& [i, pointer] : accesses) lower_access(unit, i, pointer);
  }
}

void lower_registers(Unit& unit) {
  lower_register_accesses(unit);
  for (GlobalVariable& g : make_early_inc_range(unit.module.globals())) {
    if (register_address(&g) < 0) continue;
    g.removeDeadConstantUsers();
    SmallPtrSet<const Value*, 8> seen;
    const Instruction* where = escape_of(&g, seen);
    StringRef label = g.getName();
    label.consume_front("\1");
    auto named = unit.facts.register_names.find(label.str());
    std::string name = named == unit.facts.register_names.end() ? label.str() : named->second;
    if (where)
      unit.error(where->getDebugLoc(),
                 "register " + name +
                     ": its address is stored or passed on; got a pointer to a register, expected a direct "
                     "access by its name");
    else if (!g.use_empty() && !g.hasInitializer())
      for (const User* user : g.users())
        if (!isa<Instruction>(user) && !user->use_empty()) {
          unit.error(
              DebugLoc(),
              "register " + name +
                  ": its address is the start value of a variable; expected a direct access by its name");
          break;
        }
  }
}

}  // namespace cc
