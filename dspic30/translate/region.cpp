// SPDX-License-Identifier: MIT
#include "dspic30/translate/region.h"

#include <llvm/ADT/MapVector.h>
#include <llvm/Analysis/InstructionSimplify.h>
#include <llvm/Analysis/ValueTracking.h>
#include <llvm/IR/IRBuilder.h>
#include <llvm/IR/InstIterator.h>
#include <llvm/IR/IntrinsicInst.h>
#include <llvm/IR/LegacyPassManager.h>
#include <llvm/Pass.h>
#include <llvm/Transforms/InstCombine/InstCombine.h>
#include <llvm/Transforms/Scalar.h>
#include <llvm/Transforms/Utils/BasicBlockUtils.h>
#include <llvm/Transforms/Utils/Cloning.h>
#include <llvm/Transforms/Utils/Local.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <set>

#include "dspic30/translate/hot_fields.h"
#include "dspic30/translate/machine_code.h"
#include "dspic30/translate/outside_values.h"

namespace dspic::translate {

namespace {

using namespace llvm;

constexpr StringLiteral kOffset = "_ZN5dspic3Cpu6offsetEPKNS_7DecodedEi",
                        kJump = "_ZN5dspic3Cpu4jumpEjPKNS_7DecodedE",
                        kCallTo = "_ZN5dspic3Cpu7call_toEjPKNS_7DecodedEj",
                        kReturnTo = "_ZN5dspic3Cpu9return_toEjPKNS_7DecodedE",
                        kRead = "_ZN5dspic3Cpu14read_elsewhereEjj",
                        kWrite = "_ZN5dspic3Cpu15write_elsewhereEjjj",
                        kModify = "_ZN5dspic3Cpu16modify_elsewhereEjjjj",
                        kTrap = "_ZN5dspic3Cpu4trapENS_4TrapE",
                        kSpecial = "_ZN5dspic3Cpu15special_pointerEjiib",
                        kPsvCost = "_ZN5dspic3Cpu8psv_costEv";

// the files' bitcode may have types of its own for one class, and then calls through a cast
StringRef name_of(const CallBase& call) {
  const auto* const callee = dyn_cast<Function>(call.getCalledOperand()->stripPointerCasts());
  return callee ? callee->getName() : StringRef();
}
bool is_jump(StringRef name) {
  return name == kOffset || name == kJump || name == kCallTo || name == kReturnTo;
}
bool is_real_call(const Instruction& i) {
  return isa<CallInst>(i) && (!isa<IntrinsicInst>(i) || isa<MemIntrinsic>(i));
}
bool is_access(const CallInst& call) {
  const StringRef name = name_of(call);
  return name == kRead || name == kWrite || name == kModify;
}
/// Address that is read, written or modified elsewhere than in RAM, if it is known.
const ConstantInt* address_in(const CallInst& call) {
  return is_access(call) ? dyn_cast<ConstantInt>(call.getArgOperand(1)) : nullptr;
}
/// Of no more than the clock: registers of peripherals, not those of the core.
bool is_of_peripheral(const CallInst& call) {
  const ConstantInt* const address = address_in(call);
  return address && address->getZExtValue() > sfr("DISICNT") + 1 && address->getZExtValue() < kSfrBytes;
}
/// Seldom called, as RAM is what pointers point to.
bool is_beyond_ram(const CallInst& call) {
  const StringRef name = name_of(call);
  return (is_access(call) && !address_in(call)) || name == kTrap || name == kSpecial;
}

// most cycles between two looks at the time: what is left of them before something happens is interpreted
constexpr int kSection = 16;
constexpr std::ptrdiff_t kGap = 16;  // words that were not met, within a piece

// --- one stretch ----------------------------------------------------------------------------------------

class Maker {
 public:
  Maker(Semantics& semantics, const Cpu& cpu, const std::vector<Item>& items, const std::string& name);
  ~Maker() {
    if (function_) function_->eraseFromParent();
  }
  std::unique_ptr<Module> make();

