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

/// Whether a pointer means a register whichever way control came: the optimiser merges accesses of several
/// branches to one by a chosen pointer.
bool is_register_pointer(const Value* pointer, SmallPtrSetImpl<const Value*>& seen) {
  const Value* base = base_of(pointer);
  if (register_address(base) >= 0 || !seen.insert(base).second) return true;
  if (auto* phi = dyn_cast<PHINode>(base))
    return all_of(phi->incoming_values(), [&](const Use& v) { return is_register_pointer(v.get(), seen); });
  if (auto* choice = dyn_cast<SelectInst>(base))
    return is_register_pointer(choice->getTrueValue(), seen) &&
           is_register_pointer(choice->getFalseValue(), seen);
  return false;
}

bool is_register_pointer(const Value* pointer) {
  if (!isa<Operator>(pointer) && !isa<GlobalVariable>(pointer)) return false;
  SmallPtrSet<const Value*, 8> seen;
  return is_register_pointer(pointer, seen);
}

/// Address on the chip as an i64 value; `made` holds the choices between registers that are numbers already.
Value* chip_address(IRBuilder<>& b, const DataLayout& layout, Value* pointer,
                    DenseMap<Value*, Value*>& made) {
  Value* offset = b.getInt64(0);
  while (auto* op = dyn_cast<Operator>(pointer)) {
    if (op->getOpcode() == Instruction::GetElementPtr)
      offset = b.CreateAdd(offset, EmitGEPOffset(&b, layout, op));
    else if (op->getOpcode() != Instruction::BitCast)
      break;
    pointer = op->getOperand(0);
  }
  Value*& number = made[pointer];
  if (auto* phi = dyn_cast<PHINode>(pointer); phi && !number) {
    auto* chosen = PHINode::Create(b.getInt64Ty(), phi->getNumIncomingValues(), "", phi);
    mark_free(chosen);
    number = chosen;
    for (unsigned i = 0; i < phi->getNumIncomingValues(); ++i) {
      IRBuilder<> at(phi->getIncomingBlock(i)->getTerminator());
      chosen->addIncoming(chip_address(at, layout, phi->getIncomingValue(i), made), phi->getIncomingBlock(i));
    }
    return b.CreateAdd(offset, chosen);
  }
  if (auto* choice = dyn_cast<SelectInst>(pointer); choice && !number) {
    IRBuilder<> at(choice);
    Value* one = chip_address(at, layout, choice->getTrueValue(), made);
    Value* other = chip_address(at, layout, choice->getFalseValue(), made);
    Value* chosen = at.CreateSelect(choice->getCondition(), one, other);
    made[pointer] = chosen;
    return b.CreateAdd(offset, chosen);
  }
  return b.CreateAdd(offset, number ? number : b.getInt64(register_address(pointer)));
}

/// The value of `type` that registers at `address` (i64) hold. Wider than a register: low word first, as the
/// compiler of the chip does.
Value* read_registers(Unit& unit, IRBuilder<>& b, Value* address, Type* type) {
  Module& m = unit.module;
  Type* i64 = b.getInt64Ty();
  auto read = host_function(m, "tp_sfr_read", i64, {i64, i64});
  unsigned bits = m.getDataLayout().getTypeSizeInBits(type);
  Type* whole = b.getIntNTy((bits + 7) / 8 * 8);
  Value* value = nullptr;
  for (unsigned at = 0; at < bits; at += 16) {
    unsigned part = bits - at >= 16 ? 16 : 8;
    Value* word = b.CreateCall(read, {b.CreateAdd(address, b.getInt64(at / 8)), b.getInt64(part)});
    word = b.CreateShl(b.CreateZExtOrTrunc(b.CreateTrunc(word, b.getIntNTy(part)), whole), at);
    value = value ? b.CreateOr(value, word) : word;
  }
  if (type->isIntegerTy()) return b.CreateZExtOrTrunc(value, type);
  return type->isPointerTy() ? b.CreateIntToPtr(value, type) : b.CreateBitCast(value, type);
}

void write_registers(Unit& unit, IRBuilder<>& b, Value* address, Value* value) {
  Module& m = unit.module;
  Type* i64 = b.getInt64Ty();
  auto write = host_function(m, "tp_sfr_write", b.getVoidTy(), {i64, i64, i64});
  Type* type = value->getType();
  unsigned bits = m.getDataLayout().getTypeSizeInBits(type);
  Type* whole = b.getIntNTy((bits + 7) / 8 * 8);
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

void lower_access(Unit& unit, Instruction* i, Value* pointer, DenseMap<Value*, Value*>& made) {
  IRBuilder<> b(i);
  Value* address = chip_address(b, unit.module.getDataLayout(), pointer, made);
  if (auto* load = dyn_cast<LoadInst>(i))
    load->replaceAllUsesWith(read_registers(unit, b, address, load->getType()));
  else
    write_registers(unit, b, address, cast<StoreInst>(i)->getValueOperand());
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

static void lower_register_accesses(Unit& unit) {
  for (Function& f : unit.module) {
    std::vector<std::pair<Instruction*, Value*>> accesses;
    for (Instruction& i : instructions(f)) {
      Value* pointer = nullptr;
      if (auto* load = dyn_cast<LoadInst>(&i)) pointer = load->getPointerOperand();
      if (auto* store = dyn_cast<StoreInst>(&i)) pointer = store->getPointerOperand();
      if (pointer && is_register_pointer(pointer)) accesses.emplace_back(&i, pointer);
    }
    DenseMap<Value*, Value*> made;
    for (auto& [i, pointer] : accesses) lower_access(unit, i, pointer, made);
    std::vector<WeakTrackingVH> replaced;
    for (auto& [pointer, number] : made)
      if (isa<Instruction>(pointer)) replaced.emplace_back(pointer);
    for (WeakTrackingVH& pointer : replaced) {
      if (auto* phi = dyn_cast_or_null<PHINode>(static_cast<Value*>(pointer)))
        RecursivelyDeleteDeadPHINode(phi);
      else if (pointer)
        RecursivelyDeleteTriviallyDeadInstructions(static_cast<Value*>(pointer));
    }
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
