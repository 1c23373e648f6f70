// SPDX-License-Identifier: MIT
// What makes one stretch a function of LLVM's (region.h): region.cpp puts its instructions one after another,
// region_ways.cpp what leads from one to the next and out, region_state.cpp keeps the core's state apart.
#pragma once
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/ValueHandle.h>

#include <algorithm>
#include <array>
#include <set>

#include "dspic30/translate/hot_fields.h"
#include "dspic30/translate/machine_code.h"
#include "dspic30/translate/region.h"

namespace dspic::translate {

using namespace llvm;

inline constexpr StringLiteral kOffset = "_ZN5dspic3Cpu6offsetEPKNS_7DecodedEi",
                               kJump = "_ZN5dspic3Cpu4jumpEjPKNS_7DecodedE",
                               kCallTo = "_ZN5dspic3Cpu7call_toEjPKNS_7DecodedEj",
                               kReturnTo = "_ZN5dspic3Cpu9return_toEjPKNS_7DecodedE",
                               kRead = "_ZN5dspic9DataSpace14read_elsewhereEjj",
                               kWrite = "_ZN5dspic9DataSpace15write_elsewhereEjjj",
                               kModify = "_ZN5dspic9DataSpace16modify_elsewhereEjjjj",
                               kServed = "_ZN5dspic9DataSpace11read_servedEjj",
                               kTrap = "_ZN5dspic9DataSpace4trapENS_4TrapE",
                               kSpecial = "_ZN5dspic15special_pointerERNS_3CpuEjiib",
                               kPushSlowly = "_ZN5dspic9DataSpace11push_slowlyEj",
                               kPopSlowly = "_ZN5dspic9DataSpace10pop_slowlyEv",
                               kCheckStack = "_ZN5dspic9DataSpace11check_stackEj",
                               kPsvCost = "_ZN5dspic9DataSpace8psv_costEv";

// the files' bitcode may have types of its own for one class, and then calls through a cast
inline StringRef name_of(const CallBase& call) {
  const auto* const callee = dyn_cast<Function>(call.getCalledOperand()->stripPointerCasts());
  return callee ? callee->getName() : StringRef();
}
inline bool is_jump(StringRef name) {
  return name == kOffset || name == kJump || name == kCallTo || name == kReturnTo;
}
inline bool is_real_call(const Instruction& i) {
  return isa<CallInst>(i) && (!isa<IntrinsicInst>(i) || isa<MemIntrinsic>(i));
}
inline bool is_access(const CallInst& call) {
  const StringRef name = name_of(call);
  return name == kRead || name == kWrite || name == kModify;
}
/// Address that is read, written or modified elsewhere than in RAM, if it is known.
inline const ConstantInt* address_in(const CallInst& call) {
  return is_access(call) ? dyn_cast<ConstantInt>(call.getArgOperand(1)) : nullptr;
}
/// Of no more than the clock: registers of peripherals, not those of the core.
inline bool is_of_peripheral(const CallInst& call) {
  const ConstantInt* const address = address_in(call);
  return address && address->getZExtValue() > sfr("DISICNT") + 1 && address->getZExtValue() < kSfrBytes;
}
/// Seldom called, as RAM is what pointers point to.
inline bool is_beyond_ram(const CallInst& call) {
  const StringRef name = name_of(call);
  return (is_access(call) && !address_in(call)) || name == kTrap || name == kSpecial || name == kPushSlowly ||
         name == kPopSlowly || name == kCheckStack;
}

class Maker {
 public:
  Maker(Semantics& semantics, const Cpu& cpu, const std::vector<Item>& items, const std::string& name);
  ~Maker() {
    if (function_) function_->eraseFromParent();
  }
  std::unique_ptr<Module> make();