 private:
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
  void find_effects(const Item& item, BasicBlock* first);
  void leave(const Item& item, BasicBlock* block, Value* next);
  void leave_by_return(const Item& item, BasicBlock* block);
  void leave_by_answer(const Item& item, BasicBlock* block);
  BasicBlock* edge(const Item& item, Value* next, int frame);
  BasicBlock* passed(const Item& item);
  Value* jump_to(std::ptrdiff_t place, int frame);
  bool keep_state();
  std::array<BasicBlock*, 4> exits() const { return {exit_, ways_[0].block, ways_[1].block, ways_[2].block}; }
  void optimise();
  std::unique_ptr<Module> moved_out();

  /// What runs an instruction in the interpreter's stead, by its name in MachineCode::Address.
  static std::string alone(const Item& item) { return item.is_host ? kHost : interpreter(item.word); }
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
  std::vector<AllocaInst*> backs_;   // of the frames: program address to which they return
  Value* return_address_ = nullptr;  // ... to which the instruction returns that is being put
  BasicBlock* exit_;                 // to where the interpreter goes on
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
  // calls, and stores to the deadline, of the instruction at a place
  struct Effect {
    WeakVH what;
    const Item* item;
    enum Scope { All, ClockOnly, HostCall, Routine } scope;  // what is put back before it, taken behind it
  };
  std::vector<Effect> effects_;
  // where the interpreter's function runs in an instruction's stead, from its beginning, and the stretch ends
  struct Aside {
    const Item* item;
    BasicBlock *first, *block;
  };
  std::vector<Aside> asides_;
  bool takes_long_ = false;  // more than Item::most_cycles
  std::set<const BasicBlock*> live_;
  std::ptrdiff_t end_ = 0;  // place behind the stretch itself
  bool goes_back_ = false;
};

Maker::Maker(Semantics& semantics, const Cpu& cpu, const std::vector<Item>& items, const std::string& name)
    : semantics_(semantics),
      cpu_(cpu),
      items_(items),
      context_(semantics.module->getContext()),
      layout_(semantics.module->getDataLayout()),
      ir_(context_),
      byte_(Type::getInt8Ty(context_)),
      long_(Type::getInt64Ty(context_)) {
  Type* const pointer = byte_->getPointerTo();
  function_ = Function::Create(FunctionType::get(pointer, {pointer, pointer}, false),
                               GlobalValue::ExternalLinkage, name, *semantics.module);
  function_->setDoesNotThrow();
  cpu_arg_ = function_->getArg(0);
  head_arg_ = function_->getArg(1);
  int cycles = 0;
  for (const Item& item : items_) {
    cycles += item.most_cycles;
    const bool is_new = !sections_.empty() && cycles > kSection;
    if (is_new) cycles = item.most_cycles;
    sections_.push_back(sections_.empty() ? 0 : sections_.back() + is_new);
    index_[{item.frame, item.place}] = blocks_.size();
    if (item.frame == 0) end_ = item.place + item.words;
    blocks_.push_back(BasicBlock::Create(context_));
  }
  for (const Item& item : items_) {
    const std::ptrdiff_t end = item.place + item.words;
    const auto goes_on = std::find_if(pieces_.begin(), pieces_.end(), [&](const auto& piece) {
      return item.place >= piece.first && item.place <= piece.second + kGap;
    });
    std::pair<std::ptrdiff_t, std::ptrdiff_t> piece{item.place, end};
    if (goes_on != pieces_.end()) {
      piece = {goes_on->first, std::max(goes_on->second, end)};
      pieces_.erase(goes_on);
    }
    pieces_.insert(piece);
  }
  exit_ = BasicBlock::Create(context_, "exit");
  exit_at_ = PHINode::Create(pointer, 8, "", exit_);
  for (std::size_t i = 0; i < ways_.size(); ++i) {
    BasicBlock* const block = BasicBlock::Create(context_);
    ways_[i] = {i == 0   ? kArrive
                : i == 1 ? kGoOn
                         : kReturn,
                block, PHINode::Create(ir_.getInt32Ty(), 8, "", block)};
  }
}

std::unique_ptr<Module> Maker::make() {
  put_entry();
  for (const Item& item : items_)
    if (!put_item(item)) return nullptr;
  for (BasicBlock* block : exits()) function_->getBasicBlockList().push_back(block);
  for (const Aside& aside : asides_) function_->getBasicBlockList().push_back(aside.block);
  // whoever called counts the head's cycles
  const auto pass = [&](int cycles) {
    Value* const now = field(&cpu_.now, long_);
    ir_.CreateStore(ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.getInt64(cycles)), now);
  };
  ir_.SetInsertPoint(exit_);
  ir_.CreateRet(exit_at_);
  for (const Way& way : ways_) {
    ir_.SetInsertPoint(way.block);
    ir_.CreateRet(called(way.name, {cpu_arg_, head_arg_, way.where}));
  }
  for (const Aside& aside : asides_) {
    ir_.SetInsertPoint(aside.block);
    ir_.CreateUnreachable();
  }
  removeUnreachableBlocks(*function_);
  for (BasicBlock& block : *function_) live_.insert(&block);
  if (!keep_state()) return nullptr;
  for (BasicBlock* block : exits()) {
    if (!live_.count(block)) continue;
    ir_.SetInsertPoint(&*std::find_if(block->begin(), block->end(), [](const Instruction& i) {
      return i.isTerminator() || is_real_call(i);
    }));
    pass(-items_[0].decoded.cycles);
  }
  for (const Aside& aside : asides_) {
    if (!live_.count(aside.block)) continue;
    Instruction* const end = aside.block->getTerminator();
    ir_.SetInsertPoint(end);
    Value* const d = place(aside.item->place);
    ir_.CreateStore(d, field(&cpu_.at, byte_->getPointerTo()));
    CallInst* const next = called(alone(*aside.item), {cpu_arg_, d});
    pass(aside.item->decoded.cycles - items_[0].decoded.cycles);
    ir_.CreateRet(next);
    end->eraseFromParent();
  }
  optimise();
  return moved_out();
}

void Maker::put_entry() {
  BasicBlock* const entry = BasicBlock::Create(context_, "entry", function_);
  BasicBlock* const plain = BasicBlock::Create(context_, "plain", function_);
  ir_.SetInsertPoint(entry);
  left_ = ir_.CreateAlloca(ir_.getInt1Ty());
  ir_.CreateStore(ir_.getFalse(), left_);
  for (const Item& item : items_) {
    const auto frames = static_cast<std::size_t>(std::max(item.frame, item.callee)) + 1;
    while (backs_.size() < frames) backs_.push_back(ir_.CreateAlloca(ir_.getInt32Ty()));
  }
  ir_.CreateCondBr(fits(items_[0]), blocks_[0], plain);
  ir_.SetInsertPoint(plain);
  ir_.CreateRet(called(alone(items_[0]), {cpu_arg_, head_arg_}));
}

// --- an instruction -------------------------------------------------------------------------------------

bool Maker::put_item(const Item& item) {
  BasicBlock* const first = blocks_[index_of(item)];
  function_->getBasicBlockList().push_back(first);
  ir_.SetInsertPoint(first);
  if (item.is_last) {
    ir_.CreateBr(aside(item, first));
    return true;
  }
  Value* const d = place(item.place);
  Function* const own = item.is_host ? nullptr : semantics_.of(item.word);
  CallInst* call;
  if (own) {
    const FunctionType* const type = own->getFunctionType();
    call = ir_.CreateCall(own, {ir_.CreateBitCast(cpu_arg_, type->getParamType(0)),
                                ir_.CreateBitCast(d, type->getParamType(1))});
  } else {  // not by Decoded::run, which at the head is this very stretch
    call = called(item.is_host ? kHost : kAlone, {cpu_arg_, d});
  }
  ir_.CreateRet(ir_.CreateBitCast(call, byte_->getPointerTo()));
  if (own) {
    if (!inlined(call)) return false;
    fold(item, first);
    keep_jumps(item, first);
    put_costs(item, first);
    take_saved(first);
  }
  find_effects(item, first);
  for (BasicBlock* block : blocks_from(first)) {
    auto* const back = dyn_cast<ReturnInst>(block->getTerminator());
    if (!back) continue;
    Value* const next = back->getReturnValue();
    back->eraseFromParent();
    if (item.returns && own)
      leave_by_return(item, block);
    else if (item.routine)
      leave_by_answer(item, block);
    else
      leave(item, block, next);
    break;
  }
  return true;
}

BasicBlock* Maker::aside(const Item& item, BasicBlock* first) {
  if (asides_.empty() || asides_.back().item != &item)
    asides_.push_back({&item, first, BasicBlock::Create(context_)});
  return asides_.back().block;
}

// with all that it calls, as far as that is bitcode; but not jumps
bool Maker::inlined(CallInst* call) {
  SmallVector<CallBase*, 8> work{call};
  while (!work.empty()) {
    CallBase* const c = work.pop_back_val();
    Function* const callee = c->getCalledFunction();
    if (!callee || callee->isIntrinsic() || (is_jump(callee->getName()) && c != call)) continue;
    if (callee->isMaterializable() && callee->materialize()) return false;
    if (callee->isDeclaration()) continue;
    InlineFunctionInfo info;
    if (!InlineFunction(*c, info).isSuccess()) return false;
    work.append(info.InlinedCallSites.begin(), info.InlinedCallSites.end());
  }
  return true;
}

std::vector<BasicBlock*> Maker::blocks_from(BasicBlock* first) {
  std::vector<BasicBlock*> all;
  for (auto block = first->getIterator(); block != function_->end(); ++block) all.push_back(&*block);
  return all;
}

// what the Decoded says is known, and so is where plain RAM begins
void Maker::fold(const Item& item, BasicBlock* first) {
  const auto* const bytes = reinterpret_cast<const unsigned char*>(&item.decoded);
  const auto known = [&](const Instruction& i) -> Constant* {
    const auto* const load = dyn_cast<LoadInst>(&i);
    if (!load || !load->getType()->isIntegerTy()) return nullptr;
    const auto [base, all] = split(const_cast<Value*>(load->getPointerOperand()));
    if (base == cpu_arg_ && static_cast<std::uint64_t>(all) == offset_of(cpu_, &cpu_.plain_start))
      return ConstantInt::get(load->getType(), cpu_.plain_start);
    const std::int64_t offset = all - item.place * static_cast<std::int64_t>(sizeof(Decoded));
    const std::uint64_t size = layout_.getTypeStoreSize(load->getType());
    if (base != head_arg_ || offset < 8 || offset + size > sizeof(Decoded)) return nullptr;
    std::uint64_t value = 0;
    std::memcpy(&value, bytes + offset, size);
    return ConstantInt::get(load->getType(), value);
  };
  for (bool changed = true; changed;) {
    changed = false;
    for (BasicBlock* block : blocks_from(first)) {
      for (Instruction& i : make_early_inc_range(*block)) {
        Value* value = known(i);
        if (!value) value = SimplifyInstruction(&i, {layout_});
        if (value && value != &i && !i.use_empty()) i.replaceAllUsesWith(value);
        if (isInstructionTriviallyDead(&i)) i.eraseFromParent();
      }
      changed |= ConstantFoldTerminator(block, true);
    }
    drop_dead(first);
    for (BasicBlock* block : blocks_from(first))
      if (block != first) MergeBlockIntoPredecessor(block);
  }
}

void Maker::drop_dead(BasicBlock* first) {
  SmallPtrSet<BasicBlock*, 16> live{first};
  SmallVector<BasicBlock*, 16> work{first}, dead;
  while (!work.empty())
    for (BasicBlock* next : successors(work.pop_back_val()))
      if (live.insert(next).second) work.push_back(next);
  for (BasicBlock* block : blocks_from(first))
    if (!live.count(block)) dead.push_back(block);
  DeleteDeadBlocks(dead);
}

// a jump within the stretch is no call; one out of it is made at the end
void Maker::keep_jumps(const Item& item, BasicBlock* first) {
  std::vector<CallInst*> jumps;
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : *block)
      if (auto* const call = dyn_cast<CallInst>(&i); call && is_jump(name_of(*call))) jumps.push_back(call);
  for (CallInst* jump : jumps) {
    ir_.SetInsertPoint(jump);
    Value* where = place(item.place);
    if (name_of(*jump) == kReturnTo) {
      return_address_ = jump->getArgOperand(1);
    } else if (!item.routine) {
      if (item.callee) ir_.CreateStore(jump->getArgOperand(3), backs_[static_cast<std::size_t>(item.callee)]);
      const bool is_near = name_of(*jump) == kOffset;
      const std::ptrdiff_t to =
          is_near ? item.place + cast<ConstantInt>(jump->getArgOperand(2))->getSExtValue() : item.target;
      where = jump_to(to, item.callee ? item.callee : item.frame);
    }
    jump->replaceAllUsesWith(ir_.CreateBitCast(where, jump->getType()));
    jump->eraseFromParent();
  }
}

// as Cpu::arrive(), unless it leads out of the stretch
Value* Maker::jump_to(std::ptrdiff_t to, int frame) {
  const Item* const target = find(to, frame);
  if (!target) return ir_.CreateConstInBoundsGEP1_64(byte_, place(to), 1);
  if (const int lead = target->decoded.lead) {
    Value* const now = field(&cpu_.now, long_);
    ir_.CreateStore(ir_.CreateSub(ir_.CreateLoad(long_, now), ir_.getInt64(lead)), now);
  }
  return place(to);
}

// of a read through the PSV window
void Maker::put_costs(const Item& item, BasicBlock* first) {
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : make_early_inc_range(*block)) {
      auto* const call = dyn_cast<CallInst>(&i);
      if (!call || name_of(*call) != kPsvCost) continue;
      call->replaceAllUsesWith(ConstantInt::get(call->getType(), item.decoded.psv));
      call->eraseFromParent();
    }
}

// what handlers save and give back is read and written here
void Maker::take_saved(BasicBlock* first) {
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : make_early_inc_range(*block)) {
      auto* const call = dyn_cast<CallInst>(&i);
      const ConstantInt* const address = call ? address_in(*call) : nullptr;
      const Cpu::Saved saved =
          address ? Cpu::saved_register(static_cast<unsigned>(address->getZExtValue())) : Cpu::Saved{};
      if (!saved.word || name_of(*call) == kModify) continue;
      const bool reads = name_of(*call) == kRead;
      const auto* const bits = dyn_cast<ConstantInt>(call->getArgOperand(reads ? 2 : 3));
      if (!bits || bits->getZExtValue() != 16) continue;
      ir_.SetInsertPoint(call);
      Type* const word = ir_.getInt16Ty();
      Value* const place = field(&(cpu_.*saved.word), word);
      if (reads)
        call->replaceAllUsesWith(ir_.CreateZExt(ir_.CreateLoad(word, place), call->getType()));
      else
        ir_.CreateStore(ir_.CreateTrunc(ir_.CreateAnd(call->getArgOperand(2), saved.bits), word), place);
      call->eraseFromParent();
    }
}