 private:
  // calls, and stores to the deadline, of the instruction at a place
  struct Effect {
    WeakVH what;
    const Item* item;
    // what is put back before it, taken behind it; behind a Look nothing has changed, not even the deadline
    enum Scope { All, ClockOnly, HostCall, Routine, Look, LookAtCall } scope;
    /// Can it begin or end a DO loop?
    bool is_any() const { return scope == All; }
    bool is_look() const { return scope == Look || scope == LookAtCall; }
  };
  void put_entry();
  bool put_item(const Item& item);
  BasicBlock* aside(const Item& item, BasicBlock* first);
  bool inlined(CallInst* call);
  std::vector<BasicBlock*> blocks_from(BasicBlock* first);
  void fold(const Item& item, BasicBlock* first);
  void keep_jumps(const Item& item, BasicBlock* first);
  void drop_dead(BasicBlock* first);
  void put_costs(const Item& item, BasicBlock* first);
  void take_saved(BasicBlock* first);
  void put_saved(const Cpu::Saved& saved, Value* value);
  void find_effects(const Item& item, BasicBlock* first);
  void leave(const Item& item, BasicBlock* block, Value* next);
  void leave_by_return(const Item& item, BasicBlock* block);
  void leave_by_answer(const Item& item, BasicBlock* block);
  BasicBlock* edge(const Item& item, Value* next, int frame);
  BasicBlock* passed(const Item& item);
  Value* jump_to(std::ptrdiff_t place, int frame);
  bool keep_state();
  bool find_accesses(Hot& hot);
  void find_unsaved();
  bool sees(const Hot& hot, const Effect& effect, const Hot::Field& f) const;
  bool changes(const Hot& hot, const Effect& effect, const Hot::Field& f) const;
  std::array<BasicBlock*, 4> exits() const { return {exit_, ways_[0].block, ways_[1].block, ways_[2].block}; }
  void optimise();
  std::unique_ptr<Module> moved_out();

  /// What runs an instruction in the interpreter's stead, by its name in MachineCode::Address.
  static std::string alone(const Item& item) {
    return item.is_host ? kHost : item.is_told ? kTold : interpreter(item.word);
  }
  /// A call of a function that is the simulator's, by its name in MachineCode::Address.
  CallInst* called(const std::string& name, ArrayRef<Value*> arguments) {
    SmallVector<Type*, 3> types;
    for (Value* argument : arguments) types.push_back(argument->getType());
    FunctionType* const type = FunctionType::get(byte_->getPointerTo(), types, false);
    return ir_.CreateCall(semantics_.module->getOrInsertFunction(name, type), arguments);
  }
  Value* field(const void* which, Type* type) {
    return ir_.CreateBitCast(ir_.CreateConstInBoundsGEP1_64(byte_, cpu_arg_, offset_of(cpu_, which)),
                             type->getPointerTo());
  }
  Value* place(std::ptrdiff_t words) {
    return ir_.CreateConstInBoundsGEP1_64(byte_, head_arg_,
                                          static_cast<std::uint64_t>(words) * sizeof(Decoded));
  }
  /// Base and constant offset of a pointer.
  std::pair<Value*, std::int64_t> split(Value* pointer) const {
    APInt offset(64, 0);
    Value* const base = pointer->stripAndAccumulateConstantOffsets(layout_, offset, true);
    return {base, offset.getSExtValue()};
  }
  /// Words from the head of a known Decoded*; and is it one that is jumped to, out of the stretch?
  Optional<std::ptrdiff_t> place_of(Value* pointer, bool& arrives) const {
    const auto [base, offset] = split(pointer);
    if (base != head_arg_) return None;
    arrives = offset & 1;
    return (offset - arrives) / static_cast<std::int64_t>(sizeof(Decoded));
  }
  std::size_t index_of(const Item& item) const { return static_cast<std::size_t>(&item - items_.data()); }
  /// Which item of a frame is at a place; null: none.
  const Item* find(std::ptrdiff_t place, int frame) const {
    const auto found = index_.find({frame, place});
    return found == index_.end() ? nullptr : &items_[found->second];
  }
  /// Most cycles from the beginning of this instruction to the beginning of the last one of its section; a
  /// return is not run when something comes right behind it.
  int span_from(const Item& from) const {
    int sum = 0, most = 0;
    for (const Item* i = &from; i <= &items_.back() && sections_[index_of(*i)] == sections_[index_of(from)];
         ++i) {
      most = std::max<int>(most, sum + (i->returns ? kInterruptReturnCycles : 0));
      sum += i->most_cycles;
    }
    return most;
  }
  /// Is there time for the section from an instruction on?
  Value* is_in_time(const Item& from) {
    Value* const last =
        ir_.CreateAdd(ir_.CreateLoad(long_, field(&cpu_.now, long_)), ir_.getInt64(span_from(from)));
    return ir_.CreateICmpSLT(last, ir_.CreateLoad(long_, field(&cpu_.deadline, long_)));
  }
  /// ... and does no DO loop end in the stretch?
  Value* fits(const Item& from) {
    Value* all = is_in_time(from);
    Value* const loop_end = ir_.CreateLoad(long_, field(&cpu_.loop_end, long_));
    for (const auto& [begin, end] : pieces_) {
      Value* const beyond = ir_.CreateSub(loop_end, ir_.CreatePtrToInt(place(begin), long_));
      const auto bytes = static_cast<std::uint64_t>(end - begin) * sizeof(Decoded);
      all = ir_.CreateAnd(all, ir_.CreateICmpUGE(beyond, ir_.getInt64(bytes)));
    }
    return all;
  }