// What leaves RAM leaves the stretch: the instruction is run anew, aside. But where an instruction names its
// register, or calls something else, that is called from here.
void Maker::find_effects(const Item& item, BasicBlock* first) {
  may_leave_ = false;
  std::vector<CallInst*> beyond;
  bool others = false;
  const auto deadline = static_cast<std::int64_t>(offset_of(cpu_, &cpu_.deadline));
  for (BasicBlock* block : blocks_from(first))
    for (Instruction& i : *block) {
      if (is_real_call(i)) {
        auto* const call = cast<CallInst>(&i);
        if (is_beyond_ram(*call))
          beyond.push_back(call);
        else
          others = true;
        effects_.push_back({call, &item,
                            item.is_host              ? Effect::HostCall
                            : is_of_peripheral(*call) ? Effect::ClockOnly
                                                      : Effect::All});
        may_leave_ = true;
      } else if (isa<StoreInst>(i) && split(i.getOperand(1)) == std::make_pair(cpu_arg_, deadline)) {
        effects_.push_back({&i, &item, Effect::All});
        may_leave_ = true;
      }
    }
  if (others || beyond.empty()) return;
  for (CallInst* call : beyond) {
    BasicBlock* const block = call->getParent();
    block->splitBasicBlock(call);
    block->getTerminator()->setSuccessor(0, aside(item, first));
  }
  drop_dead(first);
  may_leave_ = false;
}

// --- on to the next one ---------------------------------------------------------------------------------

// `block`, which has no end yet, goes where `next` says
void Maker::leave(const Item& item, BasicBlock* block, Value* next) {
  const int frame = item.callee ? item.callee : item.frame;
  bool arrives = false;
  if (place_of(next, arrives)) {
    BranchInst::Create(edge(item, next, frame), block);
    return;
  }
  auto* const phi = dyn_cast<PHINode>(next->stripPointerCasts());
  const auto is_bare = [&] {
    return std::all_of(block->begin(), block->end(), [&](Instruction& i) {
      return &i == phi || (isa<BitCastInst>(i) && i.getOperand(0) == phi);
    });
  };
  if (phi && phi->getParent() == block && is_bare()) {
    std::vector<std::pair<BasicBlock*, Value*>> ways;
    for (unsigned i = 0; i < phi->getNumIncomingValues(); ++i)
      ways.emplace_back(phi->getIncomingBlock(i), phi->getIncomingValue(i));
    for (const auto& [from, value] : ways) {
      Instruction* const end = from->getTerminator();
      if (end->getNumSuccessors() == 1) {
        end->eraseFromParent();
        leave(item, from, value);
      } else {
        end->replaceSuccessorWith(block, edge(item, value, frame));
      }
    }
    block->dropAllReferences();
    block->eraseFromParent();
    return;
  }
  // behind a REPEAT, or a function that was called, the next one is likely
  const Row& row = *find_row(item.word);
  const bool repeats = row.id == Insn::Repeat_lit14 || row.id == Insn::Repeat_Wn;
  ir_.SetInsertPoint(block);
  Value* const likely = place(item.place + item.words + repeats);
  Value* const same = ir_.CreateICmpEQ(ir_.CreateBitCast(next, likely->getType()), likely);
  Instruction* const end = ir_.CreateCondBr(same, exit_, exit_);
  end->setSuccessor(0, edge(item, likely, frame));
  end->setSuccessor(1, edge(item, next, frame));
}