  Semantics& semantics_;
  const Cpu& cpu_;
  const std::vector<Item>& items_;
  LLVMContext& context_;
  const DataLayout& layout_;
  IRBuilder<> ir_;
  Type *byte_, *long_;
  Function* function_;
  Value *cpu_arg_, *head_arg_;
  std::map<std::pair<int, std::ptrdiff_t>, std::size_t> index_;  // by frame and place
  std::vector<int> sections_;                                    // of the items: time is checked for each
  std::set<std::pair<std::ptrdiff_t, std::ptrdiff_t>> pieces_;   // places: begin and end
  std::vector<BasicBlock*> blocks_;
  std::vector<AllocaInst*> backs_;  // of the frames: program address to which they return
  WeakTrackingVH return_address_;   // ... to which the instruction returns that is being put
  BasicBlock* exit_;                // to where the interpreter goes on
  PHINode* exit_at_;
  // ... beyond the stretch, where jumps to a place are counted: by a jump, straight on, or by a return
  struct Way {
    const char* name;
    BasicBlock* block;
    PHINode* where;  // words from the head; of a return, a program address
  };
  std::array<Way, 3> ways_;
  AllocaInst* left_ = nullptr;  // something was called that may have changed the deadline
  bool may_leave_ = false;      // ... by the instruction that is being put
  bool may_loop_ = false;       // ... or have begun a DO loop
  std::vector<Effect> effects_;
  // where the interpreter's function runs in an instruction's stead, from its beginning, and the stretch ends
  struct Aside {
    const Item* item;
    BasicBlock *first, *block;
  };
  std::vector<Aside> asides_;
  bool takes_long_ = false;  // more than Item::most_cycles
  std::set<const BasicBlock*> live_;
  // loads and stores of the state that is kept apart, and which operand is the pointer
  std::vector<std::pair<Instruction*, unsigned>> accesses_;
  // what stores write, and what calls leave as the core has it
  std::map<const Instruction*, Hot::Fields> writes_, settles_;
  // fields that are not as the core has them: where blocks begin, and before calls
  std::map<const BasicBlock*, Hot::Fields> unsaved_;
  std::map<const Instruction*, Hot::Fields> unsaved_before_;
  std::ptrdiff_t end_ = 0;  // place behind the stretch itself
};

}  // namespace dspic::translate