// on behind the call, if that is where the stack leads
void Maker::leave_by_return(const Item& item, BasicBlock* block) {
  BasicBlock* const out = passed(item);
  ir_.SetInsertPoint(out);
  ir_.CreateBr(ways_[2].block);
  ways_[2].where->addIncoming(return_address_, out);
  if (item.caller < 0) {
    BranchInst::Create(out, block);
    return;
  }
  const Item& caller = items_[static_cast<std::size_t>(item.caller)];
  BasicBlock* const back = BasicBlock::Create(context_, "", function_);
  ir_.SetInsertPoint(back);
  Value* const where = jump_to(caller.place + caller.words, caller.frame);
  BranchInst::Create(edge(item, where, caller.frame), back);
  ir_.SetInsertPoint(block);
  Value* const expected = ir_.CreateLoad(ir_.getInt32Ty(), backs_[static_cast<std::size_t>(item.frame)]);
  ir_.CreateCondBr(ir_.CreateICmpEQ(return_address_, expected), back, out);
}

// the answer of the routine that is called, or else a jump there
void Maker::leave_by_answer(const Item& item, BasicBlock* block) {
  BasicBlock* const done = BasicBlock::Create(context_, "", function_);
  BasicBlock* const out = passed(item);
  ir_.SetInsertPoint(out);
  ir_.CreateBr(ways_[0].block);
  ways_[0].where->addIncoming(ir_.getInt32(static_cast<std::uint32_t>(item.target)), out);
  ir_.SetInsertPoint(block);
  Value* const now = field(&cpu_.now, long_);
  Value* const begin =
      ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.getInt64(item.decoded.cycles + item.way));
  FunctionType* const no_type = FunctionType::get(ir_.getVoidTy(), false);
  Value* const routine = ir_.CreateBitCast(
      semantics_.module->getOrInsertFunction(known_routine(index_of(item)), no_type).getCallee(),
      byte_->getPointerTo());
  const std::array<Value*, 4> arguments = {cpu_arg_, place(item.routine_place), routine, begin};
  FunctionType* const type = FunctionType::get(
      long_, {arguments[0]->getType(), arguments[1]->getType(), arguments[2]->getType(), long_}, false);
  CallInst* const cycles = ir_.CreateCall(semantics_.module->getOrInsertFunction(kAnswered, type), arguments);
  effects_.push_back({cycles, &item, Effect::Routine});
  ir_.CreateCondBr(ir_.CreateICmpEQ(cycles, ir_.getInt64(0)), out, done);
  // behind its RETURN
  ir_.SetInsertPoint(done);
  ir_.CreateStore(ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.CreateAdd(cycles, ir_.getInt64(item.way))),
                  now);
  Value* const where = jump_to(item.place + item.words, item.frame);
  takes_long_ = true;
  BranchInst::Create(edge(item, where, item.frame), done);
  takes_long_ = false;
}

// a block in which the instruction's time passes
BasicBlock* Maker::passed(const Item& item) {
  BasicBlock* const begin = BasicBlock::Create(context_, "", function_);
  ir_.SetInsertPoint(begin);
  Value* const now = field(&cpu_.now, long_);
  ir_.CreateStore(ir_.CreateAdd(ir_.CreateLoad(long_, now), ir_.getInt64(item.decoded.cycles)), now);
  return begin;
}

// the instruction's time passes; then the next one, unless something may happen before it
BasicBlock* Maker::edge(const Item& item, Value* next, int frame) {
  BasicBlock* const begin = passed(item);
  bool arrives = false;
  const Optional<std::ptrdiff_t> to = place_of(next, arrives);
  if (to && (arrives || (frame == 0 && *to == end_))) {
    const Way& way = ways_[arrives ? 0 : 1];
    ir_.CreateBr(way.block);
    way.where->addIncoming(ir_.getInt32(static_cast<std::uint32_t>(*to)), begin);
    return begin;
  }
  const Item* const target = to ? find(*to, frame) : nullptr;
  Value* const pointer = to ? place(*to) : ir_.CreateBitCast(next, byte_->getPointerTo());
  if (!target) {
    ir_.CreateBr(exit_);
    exit_at_->addIncoming(pointer, begin);
    return begin;
  }
  BasicBlock* const first = blocks_[index_of(*target)];
  const bool is_back = target <= &item;
  const bool begins_section =
      is_back || takes_long_ || sections_[index_of(*target)] != sections_[index_of(item)];
  goes_back_ |= is_back;
  if (!begins_section && !may_leave_) {
    ir_.CreateBr(first);
    return begin;
  }
  BasicBlock* const check = BasicBlock::Create(context_, "", function_);
  if (begins_section)
    ir_.CreateBr(check);
  else
    ir_.CreateCondBr(ir_.CreateLoad(ir_.getInt1Ty(), left_), check, first);
  ir_.SetInsertPoint(check);
  ir_.CreateStore(ir_.getFalse(), left_);
  // what comes there again and again may begin there
  const bool is_entry = !is_back && frame == 0;
  Value* const exit_pointer = place(*to);
  ir_.CreateCondBr(may_leave_ ? fits(*target) : is_in_time(*target), first,
                   is_entry ? ways_[1].block : exit_);
  if (is_entry)
    ways_[1].where->addIncoming(ir_.getInt32(static_cast<std::uint32_t>(*to)), check);
  else
    exit_at_->addIncoming(exit_pointer, check);
  return begin;
}

// --- state ----------------------------------------------------------------------------------------------

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
               (effect.scope == Effect::HostCall && hot.is_of_call(f)) ||
               (effect.scope == Effect::Routine && !hot.is_flag(f));
      };
      for (const Hot::Field& f : hot.fields)
        if (!f.writers.empty() && sees(f)) put_back(f);
      ir_.CreateStore(place(effect.item->place), field(&cpu_.at, byte_->getPointerTo()));
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

}  // namespace

std::unique_ptr<Module> translate(Semantics& semantics, const Cpu& cpu, const std::vector<Item>& items,
                                  const std::string& name) {
  return Maker(semantics, cpu, items, name).make();
}

}  // namespace dspic::translate
